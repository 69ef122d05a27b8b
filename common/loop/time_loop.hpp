/// The time loop of a solver without a partner, and the sub-steps that it shares with the coupled one.
#pragma once

#include <functional>

#include "common/loop/run_record.hpp"

namespace toryu {

/// Advances over `length` [s] in equal sub-steps, as few as stability allows but at most `most`; returns how
/// many were taken of how many that length needs. Throws PhysicsFailure if stability asks for steps so small
/// that time would stand still.
struct SubSteps {
  long taken, needed;
  double dt;
};
SubSteps advance_by(Solver& solver, double length, long most = std::numeric_limits<long>::max());

/// Threads for a solver of so many particles: what the options say, or else as many cores as have
/// `particles_per_thread` of their own. With fewer, threads only wait for each other.
int thread_count(const Options& options, std::size_t particles, int particles_per_thread);

/// Advances over a coupling window from `time` [s], `length` [s] long, and records its end. After every
/// `steps_between_checks` sub-steps at most, `taken` hears of them and the state is checked.
void advance_window(Solver& solver, RunRecord& record, double time, double length, long steps_between_checks,
                    const std::function<void(const SubSteps&)>& taken);

/// Throws BadInput, at `section` of the case, if the state at the start is beyond the limits of physics.
void check_start(const Solver& solver, const std::string& section);

/// Runs to the end time of the scene; no messages, no other process. The time-step limit and the state are
/// looked at anew every `steps_between_checks`.
void run_alone(const Scene& scene, Solver& solver, RunRecord& record, long steps_between_checks);

/// Runs `body` and finishes `record` whatever the end is: the end of the body, or the exception that it
/// throws, which is told to `leave` (if any) and thrown on. `waiting_time` gives the time spent waiting for
/// partners [s].
void run_recorded(RunRecord& record, const std::function<void()>& body,
                  const std::function<void()>& leave = {}, const std::function<double()>& waiting_time = {});

}  // namespace toryu
