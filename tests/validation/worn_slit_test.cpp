// The flow between two plates whose faces have worn away by parts of a spacing, and by more:
// cases/abrasive_opening.
#include <gtest/gtest.h>

#include "fluid_solver/observers.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

constexpr double width = 0.002, gradient = 150e6, viscosity = 1000;

/// A fifth of the passage, `across` particles wide at the start, whose faces lie back by so many spacings.
FluidCase passage(int across, double lower, double upper) {
  const double spacing = width / across;
  const auto worn = [&](const std::string& wall, const std::string& face, double depth) {
    return fmt::format("wall.{}.worn=[{{ face = \"{}\", depth = [[0.0, {}]] }}]", wall, face,
                       depth * spacing);
  };
  return FluidCase("abrasive_opening",
                   {fmt::format("fluid.spacing={}", spacing), "case.domain.max=[0.004,0.003]",
                    "wall.lower.box.max=[0.004,-0.001]", "wall.upper.box.max=[0.004,0.0025]",
                    "fluid.region.medium.box.max=[0.004,0.001]", "fluid.observer.flow.box.max=[0.004,0.003]",
                    worn("lower", "upper", lower), worn("upper", "lower", upper)});
}

/// Flow rate at 8 ms over G (w + depths)^3/(12 eta).
double flow_over_exact(int across, double lower, double upper) {
  const FluidCase the_case = passage(across, lower, upper);
  WeaklyCompressible solver = the_case.solver();
  double sum = 0;
  constexpr int samples = 5;
  for (int n = 1; n <= samples; ++n) {
    run_until(solver, 0.007 + 0.0002 * n);
    sum += volume_flux(solver.particles(), *the_case.parameters.observers.front().box, Axis::x) / samples;
  }
  const double w = width + (lower + upper) * width / across;
  return sum / (gradient * w * w * w / (12 * viscosity));
}

TEST(WornSlit, HasTheFlowOfItsWidthAtAnyDepth) {
  double before = flow_over_exact(20, 0, 0);
  for (const double depth : {0.0, 0.25, 0.4, 0.5, 0.6, 0.75, 1.0, 1.5}) {
    const double now = flow_over_exact(20, depth, depth);
    RecordProperty("at_20_depth_" + std::to_string(depth), std::to_string(now));
    EXPECT_NEAR(now, 1.0, 0.01) << depth;
    EXPECT_NEAR(now, before, 0.003) << "continuous at " << depth;
    before = now;
  }
}

TEST(WornSlit, ItsErrorFallsWithTheSpacing) {
  // as deep in metres: 0.25 and 0.75 of the coarser spacing
  for (const double depth : {0.25, 0.75}) {
    const double coarse = flow_over_exact(10, depth, 0) - 1, fine = flow_over_exact(20, 2 * depth, 0) - 1;
    RecordProperty("at_10_and_20_depth_" + std::to_string(depth),
                   std::to_string(coarse) + " " + std::to_string(fine));
    EXPECT_NEAR(fine, 0.0, 0.006);
    EXPECT_LT(std::abs(fine), 0.4 * std::abs(coarse));
  }
}

}  // namespace
}  // namespace toryu::fluid
