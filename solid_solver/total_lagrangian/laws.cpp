#include "solid_solver/total_lagrangian/laws.hpp"

#include <fmt/format.h>

namespace toryu::solid {

Law law_of(const Material& material) {
  if (material.yeoh) return *material.yeoh;
  const double lambda = material.elastic.lame_lambda(), G = material.elastic.shear_modulus();
  if (material.law == ElasticLaw::neo_hookean) return NeoHookean{lambda, G};
  return SaintVenantKirchhoff{lambda, G};
}

ActiveTerm active_law(const Material& of) {
  const auto& material = of.elastic;
  const std::string name = of.name.empty() ? "" : of.name + ": ";
  const std::string constants =
      name + fmt::format("E {:g} Pa, nu {:g}: K {:.4g} Pa, G {:.4g} Pa, c_L {:.4g} m/s",
                         material.youngs_modulus, material.poissons_ratio, material.bulk_modulus(),
                         material.shear_modulus(), material.longitudinal_sound_speed());
  if (const auto& yeoh = of.yeoh)
    return {"Yeoh",
            "psi = sum_k c_k0 (I - 3)^k + alpha/beta (1 - exp(-beta (I - 3))) + K/4 (J^2 - 1 - 2 ln J), I = "
            "J^(-2/3) I_1, plane strain",
            "Yeoh 1993; volumetric part: Simo & Taylor 1982",
            fmt::format(
                "c_10 {:g}, c_20 {:g}, c_30 {:g}, alpha {:g}, K {:g} Pa, beta {:g}; for small strains {}",
                yeoh->c_10, yeoh->c_20, yeoh->c_30, yeoh->alpha, yeoh->bulk_modulus, yeoh->beta, constants)};
  if (of.law == ElasticLaw::neo_hookean)
    return {"neo-Hookean", "psi = G/2 (I_1 - 3 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J), plane strain",
            "Simo & Pister 1984", constants};
  return {"St. Venant-Kirchhoff", "S = lambda tr(E) I + 2 G E, plane strain", "", constants};
}

}  // namespace toryu::solid
