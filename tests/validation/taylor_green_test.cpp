// cases/taylor_green at two coarse resolutions against the exact solution.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_solver/initial_flow.hpp"
#include "fluid_solver/observers.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

struct Left {
  double error, amplitude;
};
/// At t = 0.25.
Left left(int across) {
  const FluidCase the_case("taylor_green", {"fluid.spacing=" + std::to_string(1.0 / across)});
  WeaklyCompressible solver = the_case.solver();
  run_until(solver, 0.25);
  const auto& p = the_case.parameters;
  const double nu = p.laminar_viscosity->dynamic_viscosity / p.density;
  return {flow_error(solver.particles(), *p.initial_flow, decay(*p.initial_flow, nu, 0.25)),
          flow_amplitude(solver.particles(), *p.initial_flow)};
}

TEST(TaylorGreen, DecaysAsTheExactSolutionTheBetterTheFiner) {
  const Left coarse = left(20), fine = left(40);
  RecordProperty("error_at_20_and_40", std::to_string(coarse.error) + " " + std::to_string(fine.error));
  EXPECT_LT(fine.error, 0.0035);
  EXPECT_GT(std::log2(coarse.error / fine.error), 1.8);
  EXPECT_NEAR(fine.amplitude, std::exp(-8 * M_PI * M_PI * 0.25 / 100), 0.005);
}

}  // namespace
}  // namespace toryu::fluid
