#include "common/loop/outlook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "common/run/team.hpp"

namespace toryu {

namespace {

constexpr double long_enough = 0.02;  // [s] of steps that are timed
constexpr int least_timed = 3, most_timed = 20;

std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 2 * minute) return fmt::format("{:.3g} s", seconds);
  if (seconds < 2 * hour) return fmt::format("{:.3g} min", seconds / minute);
  if (seconds < 2 * day) return fmt::format("{:.3g} h", seconds / hour);
  return fmt::format("{:.4g} days", seconds / day);
}

std::string number(double count) {
  return count < 1e5 ? fmt::format("{:.0f}", std::ceil(count)) : fmt::format("{:.3g}", count);
}

/// Wall time of a step [s], the least of some: other programs make it longer. The first one, which finds the
/// neighbours, is not counted.
double time_of_step(Solver& solver) {
  using Clock = std::chrono::steady_clock;
  Team team;
  const auto step = [&] { team.compute([&] { solver.advance(solver.time_step_limit()); }); };
  step();
  double least = std::numeric_limits<double>::infinity(), passed = 0;
  for (int n = 0; n < least_timed || (n < most_timed && passed < long_enough); ++n) {
    const auto start = Clock::now();
    step();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    least = std::min(least, seconds);
    passed += seconds;
  }
  return least;
}

}  // namespace

std::string outlook(const std::string& section, Solver& solver, double end_time) {
  const double dt = solver.time_step_limit(), steps = end_time / dt;
  const std::string rule(solver.time_step_rule());
  return fmt::format(
      "{}: time step {:.3g} s ({} limit) at the start, {} steps to t = {:g} s, about {} on this machine\n",
      section, dt, rule, number(steps), end_time, duration(steps * time_of_step(solver)));
}

}  // namespace toryu
