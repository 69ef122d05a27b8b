/// The time loop of a solver without a partner, and the sub-steps that it shares with the coupled one.
#pragma once

#include <functional>

#include "common/case/case_file.hpp"
#include "common/link/participant.hpp"
#include "common/loop/checkpoints_alone.hpp"
#include "common/loop/run_record.hpp"
#include "common/run/options.hpp"

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

/// Advances over a coupling window from `time` [s], `length` [s] long. After every `steps_between_checks`
/// sub-steps at most, `taken` hears of them, the state is checked, and what is left of the window is divided
/// anew if the limit has fallen by more than a twentieth: for less, one step more would do twice the work.
void advance_window(Solver& solver, RunRecord& record, double time, double length, long steps_between_checks,
                    const std::function<void(const SubSteps&)>& taken);

/// Takes the turns of a coupled run until it is over, from its start or from the checkpoint from which it
/// goes on; `take` computes a window and answers it. What a window leaves in files is written when it is
/// final: at its end, or where windows may be repeated when the next turn has come.
template <class Link, class Take>
void take_windows(Link& link, Solver& solver, RunRecord& record, Take&& take) {
  if (const auto checkpoint = link.restart(); !checkpoint.empty())
    record.read_checkpoint(checkpoint);
  else
    record.check_and_write(0);
  double pending = 0;  // end of a window that is not written yet [s]
  const auto settle = [&] {
    if (pending > 0) record.write(pending);
    pending = 0;
  };
  while (const auto turn = link.next_turn()) {
    if (turn->task == Task::checkpoint) {
      settle();
      link.confirm_checkpoint([&] { record.write_checkpoint(turn->checkpoint); });
      continue;
    }
    if (turn->iteration > 0) {
      solver.restore();
    } else if (link.windows_repeat()) {
      settle();
      solver.save();
    }
    take(*turn);
    pending = turn->time + turn->dt;
    if (!link.windows_repeat()) settle();
  }
  settle();
}

/// Throws BadKey, of `section` of the case, if the state at the start is beyond the limits of physics.
void check_start(const Solver& solver, const std::string& section);

/// Runs to the end time of the scene, from where `record` is; no messages, no other process. The time-step
/// limit and the state are looked at anew every `steps_between_checks`.
void run_alone(const Scene& scene, Solver& solver, RunRecord& record, long steps_between_checks,
               CheckpointsAlone& checkpoints);

/// Runs `body` and finishes `record` whatever the end is: the end of the body, or the exception that it
/// throws, which is told to `leave` (if any) and thrown on. `waiting_time` gives the time spent waiting for
/// partners [s].
void run_recorded(RunRecord& record, const std::function<void()>& body,
                  const std::function<void()>& leave = {}, const std::function<double()>& waiting_time = {});

}  // namespace toryu
