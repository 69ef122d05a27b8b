/// What the scheme `serial_robin` hands the fluid: where the interface will move in a window, and the impulse
/// that the solid has taken beyond the load's force.
///
///     v = v_n + dt/2 a,   a += dt'/(dt' + tau) ((v_n - v_n-1)/dt' - a),   dt' the window before
///
/// from where the solid is. For motions slower than tau, the time in which sound crosses the fluid's kernel,
/// that is their mean velocity over the window, to the second order; faster ones, whose acceleration is not
/// known well enough to go on with, are taken as they are at the start. So the copy neither lags behind what
/// the fluid can tell from rest, which would feed waves in it, nor turns noise up.
#pragma once

#include "common/link/participant.hpp"

namespace toryu::coupling {

class Prediction {
 public:
  /// `at_start` is the solid's motion at the start of the run, `response_time` [s] is tau.
  Prediction(const InterfaceMotion& at_start, double response_time);

  /// The motion that the fluid is to follow over a window of `dt` [s], with the impulse to be given first.
  InterfaceMotion over(double dt) const;
  /// Takes the solid's motion at the end of a window of `dt` [s], and the impulse that it took.
  void note(const InterfaceMotion& at_end, double dt);

  const InterfaceMotion& now() const { return state_.now; }

  struct State {
    InterfaceMotion now = {};
    std::vector<double> acceleration = {};  ///< averaged [m/s2]
  };
  const State& state() const { return state_; }
  void resume(const State& then) { state_ = then; }

 private:
  double response_time_;
  State state_;
};

template <class Archive>
void serialize(Archive& archive, Prediction::State& state) {
  auto& [now, acceleration] = state;
  archive(now, acceleration);
}

}  // namespace toryu::coupling
