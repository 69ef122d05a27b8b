/// A medium at another temperature than that of its constants: time-temperature superposition (Ferry 1980,
/// chapter 11; the change of the modulus with T neglected). A factor a_T, 1 at the temperature of the
/// constants, scales all times of the medium and no stress,
///
///     tau(gdot, T) = tau(a_T gdot),   eta(gdot, T) = a_T eta(a_T gdot),   lambda(T) = a_T lambda
///
/// and is read from a table by a straight line in ln a_T over T. Outside the table nothing is known: that is
/// an error.
#pragma once

#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu::fluid {

struct Parameters;

struct Temperature {
  double value = 0;                                ///< T [K]
  std::vector<std::vector<double>> shift_factors;  ///< rows of temperature [K] and a_T, rising in T
};
void describe(ParameterTable& table, Temperature& temperature);

/// a_T of the table, in which `value` lies.
double shift_factor(const Temperature& temperature);

/// Scales what `parameters` say of the medium. Returns what the log says.
std::string take_temperature(Parameters& parameters);

}  // namespace toryu::fluid
