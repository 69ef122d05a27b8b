/// The rates of change of the fluid: where the model is composed of its terms. Terms that a case does not ask
/// for are not in the compiled loop at all.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "fluid_solver/energy_balance.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/ranks/ranks.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/terms/rheology.hpp"
#include "fluid_solver/weakly_compressible/friction.hpp"
#include "fluid_solver/weakly_compressible/pair_sweeps.hpp"

namespace toryu::fluid {

class Dynamics {
 public:
  Dynamics(const Parameters& parameters, const Vec& gravity, const Kernel& kernel,
           const EquationOfState& state, Geometry geometry = Geometry::plane);

  /// Gives the fields that only this case's terms need their place.
  void allocate(Particles& fluid) const;

  /// Fills p, V, the boundaries' extrapolated values and the wanted rates a, drho of `fluid` from its state,
  /// and what each boundary did to the fluid where the velocity's rate is wanted. Of a part of a fluid over
  /// `ranks` the rates of what they sweep alone.
  void evaluate(RatesOf wanted, Particles& fluid, const ClusterList& neighbours,
                std::vector<Boundary>& boundaries, Timers& timers, const Ranks* ranks = nullptr) const;

  /// Finds drho anew for `clusters` of the fluid, after velocities have changed beside the interface. The
  /// rest of the last evaluation of drho must stand.
  void renew_density_rates(Particles& fluid, const ClusterList& neighbours, std::vector<Boundary>& boundaries,
                           const std::vector<std::uint32_t>& clusters) const;

  /// Fills `boundary.force`, the exact reaction to what the boundary did to the fluid in the last evaluation,
  /// gathered pair by pair on the boundary's side, and its `friction_force` where there is friction.
  void react(const Particles& fluid, double pressure_offset, Boundary& boundary) const;
  /// The latter alone.
  void react_by_friction(const Particles& fluid, double pressure_offset, Boundary& work_piece) const;

  /// Of a medium that is held at a mean pressure: what contact adds to p [Pa].
  double pressure_offset(const Particles& fluid, const std::vector<Boundary>& boundaries,
                         const Ranks* ranks) const;
  /// Of wall `b`, which turns: the moment on the fluid that the pair forces of a laminar viscosity leave out
  /// (wall_turning.hpp). It gives the fluid as much as its viscosity takes in addition [N.m per metre depth].
  double moment_beside_pairs(const Particles& fluid, const std::vector<Boundary>& boundaries, std::size_t b,
                             const Ranks* ranks) const;
  /// What each term of the case takes from the fluid's energy, with the fields of the last evaluation;
  /// nothing before the first step. Of a part of a fluid over `ranks`, on rank 0, what they take from the
  /// whole.
  std::vector<Power> powers(const Particles& fluid, const ClusterList& neighbours,
                            const std::vector<Boundary>& boundaries, const Ranks* ranks = nullptr) const;

  /// From now on [m/s2].
  void set_gravity(const Vec& gravity) { body_force_.gravity = gravity; }

  const Medium& medium() const { return medium_; }
  const Kernel& kernel() const { return medium_.kernel; }
  const EquationOfState& equation_of_state() const { return state_; }
  /// Empty if the case has none.
  const std::optional<WorkPieceFriction>& friction() const { return friction_; }
  std::vector<ActiveTerm> active_terms() const;
  /// Whether the viscosity is a field.
  bool viscosity_varies() const { return !std::holds_alternative<Absent>(rheology_); }
  /// Viscosity of the medium without shear [Pa s].
  double viscosity_at_rest() const { return viscosity_of(parameters_, 0.0); }

 private:
  void pressures(Particles& fluid) const;
  void wall_densities(Boundary& boundary) const;
  void density_gradients(Particles& fluid, const ClusterList& neighbours,
                         const std::vector<std::uint32_t>* some) const;
  void viscosities(Particles& fluid, const ClusterList& neighbours, std::vector<Boundary>& boundaries) const;
  void polymer_stresses(Particles& fluid, std::vector<Boundary>& boundaries) const;
  void log_conformation_rates(Particles& fluid, const ClusterList& neighbours,
                              const std::vector<Boundary>& boundaries,
                              const std::vector<std::uint32_t>* some) const;
  void brake_by_friction(Particles& fluid, std::vector<Boundary>& boundaries, const Ranks* ranks) const;
  bool axisymmetric() const { return geometry_ == Geometry::axisymmetric; }
  bool viscous_walls() const { return parameters_.wall_model.slip == WallSlip::no_slip; }
  bool renormalised_diffusion() const {
    return std::holds_alternative<DensityDiffusionTerm<true>>(terms_.diffusion);
  }
  PairSweeps sweeps() const {
    return {.terms = terms_,
            .body_force = body_force_,
            .viscous_walls = viscous_walls(),
            .wall_suction = parameters_.wall_model.suction,
            .rest_density = parameters_.density,
            .tensile_control = parameters_.tensile_control.has_value(),
            .axisymmetric = axisymmetric()};
  }

  Parameters parameters_;
  BodyForce body_force_;
  Medium medium_;
  EquationOfState state_;
  Geometry geometry_;
  ChosenTerms terms_;
  std::variant<Absent, PowerLaw, HerschelBulkley, Carreau> rheology_;
  std::optional<WorkPieceFriction> friction_;
};

}  // namespace toryu::fluid
