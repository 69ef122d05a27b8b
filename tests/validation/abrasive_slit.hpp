/// cases/abrasive_slit: a medium of 1000 Pa s at the wall, in real pascals.
#pragma once

#include "tests/validation/channel.hpp"

namespace toryu::fluid {

/// Pressure gradient over the exact one, and the error of the profile.
inline ChannelFlow run_abrasive_slit(const FluidCase& the_case) {
  const Similarity& passage = *the_case.parameters.similarity;
  const SlitSolution exact(viscosity_of(the_case.parameters), passage.passage_width, passage.mean_speed);
  ChannelFlow flow = run_channel(the_case, exact, 0.6 * the_case.scene.end_time, 2e-4);
  flow.pressure_gradient /= exact.pressure_gradient();
  return flow;
}

}  // namespace toryu::fluid
