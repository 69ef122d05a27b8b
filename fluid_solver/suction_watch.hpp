/// Watches for suction that a closed medium does not bear. Under a pressure of -sigma particles pair in modes
/// that the sums do not see, at a rate of about sqrt(sigma/rho)/d_0 (Swegle, Hicks & Attaway 1995; on a
/// square lattice 1.5 times that for the cubic spline with h/d_0 = 1.25, half of it for Wendland's with 2),
/// and what has paired transmits no suction: the medium looks whole, and the force on its walls is wrong. So
/// each particle has a path
///
///     ds_i = sqrt(|p_i|/rho_i) dt/d_0,   counted back where p_i > 0, never below 0
///
/// and where it is several spacings long the suction is lost (cases/retreating_piston/suction_map.toml).
/// Beside a free surface the pressure swings about zero anyway, and such a path means little (cases/dam_break
/// has many).
#pragma once

#include <optional>
#include <string>

#include "fluid_solver/particles.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

class SuctionWatch {
 public:
  SuctionWatch(double spacing, const EquationOfState& state) : spacing_(spacing), equation_of_state_(state) {}

  /// Looks at the fluid at `time` [s], as often as rows are written: one counts for a spacing at most. A
  /// sentence where enough paths have become too long. What tensile control takes the tension off,
  /// `fluid.off_surface_and_walls`, does not count.
  std::optional<std::string> look(const Particles& fluid, double time);
  /// All paths begin anew.
  void forget() { state_.path.clear(); }

 private:
  struct State {
    std::vector<double> path;  ///< by number at the start [spacings]
    double time = 0;           ///< of the last look [s]
  };
  template <class Archive>
  friend void serialize(Archive& archive, SuctionWatch& watch) {
    auto& [path, time] = watch.state_;
    archive(path, time);
  }

  double spacing_;
  EquationOfState equation_of_state_;
  State state_;
};

}  // namespace toryu::fluid
