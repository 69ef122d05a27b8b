#include "common/scene/gravity.hpp"

#include <Eigen/Geometry>

namespace toryu {

Vec GravityChange::at(const Vec& gravity, double t) const {
  Vec sum = gravity;
  for (int axis = 0; axis < dim; ++axis)
    sum[axis] += value_in(acceleration, t, static_cast<std::size_t>(axis) + 1);
  for (const Shake& shake : sine) sum += shake.value_at(t);
  return turning ? Vec(Eigen::Rotation2Dd(turning->angle_at(t)) * sum) : sum;
}

void describe(ParameterTable& table, Shake& shake) {
  describe_sine(table, shake, "m/s2");
}

void describe(ParameterTable& table, GravityChange& change) {
  table.rows("acceleration", change.acceleration, {"time [s]", "a_x [m/s2]", "a_y [m/s2]"},
             {.help = "added to 'gravity'; linear in between, constant before and after"});
  require_rising(table, "acceleration", change.acceleration, "times");
  table.list("sine", change.sine, "accelerations that swing, added to 'gravity'");
  table.optional("turning", change.turning, "the angle by which gravity, with all that is added, is turned");
  table.require(!change.acceleration.empty() || !change.sine.empty() || change.turning, "acceleration",
                "a change of gravity needs rows of its 'acceleration', a 'sine' or a 'turning'");
}

}  // namespace toryu
