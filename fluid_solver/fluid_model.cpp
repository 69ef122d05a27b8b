#include "fluid_solver/fluid_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/run/log.hpp"
#include "common/state/serialize.hpp"
#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/held_pressure.hpp"
#include "fluid_solver/interface_contact.hpp"
#include "fluid_solver/press_area.hpp"
#include "fluid_solver/work_piece.hpp"

namespace toryu::fluid {

namespace {

Kernel kernel_of(const Parameters& parameters) {
  if (parameters.kernel == KernelForm::wendland_c2) return WendlandC2(parameters.h());
  return CubicSpline(parameters.h());
}

}  // namespace

FluidModel::FluidModel(const Parameters& parameters, const Scene& scene, Filled filled)
    : parameters_(parameters.has_open_ends() ? with_layers(parameters) : parameters),
      scene_(scene),
      kernel_(kernel_of(parameters)),
      equation_of_state_{parameters.density, parameters.sound_speed, parameters.stiffness_exponent,
                         parameters.background_pressure ? parameters.background_pressure->pressure : 0.0},
      period_(scene, parameters.spacing, (1 + parameters.neighbour_skin) * 2 * parameters.h()),
      state_{.neighbours = Neighbours(2 * parameters.h(), parameters.neighbour_skin * 2 * parameters.h(),
                                      parameters.strip_width(), period_.shifts(), scene.geometry)} {
  state_.beyond_measured =
      beyond_measured(parameters, scene.geometry).has_value();  // it is told by who reads the case
  state_.run_watch.emplace(parameters.limits, parameters.sound_speed);
  if (!parameters.particle_shifting) state_.suction_watch.emplace(parameters.spacing, equation_of_state_);
  if (filled == Filled::all)
    fill_regions();
  else
    resize_fields(state_.fluid, lane_count);  // without values a field is absent
  if (parameters.has_open_ends())
    state_.open_ends.emplace(parameters, equation_of_state_).assign_layers(state_.fluid);
  fill_walls();
  check_overlaps();
  start_momentum_ = momentum();
  start_energy_ = energy();
  start_potential_ = potential_energy();
}

void FluidModel::save() {
  saved_ = state_;
  if (ranks_) ranks_->save();
}

void FluidModel::restore() {
  state_ = *saved_;
  if (ranks_) ranks_->restore();
}

void FluidModel::write_state(std::ostream& stream) const {
  write_states(stream, state_);
}

void FluidModel::take_state(std::istream& stream) {
  read_states(stream, state_);
  if (!state_.open_ends) return;
  resize_present_fields(state_.fluid, padded(state_.fluid.count));
  state_.open_ends->find(state_.fluid);
}

void FluidModel::read_state(std::istream& stream) {
  take_state(stream);
  if (ranks_)
    spread_over(*ranks_);
  else
    list_anew();
}

void FluidModel::list_anew() {
  state_.neighbours.rebuild(state_.fluid, state_.boundaries);
}

void FluidModel::attach(const Interface& interface, bool rigid) {
  if (rigid) rigid_interface_ = interface.position;
  MovingInterface motion(interface, reach() / parameters_.sound_speed);
  std::vector<Vec> positions;
  std::vector<Faces> faces;
  for (std::uint32_t k = 0; k < interface.size(); ++k) {
    const Vec x = vector_of(interface.position, k), move = period_.back_into_domain(x);
    if (!move.isZero(0)) motion.move_by_periods(k, move);
    positions.push_back(x + move);
    faces.push_back(faces_of(vector_of(interface.area_vector, k)));
  }
  refuse_in_layers(positions);
  Boundary boundary;
  boundary.name = "interface";
  boundary.force_on_fluid.of_part = ranks_;
  boundary.motion = std::move(motion);
  boundary.place(positions, interface.volume, parameters_.density, parameters_.strip_width());
  boundary.make_work_piece(faces);
  cover_faces(boundary, interface.spacing, state_.boundaries, parameters_.spacing, period_.shifts());
  leave_out_walls_in(boundary, interface.spacing);
  state_.boundaries.push_back(std::move(boundary));
  check_overlaps();
  state_.balance = EnergyBalance(powers());
}

std::vector<Observation> FluidModel::observe_beside_solid() {
  FluidModel::save();  // of this process alone: other ranks need not know
  FluidModel::attach({});
  std::vector<Observation> row = observe();
  FluidModel::restore();
  saved_.reset();
  return row;
}

MovingInterface& FluidModel::interface() {
  return std::get<MovingInterface>(state_.boundaries.back().motion);
}

void FluidModel::begin_window(const InterfaceMotion& motion, double dt) {
  Boundary& boundary = state_.boundaries.back();
  interface().begin_window(motion, state_.time, dt);
  boundary.move(state_.time);
  if (!rigid_interface_.empty()) boundary.orientation = rotation_between(rigid_interface_, motion.position);
  state_.contact_changed = state_.impedance_wanted = !motion.impulse.empty();
  if (std::all_of(motion.impulse.begin(), motion.impulse.end(), [](double J) { return J == 0; })) return;
  const GivenImpulse given = give_impulse(motion.impulse, state_.boundaries, state_.fluid, kernel_, ranks_);
  interface().note_impulse(given.not_given, given.received, given.work);
  boundary.impulse.total += given.received;
  boundary.work += given.work;
}

InterfaceLoad FluidModel::take_load() {
  InterfaceLoad load = interface().take_load();
  if (state_.impedance_wanted)
    load.impedance = impedance(state_.boundaries, state_.fluid, kernel_, parameters_.density,
                               parameters_.sound_speed, ranks_);
  return load;
}

void FluidModel::move_boundaries(double time) {
  for (Boundary& boundary : state_.boundaries) boundary.move(time);
}

void FluidModel::move_back_into_domain() {
  if (!period_.any()) return;
  Field gained(state_.fluid.x[0].size());
  for (std::size_t i = 0; i < state_.fluid.count; ++i) {
    const Vec x = at(state_.fluid.x, i);
    const Vec back = x + period_.back_into_domain(x);
    gained[i] = state_.fluid.m[i] * (potential(x) - potential(back));
    set(state_.fluid.x, i, back);
  }
  if (ranks_) gained = ranks_->of_whole(gained);
  for (const double value : gained) state_.potential_of_moves += value;
  for (Boundary& boundary : state_.boundaries) {
    auto* prescribed = std::get_if<PrescribedMotion>(&boundary.motion);
    auto* interface = std::get_if<MovingInterface>(&boundary.motion);
    for (std::size_t k = 0; k < boundary.count; ++k) {
      const Vec move = period_.back_into_domain(at(boundary.x, k));
      if (move.isZero(0)) continue;
      if (prescribed) prescribed->start[boundary.id[k]] += move;
      if (interface) interface->move_by_periods(boundary.id[k], move);
    }
  }
  move_boundaries(state_.time);
}

void FluidModel::update_neighbours(double dt) {
  const auto timer = timers_.measure("neighbours");
  if (!state_.neighbours.exhausted(state_.fluid, state_.boundaries, dt, ranks_)) return;
  move_back_into_domain();
  if (state_.open_ends) let_through_open_ends();
  if (scene_.geometry == Geometry::plane) {
    state_.neighbours.build(state_.fluid, state_.boundaries, dt, ranks_);
    if (state_.open_ends) state_.open_ends->find(state_.fluid);
    return;
  }
  keep_off_axis(state_.fluid);
  state_.neighbours.build(state_.fluid, state_.boundaries, dt);
  mirror_bodies(state_.fluid, state_.boundaries);
}

void FluidModel::let_through_open_ends() {
  const Particles& fluid = state_.fluid;
  state_.open_ends->exchange(state_.fluid, [&](std::size_t i) {
    return 0.5 * at(fluid.v, i).squaredNorm() + potential(at(fluid.x, i)) +
           equation_of_state_.elastic_energy(fluid.rho[i]) / equation_of_state_.rho_0;
  });
}

void FluidModel::refuse_in_layers(const std::vector<Vec>& points) const {
  if (!state_.open_ends) return;
  if (const auto x = state_.open_ends->first_in_layer(points))
    throw BadInput({{"[solid]", 0, 0,
                     fmt::format("the solid lies beyond an open end of the fluid near ({:.6g}, {:.6g}) m: "
                                 "put the [[fluid.inlet]] or [[fluid.outlet]] farther out",
                                 (*x)[0], (*x)[1])}});
}

void FluidModel::record_surface(const std::filesystem::path& out) {
  find_surface();
  if (state_.surface_record) state_.surface_record->open(out);
}

void FluidModel::find_surface() {
  if (!parameters_.removal) return;
  std::optional<Sticking> sticks;
  if (parameters_.wall_model.slip == WallSlip::no_slip)
    sticks = Sticking{parameters_.spacing, [p = parameters_](double gdot) { return viscosity_of(p, gdot); }};
  state_.surface_record.emplace(*parameters_.removal, std::move(sticks), scene_.geometry);
  state_.surface_record->attach(state_.boundaries);
}

Look FluidModel::look() {
  return {powers(), penetration(state_.fluid, state_.boundaries, ranks_)};
}

void FluidModel::record(double time) {
  if (state_.steps_since_look >= steps_between_looks) {
    const auto timer = timers_.measure("energy balance");
    const Look seen = look();
    state_.balance.add(time, seen.powers);
    state_.penetration = seen.penetration;
    state_.steps_since_look = 0;
  }
  if (state_.surface_record) state_.surface_record->write(time);
}

void FluidModel::watch_stops(double time) {
  for (Boundary& boundary : state_.boundaries)
    if (auto* pressed = std::get_if<PressedMotion>(&boundary.motion); pressed && !pressed->at_stop) {
      const double way = pressed->way_at(time);
      if (way != pressed->press.travel[0] && way != pressed->press.travel[1]) continue;
      // Where it starts, a stop may hold it while its press still grows.
      pressed->at_stop = way != 0 || (pressed->pushed_on && time >= pressed->steady_from());
      if (!pressed->at_stop) continue;
      if (way != 0)
        log::warn(
            "the wall '{}' has come to the end of its travel, {:g} m, at t = {:.6g} s: its stop holds it",
            boundary.name, way, time);
      else
        log::warn(
            "the wall '{}' is pushed against the stop at which it starts, at t = {:.6g} s: its 'press' and "
            "the medium push it beyond the 'travel' [{:g}, {:g}] m",
            boundary.name, time, pressed->press.travel[0], pressed->press.travel[1]);
    }
}

void FluidModel::watch(double time) {
  watch_stops(time);
  if (state_.suction_watch) watch_suction(time);
  if (state_.steps_since_look > 0) return;
  watch_shear(time);
  state_.run_watch->look(run_figures(time));
}

void FluidModel::complete_records() {
  if (state_.surface_record) state_.surface_record->complete();
}

bool FluidModel::is_enclosed() {
  update_neighbours(0);
  find_off_surface();
  const bool closed = is_closed(state_.fluid);
  if (!parameters_.seeks_free_surface()) state_.fluid.off_surface = {};
  return closed;
}

void FluidModel::watch_shear(double time) {
  if (!parameters_.medium || state_.beyond_measured) return;
  const auto beyond = beyond_measured(record_of(*parameters_.medium), state_.fluid, time);
  if (!beyond) return;
  log::warn("{}", *beyond);
  state_.beyond_measured = true;
}

void FluidModel::find_off_surface() {
  free_surface_.find_off_surface(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, kernel_);
}

/// Who has a free surface in reach is not known in every run, and asked where it matters alone.
void FluidModel::watch_suction(double time) {
  const auto suction = state_.suction_watch->look(state_.fluid, time);
  if (!suction) return;
  find_off_surface();
  if (!is_closed(state_.fluid)) return state_.suction_watch->forget();
  log::warn("{}", *suction);
  state_.suction_watch.reset();
}

void FluidModel::push_pressed_walls(double dt) {
  const double held = kept_pressure(parameters_.enclosed_medium, state_.boundaries, equation_of_state_);
  for (std::size_t b = 0; b < state_.boundaries.size(); ++b) {
    Boundary& boundary = state_.boundaries[b];
    auto* pressed = std::get_if<PressedMotion>(&boundary.motion);
    if (!pressed) continue;
    const bool enclosed = parameters_.enclosed_medium.has_value();
    const Vec force = boundary.force_on_fluid.force();
    // Beside a free surface nobody knows how much of the face is dry.
    const double area =
        enclosed ? met_area(boundary, state_.fluid, kernel_, scene_.geometry, b, ranks_) : pressed->area;
    std::array<double, 3> of_all{force[0], force[1], area};
    if (ranks_) ranks_->take_first(of_all);
    const auto [F_x, F_y, met] = of_all;
    if (enclosed) require_medium_before_face(boundary, met);
    pressed->push(state_.time + 0.5 * dt, dt, Vec(-F_x, -F_y), held, met);
  }
}

void FluidModel::count_forces(double dt) {
  ++state_.steps_since_look;
  for (Boundary& boundary : state_.boundaries) boundary.count_force(dt);
  if (state_.open_ends) state_.open_ends->count(dt);
  const auto first = state_.fluid.m.begin();
  const double mass =
      ranks_ ? ranks_->mass()
             : std::reduce(first, first + static_cast<std::ptrdiff_t>(padded(state_.fluid.count)));
  const Vec gravity = scene_.gravity_at(state_.time + 0.5 * dt);
  state_.gravity_impulse += dt * mass * gravity;
  if (state_.open_ends) state_.gravity_impulse -= dt * state_.open_ends->layer_mass() * gravity;
  if (scene_.gravity_change) state_.work_of_gravity_change += dt * power_of(gravity - scene_.gravity, dt);
}

double FluidModel::power_of(const Vec& change, double dt) const {
  const bool kicks = parameters_.integrator == Integrator::symplectic;  // by the mean of before and after
  const Particles& fluid = state_.fluid;
  Field powers(fluid.m.size(), 0.0);
  for (std::size_t i = 0; i < fluid.count; ++i)
    if (fluid.is_inside(i))
      powers[i] = fluid.m[i] * change.dot(at(fluid.v, i) + (kicks ? 0.5 * dt : 0.0) * at(fluid.a, i));
  if (ranks_) powers = ranks_->of_whole(powers);
  return std::accumulate(powers.begin(), powers.end(), 0.0);
}

}  // namespace toryu::fluid
