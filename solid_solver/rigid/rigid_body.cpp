#include "solid_solver/rigid/rigid_body.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/state/serialize.hpp"

namespace toryu::solid {

static_assert(dim == 2, "a body that turns in the plane");

namespace {

constexpr double largest_turn_of_step = 1.0 / 20;  // of the phase of what swings, or of the body [rad]
constexpr double steps_of_frame = 20, steps_of_run = 1000;
/// Rows of a load's table are resolved, but for a jump, whose two rows may be as near as one likes: a step
/// may be as long as this share of the longest.
constexpr double step_of_jump = 1e-3;
/// Of a particle that touches a wall firmly. The wall begins and ends to push within a step: a bounce is then
/// within half a percent of its energy, at 2, where a step is just stable, within 20 % [rad].
constexpr double contact_phase_of_step = 0.5;

/// A force at the end of an arm, as it drives the coordinates.
Coordinates at_arm(const Vec& arm, const Vec& force) {
  return {force[0], force[1], cross(arm, force)};
}

double longest_step(const Scene& scene) {
  if (scene.frame_interval > 0) return scene.frame_interval / steps_of_frame;
  return scene.end_time > 0 ? scene.end_time / steps_of_run : 1.0;
}

}  // namespace

RigidBody::RigidBody(const Parameters& parameters, const Body& body, const Scene& scene)
    : SolidModel(parameters, body, scene),
      mounting_(parameters.mounting.value_or(Mounting{})),
      longest_step_(longest_step(scene)) {
  for (int n = 0; n <= dim; ++n) free_[n] = mounting_.is_fixed(n) ? 0.0 : 1.0;
  find_inertia();
  find_start();
  if (walls_) resize(x_, padded(particle_count()));
  place_particles();
  first_energy_ = kinetic_energy() + spring_energy();
  first_momentum_ = momentum();
}

void RigidBody::find_inertia() {
  if (mounting_.has_pivot())
    reference_ = mounting_.pivot;
  else
    for (std::size_t i = 0; i < particle_count(); ++i) reference_ += mass(i) / total_mass() * body_.X[i];
  inertia_ << total_mass(), total_mass(), 0;
  for (std::size_t i = 0; i < particle_count(); ++i)
    inertia_[dim] += mass(i) * ((body_.X[i] - reference_).squaredNorm() + body_.cell[i].squaredNorm() / 12);
}

void RigidBody::find_start() {
  Coordinates momentum = Coordinates::Zero();
  double of_centres = 0;  // moment of inertia without that of the cells, which the particles' motion has not
  for (std::size_t i = 0; i < particle_count(); ++i) {
    const Vec r = body_.X[i] - reference_;
    momentum += at_arm(r, mass(i) * SolidModel::velocity(i));
    of_centres += mass(i) * r.squaredNorm();
  }
  form_.v = momentum.cwiseQuotient(inertia_).cwiseProduct(free_);
  form_.v[dim] = free_[dim] * (of_centres > 0 ? momentum[dim] / of_centres : 0.0);
}

Pose RigidBody::pose() const {
  return {.about = reference_,
          .centre = reference_ + form_.q.head<dim>(),
          .angle = form_.q[dim],
          .velocity = form_.v.head<dim>(),
          .angular_velocity = form_.v[dim],
          .rotation = Eigen::Rotation2Dd(form_.q[dim]).toRotationMatrix()};
}

void RigidBody::move_particles() {
  const Pose now = pose();
  for (std::size_t k = 0; k < X_[0].size(); ++k) set(state_.v, k, now.velocity_of(at(X_, k)));
}

void RigidBody::place_particles() {
  const Pose now = pose();
  move_particles();
  for (std::size_t k = 0; k < X_[0].size(); ++k) {
    const Vec X = at(X_, k);
    set(state_.u, k, now.place(X) - X);
    if (walls_) set(x_, k, period_.inside(now.place(X)));
  }
  if (!walls_) return;
  for (int n = 0; n < dim; ++n) std::fill(state_.a[n].begin(), state_.a[n].end(), 0.0);
#pragma omp parallel
  add_wall_contact(x_);
}

Coordinates RigidBody::force() const {
  const Pose now = pose();
  Coordinates sum = -mounting_.stiffnesses().cwiseProduct(form_.q - mounting_.rests());
  for (std::size_t i = 0; i < particle_count(); ++i) {
    const std::size_t k = slot_[i];
    sum += at_arm(arm(now, i), mass(i) * (at(state_.a, k) + at(state_.external, k)));
  }
  return sum;
}

RigidBody::Resistance RigidBody::resist(double dt) {
  using Matrix = Eigen::Matrix<double, dim + 1, dim + 1>;
  const Pose now = pose();
  const Coordinates damping = mounting_.dampings();
  Matrix resistance = damping.asDiagonal();  // C + Z
  Coordinates pull = Coordinates::Zero();    // Z w_c
  for (std::size_t n = 0; n < state_.impedance.size(); ++n) {
    const Impedance& z = state_.impedance[n];
    const Coordinates g = at_arm(arm(now, state_.loaded[n]), z.normal);
    resistance += z.value * g * g.transpose();
    pull += z.value * z.normal.dot(z.velocity) * g;
  }
  // What is fixed has a row of its own, with nothing on its right side.
  Matrix A = inertia_.asDiagonal();
  A += 0.5 * dt * (free_ * free_.transpose()).cwiseProduct(resistance);
  const Coordinates impulse = inertia_.cwiseProduct(form_.v) + 0.5 * dt * (force() + pull);
  const Coordinates w = A.ldlt().solve(free_.cwiseProduct(impulse));
  Coordinates force = -damping.cwiseProduct(w);
  for (std::size_t n = 0; n < state_.impedance.size(); ++n) {
    Impedance& z = state_.impedance[n];
    const Coordinates g = at_arm(arm(now, state_.loaded[n]), z.normal);
    const double taken = dt * z.value * (z.normal.dot(z.velocity) - g.dot(w));
    force += taken / dt * g;
    z.impulse += taken;
    state_.impedance_work += taken * g.dot(w);
    state_.impulses.loads += taken * z.normal;
  }
  return {w, force};
}

void RigidBody::advance(double dt) {
  const auto scope = timers_.measure("steps");
  begin_drive(dt);
  state_.time += dt;
  count_impulses(0.5 * dt);  // of the first kick
  const Resistance resistance = resist(dt);
  form_.q += dt * resistance.drift;
  form_.v = resistance.drift;
  place_particles();
  form_.v += 0.5 * dt * free_.cwiseProduct(force() + resistance.force).cwiseQuotient(inertia_);
  move_particles();
  count_impulses(0.5 * dt);
  if (parameters_.mounting)
    state_.impulses.clamps = momentum() - first_momentum_ - state_.impulses.loads - state_.impulses.walls;
  end_drive();
  end_step();
}

void RigidBody::save() {
  SolidModel::save();
  saved_form_ = form_;
}

void RigidBody::restore() {
  SolidModel::restore();
  form_ = saved_form_;
}

void RigidBody::write_state(std::ostream& stream) const {
  SolidModel::write_state(stream);
  write_states(stream, form_);
}

void RigidBody::read_state(std::istream& stream) {
  SolidModel::read_state(stream);
  read_states(stream, form_);
}

Coordinates RigidBody::natural_frequencies() const {
  return mounting_.stiffnesses().cwiseQuotient(inertia_).cwiseSqrt();
}

double RigidBody::frequency_of_loads() const {
  // The moment of forces that keep their direction is a cos(angle) - b sin(angle).
  double a = 0, b = 0;
  for (std::size_t i = 0; i < particle_count(); ++i) {
    const Vec r = body_.X[i] - reference_, f = mass(i) * steady_acceleration(i);
    a += cross(r, f);
    b += r.dot(f);
  }
  return std::sqrt(std::hypot(a, b) / inertia_[dim]);
}

double RigidBody::time_step_limit() const {
  const Coordinates damping = mounting_.dampings().cwiseQuotient(inertia_);
  const double turning = std::hypot(frequency_of_loads(), form_.v[dim]);
  const Coordinates rates =
      (natural_frequencies() + damping + Coordinates(0, 0, turning)).cwiseProduct(free_);
  double limit =
      std::min(longest_step_, largest_turn_of_step / std::max(rates.maxCoeff(), drive_.fastest_sine()));
  limit = std::min(limit,
                   std::max(largest_turn_of_step * drive_.shortest_interval(), step_of_jump * longest_step_));
  if (walls_) limit = std::min(limit, contact_phase_of_step / walls_->highest_frequency());
  return parameters_.time_step_share * limit;
}

double RigidBody::spring_energy() const {
  const Coordinates stretch = form_.q - mounting_.rests();
  return 0.5 * stretch.dot(mounting_.stiffnesses().cwiseProduct(stretch));
}

std::vector<Observation> RigidBody::internal_energies() const {
  return {{"spring_energy", "J/m", spring_energy()}};
}

std::vector<Observation> RigidBody::observe() const {
  std::vector<Observation> row{
      {"body_displacement_x", "m", form_.q[0]}, {"body_displacement_y", "m", form_.q[1]},
      {"body_angle", "rad", form_.q[dim]},      {"body_velocity_x", "m/s", form_.v[0]},
      {"body_velocity_y", "m/s", form_.v[1]},   {"body_angular_velocity", "rad/s", form_.v[dim]}};
  for (Observation& observation : SolidModel::observe()) row.push_back(std::move(observation));
  return row;
}

Interface RigidBody::interface(double reach) const {
  Interface touched = SolidModel::interface(reach);
  double sum = 0;
  for (const double mass : touched.mass) sum += mass;
  for (double& mass : touched.mass) mass *= total_mass() / sum;
  return touched;
}

std::vector<ActiveTerm> RigidBody::active_terms() const {
  std::vector<ActiveTerm> terms;
  terms.push_back({"rigid body", "m Dv/Dt = sum f_i, I domega/dt = sum r_i x f_i", "",
                   fmt::format("mass {:.6g} kg/m, moment of inertia {:.6g} kg.m2/m about ({:.6g}, {:.6g}) m",
                               inertia_[0], inertia_[dim], reference_[0], reference_[1])});
  if (parameters_.mounting) {
    std::vector<std::string> parts;
    for (int n = 0; n <= dim; ++n) {
      const std::string& name = coordinate_names[n];
      const double k = mounting_.stiffnesses()[n], c = mounting_.dampings()[n];
      const double omega = natural_frequencies()[n];
      if (mounting_.is_fixed(n)) parts.push_back(name + " fixed");
      if (k > 0)
        parts.push_back(
            fmt::format("natural frequency in {} {:.6g} Hz", name, omega / (2 * std::numbers::pi)));
      if (c > 0 && k > 0)
        parts.push_back(fmt::format("damping ratio in {} {:.4g}", name, 0.5 * c / (inertia_[n] * omega)));
      else if (c > 0)
        parts.push_back(fmt::format("decay time in {} {:.4g} s", name, inertia_[n] / c));
    }
    terms.push_back({"mounting", "F = -k (q - q_rest) - c dq/dt", "",
                     parts.empty() ? "holds nothing" : fmt::format("{}", fmt::join(parts, ", "))});
  }
  for (auto& term : SolidModel::active_terms()) terms.push_back(std::move(term));
  return terms;
}

}  // namespace toryu::solid
