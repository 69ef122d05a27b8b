/// How many threads compute a solver's steps: as many as pay at present. A team is as late as its last
/// member: where another program holds the core of one, the others wait, and fewer threads are faster.
/// Nothing tells that but a watch, so another number is tried now and then. Results do not depend on it.
#pragma once

#include <omp.h>

#include <chrono>

namespace toryu {

/// `asked` as far as it can be of use: some more threads than cores are let be, to compare results over their
/// numbers; very many would be more than the system gives.
int useful_threads(int asked);

/// Which number of threads pays, by what the steps take.
class ThreadChoice {
 public:
  /// At most `most`.
  explicit ThreadChoice(int most) : most_(most), best_(most), tried_(most) {}

  /// For the next step.
  int threads() const { return tried_; }
  /// Takes note of what that step took [s].
  void note(double seconds);

 private:
  /// So many steps in a row.
  struct Block {
    double seconds = 0;
    long steps = 0;
    double mean() const { return seconds / static_cast<double>(steps); }
  };
  void look_at_block();
  void begin_trial();
  void end_trial(bool pays);

  int most_, best_, tried_;
  bool try_more_ = false;   // next
  Block now_, last_;        // under way with `tried_`; the last one with `best_`
  double since_trial_ = 0;  // [s]
  double patience_ = 0;     // from one trial to the next [s]
};

/// The threads of this process, of which there is one team.
class Team {
 public:
  /// Calls `step` with as many threads as pay, at most as many as OpenMP has before the first one.
  template <class Step>
  void compute(Step&& step) {
    using Clock = std::chrono::steady_clock;
    omp_set_num_threads(choice_.threads());
    const auto start = Clock::now();
    step();
    choice_.note(std::chrono::duration<double>(Clock::now() - start).count());
  }

 private:
  ThreadChoice choice_{omp_get_max_threads()};
};

}  // namespace toryu
