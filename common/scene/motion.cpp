#include "common/scene/motion.hpp"

#include <algorithm>
#include <cmath>

namespace toryu {

namespace {

using Row = std::vector<double>;

/// What a row has beside its time.
template <int N>
using Values = Eigen::Matrix<double, N, 1>;
template <int N>
Values<N> values_of(const Row& row) {
  return Eigen::Map<const Values<N>>(row.data() + 1);
}

/// The first row later than `time`.
std::size_t next_row(const Rows& rows, double time) {
  const auto later = [](double t, const Row& row) { return t < row[0]; };
  return static_cast<std::size_t>(std::upper_bound(rows.begin(), rows.end(), time, later) - rows.begin());
}

// --- tables of rates: linear in between, constant beyond

template <int N>
Values<N> slope_before(const Rows& rows, std::size_t next) {
  if (next == 0 || next == rows.size()) return Values<N>::Zero();
  const Row &a = rows[next - 1], &b = rows[next];
  return (values_of<N>(b) - values_of<N>(a)) / (b[0] - a[0]);
}

template <int N>
Values<N> rate_in(const Rows& rows, double time) {
  const std::size_t next = next_row(rows, time);
  if (next == 0) return values_of<N>(rows.front());
  const Row& last = rows[next - 1];
  return values_of<N>(last) + slope_before<N>(rows, next) * (time - last[0]);
}

/// Integral of the rate from the first row's time to `time`: trapezoids, exact for a linear table.
template <int N>
Values<N> integral_to(const Rows& rows, double time) {
  const double first = rows.front()[0];
  if (time <= first) return values_of<N>(rows.front()) * (time - first);
  Values<N> sum = Values<N>::Zero();
  const std::size_t next = next_row(rows, time);
  for (std::size_t k = 1; k < next; ++k)
    sum += 0.5 * (values_of<N>(rows[k - 1]) + values_of<N>(rows[k])) * (rows[k][0] - rows[k - 1][0]);
  const Row& last = rows[next - 1];
  const double rest = time - last[0];
  return sum + values_of<N>(last) * rest + 0.5 * slope_before<N>(rows, next) * rest * rest;
}

// --- tables of values: cubic in between, or linear where the rate may jump; constant beyond

/// Of the parabola through a row and its neighbours; 0 at the ends.
template <int N>
Values<N> slope_at(const Rows& rows, std::size_t k) {
  if (k == 0 || k + 1 == rows.size()) return Values<N>::Zero();
  const double before = rows[k][0] - rows[k - 1][0], after = rows[k + 1][0] - rows[k][0];
  const Values<N> rate_before = slope_before<N>(rows, k), rate_after = slope_before<N>(rows, k + 1);
  return (after * rate_before + before * rate_after) / (before + after);
}

/// A stretch between two rows: value and rate at `time` within it.
template <int N>
struct Cubic {
  Cubic(const Rows& rows, std::size_t next, double time, bool straight)
      : length(rows[next][0] - rows[next - 1][0]),
        s((time - rows[next - 1][0]) / length),
        first(values_of<N>(rows[next - 1])),
        chord(values_of<N>(rows[next]) - first),
        // the slopes at its ends beyond that of the chord, by the length
        g(straight ? Values<N>(Values<N>::Zero()) : Values<N>(length * slope_at<N>(rows, next - 1) - chord)),
        h(straight ? Values<N>(Values<N>::Zero()) : Values<N>(length * slope_at<N>(rows, next) - chord)) {}
  double length, s;
  Values<N> first, chord, g, h;
  Values<N> value() const { return first + s * chord + s * (1 - s) * ((1 - s) * g - s * h); }
  Values<N> rate() const { return (chord + (1 - s) * (1 - 3 * s) * g + s * (3 * s - 2) * h) / length; }
};

template <int N>
Values<N> value_in_table(const Rows& rows, double time, bool straight) {
  const std::size_t next = next_row(rows, time);
  if (next == 0) return values_of<N>(rows.front());
  if (next == rows.size()) return values_of<N>(rows.back());
  return Cubic<N>(rows, next, time, straight).value();
}

template <int N>
Values<N> rate_in_table(const Rows& rows, double time, bool straight) {
  const std::size_t next = next_row(rows, time);
  if (next == 0 || next == rows.size()) return Values<N>::Zero();
  return Cubic<N>(rows, next, time, straight).rate();
}

}  // namespace

double Turning::angle_at(double t) const {
  double sum = 0;
  if (!angle.empty()) sum += value_in_table<1>(angle, t, jumps)[0] - value_in_table<1>(angle, 0, jumps)[0];
  if (!angular_velocity.empty())
    sum += integral_to<1>(angular_velocity, t)[0] - integral_to<1>(angular_velocity, 0)[0];
  for (const Roll& roll : sine) sum += roll.value_at(t) - roll.value_at(0);
  return sum;
}

double Turning::rate_at(double t) const {
  double sum = 0;
  if (!angle.empty()) sum += rate_in_table<1>(angle, t, jumps)[0];
  if (!angular_velocity.empty()) sum += rate_in<1>(angular_velocity, t)[0];
  for (const Roll& roll : sine) sum += roll.rate_at(t);
  return sum;
}

Vec Motion::velocity_at(double t) const {
  Vec sum = velocity.empty() ? Vec(Vec::Zero()) : Vec(speed * rate_in<dim>(velocity, t / time));
  if (!position.empty()) sum += rate_in_table<dim>(position, t, jumps);
  for (const Sway& sway : sine) sum += sway.rate_at(t);
  return sum;
}

Vec Motion::displacement_at(double t) const {
  Vec sum = Vec::Zero();
  if (!velocity.empty())
    sum = speed * time * (integral_to<dim>(velocity, t / time) - integral_to<dim>(velocity, 0));
  if (!position.empty())
    sum += value_in_table<dim>(position, t, jumps) - value_in_table<dim>(position, 0, jumps);
  for (const Sway& sway : sine) sum += sway.value_at(t) - sway.value_at(0);
  return sum;
}

Vec Motion::mean_acceleration(double t, double length) const {
  return (velocity_at(t + 0.5 * length) - velocity_at(t - 0.5 * length)) / length;
}

double Motion::mean_angular_acceleration(double t, double length) const {
  if (!rotation) return 0;
  const Turning& turning = rotation->turning;
  return (turning.rate_at(t + 0.5 * length) - turning.rate_at(t - 0.5 * length)) / length;
}

Pose Motion::pose_at(double t) const {
  Pose pose;
  pose.centre = displacement_at(t);
  pose.velocity = velocity_at(t);
  if (!rotation) return pose;
  pose.about = rotation->about;
  pose.centre += rotation->about;
  pose.angle = rotation->turning.angle_at(t);
  pose.angular_velocity = rotation->turning.rate_at(t);
  pose.rotation << std::cos(pose.angle), -std::sin(pose.angle), std::sin(pose.angle), std::cos(pose.angle);
  return pose;
}

}  // namespace toryu
