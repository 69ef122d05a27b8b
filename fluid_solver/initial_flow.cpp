#include "fluid_solver/initial_flow.hpp"

#include <cmath>
#include <numbers>

namespace toryu::fluid {

static_assert(dim == 2, "the flows are those of the plane");

namespace {

constexpr double pi = std::numbers::pi;

double wave_number(const InitialFlow& flow) {
  return 2 * pi / flow.length;
}

/// Pressure over rho w^2 of a square of side L that starts to turn, at X from its smallest corner: solves
/// laplacian p = 2 rho w^2, p = 0 on the sides, by sine series; the terms fall as 1/m^3.
double pressure_of_square(double L, const Vec& X) {
  double sum = 0;
  for (int m = 1; m < 100; m += 2)
    for (int n = 1; n < 100; n += 2)
      sum -= 32 * L * L / (m * n * std::pow(pi, 4) * (m * m + n * n)) * std::sin(m * pi * X[0] / L) *
             std::sin(n * pi * X[1] / L);
  return sum;
}

}  // namespace

Vec velocity(const InitialFlow& flow, const Vec& x) {
  const Vec X = x - flow.centre;
  const double U = flow.speed, k = wave_number(flow);
  switch (flow.profile) {
    case FlowProfile::taylor_green:
      return U * Vec(-std::cos(k * X[0]) * std::sin(k * X[1]), std::sin(k * X[0]) * std::cos(k * X[1]));
    case FlowProfile::rotation:
      return U / flow.length * Vec(X[1], -X[0]);
    case FlowProfile::strain:
      return U / flow.length * Vec(X[0], -X[1]);
    case FlowProfile::standing_wave: {
      const double H = flow.depth, share = U / std::sinh(k * H);
      return share * Vec(-std::cosh(k * (X[1] + H)) * std::sin(k * X[0]),
                         std::sinh(k * (X[1] + H)) * std::cos(k * X[0]));
    }
  }
  return Vec::Zero();
}

double pressure_over_density(const InitialFlow& flow, const Box& body, double central_rate, const Vec& x) {
  const Vec X = x - flow.centre;
  const double U = flow.speed, rate = U / flow.length;
  switch (flow.profile) {
    case FlowProfile::taylor_green: {
      const double k_2 = 2 * wave_number(flow);
      return -0.25 * U * U * (std::cos(k_2 * X[0]) + std::cos(k_2 * X[1]));
    }
    case FlowProfile::rotation:
      return rate * rate * pressure_of_square(body.max[0] - body.min[0], x - body.min);
    case FlowProfile::strain: {
      const double R = 0.5 * (body.max[0] - body.min[0]);
      return 0.5 * (central_rate * central_rate + rate * rate) * (R * R - X.squaredNorm());
    }
    case FlowProfile::standing_wave:
      return 0;
  }
  return 0;
}

double decay(const InitialFlow& flow, double nu, double time) {
  const double k = wave_number(flow);
  return std::exp(-2 * nu * k * k * time);
}

}  // namespace toryu::fluid
