/// What the fluid tells of itself: bounds, frames, energies and observers.

#include <algorithm>
#include <cmath>

#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/held_pressure.hpp"
#include "fluid_solver/held_volume.hpp"
#include "fluid_solver/observers.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "columns have the components of the plane");

namespace {

/// Over the sound speed: lattices and surfaces settle with less.
constexpr double speed_of_settling = 0.003;
/// So many particles may be faster than what counts as fast: a few splash.
constexpr std::size_t least_fast = 3;

}  // namespace

void FluidModel::fail(std::size_t i, double time, const std::string& quantity, double value,
                      const std::string& limit) const {
  throw PhysicsFailure("fluid", state_.fluid.id[i], time, quantity, fmt::format("{:.6g}", value), limit);
}

void FluidModel::check(double time) const {
  const double top_speed =
      parameters_.limits.largest_speed > 0 ? parameters_.limits.largest_speed : parameters_.sound_speed;
  const double least = parameters_.density * (1 - parameters_.limits.largest_density_change);
  const double most = parameters_.density * (1 + parameters_.limits.largest_density_change);
  // Each comparison is written so that a NaN fails it. A cluster that fails is looked at one by one: a period
  // may bring back who is out of the domain.
  for (std::size_t first = 0; first < state_.fluid.count; first += lane_count) {
    const VecLanes x = load(state_.fluid.x, first), v = load(state_.fluid.v, first);
    const Lanes rho = load(state_.fluid.rho, first);
    Lanes::Mask good = (rho >= least) & (rho <= most) & (dot(v, v) <= top_speed * top_speed);
    for (int a = 0; a < dim; ++a) good &= (x[a] >= scene_.domain.min[a]) & (x[a] < scene_.domain.max[a]);
    if (all_of(good) && !scene_.domain.round) continue;
    for (std::size_t i = first; i < std::min(first + lane_count, state_.fluid.count); ++i)
      check_particle(i, time, least, most, top_speed);
  }
}

void FluidModel::check_particle(std::size_t i, double time, double least_density, double most_density,
                                double top_speed) const {
  const Vec x = at(state_.fluid.x, i), v = at(state_.fluid.v, i);
  const double rho = state_.fluid.rho[i];
  if (!(rho >= least_density && rho <= most_density))
    fail(i, time, "density [kg/m3]", rho, fmt::format("{:.6g} to {:.6g}", least_density, most_density));
  if (!(v.squaredNorm() <= top_speed * top_speed))
    fail(i, time, "speed [m/s]", v.norm(), fmt::format("{:.6g}", top_speed));
  if (!scene_.domain.contains(x + period_.back_into_domain(x)))
    fail(i, time, fmt::format("position ({:.6g}, {:.6g}) [m], outside by", x[0], x[1]),
         (scene_.domain.min - x).cwiseMax(x - scene_.domain.max).maxCoeff(), "the domain of the case");
}

Frame FluidModel::frame() const {
  const std::size_t n = state_.fluid.count;
  Frame frame;
  frame.positions.resize(dim * n);
  FrameField id{"particle", "1", "number at the start", 1, std::vector<double>(n)};
  FrameField pressure{"pressure", "Pa", "from the equation of state", 1, std::vector<double>(n)};
  FrameField density{"density", "kg/m3", "", 1, std::vector<double>(n)};
  FrameField velocity{"velocity", "m/s", "", dim, std::vector<double>(dim * n)};
  const double p_offset = pressure_offset();
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < dim; ++a) {
      frame.positions[dim * i + static_cast<std::size_t>(a)] = state_.fluid.x[a][i];
      velocity.values[dim * i + static_cast<std::size_t>(a)] = state_.fluid.v[a][i];
    }
    id.values[i] = state_.fluid.id[i];
    density.values[i] = state_.fluid.rho[i];
    pressure.values[i] = equation_of_state_.pressure(state_.fluid.rho[i]) + p_offset;
  }
  frame.fields = {std::move(id), std::move(pressure), std::move(velocity), std::move(density)};
  if (!state_.fluid.eta.empty()) {
    frame.fields.push_back({"viscosity",
                            "Pa.s",
                            "of the last evaluation",
                            1,
                            {state_.fluid.eta.begin(), state_.fluid.eta.begin() + n}});
    frame.fields.push_back({"shear_rate",
                            "1/s",
                            "sqrt(2 D : D)",
                            1,
                            {state_.fluid.gdot.begin(), state_.fluid.gdot.begin() + n}});
  }
  if (const auto& end = state_.fluid.open_end; !end.empty())
    frame.fields.push_back({"open_end",
                            "1",
                            "0 in the fluid, else the open end in whose layer it is",
                            1,
                            {end.begin(), end.begin() + static_cast<std::ptrdiff_t>(n)}});
  if (const auto& stress = state_.fluid.polymer_stress; !stress.xx.empty()) {
    FrameField field{"polymer_stress", "Pa", "of the last evaluation", dim * dim, {}};
    for (std::size_t i = 0; i < n; ++i)
      field.values.insert(field.values.end(), {stress.xx[i], stress.xy[i], stress.xy[i], stress.yy[i]});
    frame.fields.push_back(std::move(field));
  }
  return frame;
}

