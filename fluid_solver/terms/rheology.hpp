/// Generalised Newtonian media: the viscosity eta [Pa s] as a function of the shear rate gdot [1/s].
///
///     power law:  eta = m gdot^(n-1), kept between two bounds        (Ostwald 1925, de Waele 1923)
///     Carreau:    eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda gdot)^2)^((n-1)/2)  (Carreau 1972)
///     Herschel-Bulkley:  eta = [1 - exp(-t_r gdot)] tau_y/gdot + m gdot^(n-1), kept between two bounds
///                 (Herschel & Bulkley 1926, regularised by Papanastasiou 1987; n = 1: Bingham 1922)
///
/// n < 1 thins under shear, n = 1 is Newtonian, n > 1 thickens. Media of abrasive flow machining thin, at 10
/// to 1e4 Pa s. Without bounds the power law's viscosity at rest would be infinite (n < 1) or zero (n > 1):
/// the bounds stand for the plateaus that real media have, and the largest limits the time step. A medium
/// below its yield stress tau_y would have to be rigid: the regularisation lets it creep at eta = t_r
/// tau_y, which costs steps, with t_r long against the flow's 1/gdot.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/parameter_table.hpp"
#include "common/sph/lanes.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// eta = consistency gdot^(exponent-1), kept between two bounds.
struct PowerLaw {
  static constexpr const char* section = "power_law";
  static constexpr const char* help = "viscosity of a medium that thins or thickens under shear";
  double consistency = 0;         ///< m [Pa s^n]
  double exponent = 1;            ///< n
  double smallest_viscosity = 0;  ///< [Pa s]
  double largest_viscosity = 0;   ///< [Pa s]
};
inline void describe(ParameterTable& table, PowerLaw& law) {
  const auto bound = [&](const std::string& key, double& value, const std::string& help) {
    table.number(key, value,
                 {.unit = "Pa.s", .minimum = 0, .above_minimum = true, .required = true, .help = help});
  };
  table.number("consistency", law.consistency,
               {.unit = "Pa.s^n",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "m of eta = m gdot^(n-1)"});
  table.number(
      "exponent", law.exponent,
      {.minimum = 0, .maximum = 2, .above_minimum = true, .required = true, .help = "n; below 1 thins"});
  bound("smallest_viscosity", law.smallest_viscosity, "the medium is never thinner");
  bound("largest_viscosity", law.largest_viscosity, "never thicker, as at rest; limits the time step");
  table.require(law.smallest_viscosity <= law.largest_viscosity, "largest_viscosity",
                "'largest_viscosity' must be at least 'smallest_viscosity'");
}

/// A power law above a yield stress.
struct HerschelBulkley : PowerLaw {
  static constexpr const char* section = "herschel_bulkley";
  static constexpr const char* help = "a power law above a yield stress, regularised (Papanastasiou 1987)";
  double yield_stress = 0;         ///< tau_y [Pa]
  double regularisation_time = 0;  ///< t_r [s]
};
inline void describe(ParameterTable& table, HerschelBulkley& law) {
  table.number(
      "yield_stress", law.yield_stress,
      {.unit = "Pa", .minimum = 0, .required = true, .help = "tau_y, below which the medium but creeps"});
  table.number(
      "regularisation_time", law.regularisation_time,
      {.unit = "s",
       .minimum = 0,
       .above_minimum = true,
       .required = true,
       .help = "t_r of [1 - exp(-t_r gdot)] tau_y/gdot: at shear rates far below 1/t_r it creeps, at "
               "t_r tau_y; 100 over the wall's shear rate is enough"});
  describe(table, static_cast<PowerLaw&>(law));
}

