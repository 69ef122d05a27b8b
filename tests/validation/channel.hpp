/// Measures the developed flow in the middle of a channel that two pistons drive: cases/slit_channel and
/// cases/power_law_channel.
#pragma once

#include <array>
#include <cmath>

#include "tests/validation/fluid_case.hpp"
#include "tests/validation/slit_solution.hpp"

namespace toryu::fluid {

struct ChannelFlow {
  double pressure_gradient = 0;  ///< mean over time [Pa/m]
  double profile_error =
      0;  ///< largest |u - u_exact| of any twentieth of the width, over the largest u_exact
};

/// The particles within one width of the middle between the pistons, one width from either.
class ChannelMiddle {
 public:
  ChannelMiddle(const FluidCase& the_case, const SlitSolution& exact) : exact_(exact) {
    const Box& medium = the_case.parameters.regions.front().box;
    start_ = 0.5 * (medium.min[0] + medium.max[0]);
    width_ = medium.max[1] - medium.min[1];
    for (const auto& wall : the_case.scene.walls)
      if (wall.motion) motion_ = *wall.motion;  // both pistons move alike
  }

  void sample(const FluidModel& solver, const EquationOfState& state) {
    const auto& f = solver.particles();
    const double middle = start_ + motion_.displacement_at(solver.time())[0];
    double n = 0, sum_x = 0, sum_p = 0, sum_xx = 0, sum_xp = 0;
    for (std::size_t i = 0; i < f.count; ++i) {
      const double x = f.x[0][i] - middle, y = f.x[1][i], p = state.pressure(f.rho[i]);
      if (std::abs(x) > width_) continue;
      n += 1, sum_x += x, sum_p += p, sum_xx += x * x, sum_xp += x * p;
      const auto bin = static_cast<std::size_t>(std::clamp(y / width_ * bins, 0.0, bins - 1.0));
      difference_[bin] += f.v[0][i] - exact_.velocity(y);
      count_[bin] += 1;
    }
    sum_of_slopes_ += (n * sum_xp - sum_x * sum_p) / (n * sum_xx - sum_x * sum_x);
    ++samples_;
  }

  ChannelFlow mean() const {
    ChannelFlow flow{sum_of_slopes_ / samples_, 0};
    for (std::size_t b = 0; b < bins; ++b)
      if (count_[b] > 0)
        flow.profile_error = std::max(flow.profile_error, std::abs(difference_[b] / count_[b]));
    flow.profile_error /= exact_.largest_velocity();
    return flow;
  }

 private:
  static constexpr std::size_t bins = 20;
  const SlitSolution& exact_;
  Motion motion_;
  double start_, width_, sum_of_slopes_ = 0;
  int samples_ = 0;
  std::array<double, bins> difference_{}, count_{};
};

/// The viscosity that the case gives its medium, artificial viscosity apart.
inline std::function<double(double)> viscosity_of(const Parameters& p) {
  return [p](double gdot) { return viscosity_of(p, gdot); };
}

/// What the channels have in common [m], [m/s].
inline constexpr double channel_width = 0.01, mean_velocity = 0.01;

/// Runs the case; means over the time from `from` to its end, `every` so long [s].
inline ChannelFlow run_channel(const FluidCase& the_case, const SlitSolution& exact, double from = 0.1,
                               double every = 0.002) {
  const auto solver = make_model(the_case.parameters, the_case.scene);
  const auto& p = the_case.parameters;
  const EquationOfState state{p.density, p.sound_speed, p.stiffness_exponent, 0};
  ChannelMiddle middle(the_case, exact);
  for (double time = from; time < the_case.scene.end_time + 1e-9; time += every) {
    run_until(*solver, time);
    middle.sample(*solver, state);
  }
  return middle.mean();
}

}  // namespace toryu::fluid
