/// What shows in a run alone: the speed against that of sound, fluid in walls, a density that creeps, energy
/// from nowhere. Each is looked at where a row is written, told once, and ends the run where the result is
/// spoiled ([fluid.limits]).
///
///     speed     that a hundredth of the fluid exceeds, above 0.15 c_0: stopped, it changes the density by 1
///     %
///               (single particles of a splash press on nothing). The run ends at c_0, of any particle.
///     walls     particles inside (wall_penetration.hpp), 3 and more than a thousandth of the fluid
///     density   mass over volume of the fluid against the start, more than 3 % off
///     energy    what it has gained since its lowest beyond the work of the boundaries and what terms have
///               given back, above half of the largest energy that was turned over: kinetic, from gravity,
///               by boundaries and terms, held by pressure, sum_i m_i p_i^2/(2 rho_i^2 c_0^2); or, at rest,
///               that of a speed of 0.003 c_0, with which lattices and surfaces settle
#pragma once

#include "fluid_solver/parameters.hpp"
#include "fluid_solver/wall_penetration.hpp"

namespace toryu::fluid {

/// What a row tells of the fluid.
struct RunFigures {
  double time = 0;                           ///< [s]
  double fast = 0;                           ///< speed that a hundredth of the fluid exceeds [m/s]
  double mean_density = 0;                   ///< [kg/m3]
  std::size_t count = 0;                     ///< particles
  Penetration penetration = {};              ///< of them
  double gained = 0;                         ///< beyond what boundaries and terms gave [J per metre]
  double turned_over = 0, least_energy = 0;  ///< [J per metre]
};

class RunWatch {
 public:
  RunWatch(const Limits& limits, double sound_speed) : limits_(limits), sound_speed_(sound_speed) {}

  /// Warns in the log. Throws PhysicsFailure where the limits say so.
  void look(const RunFigures& figures);

 private:
  void look_at_speed(const RunFigures& now);
  void look_at_walls(const RunFigures& now);
  void look_at_density(const RunFigures& now);
  void look_at_energy(const RunFigures& now);

  struct State {
    bool told_speed = false, told_walls = false, told_density = false, told_energy = false;
    double start_density = 0;                 ///< [kg/m3]; 0 before the first look
    double lowest_gain = 0, turned_over = 0;  ///< [J per metre]
  };
  template <class Archive>
  friend void serialize(Archive& archive, RunWatch& watch) {
    auto& [told_speed, told_walls, told_density, told_energy, start_density, lowest_gain, turned_over] =
        watch.state_;
    archive(told_speed, told_walls, told_density, told_energy, start_density, lowest_gain, turned_over);
  }

  Limits limits_;
  double sound_speed_;
  State state_;
};

}  // namespace toryu::fluid