double FluidModel::kinetic_energy() const {
  return sum_inside(
      [&](std::size_t i) { return 0.5 * state_.fluid.m[i] * at(state_.fluid.v, i).squaredNorm(); });
}

double FluidModel::potential_energy() const {
  return sum_inside([&](std::size_t i) { return state_.fluid.m[i] * potential(at(state_.fluid.x, i)); },
                    state_.potential_of_moves);
}

double FluidModel::potential(const Vec& x) const {
  double value = -scene_.gravity.dot(x);
  if (const auto& pull = parameters_.central_force)
    value += 0.5 * pull->rate * pull->rate * (x - pull->centre).squaredNorm();
  return value;
}

double FluidModel::mean_density() const {
  return mass() / sum_inside([&](std::size_t i) { return state_.fluid.m[i] / state_.fluid.rho[i]; });
}

double FluidModel::density_of_packing() const {
  if (state_.neighbours.builds() == 0) return parameters_.density;
  return parameters_.density * packing(state_.fluid, state_.neighbours.of_fluid(), state_.boundaries, kernel_,
                                       parameters_.density, ranks_);
}

double FluidModel::energy_gained() const {
  double gained = energy() - start_energy_ - state_.work_of_gravity_change;
  for (const Boundary& boundary : state_.boundaries) gained -= boundary.work;
  for_each_open_end([&](const OpenEnds& ends, std::size_t end) { gained -= ends.state(end).work; });
  return gained;
}

double FluidModel::elastic_energy() const {
  const auto& s = equation_of_state_;
  return sum_inside(
      [&](std::size_t i) { return state_.fluid.m[i] / s.rho_0 * s.elastic_energy(state_.fluid.rho[i]); });
}

double FluidModel::mass() const {
  return sum_inside([&](std::size_t i) { return state_.fluid.m[i]; });
}

RunFigures FluidModel::run_figures(double time) const {
  const Particles& fluid = state_.fluid;
  const double c_0 = parameters_.sound_speed, stored = state_.balance.taken(Taken::stored, state_.time);
  std::vector<double> speed(fluid.count);
  double mass = 0, held = 0, moved = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    speed[i] = at(fluid.v, i).norm();
    mass += fluid.m[i];
    const double p_rho = equation_of_state_.pressure(fluid.rho[i]) / fluid.rho[i];
    held += 0.5 * fluid.m[i] * p_rho * p_rho / (c_0 * c_0);
  }
  for (const Boundary& boundary : state_.boundaries) moved += std::abs(boundary.work);
  for_each_open_end([&](const OpenEnds& ends, std::size_t end) { moved += std::abs(ends.state(end).work); });
  moved += std::abs(state_.work_of_gravity_change);
  const std::size_t faster = std::min(std::max(fluid.count / 100, least_fast), fluid.count - 1);
  const auto fast = speed.end() - 1 - static_cast<std::ptrdiff_t>(faster);
  std::nth_element(speed.begin(), fast, speed.end());
  return {.time = time,
          .fast = *fast,
          .mean_density = parameters_.held_volume ? density_of_packing() : mean_density(),
          .count = fluid.count,
          .penetration = state_.penetration,
          .gained = energy_gained() + stored,
          .turned_over = std::max({kinetic_energy(), std::abs(potential_energy() - start_potential_), moved,
                                   std::abs(stored), held}),
          .least_energy = 0.5 * mass * std::pow(speed_of_settling * c_0, 2)};
}

Vec FluidModel::momentum() const {
  return sum_inside([&](std::size_t i) { return Vec(state_.fluid.m[i] * at(state_.fluid.v, i)); },
                    Vec(Vec::Zero()));
}

