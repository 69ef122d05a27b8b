/// The exchange audit: the impulse that one side gives must be the impulse that the other takes.
#pragma once

#include <vector>

#include "common/link/participant.hpp"

namespace toryu::coupling {

/// Sum of vectors that lie one after the other, dim values each.
Vec sum_of(const std::vector<double>& vectors);
/// Sum of their lengths.
double sum_of_lengths(const std::vector<double>& vectors);

class ExchangeAudit {
 public:
  /// Differences above this are reported: the two sides round differently, but no more.
  static constexpr double tolerance = 1e-12;

  /// Compares, over a window of `dt` [s], `of_fluid` (its whole load) and `returned` (the impulse that it was
  /// to give) with what the fluid says it received, and `applied` (what the solid was handed) and `excess`
  /// (what its impedance came to) with what the solid says it took. Returns the larger of the two
  /// differences, relative to the sum of the lengths of all these: the scale of what was summed.
  double compare(const InterfaceLoad& of_fluid, const std::vector<double>& returned,
                 const InterfaceLoad& applied, const std::vector<double>& excess, const Vec& impulse_taken,
                 double dt);

  double largest() const { return state_.largest; }

  struct State {
    double largest = 0;  ///< of the run
  };
  const State& state() const { return state_; }
  void resume(const State& then) { state_ = then; }

 private:
  State state_;
};

template <class Archive>
void serialize(Archive& archive, ExchangeAudit::State& state) {
  auto& [largest] = state;
  archive(largest);
}

}  // namespace toryu::coupling
