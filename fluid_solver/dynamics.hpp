/// The rates of change of the fluid: where the model is composed of its terms. Terms that a case does not ask
/// for are not in the compiled loop at all.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/friction.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/terms/artificial_viscosity.hpp"
#include "fluid_solver/terms/continuity.hpp"
#include "fluid_solver/terms/density_diffusion.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/pressure.hpp"
#include "fluid_solver/terms/rheology.hpp"
#include "fluid_solver/terms/variable_viscosity.hpp"
#include "fluid_solver/terms/wall_repulsion.hpp"

namespace toryu::fluid {

/// A term that a case does without.
struct Absent {};

/// What a boundary gave the fluid in one evaluation.
struct Given {
  std::vector<Vec> by_cluster;           ///< force on each cluster of the fluid [N per metre depth]
  std::vector<Vec> friction_by_cluster;  ///< the same of the friction alone; empty where there is none
  Vec force() const;                     ///< the sum of both
  Vec friction() const;
};

class Dynamics {
 public:
  Dynamics(const Parameters& parameters, const Vec& gravity);

  /// Fills p, V, the boundaries' extrapolated values and the rates a, drho of `fluid` from its state.
  /// `given[b]` becomes the force that boundary b exerted on the fluid.
  void evaluate(Particles& fluid, const ClusterList& neighbours, std::vector<Boundary>& boundaries,
                std::vector<Given>& given, Timers& timers) const;

  /// Fills `boundary.force`, the exact reaction to what the boundary did to the fluid in the last evaluation,
  /// gathered pair by pair on the boundary's side, and its `friction_force` where there is friction.
  void react(const Particles& fluid, Boundary& boundary) const;
  /// The latter alone.
  void react_by_friction(const Particles& fluid, Boundary& work_piece) const;

  const CubicSpline& kernel() const { return kernel_; }
  const EquationOfState& equation_of_state() const { return state_; }
  /// Empty if the case has none.
  const std::optional<WorkPieceFriction>& friction() const { return friction_; }
  std::vector<ActiveTerm> active_terms() const;
  /// Whether the viscosity is a field.
  bool viscosity_varies() const { return !std::holds_alternative<Absent>(rheology_); }
  /// Viscosity of the medium without shear [Pa s].
  double viscosity_at_rest() const;

 private:
  void pressures(Particles& fluid) const;
  void wall_densities(Boundary& boundary) const;
  void viscosities(Particles& fluid, const ClusterList& neighbours, std::vector<Boundary>& boundaries) const;
  bool viscous_walls() const { return parameters_.wall_model.slip == WallSlip::no_slip; }

  Parameters parameters_;
  Vec gravity_;
  CubicSpline kernel_;
  EquationOfState state_;
  std::variant<Absent, DensityDiffusionTerm<false>, DensityDiffusionTerm<true>> diffusion_;
  std::variant<Absent, ArtificialViscosityTerm> artificial_;
  std::variant<Absent, LaminarViscosityTerm, VariableViscosityTerm> viscous_;
  std::variant<Absent, WallRepulsionTerm> repulsion_;
  std::variant<Absent, PowerLaw, Carreau> rheology_;
  std::optional<WorkPieceFriction> friction_;
};

}  // namespace toryu::fluid