double FluidModel::pressure_offset() const {
  return fluid::pressure_offset(parameters_.enclosed_medium, state_.fluid, state_.boundaries,
                                equation_of_state_, ranks_);
}

Vec FluidModel::numerical_impulse() const {
  Vec impulse = momentum() - start_momentum_ - state_.gravity_impulse;
  for (const Boundary& boundary : state_.boundaries) impulse -= boundary.impulse.total;
  for_each_open_end([&](const OpenEnds& ends, std::size_t end) { impulse -= ends.state(end).impulse; });
  return impulse;
}

std::vector<Observation> FluidModel::observe() const {
  const Vec p = momentum();
  const auto unit_of = [&](const char* of_all) -> std::string {
    return scene_.geometry == Geometry::plane ? fmt::format("{}/m", of_all) : of_all;
  };
  std::vector<Observation> row{{"kinetic_energy", unit_of("J"), kinetic_energy()},
                               {"potential_energy", unit_of("J"), potential_energy()},
                               {"elastic_energy", unit_of("J"), elastic_energy()},
                               {"momentum_x", unit_of("N.s"), p[0]},
                               {"momentum_y", unit_of("N.s"), p[1]},
                               {"largest_speed", "m/s", state_.largest.speed},
                               {"mean_density", "kg/m3", mean_density()},
                               {"particles_in_walls", "1", static_cast<double>(state_.penetration.count)}};
  const auto push = [&](const std::string& name, const std::string& unit, const Vec& value) {
    row.push_back({name + "_x", unit, value[0]});
    row.push_back({name + "_y", unit, value[1]});
  };
  for (const Boundary& boundary : state_.boundaries) {
    const ForceOnFluid& given = boundary.force_on_fluid;
    push("force_from_" + boundary.name, unit_of("N"), boundary.counted ? given.force() : Vec(Vec::Zero()));
    push("impulse_from_" + boundary.name, unit_of("N.s"), boundary.impulse.total);
    if (boundary.moves()) row.push_back({"work_from_" + boundary.name, unit_of("J"), boundary.work});
    if (boundary.turns()) {
      row.push_back({"moment_from_" + boundary.name, unit_of("N.m"), boundary.moment});
      row.push_back({"power_from_" + boundary.name, unit_of("W"), boundary.power_given});
    }
    if (const auto* pressed = std::get_if<PressedMotion>(&boundary.motion)) {
      row.push_back({"way_of_" + boundary.name, "m", pressed->way_at(state_.time)});
      row.push_back({"speed_of_" + boundary.name, "m/s", pressed->speed_at(state_.time)});
    }
    // the solid is one, also while nobody has told its particles
    if (!parameters_.friction || parameters_.wall_slip) continue;
    if (!boundary.is_work_piece() && !boundary.is_interface()) continue;
    push("friction_from_" + boundary.name, unit_of("N"),
         boundary.counted ? given.friction() : Vec(Vec::Zero()));
    push("friction_impulse_from_" + boundary.name, unit_of("N.s"), boundary.impulse.friction);
  }
  if (state_.open_ends) row.push_back({"mass", unit_of("kg"), mass()});
  for_each_open_end([&](const OpenEnds& ends, std::size_t end) {
    for (const auto& observation : ends.observe(end)) row.push_back(observation);
  });
  if (scene_.gravity.norm() > 0 || scene_.gravity_change)
    push("impulse_of_gravity", unit_of("N.s"), state_.gravity_impulse);
  if (scene_.gravity_change) {
    const Vec g = scene_.gravity_at(state_.time);
    row.push_back({"gravity_x", "m/s2", g[0]});
    row.push_back({"gravity_y", "m/s2", g[1]});
    row.push_back({"work_of_gravity_change", unit_of("J"), state_.work_of_gravity_change});
  }
  if (parameters_.seeks_free_surface()) push("impulse_of_corrections", unit_of("N.s"), numerical_impulse());
  for (const auto& energy : state_.balance.observe(energy_gained(), state_.time, unit_of("J")))
    row.push_back(energy);
  for (const auto& observer : parameters_.observers)
    row.push_back(toryu::fluid::observe(
        observer, {state_.fluid, state_.boundaries, parameters_, kernel_, equation_of_state_, period_,
                   state_.time, pressure_offset(), scene_.geometry}));
  if (state_.surface_record)
    for (const auto& observation : state_.surface_record->observe()) row.push_back(observation);
  return row;
}

}  // namespace toryu::fluid
