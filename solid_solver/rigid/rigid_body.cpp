#include "solid_solver/rigid/rigid_body.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/state/serialize.hpp"
#include "solid_solver/rigid/meeting_bodies.hpp"

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

double longest_step(const Scene& scene) {
  if (scene.frame_interval > 0) return scene.frame_interval / steps_of_frame;
  return scene.end_time > 0 ? scene.end_time / steps_of_run : 1.0;
}

}  // namespace

RigidBody::RigidBody(const Parameters& parameters, const Body& body, const Scene& scene)
    : SolidModel(parameters, body, scene),
      parts_(rigid_parts(parameters, body_)),
      part_of_(particle_count()),
      longest_step_(longest_step(scene)) {
  form_.q.assign(parts_.size(), Coordinates::Zero());
  form_.v = form_.q;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    for (const auto i : parts_[b].particles) part_of_[i] = static_cast<std::uint32_t>(b);
    find_start(b);
  }
  if (walls_) resize(x_, padded(particle_count()));
  place_particles();
  first_energy_ = kinetic_energy() + spring_energy();
  first_momentum_ = momentum();
}

void RigidBody::find_start(std::size_t b) {
  const RigidPart& part = parts_[b];
  Coordinates momentum = Coordinates::Zero();
  double of_centres = 0;  // moment of inertia without that of the cells, which the particles' motion has not
  for (const auto i : part.particles) {
    const Vec r = body_.X[i] - part.reference;
    momentum += at_arm(r, mass(i) * SolidModel::velocity(i));
    of_centres += mass(i) * r.squaredNorm();
  }
  form_.v[b] = momentum.cwiseQuotient(part.inertia).cwiseProduct(part.free);
  form_.v[b][dim] = part.free[dim] * (of_centres > 0 ? momentum[dim] / of_centres : 0.0);
}

void RigidBody::move_particles() {
  std::vector<Pose> now;
  for (std::size_t b = 0; b < parts_.size(); ++b) now.push_back(pose(b));
  for (std::size_t k = 0; k < X_[0].size(); ++k) set(state_.v, k, now[part_in(k)].velocity_of(at(X_, k)));
}

void RigidBody::place_particles() {
  std::vector<Pose> now;
  for (std::size_t b = 0; b < parts_.size(); ++b) now.push_back(pose(b));
  move_particles();
  for (std::size_t k = 0; k < X_[0].size(); ++k) {
    const Vec X = at(X_, k), x = now[part_in(k)].place(X);
    set(state_.u, k, x - X);
    if (walls_) set(x_, k, period_.inside(x));
  }
  if (!walls_) return;
  for (int n = 0; n < dim; ++n) std::fill(state_.a[n].begin(), state_.a[n].end(), 0.0);
#pragma omp parallel
  add_wall_contact(x_);
}

Coordinates RigidBody::force(std::size_t b) const {
  const RigidPart& part = parts_[b];
  const Pose now = pose(b);
  Coordinates sum = -part.mounting.stiffnesses().cwiseProduct(form_.q[b] - part.mounting.rests());
  for (const auto i : part.particles) {
    const std::size_t k = slot_[i];
    sum += at_arm(arm(now, i), mass(i) * (at(state_.a, k) + at(state_.external, k)));
  }
  return sum;
}

