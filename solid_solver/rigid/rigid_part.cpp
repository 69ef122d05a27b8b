#include "solid_solver/rigid/rigid_part.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

namespace toryu::solid {

RigidPart::RigidPart(const Body& body, std::vector<std::uint32_t> of_it, const std::optional<Mounting>& held,
                     std::string called)
    : name(std::move(called)),
      particles(std::move(of_it)),
      mounting(held.value_or(Mounting{})),
      mounted(held.has_value()) {
  for (int n = 0; n <= dim; ++n) free[n] = mounting.is_fixed(n) ? 0.0 : 1.0;
  const double mass = body.mass_of(particles);
  if (mounting.has_pivot())
    reference = mounting.pivot;
  else
    for (const auto i : particles) reference += body.mass(i) / mass * body.X[i];
  inertia << mass, mass, 0;
  for (const auto i : particles)
    inertia[dim] += body.mass(i) * ((body.X[i] - reference).squaredNorm() + body.cell[i].squaredNorm() / 12);
}

Pose RigidPart::pose(const Coordinates& q, const Coordinates& v) const {
  return {.about = reference,
          .centre = reference + q.head<dim>(),
          .angle = q[dim],
          .velocity = v.head<dim>(),
          .angular_velocity = v[dim],
          .rotation = Eigen::Rotation2Dd(q[dim]).toRotationMatrix()};
}

Coordinates RigidPart::natural_frequencies() const {
  return mounting.stiffnesses().cwiseQuotient(inertia).cwiseSqrt();
}

double RigidPart::spring_energy(const Coordinates& q) const {
  const Coordinates stretch = q - mounting.rests();
  return 0.5 * stretch.dot(mounting.stiffnesses().cwiseProduct(stretch));
}

void RigidPart::append_terms(std::vector<ActiveTerm>& terms) const {
  terms.push_back({prefix() + "rigid body", "m Dv/Dt = sum f_i, I domega/dt = sum r_i x f_i", "",
                   fmt::format("mass {:.6g} kg/m, moment of inertia {:.6g} kg.m2/m about ({:.6g}, {:.6g}) m",
                               inertia[0], inertia[dim], reference[0], reference[1])});
  if (mounted) {
    std::vector<std::string> parts;
    for (int n = 0; n <= dim; ++n) {
      const std::string& coordinate = coordinate_names[n];
      const double k = mounting.stiffnesses()[n], c = mounting.dampings()[n];
      const double omega = natural_frequencies()[n];
      if (mounting.is_fixed(n)) parts.push_back(coordinate + " fixed");
      if (k > 0)
        parts.push_back(
            fmt::format("natural frequency in {} {:.6g} Hz", coordinate, omega / (2 * std::numbers::pi)));
      if (c > 0 && k > 0)
        parts.push_back(
            fmt::format("damping ratio in {} {:.4g}", coordinate, 0.5 * c / (inertia[n] * omega)));
      else if (c > 0)
        parts.push_back(fmt::format("decay time in {} {:.4g} s", coordinate, inertia[n] / c));
    }
    terms.push_back({prefix() + "mounting", "F = -k (q - q_rest) - c dq/dt", "",
                     parts.empty() ? "holds nothing" : fmt::format("{}", fmt::join(parts, ", "))});
  }
}

std::vector<RigidPart> rigid_parts(const Parameters& parameters, const Body& body) {
  std::vector<RigidPart> parts;
  if (parameters.bodies.empty()) {
    std::vector<std::uint32_t> all(body.size());
    std::iota(all.begin(), all.end(), 0u);
    parts.emplace_back(body, all, parameters.mounting, "");
  }
  for (const NamedBody& named : parameters.bodies) {
    std::vector<std::uint32_t> particles;
    for (std::uint32_t i = 0; i < body.size(); ++i)
      if (parameters.regions[body.region[i]].body == named.name) particles.push_back(i);
    parts.emplace_back(body, particles, named.mounting, named.name);
  }
  return parts;
}

}  // namespace toryu::solid
