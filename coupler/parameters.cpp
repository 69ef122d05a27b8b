#include "coupler/parameters.hpp"

#include <algorithm>

namespace toryu::coupling {

bool Parameters::passes_on(const std::string& load) const {
  return std::find(loads.begin(), loads.end(), load) != loads.end();
}

void describe(ParameterTable& table, ImplicitParameters& p) {
  table.choice("relaxation", p.relaxation, {"fixed", "aitken", "quasi_newton"},
               {.help = "how an iteration gets to its next guess of the interface's motion"});
  table.number("relaxation_factor", p.relaxation_factor,
               {.minimum = 0,
                .maximum = 2,
                .above_minimum = true,
                .help = "share of the residual that a step takes; 'aitken' and 'quasi_newton' find their own "
                        "after the first step"});
  table.number(
      "tolerance", p.tolerance,
      {.minimum = 0,
       .above_minimum = true,
       .help = "of the residual, over the interface's displacement in the window (root mean squares)"});
  table.integer("largest_iteration_count", p.largest_iteration_count, {.minimum = 1, .help = "in a window"});
  table.integer("remembered_windows", p.remembered_windows,
                {.minimum = 0, .help = "earlier windows that 'quasi_newton' learns from"});
  table.integer("unconverged_windows_to_stop", p.unconverged_windows_to_stop,
                {.minimum = 1, .help = "the run fails after so many windows in a row without convergence"});
}

void describe(ParameterTable& table, Parameters& p) {
  table.choice(
      "scheme", p.scheme, {"serial_robin", "serial_explicit", "parallel_explicit", "serial_implicit"},
      {.help = "the fluid, then the solid under its load, which answers the solid's motion by the fluid's "
               "impedance, or is constant; both at once, the solid under the load of the "
               "window before; or in turn again and again until the motion settles"});
  table.optional("implicit", p.implicit, "the iteration of 'serial_implicit'");
  if (p.scheme == SchemeKind::serial_implicit && !p.implicit) p.implicit.emplace();
  table.require(p.scheme == SchemeKind::serial_implicit || !p.implicit, "implicit",
                "[coupling.implicit] needs scheme = 'serial_implicit'");
  table.integer(
      "extrapolation_order", p.extrapolation_order,
      {.minimum = 0,
       .maximum = 2,
       .help = "of the interface's motion over a window that the solid has not computed yet; 0: the "
               "fluid follows one window late. 'serial_implicit' begins with it, at least 1"});
  table.integer("fluid_steps_per_window", p.fluid_steps_per_window,
                {.minimum = 1,
                 .help = "largest fluid steps in a coupling window; the solid's load is constant over it"});
  table.number(
      "time_limit", p.time_limit,
      {.unit = "s",
       .minimum = 0,
       .above_minimum = true,
       .help = "longest wait for a participant that does not move, at the start and in each window"});
  table.number("largest_false_work", p.largest_false_work,
               {.minimum = 0,
                .above_minimum = true,
                .help = "the run fails once the exchange has made more work than this share of the largest "
                        "that the fluid gave or the solid's energy changed by, and goes on to make it"});
  table.choice(
      "record", p.record, {"frames", "every_window"},
      {.help =
           "what is kept of the exchange: the interface at each frame in interface.h5, or beside it every "
           "window in exchange.h5, for a replay of either side alone"});
  table.texts("loads", p.loads,
              {.help = "what the solid feels of the fluid: 'pressure_and_viscous', 'friction', or both"});
  const auto known = [](const std::string& word) {
    return word == "pressure_and_viscous" || word == "friction";
  };
  table.require(std::all_of(p.loads.begin(), p.loads.end(), known) && !p.loads.empty(), "loads",
                "'loads' must name 'pressure_and_viscous', 'friction' or both");
}

}  // namespace toryu::coupling
