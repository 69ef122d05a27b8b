/// What the fluid tells of itself: bounds, frames, energies and observers.

#include <cmath>

#include "fluid_solver/fluid_solver.hpp"
#include "fluid_solver/observers.hpp"

namespace toryu::fluid {

void FluidSolver::fail(std::size_t i, double time, const std::string& quantity, double value,
                       const std::string& limit) const {
  throw PhysicsFailure("fluid", fluid_.id[i], time, quantity, fmt::format("{:.6g}", value), limit);
}

void FluidSolver::check(double time) const {
  const double top_speed =
      parameters_.limits.largest_speed > 0 ? parameters_.limits.largest_speed : parameters_.sound_speed;
  const double least = parameters_.density * (1 - parameters_.limits.largest_density_change);
  const double most = parameters_.density * (1 + parameters_.limits.largest_density_change);
  for (std::size_t i = 0; i < fluid_.count; ++i) {
    const Vec x = at(fluid_.x, i), v = at(fluid_.v, i);
    const double rho = fluid_.rho[i];
    // written so that a NaN fails each of them
    if (!(rho >= least && rho <= most))
      fail(i, time, "density [kg/m3]", rho, fmt::format("{:.6g} to {:.6g}", least, most));
    if (!(v.squaredNorm() <= top_speed * top_speed))
      fail(i, time, "speed [m/s]", v.norm(), fmt::format("{:.6g}", top_speed));
    if (!scene_.domain.contains(x + period_.back_into_domain(x)))
      fail(i, time, fmt::format("position ({:.6g}, {:.6g}) [m], outside by", x[0], x[1]),
           (scene_.domain.min - x).cwiseMax(x - scene_.domain.max).maxCoeff(), "the domain of the case");
  }
}

Frame FluidSolver::frame() const {
  const std::size_t n = fluid_.count;
  Frame frame;
  frame.positions.resize(dim * n);
  FrameField id{"particle", "1", "number at the start", 1, std::vector<double>(n)};
  FrameField pressure{"pressure", "Pa", "from the equation of state", 1, std::vector<double>(n)};
  FrameField density{"density", "kg/m3", "", 1, std::vector<double>(n)};
  FrameField velocity{"velocity", "m/s", "", dim, std::vector<double>(dim * n)};
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < dim; ++a) {
      frame.positions[dim * i + static_cast<std::size_t>(a)] = fluid_.x[a][i];
      velocity.values[dim * i + static_cast<std::size_t>(a)] = fluid_.v[a][i];
    }
    id.values[i] = fluid_.id[i];
    density.values[i] = fluid_.rho[i];
    pressure.values[i] = dynamics_.equation_of_state().pressure(fluid_.rho[i]);
  }
  frame.fields = {std::move(id), std::move(pressure), std::move(velocity), std::move(density)};
  if (dynamics_.viscosity_varies()) {
    frame.fields.push_back(
        {"viscosity", "Pa.s", "of the last evaluation", 1, {fluid_.eta.begin(), fluid_.eta.begin() + n}});
    frame.fields.push_back(
        {"shear_rate", "1/s", "sqrt(2 D : D)", 1, {fluid_.gdot.begin(), fluid_.gdot.begin() + n}});
  }
  return frame;
}

double FluidSolver::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < fluid_.count; ++i) sum += 0.5 * fluid_.m[i] * at(fluid_.v, i).squaredNorm();
  return sum;
}

double FluidSolver::potential_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < fluid_.count; ++i) sum -= fluid_.m[i] * scene_.gravity.dot(at(fluid_.x, i));
  return sum;
}

double FluidSolver::elastic_energy() const {
  // integral of p/rho^2 over the density, from rho_0
  const auto& s = dynamics_.equation_of_state();
  const double n = s.gamma - 1.0;
  double sum = 0;
  for (std::size_t i = 0; i < fluid_.count; ++i) {
    const double ratio = fluid_.rho[i] / s.rho_0;
    const double growth = n > 0 ? (std::pow(ratio, n) - 1) / n : std::log(ratio);
    sum += fluid_.m[i] / s.rho_0 * (s.p_0() * (growth + 1 / ratio - 1) + s.p_b * (1 - 1 / ratio));
  }
  return sum;
}

Vec FluidSolver::momentum() const {
  Vec sum = Vec::Zero();
  for (std::size_t i = 0; i < fluid_.count; ++i) sum += fluid_.m[i] * at(fluid_.v, i);
  return sum;
}

Vec FluidSolver::numerical_impulse() const {
  Vec impulse = momentum() - start_momentum_ - gravity_impulse_;
  for (const auto& given : impulses_) impulse -= given.total;
  return impulse;
}

std::vector<Observation> FluidSolver::observe() const {
  const Vec p = momentum();
  std::vector<Observation> row{{"kinetic_energy", "J/m", kinetic_energy()},
                               {"potential_energy", "J/m", potential_energy()},
                               {"elastic_energy", "J/m", elastic_energy()},
                               {"momentum_x", "N.s/m", p[0]},
                               {"momentum_y", "N.s/m", p[1]},
                               {"largest_speed", "m/s", largest_.speed}};
  const auto push = [&](const std::string& name, const std::string& unit, const Vec& value) {
    row.push_back({name + "_x", unit, value[0]});
    row.push_back({name + "_y", unit, value[1]});
  };
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    const std::string& name = boundaries_[b].name;
    const bool counted = b < impulses_.size();  // after the first step
    const Impulse impulse = counted ? impulses_[b] : Impulse{};
    push("force_from_" + name, "N/m", counted ? given_[b].force() : Vec(Vec::Zero()));
    push("impulse_from_" + name, "N.s/m", impulse.total);
    if (!dynamics_.friction() || !boundaries_[b].is_work_piece()) continue;
    push("friction_from_" + name, "N/m", counted ? given_[b].friction() : Vec(Vec::Zero()));
    push("friction_impulse_from_" + name, "N.s/m", impulse.friction);
  }
  if (scene_.gravity.norm() > 0) push("impulse_of_gravity", "N.s/m", gravity_impulse_);
  if (parameters_.seeks_free_surface()) push("impulse_of_corrections", "N.s/m", numerical_impulse());
  for (const auto& observer : parameters_.observers)
    row.push_back(toryu::fluid::observe(observer, {fluid_, boundaries_, parameters_, dynamics_.kernel(),
                                                   dynamics_.equation_of_state(), period_, time_}));
  if (surface_record_)
    for (const auto& observation : surface_record_->observe()) row.push_back(observation);
  return row;
}

}  // namespace toryu::fluid