struct Carreau {
  static constexpr const char* section = "carreau";
  static constexpr const char* help =
      "viscosity between two plateaus, of slow and of fast shear (Carreau 1972)";
  double zero_shear_viscosity = 0;      ///< eta_0 [Pa s]
  double infinite_shear_viscosity = 0;  ///< eta_inf [Pa s]
  double relaxation_time = 0;           ///< lambda [s]
  double exponent = 1;                  ///< n
};
inline void describe(ParameterTable& table, Carreau& law) {
  table.number(
      "zero_shear_viscosity", law.zero_shear_viscosity,
      {.unit = "Pa.s", .minimum = 0, .above_minimum = true, .required = true, .help = "eta_0, at rest"});
  table.number(
      "infinite_shear_viscosity", law.infinite_shear_viscosity,
      {.unit = "Pa.s", .minimum = 0, .required = true, .help = "eta_inf, under the strongest shear"});
  table.number("relaxation_time", law.relaxation_time,
               {.unit = "s",
                .minimum = 0,
                .required = true,
                .help = "lambda: shear rates above 1/lambda thin the medium"});
  table.number(
      "exponent", law.exponent,
      {.minimum = 0, .maximum = 2, .above_minimum = true, .required = true, .help = "n; below 1 thins"});
  table.require(
      law.infinite_shear_viscosity <= law.zero_shear_viscosity, "infinite_shear_viscosity",
      "'infinite_shear_viscosity' must not exceed 'zero_shear_viscosity'; what thickens under shear has "
      "an exponent above 1");
}

inline double viscosity(const PowerLaw& law, double shear_rate) {
  return std::clamp(law.consistency * std::pow(shear_rate, law.exponent - 1), law.smallest_viscosity,
                    law.largest_viscosity);
}

inline double viscosity(const HerschelBulkley& law, double shear_rate) {
  const double strain = law.regularisation_time * shear_rate;
  const double creep = law.yield_stress * law.regularisation_time;
  return std::clamp((strain > 0 ? -std::expm1(-strain) / strain * creep : creep) +
                        law.consistency * std::pow(shear_rate, law.exponent - 1),
                    law.smallest_viscosity, law.largest_viscosity);
}

inline double viscosity(const Carreau& law, double shear_rate) {
  const double lambda_gdot = law.relaxation_time * shear_rate;
  return law.infinite_shear_viscosity + (law.zero_shear_viscosity - law.infinite_shear_viscosity) *
                                            std::pow(1 + lambda_gdot * lambda_gdot, 0.5 * (law.exponent - 1));
}

/// Lane by lane: once a particle, not once a pair.
Lanes viscosity(const auto& law, const Lanes& shear_rate) {
  Lanes eta;
  for (std::size_t lane = 0; lane < lane_count; ++lane) eta.value[lane] = viscosity(law, shear_rate[lane]);
  return eta;
}

inline ActiveTerm text(const PowerLaw& law, const Medium&) {
  return {"power law", "eta = m gdot^(n-1), harmonic mean of a pair", "Ostwald 1925, de Waele 1923",
          fmt::format("m {} Pa s^n, n {}, {} to {} Pa s", law.consistency, law.exponent,
                      law.smallest_viscosity, law.largest_viscosity)};
}

inline ActiveTerm text(const HerschelBulkley& law, const Medium&) {
  return {"Herschel-Bulkley", "eta = [1 - exp(-t_r gdot)] tau_y/gdot + m gdot^(n-1), harmonic mean of a pair",
          "Herschel & Bulkley 1926; Papanastasiou 1987",
          fmt::format("tau_y {} Pa, t_r {} s, m {} Pa s^n, n {}, {} to {} Pa s", law.yield_stress,
                      law.regularisation_time, law.consistency, law.exponent, law.smallest_viscosity,
                      law.largest_viscosity)};
}

inline ActiveTerm text(const Carreau& law, const Medium&) {
  return {"Carreau", "eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda gdot)^2)^((n-1)/2)", "Carreau 1972",
          fmt::format("eta_0 {} Pa s, eta_inf {} Pa s, lambda {} s, n {}", law.zero_shear_viscosity,
                      law.infinite_shear_viscosity, law.relaxation_time, law.exponent)};
}

}  // namespace toryu::fluid
