#include "fluid_solver/ranks/spread_fluid.hpp"

#include "common/error/failure.hpp"

namespace toryu::fluid {

namespace {

std::string packed_interface(const Interface& i, bool rigid) {
  return packed(i.id, i.position, i.volume, i.area_vector, i.mass, i.spacing, rigid);
}

void attach_packed(const std::string& text, FluidModel& part) {
  Interface i;
  bool rigid = false;
  unpack(text, i.id, i.position, i.volume, i.area_vector, i.mass, i.spacing, rigid);
  part.attach(i, rigid);
}

void begin_packed_window(const std::string& text, double dt, FluidModel& part) {
  InterfaceMotion motion;
  unpack(text, motion.position, motion.velocity, motion.impulse, motion.work_of_impulse);
  part.begin_window(motion, dt);
}

bool fails(const FluidModel& part, double time) {
  try {
    part.check(time);
  } catch (const PhysicsFailure&) {
    return true;
  }
  return false;
}

/// Whether any part fails.
bool any_fails(const Ranks& ranks, const FluidModel& part, double time) {
  return ranks.largest(fails(part, time) ? 1 : 0) > 0;
}

/// The whole is filled: the others may fill it too, for the case is right.
MPI_Comm have_it_filled(MPI_Comm communicator) {
  give(communicator, {.action = Action::fill});
  return communicator;
}

}  // namespace

SpreadFluid::SpreadFluid(const Parameters& parameters, const Scene& scene, MPI_Comm communicator)
    : WeaklyCompressible(parameters, scene),
      communicator_(have_it_filled(communicator)),
      ranks_of_parts_(communicator),
      part_(parameters, scene, Filled::walls_alone) {}

void SpreadFluid::together(const Order& order, const std::function<void()>& share) const {
  give(communicator_, order);
  end_all_if_it_fails(communicator_, share);
}

void SpreadFluid::hand_out() {
  if (handed_out_) return;
  spread(std::move(state_.fluid), begun());
  forget();
}

/// Makes parts of the `fluid`; those of a checkpoint are read after that.
void SpreadFluid::spread(Particles fluid, const Begun& begun) {
  handed_out_ = true;
  together({.action = Action::hand_out, .with = packed(begun)},
           [&] { part_.spread_over(ranks_of_parts_, begun, std::move(fluid)); });
}

void SpreadFluid::collect(Known wanted) const {
  if (known_ >= wanted) return;
  const bool all = wanted == Known::all;
  together({.action = Action::collect, .value = all ? 1.0 : 0.0}, [&] { part_.collect(&whole_, all); });
  known_ = wanted;
}

void SpreadFluid::forget() {
  if (known_ != Known::nothing) FluidModel::forget();
  known_ = Known::nothing;
}

double SpreadFluid::time_step_limit() const {
  return handed_out_ ? part_.time_step_limit() : WeaklyCompressible::time_step_limit();
}

std::string_view SpreadFluid::time_step_rule() const {
  return handed_out_ ? part_.time_step_rule() : WeaklyCompressible::time_step_rule();
}

void SpreadFluid::advance(double dt) {
  hand_out();
  forget();
  together({.action = Action::advance, .value = dt}, [&] { part_.advance(dt); });
  ++state_.steps_since_look;
  if (state_.surface_record) state_.surface_record->add(part_.surface_found(), dt);
}

void SpreadFluid::check(double time) const {
  bool any = !handed_out_;
  if (handed_out_)
    together({.action = Action::check, .value = time},
             [&] { any = any_fails(ranks_of_parts_, part_, time); });
  if (!any) return;
  collect(Known::reported);
  WeaklyCompressible::check(time);  // which finds the same particle as in one process
}

Frame SpreadFluid::frame() const {
  collect(Known::reported);
  return WeaklyCompressible::frame();
}

std::optional<Frame> SpreadFluid::walls() const {
  collect(Known::reported);
  return WeaklyCompressible::walls();
}

std::vector<Observation> SpreadFluid::observe() const {
  collect(Known::reported);
  return WeaklyCompressible::observe();
}

void SpreadFluid::watch(double time) {
  collect(Known::reported);
  WeaklyCompressible::watch(time);
}

Look SpreadFluid::look() {
  Look seen;
  hand_out();
  together({.action = Action::look}, [&] { seen = part_.look(); });
  return seen;
}

double SpreadFluid::density_of_packing() const {
  if (!handed_out_) return WeaklyCompressible::density_of_packing();
  double found = 0;
  together({.action = Action::pack}, [&] { found = part_.density_of_packing(); });
  return found;
}

void SpreadFluid::find_off_surface() {
  collect(Known::all);
  list_anew();
  WeaklyCompressible::find_off_surface();
}

void SpreadFluid::save() {
  hand_out();
  forget();
  together({.action = Action::save}, [&] { part_.save(); });
  WeaklyCompressible::save();
}

void SpreadFluid::restore() {
  together({.action = Action::restore}, [&] { part_.restore(); });
  WeaklyCompressible::restore();
  known_ = Known::nothing;
}

void SpreadFluid::write_state(std::ostream& stream) const {
  collect(Known::all);
  WeaklyCompressible::write_state(stream);
}

/// The whole comes first: what is wrong with the state is told by it alone.
void SpreadFluid::read_state(std::istream& stream) {
  const std::string state(std::istreambuf_iterator<char>(stream), {});
  std::istringstream of_part(state, std::ios::binary), of_whole(state, std::ios::binary);
  take_state(of_whole);
  if (!handed_out_) spread({}, {.largest = state_.largest, .start_volume = start_volume_});
  known_ = Known::all;
  forget();
  together({.action = Action::read_state, .with = state}, [&] { part_.read_state(of_part); });
}

void SpreadFluid::record_surface(const std::filesystem::path& out) {
  WeaklyCompressible::record_surface(out);
  together({.action = Action::find_surface}, [&] { part_.find_surface(); });
}

/// As `read_state`.
void SpreadFluid::attach(const Interface& interface, bool rigid) {
  WeaklyCompressible::attach(interface, rigid);
  together({.action = Action::attach, .with = packed_interface(interface, rigid)},
           [&] { part_.attach(interface, rigid); });
}

void SpreadFluid::begin_window(const InterfaceMotion& motion, double dt) {
  hand_out();
  forget();
  together({.action = Action::begin_window,
            .value = dt,
            .with = packed(motion.position, motion.velocity, motion.impulse, motion.work_of_impulse)},
           [&] { part_.begin_window(motion, dt); });
}

InterfaceLoad SpreadFluid::take_load() {
  InterfaceLoad load;
  together({.action = Action::take_load}, [&] { load = part_.take_load(); });
  collect(Known::reported);  // for the energies that go with it
  return load;
}

void follow(MPI_Comm communicator, const std::function<std::pair<Parameters, Scene>()>& read) {
  std::optional<ZoltanRanks> ranks;
  std::unique_ptr<WeaklyCompressible> part;
  while (true) {
    const Order order = take(communicator);
    switch (order.action) {
      case Action::fill: {
        ranks.emplace(communicator);
        const auto [parameters, scene] = read();
        part = std::make_unique<WeaklyCompressible>(parameters, scene, Filled::walls_alone);
        break;
      }
      case Action::hand_out: {
        FluidModel::Begun begun;
        unpack(order.with, begun);
        part->spread_over(*ranks, begun, {});
        break;
      }
      case Action::read_state: {
        std::istringstream state(order.with, std::ios::binary);
        part->read_state(state);
        break;
      }
      case Action::find_surface:
        part->find_surface();
        break;
      case Action::attach:
        attach_packed(order.with, *part);
        break;
      case Action::begin_window:
        begin_packed_window(order.with, order.value, *part);
        break;
      case Action::advance:
        part->advance(order.value);
        break;
      case Action::check:
        any_fails(*ranks, *part, order.value);
        break;
      case Action::look:
        part->look();
        break;
      case Action::collect:
        part->collect(nullptr, order.value > 0);
        break;
      case Action::pack:
        part->density_of_packing();
        break;
      case Action::take_load:
        part->take_load();
        break;
      case Action::save:
        part->save();
        break;
      case Action::restore:
        part->restore();
        break;
      case Action::end:
        return;
    }
  }
}

}  // namespace toryu::fluid
