/// The audit of work: what the fluid gives to the interface should be what the solid takes from it. The
/// impulses agree to rounding, the work does not: the fluid's copy of the interface moves where it was
/// extrapolated to, the solid where it goes under the load. The difference is energy that the exchange makes;
/// where the copy follows a window late it is F_n . (dx_n - dx_n-1) a window (Piperno & Farhat 2001). It is
/// small where windows are short against what moves, and grows without end where the lag feeds a mode of the
/// solid.
#pragma once

#include <algorithm>
#include <vector>

#include "common/link/participant.hpp"

namespace toryu::coupling {

class WorkAudit {
 public:
  /// `start` is where the interface is at the start: dim coordinates a particle [m].
  explicit WorkAudit(const std::vector<double>& start) : state_{.fluid = start, .solid = start} {}

  /// Takes a window: the fluid sent `sent` while it brought its copy to `interface_position`, from
  /// `interface_start` or, if that is empty, from where the window before left it; the solid applied
  /// `applied` while its motion became `solid`, where its kinetic energy is `kinetic_energy` [J per metre
  /// depth].
  void note(const InterfaceLoad& sent, const std::vector<double>& interface_start,
            const std::vector<double>& interface_position, const InterfaceLoad& applied,
            const InterfaceMotion& solid, double kinetic_energy);

  double given() const { return state_.given; }      ///< by the fluid, since the start [J/m]
  double taken() const { return state_.taken; }      ///< by the solid [J/m]
  double made() const { return taken() - given(); }  ///< by the exchange [J/m]

  /// Whether the exchange feeds the solid: for some windows in a row it has made more than any kinetic energy
  /// that the solid ever had, more than a fifth of the largest work of the fluid (measured: at most a tenth
  /// in runs that are right, a quarter and more in runs that are wrong), and goes on to make more: what the
  /// start of a run makes stays as it is. What rounding makes of a body at rest does not count.
  bool feeds() const { return state_.suspicious >= windows_in_a_row; }

  /// Takes the energy of the solid and the kinetic energy of the fluid [J/m] after the window noted last.
  void note_energies(double of_solid, double of_fluid);
  /// Whether it feeds the solid with more than `share` of the largest work of the fluid, and of what the
  /// energy of the solid ever changed by. Where a stiff solid hardly moves, in work that is nothing beside
  /// the energy of the flow, it is of no account.
  bool feeds_beyond(double share) const {
    const double of_note = std::max(state_.largest_given, state_.largest_energy_change);
    return feeds() && made() > std::max(share * of_note, least_share_of_flow * state_.largest_fluid_energy);
  }

  struct State {
    std::vector<double> fluid = {}, solid = {};  ///< where both have their interface [m]
    double given = 0, taken = 0;
    double largest_given = 0, largest_kinetic_energy = 0;  ///< so far
    double first_energy = 0, largest_energy_change = 0,
           largest_fluid_energy = 0;  ///< of the solid, of the fluid [J/m]
    double rounding = 0;  ///< bound of what made() may be by rounding of the positions alone [J/m]
    unsigned long windows = 0;
    double made_at_power_of_two = 0, made_before = 0;  ///< at that window, and at half of it
    int suspicious = 0;                                ///< windows in a row
  };
  const State& state() const { return state_; }
  void resume(const State& then) { state_ = then; }

 private:
  static constexpr double bearable_share = 0.2;
  static constexpr double least_share_of_flow = 1e-6;
  static constexpr double least_growth = 1.8;  // since half the run or before
  static constexpr int windows_in_a_row = 20;

  State state_;
};

template <class Archive>
void serialize(Archive& archive, WorkAudit::State& state) {
  auto& [fluid, solid, given, taken, largest_given, largest_kinetic_energy, first_energy,
         largest_energy_change, largest_fluid_energy, rounding, windows, made_at_power_of_two, made_before,
         suspicious] = state;
  archive(fluid, solid, given, taken, largest_given, largest_kinetic_energy, first_energy,
          largest_energy_change, largest_fluid_energy, rounding, windows, made_at_power_of_two, made_before,
          suspicious);
}

}  // namespace toryu::coupling
