/// The optional terms of a fluid. A term is one file in terms/: what a case says of it, what the log says,
/// and its formula. A new one is a member here, and a name in the list below it, which does not compile while
/// a name is missing; a term whose formula is a force between pairs acts from then on
/// (weakly_compressible/further_forces.hpp).
#pragma once

#include <optional>
#include <type_traits>

#include "fluid_solver/terms/artificial_viscosity.hpp"
#include "fluid_solver/terms/central_force.hpp"
#include "fluid_solver/terms/consistent_gradients.hpp"
#include "fluid_solver/terms/density_diffusion.hpp"
#include "fluid_solver/terms/enclosed_medium.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/terms/friction.hpp"
#include "fluid_solver/terms/held_volume.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/particle_shifting.hpp"
#include "fluid_solver/terms/removal.hpp"
#include "fluid_solver/terms/rheology.hpp"
#include "fluid_solver/terms/surface_tension.hpp"
#include "fluid_solver/terms/tensile_control.hpp"
#include "fluid_solver/terms/viscoelasticity.hpp"
#include "fluid_solver/terms/wall_repulsion.hpp"
#include "fluid_solver/terms/wall_slip.hpp"

namespace toryu::fluid {

/// In the order in which a case lists them.
struct OptionalTerms {
  std::optional<CentralForce> central_force;
  std::optional<BackgroundPressure> background_pressure;
  std::optional<EnclosedMedium> enclosed_medium;
  std::optional<HeldVolume> held_volume;
  std::optional<DensityDiffusion> density_diffusion;
  std::optional<ParticleShifting> particle_shifting;
  std::optional<TensileControl> tensile_control;
  std::optional<ConsistentGradients> consistent_gradients;
  std::optional<ArtificialViscosity> artificial_viscosity;
  std::optional<LaminarViscosity> laminar_viscosity;
  std::optional<PowerLaw> power_law;
  std::optional<HerschelBulkley> herschel_bulkley;
  std::optional<Carreau> carreau;
  std::optional<Viscoelasticity> viscoelasticity;
  std::optional<SlipLaw> wall_slip;
  std::optional<Friction> friction;
  std::optional<WallRepulsion> wall_repulsion;
  std::optional<SurfaceTension> surface_tension;
  std::optional<Removal> removal;
};

/// Whether the case gives its medium a viscosity of its own.
inline bool is_viscous(const OptionalTerms& terms) {
  return terms.laminar_viscosity || terms.power_law || terms.herschel_bulkley || terms.carreau;
}
/// Viscosity of the medium at a shear rate [1/s], artificial viscosity and polymer apart; 0 without one
/// [Pa s].
inline double viscosity_of(const OptionalTerms& terms, double shear_rate) {
  if (terms.power_law) return viscosity(*terms.power_law, shear_rate);
  if (terms.herschel_bulkley) return viscosity(*terms.herschel_bulkley, shear_rate);
  if (terms.carreau) return viscosity(*terms.carreau, shear_rate);
  return terms.laminar_viscosity ? terms.laminar_viscosity->dynamic_viscosity : 0.0;
}

/// Whether a term is among those that a model or a geometry has.
template <class Term, class... Known>
constexpr bool is_one_of = (std::is_same_v<Term, Known> || ...);

/// What it means that a case does not mention the term.
template <class Term>
constexpr Absence absence_of() {
  // Without it the pressure of water at rest grows noise until the run fails, whatever the integrator and
  // step.
  return std::is_same_v<Term, DensityDiffusion> ? Absence::takes_defaults : Absence::leaves_out;
}

/// Calls visit(term) for the std::optional of each.
template <class Terms, class Visit>
void for_each_term(Terms& terms, Visit&& visit) {
  using Base = std::conditional_t<std::is_const_v<Terms>, const OptionalTerms, OptionalTerms>;
  auto& [central_force, background_pressure, enclosed_medium, held_volume, density_diffusion,
         particle_shifting, tensile_control, consistent_gradients, artificial_viscosity, laminar_viscosity,
         power_law, herschel_bulkley, carreau, viscoelasticity, wall_slip, friction, wall_repulsion,
         surface_tension, removal] = static_cast<Base&>(terms);
  const auto visit_each = [&](auto&... term) { (visit(term), ...); };
  visit_each(central_force, background_pressure, enclosed_medium, held_volume, density_diffusion,
             particle_shifting, tensile_control, consistent_gradients, artificial_viscosity,
             laminar_viscosity, power_law, herschel_bulkley, carreau, viscoelasticity, wall_slip, friction,
             wall_repulsion, surface_tension, removal);
}

}  // namespace toryu::fluid
