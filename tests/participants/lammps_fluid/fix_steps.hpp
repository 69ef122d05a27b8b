/// The fix `toryu/steps` of LAMMPS: advances the fluid, a step of it in two of LAMMPS's, by the symplectic or
/// the midpoint steps of fluid_solver, and moves the solid's interface along.
#pragma once

#include "interface_motion.hpp"
#include "pair_sph.hpp"

namespace toryu::lammps_fluid {

/// What is wrong with the particle of the smallest number, and the extremes of all others.
struct Extremes {
  long number = none;   ///< that fails, from 0
  char quantity = ' ';  ///< s: speed [m/s], d: density [kg/m3], x: place [m]
  double value[dim] = {};
  double speed = 0, acceleration = 0;  ///< the largest [m/s], [m/s2]
  static constexpr long none = 1L << 60;
};

class FixSteps : public LAMMPS_NS::Fix {
 public:
  FixSteps(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) : Fix(lmp, argc, argv) { time_integrate = 1; }

  MovedInterface interface;
  double time = 0, dt = 0;  ///< of the step that comes [s]
  Extremes extremes;        ///< of own particles, over that step

  /// Before the two steps of LAMMPS.
  void begin(double length) {
    dt = length;
    half_ = 0;
    extremes = {};
  }
  /// Puts own particles of the interface where they are at `when` [s].
  void move_interface(double when);

  int setmask() override;
  void initial_integrate(int) override;
  void final_integrate() override;

 private:
  PairSph& pair() const;
  double* custom(const char* name) const { return pair().custom(name); }
  void drift(double length);
  void thicken(double length);
  void advance_from_start(double length);
  void note(int i, char quantity, double value, double second = 0);
  bool is_sound(int i);
  template <class Visit>
  void over_fluid(Visit&& visit) const;

  int half_ = 0;
};

}  // namespace toryu::lammps_fluid
