/// How a step of the solid is driven: gravity and loads that change, clamps that move, and their work. Over a
/// step gravity and loads are those of its middle. What a clamp gives its particles, of mass m, is what their
/// motion needs beyond the forces f of the solid, of gravity and of loads, and with the step's change of
/// velocity and displacement u,
///
///     impulse = m (v_1 - v_0) - (f_0 + f_1) dt/2,   work = m (v_1^2 - v_0^2)/2 - (f_0 + f_1) (u_1 - u_0)/2
///
/// Where clamps turn, free particles see them as their face (clamp_faces.hpp), which goes otherwise than the
/// held particles behind it. The solid's share of the work is then that of its forces F and their moment M
/// about the clamps' centre c on the free ones, (F_0 + F_1) (c_1 - c_0)/2 + (M_0 + M_1) (theta_1 -
/// theta_0)/2, for in the frame of the clamps they are the gradient of an energy.
#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

void SolidModel::find_driven(double time) {
  state_.time_of_drive = time;
  gravity_ = drive_.gravity(time);
  constant_ = drive_.accelerations(time);
}

Vec SolidModel::force_on(std::size_t particle) const {
  const std::size_t k = slot_[particle];
  const Vec inner = drive_.turns() ? Vec(Vec::Zero()) : at(state_.a, k);
  return mass(particle) * (inner + at(state_.external, k));
}

SolidModel::OnFree SolidModel::force_on_free() const {
  OnFree sum{drive_.pose(state_.time)};
  for (std::size_t i = 0; i < particle_count(); ++i) {
    if (body_.held[i]) continue;
    const std::size_t k = slot_[i];
    const Vec push = walls_ ? at(state_.push, k) : Vec(Vec::Zero()),
              force = mass(i) * (at(state_.a, k) - push);
    sum.force += force;
    sum.moment += Pose::across(body_.X[i] + displacement(i) - sum.pose.centre).dot(force);
  }
  return sum;
}

void SolidModel::begin_drive(double dt) {
  if (drive_.changes()) {
    find_driven(state_.time + 0.5 * dt);
    find_external();
    state_.load_sum = sum_of_loads();
  }
  if (drive_.changes() || !drive_.clamps().empty()) {
    u_before_.resize(particle_count());
    for (std::size_t i = 0; i < particle_count(); ++i) u_before_[i] = displacement(i);
  }
  if (drive_.turns()) on_free_before_ = force_on_free();
  clamped_before_.clear();
  for (const auto& clamp : drive_.clamps())
    for (const auto i : clamp.particles) clamped_before_.push_back({velocity(i), force_on(i)});
}

void SolidModel::move_clamps() {
  for (const auto& [motion, particles] : drive_.clamps()) {
    const Pose pose = motion.pose_at(state_.time);
    for (const auto i : particles) {
      const Vec& X = body_.X[i];
      set(state_.u, slot_[i], motion.turns() ? Vec(pose.place(X) - X) : pose.centre);
      set(state_.v, slot_[i], pose.velocity_of(X));
    }
  }
}

void SolidModel::end_drive() {
  if (drive_.changes())
    for (std::size_t i = 0; i < particle_count(); ++i)
      state_.work_of_changes +=
          mass(i) * (constant_[i] - drive_.steady()[i]).dot(displacement(i) - u_before_[i]);
  if (drive_.turns()) {
    const OnFree &before = on_free_before_, now = force_on_free();
    state_.work_of_clamps += 0.5 * (before.force + now.force).dot(now.pose.centre - before.pose.centre) +
                             0.5 * (before.moment + now.moment) * (now.pose.angle - before.pose.angle);
  }
  std::size_t n = 0;
  for (const auto& clamp : drive_.clamps())
    for (const auto i : clamp.particles) {
      const auto& [v_0, f_0] = clamped_before_[n++];
      const Vec v_1 = velocity(i), mean_force = 0.5 * (f_0 + force_on(i));
      state_.impulses.clamps += mass(i) * (v_1 - v_0);
      state_.work_of_clamps += 0.5 * mass(i) * (v_1.squaredNorm() - v_0.squaredNorm()) -
                               mean_force.dot(displacement(i) - u_before_[i]);
    }
}

}  // namespace toryu::solid
