/// The elastic solid's interface as the fluid holds it: wall particles whose motion comes from the solid, and
/// the load that they bear.
#pragma once

#include "common/link/participant.hpp"
#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

class MovingInterface {
 public:
  /// `interface` as the solid registered it; the boundary takes its places.
  /// `response_time` [s] is the time over which its acceleration is averaged.
  void attach(const Interface& interface, Boundary& boundary, double rest_density, double strip_width,
              double response_time);

  /// Begins a window of `dt` [s] at `time` [s], in which the interface is brought to where `motion` says.
  /// Each particle goes there in a straight line from where the last window left it: displacement and
  /// velocity agree exactly, and no position ever jumps.
  ///
  /// The acceleration that (29) uses is the change of that velocity, averaged over the response time. Taken
  /// as it is, it would be an added mass that lags by a window: a layer of the solid with mass m_s per area
  /// would answer a change of acceleration by some rho_f d_0/m_s times as much of the opposite sign, which
  /// grows where that exceeds 1. Averaged over tau, the recursion is stable up to rho_f d_0/m_s = 2 tau/dt
  /// + 1. Left out altogether, the gate of cases/elastic_gate rings.
  void begin_window(const InterfaceMotion& motion, double time, double dt);
  /// Moves the boundary's particles to where they are at `time`.
  void move(Boundary& boundary, double time) const;

  /// Adds the boundary's force over `dt` [s] to the load; `received` is the force that the fluid got from it.
  void add_load(const Boundary& boundary, const Vec& received, double dt);
  /// The mean load since the last call.
  InterfaceLoad take_load();

 private:
  std::size_t count_ = 0;
  double response_time_ = 0, window_start_ = 0, last_dt_ = 0;
  std::vector<Vec> start_, end_, velocity_, acceleration_;  ///< over the present window
  double load_time_ = 0;
  InterfaceLoad sum_;
};

}  // namespace toryu::fluid
