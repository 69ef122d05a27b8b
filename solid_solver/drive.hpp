/// What a case prescribes to the solid over time: gravity and loads that change, clamps that move.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solid_solver/body.hpp"
#include "solid_solver/parameters.hpp"

namespace toryu::solid {

class Drive {
 public:
  Drive() = default;
  Drive(const Parameters& parameters, const Body& body, const Scene& scene);

  /// Whether gravity or a load changes.
  bool changes() const { return changes_; }
  Vec gravity(double t) const;  ///< [m/s2]
  /// Whether a load's force acts on the particle, be it for a time.
  bool is_forced(std::size_t particle) const { return forced_[particle] != 0; }
  /// By gravity and loads, of each particle [m/s2].
  std::vector<Vec> accelerations(double t) const;
  /// Of the fastest sine in them [rad/s].
  double fastest_sine() const;
  /// Between two rows of a table in them [s]; infinite without tables.
  double shortest_interval() const;
  /// Of them what never changes.
  const std::vector<Vec>& steady() const { return steady_; }

  struct MovingClamp {
    Motion motion;
    std::vector<std::uint32_t> particles;
  };
  const std::vector<MovingClamp>& clamps() const { return clamps_; }
  /// Whether clamps turn; then all move as one.
  bool turns() const { return turns_; }
  Pose pose(double t) const;  ///< of clamps that turn

 private:
  struct Share {
    BoxLoad load;
    std::vector<std::uint32_t> particles;
    std::vector<double> masses = {};  ///< [kg/m]
  };
  Scene scene_;
  bool changes_ = false, turns_ = false;
  /// Adds constant pressures. What acts at a point of the surface is shared by the particles with the weights
  /// by which they make up the displacement there: its work is then that of the surface, and no layer below
  /// it gives way, as the first row does where it bears a load alone.
  void bear_pressures(const Parameters& parameters, const Body& body);

  std::vector<Vec> steady_;
  std::vector<char> forced_;
  std::vector<Share> changing_;  ///< loads
  std::vector<MovingClamp> clamps_;
};

/// Gives each clamp its motion: that which it names, or that of the wall which holds it. Faults go to `file`.
void take_motions(CaseFile& file, const Scene& scene, Parameters& parameters);
/// What is wrong with how clamps move, with the number of the clamp.
std::vector<std::pair<std::size_t, std::string>> clamp_faults(const Parameters& parameters);

}  // namespace toryu::solid
