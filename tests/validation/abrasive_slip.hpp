/// cases/abrasive_slip: a medium that slides along its plates, and cases/axisymmetric_tube: along a tube; in
/// real pascals.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/validation/channel.hpp"

namespace toryu::fluid {

/// Means over the last 12 ms; on the lower plate or the tube within a width of the middle.
struct SlidingFlow {
  double pressure_gradient = 0;  ///< [Pa/m]
  double slip_speed = 0;         ///< [m/s]
  double wall_stress = 0;        ///< [Pa]
  double log_slope = 0;          ///< d ln p/dx [1/m], of the pressure with what holds the medium
  double removed_depth = 0;      ///< Preston's, mean of the work piece since the start [m]
};

/// Between the plates, or of the tube [m].
inline double passage_width(const FluidCase& the_case) {
  if (const auto& similarity = the_case.parameters.similarity) return similarity->passage_width;
  const Box& medium = the_case.parameters.regions.front().box;
  return medium.max[1] - medium.min[1];
}

class SlidingMeans {
 public:
  explicit SlidingMeans(const FluidCase& the_case) : the_case_(the_case) {
    const Box& medium = the_case.parameters.regions.front().box;
    width_ = passage_width(the_case);
    middle_ = 0.5 * (medium.min[0] + medium.max[0]);
    for (const auto& wall : the_case.scene.walls)
      if (wall.motion) motion_ = *wall.motion;
  }

  void sample(const FluidModel& solver) {
    const double middle = middle_ + motion_.displacement_at(solver.time())[0];
    const auto& f = solver.particles();
    const auto& p = the_case_.parameters;
    const EquationOfState state{p.density, p.sound_speed, p.stiffness_exponent,
                                p.background_pressure->pressure};
    Slope plain, log;
    for (std::size_t i = 0; i < f.count; ++i) {
      const double x = f.x[0][i] - middle, p_i = state.pressure(f.rho[i]) + solver.pressure_offset();
      if (std::abs(x) > width_) continue;
      plain.add(x, p_i);
      log.add(x, std::log(p_i));
    }
    sum_.pressure_gradient += plain.value();
    sum_.log_slope += log.value();
    double n = 0, u_s = 0, tau_w = 0;
    for (const Boundary& boundary : solver.boundaries()) {
      if ((boundary.name != "lower" && boundary.name != "tube") || !boundary.is_slippery()) continue;
      const auto& face = (boundary.name == "lower" ? boundary.upper_face : boundary.lower_face)[1];
      for (std::size_t k = 0; k < boundary.count; ++k)
        if (face[k] > 0 && std::abs(boundary.x[0][k] - middle) < width_) {
          n += 1;
          u_s += boundary.slip_velocity[0][k];
          tau_w += boundary.shear_stress[k];
        }
    }
    if (n > 0) sum_.slip_speed += u_s / n, sum_.wall_stress += tau_w / n;
    ++samples_;
  }

  SlidingFlow mean() const {
    SlidingFlow flow = sum_;
    for (double* value : {&flow.pressure_gradient, &flow.slip_speed, &flow.wall_stress, &flow.log_slope})
      *value /= samples_;
    return flow;
  }

 private:
  const FluidCase& the_case_;
  Motion motion_;
  double width_, middle_;
  SlidingFlow sum_;
  int samples_ = 0;
};

/// `name`: of a case file, in cases/abrasive_slip if it says no folder.
inline FluidCase sliding_case(const std::string& name, const std::vector<std::string>& overrides) {
  return FluidCase(name.find('/') == std::string::npos ? "abrasive_slip/" + name : name, overrides);
}

inline SlidingFlow run_abrasive_slip(const std::string& name, double spacing,
                                     std::vector<std::string> overrides = {}) {
  overrides.push_back("fluid.spacing=" + std::to_string(spacing));
  const FluidCase the_case = sliding_case(name, overrides);
  const auto model = make_model(the_case.parameters, the_case.scene);
  FluidModel& solver = *model;
  const auto out = std::filesystem::path(testing::TempDir()) / ("abrasive_slip_" + std::to_string(getpid()));
  std::filesystem::create_directories(out);
  solver.record_surface(out);
  SlidingMeans means(the_case);
  const double end = the_case.scene.end_time;
  for (double time = end - 0.012; time < end + 1e-9; time += 2e-4) {
    run_until(solver, time);
    means.sample(solver);
  }
  SlidingFlow flow = means.mean();
  for (const auto& seen : solver.observe())
    if (seen.name == "removed_depth_mean") flow.removed_depth = seen.value;
  std::filesystem::remove_all(out);
  return flow;
}

/// Of the case's medium and slip law.
inline DevelopedFlow exact_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const FluidCase the_case = sliding_case(name, overrides);
  const Parameters& p = the_case.parameters;
  const double mean_speed = p.similarity ? p.similarity->mean_speed : 0.05;  // of the pistons
  return {viscosity_of(p), passage_width(the_case), mean_speed, the_case.scene.geometry,
          [law = *p.wall_slip](double tau) { return slip_speed(law, tau); }};
}

/// Holds pressure gradient and slip speed to the exact ones.
inline SlidingFlow expect_sliding(const std::string& name, double spacing, double gradient_error,
                                  double slip_error, const std::vector<std::string>& overrides = {}) {
  const DevelopedFlow exact = exact_of(name, overrides);
  const SlidingFlow flow = run_abrasive_slip(name, spacing, overrides);
  testing::Test::RecordProperty("gradient_and_slip_over_exact",
                                std::to_string(flow.pressure_gradient / exact.pressure_gradient()) + " " +
                                    std::to_string(flow.slip_speed / exact.slip_speed()));
  EXPECT_NEAR(flow.pressure_gradient / exact.pressure_gradient(), 1, gradient_error)
      << name << ' ' << spacing;
  EXPECT_NEAR(flow.slip_speed / exact.slip_speed(), 1, slip_error) << name << ' ' << spacing;
  return flow;
}

}  // namespace toryu::fluid
