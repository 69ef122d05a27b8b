/// The section `[coupling]` of a case.
#pragma once

#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu {

struct CouplingParameters {
  int fluid_steps_per_window = 1;
  double time_limit = 30;  ///< [s]
  std::vector<std::string> loads = {"pressure_and_viscous", "friction"};

  bool feels(const std::string& load) const;
};
void describe(ParameterTable& table, CouplingParameters& p);

}  // namespace toryu
