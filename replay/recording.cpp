#include "replay/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error/failure.hpp"

namespace toryu::replay {

namespace {

/// Over the larger of both numbers: what differs by less is rounding.
constexpr double rounding = 1e-9;

Vec sum_of(const std::vector<double>& vectors) {
  Vec sum = Vec::Zero();
  for (std::size_t k = 0; dim * k < vectors.size(); ++k) sum += vector_of(vectors, k);
  return sum;
}

/// Adds `share` times `more`; what is empty counts as zeros.
void add(std::vector<double>& sum, double share, const std::vector<double>& more) {
  sum.resize(std::max(sum.size(), more.size()), 0.0);
  for (std::size_t k = 0; k < more.size(); ++k) sum[k] += share * more[k];
}

}  // namespace

Recording::Recording(const std::filesystem::path& results, const CaseFile& file) : record_(results) {
  const double end_time = file.value<double>("case.end_time").value_or(0);
  if (record_.end() < end_time * (1 - rounding))
    throw BadInput({{.place = record_.path().string(),
                     .message = fmt::format("the record ends at t = {:g} s, before case.end_time = {:g} s; "
                                            "give --end-time",
                                            record_.end(), end_time)}});
}

void Recording::check(const Interface& interface) const {
  const auto& recorded = start().interface;
  const double tolerance = rounding * recorded.spacing;
  const bool same =
      interface.id == recorded.id &&
      std::equal(interface.position.begin(), interface.position.end(), recorded.position.begin(),
                 recorded.position.end(), [&](double a, double b) { return std::abs(a - b) <= tolerance; });
  if (!same)
    throw BadInput({{.place = record_.path().string(),
                     .message = fmt::format("holds the load of {} particles, and the solid has {} on its "
                                            "interface or has them elsewhere: a load can be replayed to the "
                                            "particles for which it was recorded",
                                            recorded.size(), interface.size())}});
}

void Recording::check_reach(double reach) const {
  const double recorded = start().traits.reach;
  if (reach > recorded * (1 + rounding))
    throw BadInput(
        {{.place = record_.path().string(),
          .message = fmt::format("holds the solid as deep as {:g} m, which the fluid of the record "
                                 "reached, and this fluid reaches {:g} m: record with the coarser "
                                 "fluid",
                                 recorded, reach)}});
}

template <class Add>
void Recording::over(const Window& window, const Add& add) {
  const double end = window.time + window.dt;
  for (std::size_t n = record_.at(window.time); n < record_.size(); ++n) {
    const RecordedWindow& recorded = record_.window(n);
    const double from = recorded.window.time, length = recorded.window.dt;
    if (from >= end) return;
    const double shared = std::min(from + length, end) - std::max(from, window.time);
    if (shared > 0) add(recorded, shared / length);
  }
}

FluidAnswer Recording::mean_over(const Window& window) {
  FluidAnswer mean;
  over(window, [&](const RecordedWindow& recorded, double share) {
    const double part = share * recorded.window.dt / window.dt;
    const InterfaceLoad& load = recorded.fluid.load;
    add(mean.load.pressure, part, load.pressure);
    add(mean.load.force, part, load.force);
    add(mean.load.friction_force, part, load.friction_force);
    add(mean.load.impedance, part, load.impedance);
    mean.load.work_of_impulse += share * load.work_of_impulse;
    mean.time_step_limit = recorded.fluid.time_step_limit;
    mean.health = recorded.fluid.health;
  });
  return mean;
}

FluidAnswer Recording::fluid_over(const Window& window, const std::vector<double>& returned) {
  const RecordedWindow& recorded = record_.window(record_.at(window.time + window.dt));
  const bool same = recorded.window.time == window.time && recorded.window.dt == window.dt;
  FluidAnswer answer = same ? recorded.fluid : mean_over(window);
  const InterfaceLoad& load = answer.load;
  answer.load.impulse_on_fluid =
      -(window.dt * (sum_of(load.force) + sum_of(load.friction_force)) + sum_of(returned));
  return answer;
}

const InterfaceMotion& Recording::motion_before(std::size_t number) {
  return number == 0 ? start().motion : record_.window(number - 1).solid.motion;
}

InterfaceMotion Recording::motion_within(std::size_t number, double time) {
  const InterfaceMotion begin = motion_before(number);
  const RecordedWindow& recorded = record_.window(number);
  const InterfaceMotion& end = recorded.solid.motion;
  const double dt = recorded.window.dt, s = std::clamp((time - recorded.window.time) / dt, 0.0, 1.0);
  const double r = 1 - s;
  InterfaceMotion motion;
  for (std::size_t k = 0; k < end.position.size(); ++k) {
    const double x_0 = begin.position[k], x_1 = end.position[k], v_0 = begin.velocity[k],
                 v_1 = end.velocity[k];
    motion.position.push_back(r * r * (1 + 2 * s) * x_0 + s * s * (3 - 2 * s) * x_1 +
                              dt * s * r * (r * v_0 - s * v_1));
    motion.velocity.push_back(6 * s * r * (x_1 - x_0) / dt + r * (1 - 3 * s) * v_0 + s * (3 * s - 2) * v_1);
  }
  return motion;
}

SolidAnswer Recording::solid_over(const Window& window, const InterfaceLoad& load) {
  const std::size_t number = record_.at(window.time + window.dt);
  const RecordedWindow recorded = record_.window(number);
  SolidAnswer answer = recorded.solid;
  if (recorded.window.time != window.time || recorded.window.dt != window.dt) {
    answer.motion = motion_within(number, window.time + window.dt);
    over(window, [&](const RecordedWindow& part, double share) {
      add(answer.motion.impulse, share, part.solid.motion.impulse);
      answer.motion.work_of_impulse += share * part.solid.motion.work_of_impulse;
    });
  }
  // A scheme with an impedance asks for an impulse, also of a record that was made without.
  if (!load.impedance.empty()) answer.motion.impulse.resize(answer.motion.position.size(), 0.0);
  answer.impulse_taken =
      window.dt * (sum_of(load.force) + sum_of(load.friction_force)) + sum_of(answer.motion.impulse);
  return answer;
}

}  // namespace toryu::replay
