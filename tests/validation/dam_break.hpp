/// The surge front of the dam break against the measurement.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {

struct Reading {
  double T, Z;
};
/// Martin & Moyce 1952 (Phil. Trans. R. Soc. A 244, 312-324), H/a = 2, a = 2.25 in: T = t sqrt(2 g/a), Z =
/// x/a.
inline constexpr Reading martin_moyce[] = {{0.832, 1.217}, {1.219, 1.474}, {1.997, 2.292}, {2.547, 2.995},
                                           {3.345, 4.134}, {4.034, 4.944}, {4.418, 5.881}, {5.091, 6.980},
                                           {5.685, 7.945}, {6.306, 8.966}, {6.822, 9.986}, {7.439, 10.963}};

/// The front over time of a run, at equal intervals of T from 0.
struct Front {
  double interval;
  std::vector<double> Z;
  double at(double T) const {
    const double place = std::max(T / interval, 0.0);
    const auto k = std::min(static_cast<std::size_t>(place), Z.size() - 2);
    return Z[k] + (place - static_cast<double>(k)) * (Z[k + 1] - Z[k]);
  }
};

/// Distances to the readings, relative to each, when T is measured from `start`: the moment at which the gate
/// of the experiment let the water go is not known.
struct Fit {
  double start = 0, root_mean_square = 0, largest = std::numeric_limits<double>::infinity();
};
/// The start that makes the largest distance least.
inline Fit best_fit(const Front& front) {
  Fit best;
  for (double start = 0; start < 1; start += 0.001) {
    Fit fit{start, 0, 0};
    for (const auto& reading : martin_moyce) {
      const double distance = std::abs(front.at(reading.T - start) / reading.Z - 1);
      fit.root_mean_square += distance * distance / std::size(martin_moyce);
      fit.largest = std::max(fit.largest, distance);
    }
    fit.root_mean_square = std::sqrt(fit.root_mean_square);
    if (fit.largest < best.largest) best = fit;
  }
  return best;
}

/// Runs the case to T = 7.4; no particle may leave physics or the domain on the way.
inline Fit run_dam_break(const std::vector<std::string>& overrides) {
  const FluidCase the_case("dam_break", overrides);
  const double a = 0.05715, unit = std::sqrt(a / (2 * the_case.scene.gravity.norm()));  // of T [s]
  WeaklyCompressible solver = the_case.solver();
  const std::size_t particles = solver.particle_count();
  Front front{0.02, {}};
  for (int n = 0; n * front.interval < 7.41; ++n) {
    run_until(solver, n * front.interval * unit);
    solver.check(solver.time());
    double x = 0;
    for (std::size_t k = 0; k < particles; ++k) x = std::max(x, solver.particles().x[0][k]);
    front.Z.push_back((x + 0.5 * the_case.parameters.spacing) / a);
  }
  const Fit fit = best_fit(front);
  for (const auto& [name, value] :
       {std::pair{"start", fit.start}, {"root_mean_square", fit.root_mean_square}, {"largest", fit.largest}})
    ::testing::Test::RecordProperty(name, fmt::format("{:.4f}", value));
  return fit;
}

}  // namespace toryu::fluid
