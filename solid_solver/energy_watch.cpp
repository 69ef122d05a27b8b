#include "solid_solver/energy_watch.hpp"

#include <algorithm>

#include "common/run/log.hpp"

namespace toryu::solid {

void EnergyWatch::warn_of_gain(double kinetic, double given, double rounding, double time) {
  constexpr double gain_to_warn_of = 0.02;
  most = std::max(most, kinetic);
  if (!(most > rounding)) return;
  const double gain = (kinetic - given) / most;
  largest_gain = std::max(largest_gain, gain);
  if (gain < std::max(gain_to_warn_of, 2 * warned)) return;
  warned = gain;
  log::warn(
      "the solid has gained energy of motion from nowhere by t = {:.6g} s: {:.2g} of it; artificial stress "
      "or "
      "steps that are too long feed it, see cases/rigid_rotation",
      time, gain);
}

}  // namespace toryu::solid
