/// The elastic solid's interface as the fluid holds it: wall particles whose motion comes from the solid, and
/// the load that they bear.
#pragma once

#include "common/link/participant.hpp"
#include "fluid_solver/boundary_motion.hpp"

namespace toryu::fluid {

struct Boundary;

/// The turn that brings points from where they were to where they are, dim values each [m], as nearly as one
/// can (Kabsch 1976; in the plane).
Mat rotation_between(const std::vector<double>& before, const std::vector<double>& now);

class MovingInterface {
 public:
  /// `interface` as the solid registered it. `response_time` [s] is the time over which its acceleration is
  /// averaged. Where space repeats itself the solid goes on out of the domain, and its particles here come in
  /// at the other side.
  MovingInterface(const Interface& interface, double response_time);

  /// Begins a window of `dt` [s] at `time` [s], in which the interface is brought to where `motion` says.
  /// Each particle goes there in a straight line from where the last window left it: displacement and
  /// velocity agree exactly, and no position ever jumps. Only a motion with an impulse has a velocity of its
  /// own, and begins where the solid is: the way between is of second order in `dt`.
  ///
  /// The acceleration that (29) uses is the change of that velocity, averaged over the response time. Taken
  /// as it is, it would be an added mass that lags by a window: a layer of the solid with mass m_s per area
  /// would answer a change of acceleration by some rho_f d_0/m_s times as much of the opposite sign, which
  /// grows where that exceeds 1. Averaged over tau, the recursion is stable up to rho_f d_0/m_s = 2 tau/dt
  /// + 1. Left out altogether, the gate of cases/elastic_gate rings.
  void begin_window(const InterfaceMotion& motion, double time, double dt);
  /// Gives what particle k does at `time` [s].
  auto at(double time) const {
    return [this, since = time - state_.window_start](std::uint32_t k) {
      Vec x = state_.start[k] + state_.velocity[k] * since;
      if (!state_.periods.empty()) x += state_.periods[k];
      return Kinematics{x, state_.velocity[k], state_.acceleration[k]};
    };
  }
  /// Moves particle k by whole periods of space, besides those by which it was moved before [m].
  void move_by_periods(std::uint32_t k, const Vec& by);

  /// Adds the boundary's force over `dt` [s] to the load; `received` is the force that the fluid got from it.
  void add_load(const Boundary& boundary, const Vec& received, double dt);
  /// Takes impulses back that found no fluid, dim values a particle [N s/m]: the next load makes them good.
  /// `received` is what the fluid did get, `work` [J/m] what that did to it.
  void note_impulse(const std::vector<double>& not_given, const Vec& received, double work);
  /// The mean load since the last call.
  InterfaceLoad take_load();

 private:
  struct State {
    double window_start = 0, last_dt = 0;                 ///< [s]
    std::vector<Vec> start, end, velocity, acceleration;  ///< over the present window
    std::vector<Vec> periods;                             ///< from where the solid is [m]; empty: none
    double load_time = 0;                                 ///< [s]
    InterfaceLoad sum;                                    ///< of load times time
  };
  template <class Archive>
  friend void serialize(Archive& archive, MovingInterface& interface) {
    auto& [window_start, last_dt, start, end, velocity, acceleration, periods, load_time, sum] =
        interface.state_;
    auto& [pressure, force, friction_force, impulse_on_fluid, work_of_impulse, impedance, of_copy] = sum;
    archive(window_start, last_dt, start, end, velocity, acceleration, periods, load_time, pressure, force,
            friction_force, impulse_on_fluid, work_of_impulse, impedance, of_copy);
  }

  std::size_t count_;
  double response_time_;
  State state_;
};

}  // namespace toryu::fluid
