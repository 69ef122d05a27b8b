/// Where the solid's interface will be: the position to which the fluid brings its copy by the end of a
/// window, before the solid has computed that window.
///
///     x = x_n + tau v_n + tau^2/2 a_n,   a_n = (v_n - v_n-1)/dt_n-1 at order 2, else left out
///
/// From order 1 on tau is the window's length: the copy is where the solid will be, but for the error of the
/// extrapolation. At order 0 it follows one window late, as in the usual staggered scheme: tau is what this
/// window is longer than the first one, zero in most. Late by the same time always, the copy keeps its speed
/// when windows change their length.
#pragma once

#include "common/link/participant.hpp"

namespace toryu::coupling {

class Extrapolation {
 public:
  /// `order` is 0, 1 or 2; `at_start` the solid's motion at the start of the run.
  Extrapolation(int order, const InterfaceMotion& at_start) : order_(order), state_{.now = at_start} {}

  /// The motion that the fluid is to follow over a window of `dt` [s]. Its velocity is that of the way from
  /// the solid's present position (at order 0 the solid's own).
  InterfaceMotion over(double dt) const;
  /// Takes the solid's motion at the end of a window of `dt` [s].
  void note(const InterfaceMotion& at_end, double dt);

  const InterfaceMotion& now() const { return state_.now; }

  struct State {
    InterfaceMotion now = {};
    std::vector<double> past_velocity = {};  ///< at the start of the last window [m/s]
    double first_dt = 0, last_dt = 0;        ///< [s]
  };
  const State& state() const { return state_; }
  void resume(const State& then) { state_ = then; }

 private:
  int order_;
  State state_;
};

template <class Archive>
void serialize(Archive& archive, Extrapolation::State& state) {
  auto& [now, past_velocity, first_dt, last_dt] = state;
  archive(now, past_velocity, first_dt, last_dt);
}

}  // namespace toryu::coupling
