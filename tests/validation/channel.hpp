/// Measures the developed flow in the middle of a channel that two pistons drive: cases/slit_channel and
/// cases/power_law_channel.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/validation/developed_flow.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

struct ChannelFlow {
  double pressure_gradient = 0;  ///< mean over time [Pa/m]
  double profile_error =
      0;  ///< largest |u - u_exact| of any twentieth of the width, over the largest u_exact
};

/// Of a straight line through points.
struct Slope {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  void add(double x_i, double y_i) { n += 1, x += x_i, y += y_i, xx += x_i * x_i, xy += x_i * y_i; }
  double value() const { return (n * xy - x * y) / (n * xx - x * x); }
};

/// The particles within a width of the middle between the pistons, or a diameter of the tube, and the profile
/// by twentieths of it.
class ChannelMiddle {
 public:
  ChannelMiddle(const FluidCase& the_case, const DevelopedFlow& exact) : exact_(exact) {
    const Box& medium = the_case.parameters.regions.front().box;
    start_ = 0.5 * (medium.min[0] + medium.max[0]);
    const double side = medium.max[1] - medium.min[1];
    width_ = the_case.scene.geometry == Geometry::plane ? side : 2 * side;
    for (const auto& wall : the_case.scene.walls)
      if (wall.motion) motion_ = *wall.motion;  // both pistons move alike
  }

  void sample(const FluidModel& solver, const EquationOfState& state) {
    const auto& f = solver.particles();
    const double middle = start_ + motion_.displacement_at(solver.time())[0];
    Slope slope;
    for (std::size_t i = 0; i < f.count; ++i) {
      const double x = f.x[0][i] - middle, y = f.x[1][i];
      if (std::abs(x) > width_) continue;
      slope.add(x, state.pressure(f.rho[i]));
      const auto part = static_cast<std::size_t>(std::clamp(y / width_ * parts, 0.0, parts - 1.0));
      difference_[part] += f.v[0][i] - exact_.velocity(y);
      count_[part] += 1;
    }
    sum_of_slopes_ += slope.value();
    ++samples_;
  }

  ChannelFlow mean() const {
    ChannelFlow flow{sum_of_slopes_ / samples_, 0};
    for (std::size_t part = 0; part < parts; ++part)
      if (count_[part] > 0)
        flow.profile_error = std::max(flow.profile_error, std::abs(difference_[part] / count_[part]));
    flow.profile_error /= exact_.largest_velocity();
    return flow;
  }

 private:
  static constexpr std::size_t parts = 20;
  const DevelopedFlow& exact_;
  Motion motion_;
  double start_, width_, sum_of_slopes_ = 0;
  int samples_ = 0;
  std::array<double, parts> difference_{}, count_{};
};

/// The viscosity that the case gives its medium, artificial viscosity apart.
inline std::function<double(double)> viscosity_of(const Parameters& p) {
  return [p](double gdot) { return viscosity_of(p, gdot); };
}

/// What the channels have in common [m], [m/s].
inline constexpr double channel_width = 0.01, mean_velocity = 0.01;

/// Runs the case; means over the time from `from` to its end, `every` so long [s].
inline ChannelFlow run_channel(const FluidCase& the_case, const DevelopedFlow& exact, double from = 0.1,
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

inline void expect_within_two_percent(const ChannelFlow& flow, double gradient) {
  testing::Test::RecordProperty("pressure_gradient_over_exact",
                                std::to_string(flow.pressure_gradient / gradient));
  testing::Test::RecordProperty("profile_error", std::to_string(flow.profile_error));
  EXPECT_NEAR(flow.pressure_gradient / gradient, 1.0, 0.02);
  EXPECT_LT(flow.profile_error, 0.02);
}

/// In the passage that [fluid.similarity] of the case describes.
inline DevelopedFlow flow_in_passage(const FluidCase& the_case) {
  const Similarity& passage = *the_case.parameters.similarity;
  return {viscosity_of(the_case.parameters), passage.passage_width, passage.mean_speed,
          the_case.scene.geometry};
}

/// Holds the last 40 % of a run to the exact flow. Returns the pressure gradient over the exact one.
inline double expect_developed(const FluidCase& the_case, const DevelopedFlow& exact, double every,
                               double gradient_error, double profile_error) {
  const ChannelFlow flow = run_channel(the_case, exact, 0.6 * the_case.scene.end_time, every);
  const double gradient = flow.pressure_gradient / exact.pressure_gradient();
  testing::Test::RecordProperty("pressure_gradient_over_exact", std::to_string(gradient));
  testing::Test::RecordProperty("profile_error", std::to_string(flow.profile_error));
  const std::string what = fmt::format("{} at {} m", the_case.scene.title, the_case.parameters.spacing);
  EXPECT_NEAR(gradient, 1, gradient_error) << what;
  EXPECT_LT(flow.profile_error, profile_error) << what;
  return gradient;
}

/// The same of a case with [fluid.similarity].
inline void expect_passage(const std::string& case_file, double spacing, double gradient_error,
                           double profile_error) {
  const FluidCase the_case(case_file, {"fluid.spacing=" + std::to_string(spacing)});
  expect_developed(the_case, flow_in_passage(the_case), 2e-4, gradient_error, profile_error);
}

}  // namespace toryu::fluid
