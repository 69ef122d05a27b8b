#include "fluid_solver/implicit/pistons.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_solver/held_pressure.hpp"
#include "fluid_solver/press_area.hpp"

namespace toryu::fluid {

Pistons::Pistons(std::vector<Boundary>& boundaries, const Parameters& parameters,
                 const EquationOfState& state, double dt)
    : dt_(dt) {
  const double q = kept_pressure(parameters.enclosed_medium, boundaries, state);
  for (Boundary& boundary : boundaries) {
    const auto* pressed = std::get_if<PressedMotion>(&boundary.motion);
    if (!pressed) continue;
    const Press& press = pressed->press;
    const double area = pressed->area, way = pressed->way;
    all_.push_back({.boundary = &boundary,
                    .pressure = press.pressure_at(pressed->time, area) - q,
                    .area = area,
                    .row_mass = state.rho_0 * area * parameters.spacing,
                    .least = (press.travel[0] - way) / (0.5 * dt),
                    .most = (press.travel[1] - way) / (0.5 * dt)});
  }
}

Pistons::Vector Pistons::speeds() const {
  Vector u(count());
  for (Eigen::Index k = 0; k < count(); ++k) u[k] = motion(k).speed;
  return u;
}

Pistons::Vector Pistons::accelerations() const {
  Vector a(count());
  for (Eigen::Index k = 0; k < count(); ++k) a[k] = motion(k).acceleration;
  return a;
}

void Pistons::move_at(const Vector& u) {
  for (Eigen::Index k = 0; k < count(); ++k) {
    const Vec v = u[k] * axis(k), a = (u[k] - motion(k).speed) / dt_ * axis(k);
    Boundary& boundary = *at(k).boundary;
    for (std::size_t w = 0; w < boundary.count; ++w) {
      set(boundary.v, w, v);
      set(boundary.acceleration, w, a);
    }
  }
}

double Pistons::force_on(Eigen::Index k) const {
  const double F = -at(k).boundary->force_on_fluid.force().dot(axis(k));
  return at(k).area * at(k).pressure + F;
}

double Pistons::unbalanced_force(Eigen::Index k, double u) const {
  return (motion(k).mass * (motion(k).speed - u) + dt_ * force_on(k)) / at(k).row_mass;
}

Pistons::Vector Pistons::unbalance(const Vector& u) const {
  Vector r(count());
  for (Eigen::Index k = 0; k < count(); ++k)
    r[k] = at(k).bound ? *at(k).bound - u[k] : unbalanced_force(k, u[k]);
  return r;
}

Pistons::Vector Pistons::driving() const {
  Vector r(count());
  for (Eigen::Index k = 0; k < count(); ++k)
    r[k] = at(k).bound ? *at(k).bound : dt_ * force_on(k) / at(k).row_mass;
  return r;
}

void Pistons::take_areas(const Particles& fluid, const Kernel& kernel) {
  for (Piston& piston : all_) {
    piston.area = met_area(*piston.boundary, fluid, kernel);
    require_medium_before_face(*piston.boundary, piston.area);
  }
}

void Pistons::release(Vector& u) {
  for (Eigen::Index k = 0; k < count(); ++k) {
    Piston& piston = all_[static_cast<std::size_t>(k)];
    u[k] = piston.bound ? *piston.bound : std::clamp(u[k], piston.least, piston.most);
    piston.bound.reset();
  }
}

void Pistons::hold_at_stops(const Vector& u) {
  for (Eigen::Index k = 0; k < count(); ++k) {
    Piston& piston = all_[static_cast<std::size_t>(k)];
    const double on = unbalanced_force(k, u[k]);
    if (u[k] == piston.most && on > 0) piston.bound = piston.most;
    if (u[k] == piston.least && on < 0) piston.bound = piston.least;
  }
}

void Pistons::finish(const Vector& u) {
  for (Eigen::Index k = 0; k < count(); ++k) {
    PressedMotion& pressed = motion(k);
    pressed.end_step(dt_, u[k]);
    pressed.pushed_on = at(k).bound.has_value();
    if (u[k] == at(k).least) pressed.way = pressed.press.travel[0];  // and not a rounding beside it
    if (u[k] == at(k).most) pressed.way = pressed.press.travel[1];
  }
}

std::optional<Eigen::Index> Pistons::free_number_of(const Boundary& boundary) const {
  for (Eigen::Index k = 0; k < count(); ++k)
    if (at(k).boundary == &boundary && !at(k).bound) return k;
  return std::nullopt;
}

std::vector<CoarseFlow::Piston> Pistons::of_coarse_flow() const {
  std::vector<CoarseFlow::Piston> pistons;
  for (Eigen::Index k = 0; k < count(); ++k)
    pistons.push_back({at(k).bound ? at(k).row_mass : motion(k).mass, at(k).row_mass});
  return pistons;
}

}  // namespace toryu::fluid
