#include "fluid_solver/observers.hpp"

#include <algorithm>
#include <cmath>

namespace toryu::fluid {

namespace {

/// Share of the square of side `side` about `x` that lies in the box.
double share_in(const Box& box, const Vec& x, double side) {
  double share = 1;
  for (int a = 0; a < dim; ++a) {
    const double inside = std::min(x[a] + 0.5 * side, box.max[a]) - std::max(x[a] - 0.5 * side, box.min[a]);
    share *= std::max(inside, 0.0) / side;
  }
  return share;
}

}  // namespace

double front_x(const Particles& fluid, double spacing) {
  double front = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fluid.count; ++i) front = std::max(front, fluid.x[0][i]);
  return front + 0.5 * spacing;
}

double pressure_at(const Vec& point, const Particles& fluid, const CubicSpline& kernel,
                   const EquationOfState& state) {
  double sum_W = 0, sum_p = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const double W = kernel.value((at(fluid.x, i) - point).norm());
    sum_W += W;
    sum_p += W * state.pressure(fluid.rho[i]);
  }
  return sum_W > 0 ? sum_p / sum_W : 0.0;
}

double flow_rate(const Particles& fluid, const Box& box, Axis axis) {
  const int along = static_cast<int>(axis);
  double sum_V = 0, sum_V_v = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const double V = fluid.m[i] / fluid.rho[i];
    const double V_inside = V * share_in(box, at(fluid.x, i), std::sqrt(V));
    sum_V += V_inside;
    sum_V_v += V_inside * fluid.v[along][i];
  }
  double cross_section = 1;
  for (int a = 0; a < dim; ++a)
    if (a != along) cross_section *= box.max[a] - box.min[a];
  return sum_V > 0 ? cross_section * sum_V_v / sum_V : 0.0;
}

Observation observe(const Observer& observer, const Particles& fluid, double spacing,
                    const CubicSpline& kernel, const EquationOfState& state) {
  switch (observer.quantity) {
    case Quantity::front_x:
      return {observer.name, "m", front_x(fluid, spacing)};
    case Quantity::pressure:
      return {observer.name, "Pa", pressure_at(observer.point, fluid, kernel, state)};
    case Quantity::flow_rate:
      return {observer.name, "m2/s", flow_rate(fluid, *observer.box, observer.axis)};
  }
  return {};
}

}  // namespace toryu::fluid
