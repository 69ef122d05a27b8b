#include <algorithm>
#include <cmath>

#include "common/scene/scene.hpp"

namespace toryu {

namespace {

using Row = std::vector<double>;

Vec velocity_of(const Row& row) {
  return Eigen::Map<const Vec>(row.data() + 1);
}

/// The first row later than `time`.
std::size_t next_row(const std::vector<Row>& rows, double time) {
  const auto later = [](double t, const Row& row) { return t < row[0]; };
  return static_cast<std::size_t>(std::upper_bound(rows.begin(), rows.end(), time, later) - rows.begin());
}

Vec slope_before(const std::vector<Row>& rows, std::size_t next) {
  if (next == 0 || next == rows.size()) return Vec::Zero();
  const Row &a = rows[next - 1], &b = rows[next];
  return (velocity_of(b) - velocity_of(a)) / (b[0] - a[0]);
}

/// Integral of the velocity from the first row's time to `time`: trapezoids, exact for a linear table.
Vec integral_to(const std::vector<Row>& rows, double time) {
  const double first = rows.front()[0];
  if (time <= first) return velocity_of(rows.front()) * (time - first);
  Vec sum = Vec::Zero();
  const std::size_t next = next_row(rows, time);
  for (std::size_t k = 1; k < next; ++k)
    sum += 0.5 * (velocity_of(rows[k - 1]) + velocity_of(rows[k])) * (rows[k][0] - rows[k - 1][0]);
  const Row& last = rows[next - 1];
  const double rest = time - last[0];
  return sum + velocity_of(last) * rest + 0.5 * slope_before(rows, next) * rest * rest;
}

}  // namespace

Vec Motion::velocity_at(double t) const {
  t /= time;
  const std::size_t next = next_row(velocity, t);
  if (next == 0) return speed * velocity_of(velocity.front());
  const Row& last = velocity[next - 1];
  return speed * (velocity_of(last) + slope_before(velocity, next) * (t - last[0]));
}

double Motion::largest_speed() const {
  double largest = 0;
  for (const Row& row : velocity) largest = std::max(largest, velocity_of(row).norm());
  return std::abs(speed) * largest;
}

Vec Motion::displacement_at(double t) const {
  return speed * time * (integral_to(velocity, t / time) - integral_to(velocity, 0));
}

Vec Motion::mean_acceleration(double t, double length) const {
  return (velocity_at(t + 0.5 * length) - velocity_at(t - 0.5 * length)) / length;
}

double largest_wall_speed(const Scene& scene) {
  double largest = 0;
  for (const Wall& wall : scene.walls)
    if (wall.motion) largest = std::max(largest, wall.motion->largest_speed());
  return largest;
}

}  // namespace toryu
