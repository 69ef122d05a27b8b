#include "common/run/team.hpp"

#include <algorithm>

namespace toryu {

namespace {

// Steps differ, and the core of a late member comes back after some milliseconds: a block has enough of both.
constexpr long fewest_steps = 20;
constexpr double shortest_block = 0.02;  // [s]

/// More threads must save so much of the time; fewer need only be as fast.
constexpr double least_gain = 0.1;

/// A block this much slower than the one before says that something has changed.
constexpr double sign_of_change = 1.3;

// A trial that does not pay costs less than half a block.
constexpr double shortest_patience = 0.1, longest_patience = 2.0;  // [s]

constexpr int enough_to_compare = 16;

}  // namespace

int useful_threads(int asked) {
  return std::min(asked, std::max(enough_to_compare, omp_get_num_procs()));
}

void ThreadChoice::note(double seconds) {
  if (most_ == 1) return;
  now_.seconds += seconds;
  ++now_.steps;
  since_trial_ += seconds;
  if (tried_ == best_) return look_at_block();
  // As many steps as the best number took last, and no more time than they did.
  const double limit = tried_ < best_ ? last_.seconds : (1 - least_gain) * last_.seconds;
  if (now_.seconds > limit)
    end_trial(false);
  else if (now_.steps == last_.steps)
    end_trial(true);
}

void ThreadChoice::look_at_block() {
  if (now_.steps < fewest_steps || now_.seconds < shortest_block) return;
  const bool changed = last_.steps > 0 && now_.mean() > sign_of_change * last_.mean();
  if (changed) patience_ = shortest_patience;
  last_ = now_;
  now_ = {};
  if (since_trial_ >= patience_) begin_trial();
}

void ThreadChoice::begin_trial() {
  const bool more = best_ == 1 || (best_ < most_ && try_more_);
  tried_ = more ? std::min(2 * best_, most_) : best_ / 2;
  try_more_ = !more;
}

void ThreadChoice::end_trial(bool pays) {
  if (pays) best_ = tried_;
  if (pays) last_ = now_;
  patience_ = pays ? shortest_patience : std::clamp(2 * patience_, shortest_patience, longest_patience);
  tried_ = best_;
  now_ = {};
  since_trial_ = 0;
}

}  // namespace toryu