RigidBody::Resistance RigidBody::resist(std::size_t b, double dt) {
  using Matrix = Eigen::Matrix<double, dim + 1, dim + 1>;
  const RigidPart& part = parts_[b];
  const Pose now = pose(b);
  const Coordinates damping = part.mounting.dampings();
  Matrix resistance = damping.asDiagonal();  // C + Z
  Coordinates pull = Coordinates::Zero();    // Z w_c
  for (std::size_t n = 0; n < state_.impedance.size(); ++n) {
    if (part_of_[state_.loaded[n]] != b) continue;
    const Impedance& z = state_.impedance[n];
    const Coordinates g = at_arm(arm(now, state_.loaded[n]), z.normal);
    resistance += z.value * g * g.transpose();
    pull += z.value * z.normal.dot(z.velocity) * g;
  }
  // What is fixed has a row of its own, with nothing on its right side.
  Matrix A = part.inertia.asDiagonal();
  A += 0.5 * dt * (part.free * part.free.transpose()).cwiseProduct(resistance);
  const Coordinates impulse = part.inertia.cwiseProduct(form_.v[b]) + 0.5 * dt * (force(b) + pull);
  const Coordinates w = A.ldlt().solve(part.free.cwiseProduct(impulse));
  Coordinates force = -damping.cwiseProduct(w);
  for (std::size_t n = 0; n < state_.impedance.size(); ++n) {
    if (part_of_[state_.loaded[n]] != b) continue;
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
  std::vector<Resistance> resistances;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Resistance& resistance = resistances.emplace_back(resist(b, dt));
    form_.q[b] += dt * resistance.drift;
    form_.v[b] = resistance.drift;
  }
  place_particles();
  for (std::size_t b = 0; b < parts_.size(); ++b)
    form_.v[b] +=
        0.5 * dt *
        parts_[b].free.cwiseProduct(force(b) + resistances[b].force).cwiseQuotient(parts_[b].inertia);
  move_particles();
  count_impulses(0.5 * dt);
  if (std::any_of(parts_.begin(), parts_.end(), [](const RigidPart& part) { return part.mounted; }))
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

double RigidBody::frequency_of_loads(const RigidPart& part) const {
  // The moment of forces that keep their direction is a cos(angle) - b sin(angle).
  double a = 0, b = 0;
  for (const auto i : part.particles) {
    const Vec r = body_.X[i] - part.reference, f = mass(i) * steady_acceleration(i);
    a += cross(r, f);
    b += r.dot(f);
  }
  return std::sqrt(std::hypot(a, b) / part.inertia[dim]);
}

double RigidBody::time_step_limit() const {
  double fastest = drive_.fastest_sine();
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const RigidPart& part = parts_[b];
    const Coordinates damping = part.mounting.dampings().cwiseQuotient(part.inertia);
    const double turning = std::hypot(frequency_of_loads(part), form_.v[b][dim]);
    const Coordinates rates =
        (part.natural_frequencies() + damping + Coordinates(0, 0, turning)).cwiseProduct(part.free);
    fastest = std::max(fastest, rates.maxCoeff());
  }
  double limit = std::min(longest_step_, largest_turn_of_step / fastest);
  limit = std::min(limit,
                   std::max(largest_turn_of_step * drive_.shortest_interval(), step_of_jump * longest_step_));
  if (walls_) limit = std::min(limit, contact_phase_of_step / walls_->highest_frequency());
  return parameters_.time_step_share * limit;
}

double RigidBody::spring_energy() const {
  double sum = 0;
  for (std::size_t b = 0; b < parts_.size(); ++b) sum += parts_[b].spring_energy(form_.q[b]);
  return sum;
}

double RigidBody::kinetic_energy() const {
  double sum = 0;
  for (std::size_t b = 0; b < parts_.size(); ++b)
    sum += 0.5 * form_.v[b].dot(parts_[b].inertia.cwiseProduct(form_.v[b]));
  return sum;
}

std::vector<Observation> RigidBody::internal_energies() const {
  return {{"spring_energy", "J/m", spring_energy()}};
}

std::vector<Observation> RigidBody::places() const {
  std::vector<Observation> row;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const std::string name = parts_[b].name.empty() ? "body" : parts_[b].name;
    const Coordinates &q = form_.q[b], &v = form_.v[b];
    row.insert(row.end(), {{name + "_displacement_x", "m", q[0]},
                           {name + "_displacement_y", "m", q[1]},
                           {name + "_angle", "rad", q[dim]},
                           {name + "_velocity_x", "m/s", v[0]},
                           {name + "_velocity_y", "m/s", v[1]},
                           {name + "_angular_velocity", "rad/s", v[dim]}});
  }
  for (Observation& observation : SolidModel::places()) row.push_back(std::move(observation));
  return row;
}

Interface RigidBody::interface(double reach) const {
  Interface touched = SolidModel::interface(reach);
  std::vector<double> sums(parts_.size(), 0.0);
  for (std::size_t n = 0; n < touched.size(); ++n) sums[part_of_[touched.id[n]]] += touched.mass[n];
  for (std::size_t n = 0; n < touched.size(); ++n) {
    const auto b = part_of_[touched.id[n]];
    touched.mass[n] *= parts_[b].inertia[0] / sums[b];
  }
  return touched;
}

void RigidBody::check_strain(double time) const {
  if (parts_.size() == 1) return;
  std::vector<Vec> x(particle_count());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = period_.inside(body_.X[i] + displacement(i));
  const double nearest = least_gap * body_.spacing;
  const auto met = meeting_particles(x, part_of_, nearest);
  if (!met) return;
  const auto& [i, j] = *met;
  fail(slot_[i], time,
       fmt::format("distance of '{}' and '{}'", parts_[part_of_[i]].name, parts_[part_of_[j]].name),
       fmt::format("{:.4g} m", (x[i] - x[j]).norm()),
       fmt::format("above {:.4g} m: rigid bodies do not push each other", nearest));
}

std::vector<ActiveTerm> RigidBody::active_terms() const {
  std::vector<ActiveTerm> terms;
  for (const RigidPart& part : parts_) part.append_terms(terms);
  for (auto& term : SolidModel::active_terms()) terms.push_back(std::move(term));
  return terms;
}

}  // namespace toryu::solid
