/// Density diffusion of delta-SPH, (18) second sum (Marrone et al. 2011; Molteni & Colagrossi 2009 without
/// the gradients): delta h c_0 sum_j V_j psi_ij . gradW_ij over fluid particles,
///
///     psi_ij = 2 (rho_i - rho_j) x_ij/r_ij^2 - [<grad rho>_i + <grad rho>_j]
///
/// psi_ij = psi_ji, so no mass is made; with the renormalised gradients a linear density does not diffuse.
/// The 0.01 h^2 that (19) adds to r_ij^2 is left out: x_ij . gradW_ij/r_ij^2 is finite without it, and with
/// it a linear density does diffuse where neighbours are one-sided. At the floor of the hydrostatic tank that
/// raised the pressure by 2 % of rho_0 g H in 40 s.
#pragma once

#include <fmt/format.h>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

/// What the linear part of the density is taken from before it is diffused.
enum class DiffusionGradient { renormalised, none };
struct DensityDiffusion {
  static constexpr const char* section = "density_diffusion";
  static constexpr const char* help = "delta-SPH (Marrone et al. 2011)";
  double delta = 0.1;
  DiffusionGradient gradient = DiffusionGradient::renormalised;
};
inline void describe(ParameterTable& table, DensityDiffusion& diffusion) {
  table.number(
      "delta", diffusion.delta,
      {.minimum = 0, .maximum = 1, .help = "coefficient of the diffusion; Marrone et al. 2011 take 0.1"});
  table.choice(
      "gradient", diffusion.gradient, {"renormalised", "none"},
      {.help =
           "linear part left alone: renormalised (Marrone et al. 2011) or none (Molteni & Colagrossi 2009)"});
}

template <bool renormalised>
struct DensityDiffusionTerm {
  double delta_h_c0;

  TORYU_INLINE void diffusion(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                              Rates& rates) const {
    Lanes psi_x = 2.0 * (i.rho - source.rho[j]);  // psi_ij . x_ij
    if constexpr (renormalised)
      for (int a = 0; a < dim; ++a) psi_x -= (i.grad_rho[a] + source.grad_rho[a][j]) * pair.x_ij[a];
    rates.diffusion += (delta_h_c0 * pair.V_G) * psi_x;
  }
};

inline ActiveTerm text(const DensityDiffusion& diffusion, const Medium&) {
  return {"density diffusion", "delta h c_0 sum_j V_j psi_ij . gradW_ij",
          diffusion.gradient == DiffusionGradient::renormalised ? "Marrone et al. 2011; thesis eq. 18-21"
                                                                : "Molteni & Colagrossi 2009",
          fmt::format("delta {}", diffusion.delta)};
}

}  // namespace toryu::fluid
