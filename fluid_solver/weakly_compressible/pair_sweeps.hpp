/// The loops over all pairs: the terms of a case joined at compile time, for each kernel in a file of its
/// own.
#pragma once

#include <variant>
#include <vector>

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/terms/artificial_viscosity.hpp"
#include "fluid_solver/terms/density_diffusion.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/variable_viscosity.hpp"
#include "fluid_solver/terms/wall_repulsion.hpp"

namespace toryu::fluid {

/// A term that a case does without.
struct Absent {};

/// The terms that a case may add to continuity and pressure.
struct ChosenTerms {
  std::variant<Absent, DensityDiffusionTerm<false>, DensityDiffusionTerm<true>> diffusion;
  std::variant<Absent, ArtificialViscosityTerm> artificial;
  std::variant<Absent, LaminarViscosityTerm, VariableViscosityTerm> viscous;
  std::variant<Absent, WallRepulsionTerm> repulsion;
};

/// Which rates a sweep finds: the midpoint step wants both at once, the symplectic one by one.
enum class RatesOf { both, velocity, density };

/// What acts on each particle by itself: gravity, and a pull towards a centre.
struct BodyForce {
  Vec gravity = Vec::Zero();        ///< [m/s2]
  Vec centre = Vec::Zero();         ///< [m]
  double central_rate_squared = 0;  ///< acceleration towards the centre over the distance from it [1/s2]
};

struct PairSweeps {
  const ChosenTerms& terms;
  const BodyForce& body_force;
  bool viscous_walls;
  bool wall_suction;
  double rest_density;        ///< [kg/m3]
  bool tensile_control;       ///< needs `off_surface_and_walls` of the fluid
  bool axisymmetric = false;  ///< terms as they are about an axis (terms/axisymmetry.hpp)

  /// Fills the rates a, drho of `fluid`, and what each boundary did to it where the velocity is among them.
  /// Opens a parallel region. With `some`, only for these clusters. Defined for CubicSpline and WendlandC2.
  template <class W>
  void rates(const W& kernel, RatesOf wanted, Particles& fluid, const ClusterList& neighbours,
             std::vector<Boundary>& boundaries, const std::vector<std::uint32_t>* some = nullptr) const;

  /// Fills `boundary.force`: the forces on the fluid's side gathered pair by pair on the boundary's.
  template <class W>
  void reaction(const W& kernel, const Particles& fluid, Boundary& boundary) const;

 private:
  template <class W>
  void rates_about_axis(const W& kernel, RatesOf wanted, Particles& fluid, const ClusterList& neighbours,
                        std::vector<Boundary>& boundaries) const;
};

}  // namespace toryu::fluid
