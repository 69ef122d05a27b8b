/// The passes of a viscoelastic medium over its particles; terms/viscoelasticity.hpp has the formulas. The
/// logarithm of the conformation advances as the density does: its rate is found with the density's, and the
/// stress where the velocity's is.
#pragma once

#include "fluid_solver/ranks/ranks.hpp"
#include "fluid_solver/terms/velocity_gradient.hpp"
#include "fluid_solver/terms/viscoelasticity.hpp"

namespace toryu::fluid {

/// Gives the fields of the medium's modes their place, at rest.
void allocate_polymer(const Viscoelasticity& medium, Particles& fluid);

/// Fills `polymer_stress` of one cluster from its conformation.
void find_polymer_stress(const Viscoelasticity& medium, Particles& fluid, std::size_t cluster);

/// Fills `log_conformation_rate` of one cluster; grad_v[a][b] = dv_b/dx_a.
void find_log_conformation_rate(const Viscoelasticity& medium, const TensorLanes& grad_v, Particles& fluid,
                                std::size_t cluster);

/// Calls visit(field, rate, component) for each component of each mode that the fluid has, where `component`
/// numbers them.
template <class Visit>
void for_each_log_conformation(Particles& fluid, Visit&& visit) {
  std::size_t component = 0;
  for (std::size_t k = 0; k < most_polymer_modes; ++k) {
    auto &psi = fluid.log_conformation[k], &rate = fluid.log_conformation_rate[k];
    if (psi.xx.empty()) return;
    visit(psi.xx, rate.xx, component++);
    visit(psi.yy, rate.yy, component++);
    visit(psi.xy, rate.xy, component++);
  }
}

/// What bounds the time step.
struct PolymerExtremes {
  double elastic_speed = 0;    ///< of the fastest shear wave [m/s]
  double relaxation_rate = 0;  ///< the fastest [1/s]
};
PolymerExtremes polymer_extremes(const Viscoelasticity& medium, const Particles& fluid);

/// Free energy that the polymer holds [J per metre depth], and what it loses of it [W per metre depth]; of a
/// part of a fluid over `ranks`, on rank 0, that of the whole.
double polymer_energy(const Viscoelasticity& medium, const Particles& fluid);
double dissipated_power(const Viscoelasticity& medium, const Particles& fluid, const Ranks* ranks = nullptr);

}  // namespace toryu::fluid
