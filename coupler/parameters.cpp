#include "coupler/parameters.hpp"

#include <algorithm>

namespace toryu {

bool CouplingParameters::feels(const std::string& load) const {
  return std::find(loads.begin(), loads.end(), load) != loads.end();
}

void describe(ParameterTable& table, CouplingParameters& p) {
  table.integer("fluid_steps_per_window", p.fluid_steps_per_window,
                {.minimum = 1,
                 .help = "largest fluid steps in a coupling window; the solid's load is constant over it"});
  table.number(
      "time_limit", p.time_limit,
      {.unit = "s",
       .minimum = 0,
       .above_minimum = true,
       .help = "longest wait for a participant that does not move, at the start and in each window"});
  table.texts("loads", p.loads,
              {.help = "what the solid feels of the fluid: 'pressure_and_viscous', 'friction', or both"});
  const auto known = [](const std::string& word) {
    return word == "pressure_and_viscous" || word == "friction";
  };
  table.require(std::all_of(p.loads.begin(), p.loads.end(), known) && !p.loads.empty(), "loads",
                "'loads' must name 'pressure_and_viscous', 'friction' or both");
}

}  // namespace toryu
