#include "fluid_solver/temperature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

namespace {

using Rows = std::vector<std::vector<double>>;

bool rises(const Rows& rows) {
  return std::adjacent_find(rows.begin(), rows.end(),
                            [](const auto& a, const auto& b) { return !(a[0] < b[0]); }) == rows.end();
}
bool has_positive_factors(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row[1] > 0; });
}
/// Whether the constants' own temperature is in the table.
bool passes_one(const Rows& rows) {
  const auto [least, most] =
      std::minmax_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  return (*least)[1] <= 1 && (*most)[1] >= 1;
}

// m gdot^n is a stress
void shift(PowerLaw& law, double a_T) {
  law.consistency *= std::pow(a_T, law.exponent);
  law.smallest_viscosity *= a_T;
  law.largest_viscosity *= a_T;
}
void shift(HerschelBulkley& law, double a_T) {
  shift(static_cast<PowerLaw&>(law), a_T);
  law.regularisation_time *= a_T;
}
void shift(Carreau& law, double a_T) {
  law.zero_shear_viscosity *= a_T;
  law.infinite_shear_viscosity *= a_T;
  law.relaxation_time *= a_T;
}
void shift(LaminarViscosity& law, double a_T) {
  law.dynamic_viscosity *= a_T;
}
void shift(Viscoelasticity& medium, double a_T) {
  for (PolymerMode& mode : medium.modes) mode.polymer_viscosity *= a_T, mode.relaxation_time *= a_T;
}

}  // namespace

void describe(ParameterTable& table, Temperature& temperature) {
  table.number("value", temperature.value,
               {.unit = "K", .minimum = 0, .above_minimum = true, .required = true, .help = "of the medium"});
  table.rows("shift_factors", temperature.shift_factors, {"temperature [K]", "factor [1]"},
             {.required = true,
              .help = "a_T by which viscosity and relaxation times grow from those of the case, 1 at the "
                      "temperature at which they were measured; between the rows ln a_T is a straight line"});
  const Rows& rows = temperature.shift_factors;
  table.require(!rows.empty() && rises(rows), "shift_factors",
                "'shift_factors' needs a row, and temperatures that rise from row to row");
  table.require(has_positive_factors(rows), "shift_factors", "factors in 'shift_factors' must be above 0");
  if (rows.empty() || !rises(rows)) return;
  table.require(
      passes_one(rows), "shift_factors",
      "no factor in 'shift_factors' is 1, and none lies on either side of it: the temperature at which the "
      "constants of the medium were measured must be among the rows");
  table.require(
      temperature.value >= rows.front()[0] && temperature.value <= rows.back()[0], "value",
      fmt::format(
          "'value' {:g} K lies outside 'shift_factors', which go from {:g} to {:g} K: what the medium "
          "does there is not known",
          temperature.value, rows.front()[0], rows.back()[0]));
}

double shift_factor(const Temperature& temperature) {
  const Rows& rows = temperature.shift_factors;
  const auto above =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[0] >= temperature.value; });
  const auto& high = *above;
  if (high[0] == temperature.value) return high[1];
  const auto& low = *(above - 1);
  const double share = (temperature.value - low[0]) / (high[0] - low[0]);
  return low[1] * std::pow(high[1] / low[1], share);
}

std::string take_temperature(Parameters& p) {
  const double a_T = shift_factor(*p.temperature);
  const auto shift_if_there = [&](auto& law) {
    if (law) shift(*law, a_T);
  };
  shift_if_there(p.laminar_viscosity);
  shift_if_there(p.power_law);
  shift_if_there(p.herschel_bulkley);
  shift_if_there(p.carreau);
  shift_if_there(p.viscoelasticity);
  return fmt::format("medium at {:g} K: viscosities and relaxation times are {:.4g} times those of the case",
                     p.temperature->value, a_T);
}

}  // namespace toryu::fluid
