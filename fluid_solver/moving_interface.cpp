#include "fluid_solver/moving_interface.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "a turn in the plane");

Mat rotation_between(const std::vector<double>& before, const std::vector<double>& now) {
  const std::size_t count = before.size() / dim;
  Vec from = Vec::Zero(), to = Vec::Zero();  // the middles
  for (std::size_t k = 0; k < count; ++k) {
    from += vector_of(before, k) / static_cast<double>(count);
    to += vector_of(now, k) / static_cast<double>(count);
  }
  double along = 0, across = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec r = vector_of(before, k) - from, s = vector_of(now, k) - to;
    along += r.dot(s);
    across += cross(r, s);
  }
  return Eigen::Rotation2Dd(std::atan2(across, along)).toRotationMatrix();
}

MovingInterface::MovingInterface(const Interface& interface, double response_time)
    : count_(interface.size()), response_time_(response_time) {
  for (std::size_t k = 0; k < count_; ++k) state_.start.push_back(vector_of(interface.position, k));
  state_.end = state_.start;
  state_.velocity.assign(count_, Vec::Zero());
  state_.acceleration = state_.velocity;
  take_load();
}

void MovingInterface::begin_window(const InterfaceMotion& motion, double time, double dt) {
  const bool first = state_.last_dt == 0, has_velocity = first || !motion.impulse.empty();
  const double share = state_.last_dt / (state_.last_dt + response_time_);
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec now = vector_of(motion.position, k);
    state_.start[k] = has_velocity ? Vec(now - vector_of(motion.velocity, k) * dt) : state_.end[k];
    state_.end[k] = now;
    const Vec mean = (state_.end[k] - state_.start[k]) / dt;
    const Vec change = first ? Vec(Vec::Zero()) : Vec((mean - state_.velocity[k]) / state_.last_dt);
    state_.acceleration[k] += share * (change - state_.acceleration[k]);
    state_.velocity[k] = mean;
  }
  state_.window_start = time;
  state_.last_dt = dt;
}

void MovingInterface::move_by_periods(std::uint32_t k, const Vec& by) {
  state_.periods.resize(count_, Vec::Zero());
  state_.periods[k] += by;
}

void MovingInterface::note_impulse(const std::vector<double>& not_given, const Vec& received, double work) {
  for (std::size_t n = 0; n < not_given.size(); ++n) state_.sum.force[n] -= not_given[n];
  state_.sum.impulse_on_fluid += received;
  state_.sum.work_of_impulse += work;
}

void MovingInterface::add_load(const Boundary& boundary, const Vec& received, double dt) {
  for (std::size_t k = 0; k < boundary.count; ++k) {
    const std::size_t n = boundary.id[k];
    state_.sum.pressure[n] += boundary.p[k] * dt;
    for (int a = 0; a < dim; ++a)
      state_.sum.force[dim * n + static_cast<std::size_t>(a)] += boundary.force[a][k] * dt;
  }
  if (!boundary.friction_force[0].empty()) {
    state_.sum.friction_force.resize(dim * count_);
    for (std::size_t k = 0; k < boundary.count; ++k) {
      const std::size_t n = boundary.id[k];
      for (int a = 0; a < dim; ++a)
        state_.sum.friction_force[dim * n + static_cast<std::size_t>(a)] +=
            boundary.friction_force[a][k] * dt;
    }
  }
  state_.sum.impulse_on_fluid += received * dt;
  state_.load_time += dt;
}

InterfaceLoad MovingInterface::take_load() {
  InterfaceLoad mean = std::move(state_.sum);
  for (auto* values : {&mean.pressure, &mean.force, &mean.friction_force})
    for (double& value : *values) value /= state_.load_time;
  state_.sum = InterfaceLoad{};
  state_.sum.pressure.assign(count_, 0.0);
  state_.sum.force.assign(dim * count_, 0.0);
  state_.load_time = 0;
  return mean;
}

}  // namespace toryu::fluid
