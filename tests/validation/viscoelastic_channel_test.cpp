// A viscoelastic medium set in motion between plates: cases/viscoelastic_channel against the series of Waters
// & King (1970), and the stress along the steady flow.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

/// Oldroyd-B between plates at y = 0 and `width`, from rest, under a force per mass. Of each component sin(k
/// y) of u and cos(k y) of the polymer's shear stress s,
///
///     rho u' = rho F_n - eta_s k^2 u - k s,   lambda s' = eta_p k u - s,   k = n pi/width, n odd,
///
/// which x = x_steady - exp(M t) x_steady solves.
struct Startup {
  double rho, eta_s, eta_p, lambda, width, force;

  double velocity(double y, double t) const {
    double u = 0;
    for (int n = 1; n < 400; n += 2) u += component(n, t) * std::sin(n * std::numbers::pi * y / width);
    return u;
  }
  double steady_shear_rate(double y) const { return rho * force * (0.5 * width - y) / (eta_s + eta_p); }

 private:
  double component(int n, double t) const {
    using Complex = std::complex<double>;
    const double k = n * std::numbers::pi / width;
    const double u_steady = 4 * force / (n * std::numbers::pi) * rho / ((eta_s + eta_p) * k * k);
    const double s_steady = eta_p * k * u_steady;
    const double a = eta_s * k * k / rho, d = 1 / lambda, mean = 0.5 * (a + d);
    const Complex root = std::sqrt(Complex(0.25 * (a - d) * (a - d) - eta_p * k * k / (rho * lambda)));
    // exp(M t) = e^(-mean t) [cosh(root t) I + sinh(root t)/root (M + mean I)]
    const Complex grow = std::exp((root - mean) * t), fall = std::exp((-root - mean) * t);
    const double C = (0.5 * (grow + fall)).real(), S = (0.5 * (grow - fall) / root).real();
    return u_steady - ((C + S * (mean - a)) * u_steady - S * k / rho * s_steady);
  }
};

Startup startup_of(const FluidCase& the_case) {
  const Parameters& p = the_case.parameters;
  const PolymerMode& mode = p.viscoelasticity->modes.front();
  return {p.density,
          p.laminar_viscosity->dynamic_viscosity,
          mode.polymer_viscosity,
          mode.relaxation_time,
          1.0,
          the_case.scene.gravity[0]};
}

TEST(Startup, HasTheNewtonianLimitAndTheSteadyState) {
  // E to 0: the series of a viscosity eta_s + eta_p
  const Startup quick{1000, 10, 90, 1e-5, 1, 0.02};
  for (const double t : {0.5, 1.0, 3.0}) {
    double u = 0.02 / (2 * 0.1) * 0.25;
    for (int n = 1; n < 200; n += 2) {
      const double k = n * std::numbers::pi;
      u -= 4 * 0.02 / (0.1 * k * k * k) * std::sin(0.5 * k) * std::exp(-0.1 * k * k * t);
    }
    EXPECT_NEAR(quick.velocity(0.5, t), u, 2e-4 * 0.025) << t;
  }
  const Startup slow{1000, 10, 90, 10, 1, 0.02};
  EXPECT_NEAR(slow.velocity(0.5, 1000), 0.025, 1e-8);
  EXPECT_NEAR(slow.velocity(0.2, 1000), 0.1 * 0.2 * 0.8, 1e-8);
  // before the polymer feels it: F t in the middle
  EXPECT_NEAR(slow.velocity(0.5, 0.1), 0.02 * 0.1, 1e-6);
}

struct Errors {
  double velocity = 0;       ///< largest difference in the middle over time, over the peak
  double normal_stress = 0;  ///< of the first normal stress difference at the end, over its largest
  double energy = 0;         ///< of what the polymer holds at the end, over the work of its stress
};

/// Root mean square difference from 2 eta_p lambda gdot^2, over its largest.
double normal_stress_error(const Particles& f, const PolymerMode& mode, const Startup& exact) {
  const auto N_1 = [&](double y) {
    return 2 * mode.polymer_viscosity * mode.relaxation_time * std::pow(exact.steady_shear_rate(y), 2);
  };
  double sum = 0;
  for (std::size_t i = 0; i < f.count; ++i)
    sum += std::pow(f.polymer_stress.xx[i] - f.polymer_stress.yy[i] - N_1(f.x[1][i]), 2);
  return std::sqrt(sum / static_cast<double>(f.count)) / N_1(0);
}

/// Mean over the width of G/2 [2 W^2 - ln(1 + W^2)], which is G/2 tr(A - I - ln A), W = lambda gdot.
double steady_energy(const PolymerMode& mode, const Startup& exact) {
  const double W = mode.relaxation_time * exact.steady_shear_rate(0);
  return 0.5 * mode.modulus() * (2 * W * W / 3 - (std::log(1 + W * W) - 2 + 2 * std::atan(W) / W));
}

Errors errors(const std::vector<std::string>& overrides) {
  const FluidCase the_case("viscoelastic_channel", overrides);
  const Startup exact = startup_of(the_case);
  const double spacing = the_case.parameters.spacing, end = the_case.scene.end_time;
  const PolymerMode& mode = the_case.parameters.viscoelasticity->modes.front();
  WeaklyCompressible solver = the_case.solver();
  const auto& f = solver.particles();
  Errors found;
  double peak = 0;
  for (int row = 1; row <= 160; ++row) {
    run_until(solver, end * row / 160);
    solver.record(solver.time());
    double difference = 0, count = 0;
    for (std::size_t i = 0; i < f.count; ++i) {
      if (std::abs(f.x[1][i] - 0.5) > spacing) continue;
      difference += f.v[0][i] - exact.velocity(f.x[1][i], solver.time());
      ++count;
    }
    found.velocity = std::max(found.velocity, std::abs(difference / count));
    peak = std::max(peak, std::abs(exact.velocity(0.5, solver.time())));
  }
  found.velocity /= peak;
  found.normal_stress = normal_stress_error(f, mode, exact);
  double stored = 0, dissipated = 0;
  for (const Observation& seen : solver.observe()) {
    if (seen.name == "stored_by_viscoelasticity") stored = seen.value;
    if (seen.name == "dissipated_by_viscoelasticity") dissipated = seen.value;
  }
  found.energy = std::abs(stored - steady_energy(mode, exact)) / (stored + dissipated);
  return found;
}

void record(const std::string& name, const Errors& found) {
  ::testing::Test::RecordProperty(name, std::to_string(found.velocity) + " " +
                                            std::to_string(found.normal_stress) + " " +
                                            std::to_string(found.energy));
}

TEST(ViscoelasticChannel, FollowsTheSeriesAndBearsItsNormalStress) {
  const Errors coarse = errors({"fluid.spacing=0.1"}), fine = errors({});
  record("errors_at_10", coarse);
  record("errors_at_20", fine);
  EXPECT_LT(fine.velocity, 0.02);
  EXPECT_LT(fine.velocity, coarse.velocity / 1.5);
  EXPECT_LT(fine.normal_stress, 0.03);
  EXPECT_LT(fine.normal_stress, coarse.normal_stress / 1.5);
  EXPECT_LT(fine.energy, 0.01);
}

TEST(ViscoelasticChannel, FollowsTheSeriesAtATenfoldElasticity) {
  const Errors found = errors({"fluid.viscoelasticity.mode.0.relaxation_time=100", "case.gravity=[0.002, 0]",
                               "fluid.background_pressure.pressure=5"});
  record("errors_at_E_10", found);
  EXPECT_LT(found.velocity, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
