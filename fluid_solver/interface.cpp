#include "fluid_solver/interface.hpp"

namespace toryu::fluid {

namespace {
Vec item(const std::vector<double>& values, std::size_t k) {
  return Vec(Eigen::Map<const Vec>(values.data() + dim * k));
}
}  // namespace

void MovingInterface::attach(const Interface& interface, Boundary& boundary, double rest_density,
                             double strip_width, double response_time) {
  response_time_ = response_time;
  count_ = interface.size();
  std::vector<Vec> positions(count_);
  for (std::size_t k = 0; k < count_; ++k) positions[k] = item(interface.position, k);
  boundary.name = "interface";
  boundary.moves = true;
  boundary.place(positions, interface.volume, rest_density, strip_width);
  std::vector<Vec> area_vectors(count_);
  for (std::size_t k = 0; k < count_; ++k) area_vectors[k] = item(interface.area_vector, k);
  boundary.make_work_piece(area_vectors);
  start_ = end_ = positions;
  velocity_.assign(count_, Vec::Zero());
  acceleration_ = velocity_;
  take_load();
}

void MovingInterface::begin_window(const InterfaceMotion& motion, double time, double dt) {
  const bool first = last_dt_ == 0;
  const double share = last_dt_ / (last_dt_ + response_time_);
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec now = item(motion.position, k);
    start_[k] = first ? Vec(now - item(motion.velocity, k) * dt) : end_[k];
    end_[k] = now;
    const Vec mean = (end_[k] - start_[k]) / dt;
    const Vec change = first ? Vec(Vec::Zero()) : Vec((mean - velocity_[k]) / last_dt_);
    acceleration_[k] += share * (change - acceleration_[k]);
    velocity_[k] = mean;
  }
  window_start_ = time;
  last_dt_ = dt;
}

void MovingInterface::move(Boundary& boundary, double time) const {
  const double since = time - window_start_;
  boundary.move([&](std::uint32_t k) {
    return Kinematics{start_[k] + velocity_[k] * since, velocity_[k], acceleration_[k]};
  });
}

void MovingInterface::add_load(const Boundary& boundary, const Vec& received, double dt) {
  for (std::size_t k = 0; k < boundary.count; ++k) {
    const std::size_t n = boundary.id[k];
    sum_.pressure[n] += boundary.p[k] * dt;
    for (int a = 0; a < dim; ++a)
      sum_.force[dim * n + static_cast<std::size_t>(a)] += boundary.force[a][k] * dt;
  }
  if (!boundary.friction_force[0].empty()) {
    sum_.friction_force.resize(dim * count_);
    for (std::size_t k = 0; k < boundary.count; ++k)
      for (int a = 0; a < dim; ++a)
        sum_.friction_force[dim * boundary.id[k] + static_cast<std::size_t>(a)] +=
            boundary.friction_force[a][k] * dt;
  }
  sum_.impulse_on_fluid += received * dt;
  load_time_ += dt;
}

InterfaceLoad MovingInterface::take_load() {
  InterfaceLoad mean = std::move(sum_);
  for (auto* values : {&mean.pressure, &mean.force, &mean.friction_force})
    for (double& value : *values) value /= load_time_;
  sum_ = InterfaceLoad{};
  sum_.pressure.assign(count_, 0.0);
  sum_.force.assign(dim * count_, 0.0);
  load_time_ = 0;
  return mean;
}

}  // namespace toryu::fluid
