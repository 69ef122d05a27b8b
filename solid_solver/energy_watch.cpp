#include "solid_solver/energy_watch.hpp"

#include <algorithm>

#include "common/run/log.hpp"

namespace toryu::solid {

void EnergyWatch::look(double kinetic, double given, double time) {
  constexpr double gain_to_tell = 0.02;
  most_ = std::max(most_, kinetic);
  if (!(most_ > 0)) return;
  const double gain = (kinetic - given) / most_;
  largest_gain_ = std::max(largest_gain_, gain);
  if (gain < std::max(gain_to_tell, 2 * told_)) return;
  told_ = gain;
  log::warn(
      "the solid has gained energy of motion from nowhere by t = {:.6g} s: {:.2g} of it; artificial stress "
      "or "
      "steps that are too long feed it, see cases/rigid_rotation",
      time, gain);
}

}  // namespace toryu::solid
