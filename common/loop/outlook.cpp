#include "common/loop/outlook.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error/failure.hpp"

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

/// Seconds that pass for one thread by the processor's clock, for more by that on the wall: beside other
/// programs a step takes far longer on the wall, and a long one longer than many short ones.
double now(int threads) {
  timespec time{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Time of a step [s] with this number of threads, the least of some.
double time_of_step(Solver& solver, int threads) {
  omp_set_num_threads(threads);
  double least = std::numeric_limits<double>::infinity(), passed = 0;
  for (int n = 0; n < least_timed || (n < most_timed && passed < long_enough); ++n) {
    const double start = now(threads);
    solver.advance(solver.time_step_limit());
    const double seconds = now(threads) - start;
    least = std::min(least, seconds);
    passed += seconds;
  }
  return least;
}

/// As in a run, which takes as many threads as pay.
double time_of_step(Solver& solver) {
  const int threads = omp_get_max_threads();
  solver.advance(solver.time_step_limit());  // finds the neighbours
  const double alone = time_of_step(solver, 1);
  return threads > 1 ? std::min(alone, time_of_step(solver, threads)) : alone;
}

}  // namespace

Outlook outlook(const std::string& section, Solver& solver, double end_time) {
  const double dt = solver.time_step_limit(), steps = end_time / dt;
  const std::string rule(solver.time_step_rule());
  if (!(dt > 0 && std::isfinite(dt) && std::isfinite(steps)))
    throw BadInput(
        {{.place = section, .message = fmt::format("the time step would be {:.3g} s ({} limit)", dt, rule)}});
  std::optional<double> time;
  std::string told;
  try {
    time = steps * time_of_step(solver);
    told = "about " + duration(*time) + " on this machine";
  } catch (const PhysicsFailure& failure) {
    told = std::string("but the first ones fail: ") + failure.what();
  }
  return {fmt::format("{}: time step {:.3g} s ({} limit) at the start, {} step{} to t = {:g} s, {}\n",
                      section, dt, rule, number(steps), steps > 1 ? "s" : "", end_time, told),
          time};
}

}  // namespace toryu
