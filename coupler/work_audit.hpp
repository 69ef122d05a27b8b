/// The audit of work: what the fluid gives to the interface should be what the solid takes from it. The
/// impulses agree to rounding, the work does not: the fluid's copy of the interface moves where it was
/// forecast, the solid where it goes under the load. The difference is energy that the exchange makes; where
/// the copy follows a window late it is F_n . (dx_n - dx_n-1) a window (Piperno & Farhat 2001). It is small
/// where windows are short against what moves, and grows without end where the lag feeds a mode of the solid.
#pragma once

#include <vector>

#include "common/link/participant.hpp"

namespace toryu::coupling {

class WorkAudit {
 public:
  /// `start` is where the interface is at the start: dim coordinates a particle [m].
  explicit WorkAudit(const std::vector<double>& start) : fluid_(start), solid_(start) {}

  /// Takes a window: the fluid gave `given` while it brought its copy to `fluid`, the solid took `taken`
  /// while it went to `solid`, where its kinetic energy is `kinetic_energy` [J per metre depth].
  void note(const InterfaceLoad& given, const std::vector<double>& fluid, const InterfaceLoad& taken,
            const std::vector<double>& solid, double kinetic_energy);

  double given() const { return given_; }          ///< by the fluid, since the start [J/m]
  double taken() const { return taken_; }          ///< by the solid [J/m]
  double made() const { return taken_ - given_; }  ///< by the exchange [J/m]

  /// Whether the exchange feeds the solid: for some windows in a row it has made more than any kinetic energy
  /// that the solid ever had, more than a fifth of the largest work of the fluid (measured: at most a tenth
  /// in runs that are right, a quarter and more in runs that are wrong), and goes on to make more: what the
  /// start of a run makes stays as it is.
  bool feeds() const { return suspicious_ >= windows_in_a_row; }

 private:
  static constexpr double bearable_share = 0.2;
  static constexpr double least_growth = 1.8;  // since half the run or before
  static constexpr int windows_in_a_row = 20;

  std::vector<double> fluid_, solid_;
  double given_ = 0, taken_ = 0;
  double largest_given_ = 0, largest_kinetic_energy_ = 0;  // so far
  unsigned long windows_ = 0;
  double made_at_power_of_two_ = 0, made_before_ = 0;  // at that window, and at half of it
  int suspicious_ = 0;
};

}  // namespace toryu::coupling
