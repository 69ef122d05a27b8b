#include "fluid_solver/ranks/spread_fluid.hpp"

#include "common/error/failure.hpp"
#include "fluid_solver/ranks/orders.hpp"

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

}  // namespace

SpreadFluid::SpreadFluid(const Parameters& parameters, const Scene& scene, MPI_Comm communicator)
    : WeaklyCompressible(parameters, scene),
      communicator_(communicator),
      ranks_of_parts_(communicator),
      part_(static_cast<const WeaklyCompressible&>(*this)) {
  part_.spread_over(ranks_of_parts_);
}

void SpreadFluid::collect() const {
  if (!behind_) return;
  give(communicator_, {.action = Action::collect});
  part_.collect(&whole_);
  behind_ = listed_ = false;
}

void SpreadFluid::advance(double dt) {
  give(communicator_, {.action = Action::advance, .value = dt});
  part_.advance(dt);
  ++state_.steps_since_look;
  behind_ = true;
}

void SpreadFluid::check(double time) const {
  give(communicator_, {.action = Action::check, .value = time});
  if (!any_fails(ranks_of_parts_, part_, time)) return;
  collect();
  WeaklyCompressible::check(time);  // which finds the same particle as in one process
}

Frame SpreadFluid::frame() const {
  collect();
  return WeaklyCompressible::frame();
}

std::optional<Frame> SpreadFluid::walls() const {
  collect();
  return WeaklyCompressible::walls();
}

std::vector<Observation> SpreadFluid::observe() const {
  collect();
  return WeaklyCompressible::observe();
}

void SpreadFluid::record(double time) {
  collect();
  if (!listed_) list_anew();
  listed_ = true;
  WeaklyCompressible::record(time);
}

void SpreadFluid::save() {
  give(communicator_, {.action = Action::save});
  part_.save();
  WeaklyCompressible::save();
}

void SpreadFluid::restore() {
  give(communicator_, {.action = Action::restore});
  part_.restore();
  WeaklyCompressible::restore();
  behind_ = true;
}

void SpreadFluid::write_state(std::ostream& stream) const {
  collect();
  WeaklyCompressible::write_state(stream);
}

void SpreadFluid::read_state(std::istream& stream) {
  const std::string state(std::istreambuf_iterator<char>(stream), {});
  give(communicator_, {.action = Action::read_state, .with = state});
  std::istringstream of_part(state, std::ios::binary), of_whole(state, std::ios::binary);
  part_.read_state(of_part);
  WeaklyCompressible::read_state(of_whole);
  listed_ = true;
}

void SpreadFluid::attach(const Interface& interface, bool rigid) {
  give(communicator_, {.action = Action::attach, .with = packed_interface(interface, rigid)});
  part_.attach(interface, rigid);
  WeaklyCompressible::attach(interface, rigid);
}

void SpreadFluid::begin_window(const InterfaceMotion& motion, double dt) {
  give(communicator_,
       {.action = Action::begin_window,
        .value = dt,
        .with = packed(motion.position, motion.velocity, motion.impulse, motion.work_of_impulse)});
  part_.begin_window(motion, dt);
  behind_ = true;
}

InterfaceLoad SpreadFluid::take_load() {
  give(communicator_, {.action = Action::take_load});
  InterfaceLoad load = part_.take_load();
  collect();  // for the energies that go with it
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
        part = std::make_unique<WeaklyCompressible>(parameters, scene);
        part->spread_over(*ranks);
        break;
      }
      case Action::read_state: {
        std::istringstream state(order.with, std::ios::binary);
        part->read_state(state);
        break;
      }
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
      case Action::collect:
        part->collect(nullptr);
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
