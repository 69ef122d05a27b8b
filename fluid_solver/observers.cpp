#include "fluid_solver/observers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid_solver/initial_flow.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"

namespace toryu::fluid {

static_assert(dim == 2, "voids are looked for column by column of the plane");

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

/// Sums over what lies in a box.
struct Inside {
  double V = 0;    ///< volume [m2], about an axis [m3]
  double V_v = 0;  ///< times velocity [m/s]
};

Inside inside(const Particles& fluid, const Box& box, int along, Geometry geometry) {
  Inside sum;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const Vec x = at(fluid.x, i);
    const double V = fluid.m[i] / fluid.rho[i];
    const double area = geometry == Geometry::plane ? V : V / circumference(x[1]);
    const double V_inside = V * share_in(box, x, std::sqrt(area));
    sum.V += V_inside;
    sum.V_v += V_inside * fluid.v[along][i];
  }
  return sum;
}

/// Across which a flow along `axis` leaves the box: of a slice of unit depth, or of all of the ring [m],
/// [m2].
double cross_section(const Box& box, int along, Geometry geometry) {
  const int across = 1 - along;
  const double low = box.min[across], high = box.max[across];
  if (geometry == Geometry::plane) return high - low;
  const double inner = std::max(low, 0.0);
  return std::numbers::pi * (high * high - inner * inner);
}

/// Farthest that one of the points which fill a box, `step` apart, lies from any of `particles`; at most
/// `reach`. Column by column of points, so that it takes little memory.
double farthest_from_any(std::vector<Vec> particles, const Box& box, double step, double reach) {
  std::sort(particles.begin(), particles.end(), [](const Vec& a, const Vec& b) { return a[0] < b[0]; });
  const auto count = [&](int a) { return std::lround((box.max[a] - box.min[a]) / step) + 1; };
  const long columns = count(0), rows = count(1);
  std::vector<double> r2(static_cast<std::size_t>(rows));
  double farthest = 0;
  auto first = particles.begin();
  for (long i = 0; i < columns; ++i) {
    std::fill(r2.begin(), r2.end(), reach * reach);
    const double x = box.min[0] + step * static_cast<double>(i);
    while (first != particles.end() && (*first)[0] < x - reach) ++first;
    for (auto p = first; p != particles.end() && (*p)[0] <= x + reach; ++p) {
      const double y = (*p)[1] - box.min[1];
      const long begin = std::max(static_cast<long>(std::floor((y - reach) / step)), 0L);
      const long end = std::min(static_cast<long>(std::ceil((y + reach) / step)) + 1, rows);
      for (long j = begin; j < end; ++j) {
        double& nearest = r2[static_cast<std::size_t>(j)];
        nearest = std::min(nearest, (box.min + step * Vec(i, j) - *p).squaredNorm());
      }
    }
    farthest = std::max(farthest, *std::max_element(r2.begin(), r2.end()));
  }
  return std::sqrt(farthest);
}

}  // namespace

double front_x(const Particles& fluid, double spacing) {
  double front = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fluid.count; ++i)
    if (fluid.is_inside(i)) front = std::max(front, fluid.x[0][i]);
  return front + 0.5 * spacing;
}

double pressure_at(const Vec& point, const Particles& fluid, const Kernel& kernel,
                   const EquationOfState& state, const Period& period) {
  double sum_W = 0, sum_p = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const double W = kernel.value(period.shortest(at(fluid.x, i) - point).norm());
    sum_W += W;
    sum_p += W * state.pressure(fluid.rho[i]);
  }
  return sum_W > 0 ? sum_p / sum_W : 0.0;
}

double flow_rate(const Particles& fluid, const Box& box, Axis axis, Geometry geometry) {
  const int along = static_cast<int>(axis);
  const Inside sum = inside(fluid, box, along, geometry);
  return sum.V > 0 ? cross_section(box, along, geometry) * sum.V_v / sum.V : 0.0;
}

double volume_flux(const Particles& fluid, const Box& box, Axis axis, Geometry geometry) {
  const int along = static_cast<int>(axis);
  return inside(fluid, box, along, geometry).V_v / (box.max[along] - box.min[along]);
}

double flow_amplitude(const Particles& fluid, const InitialFlow& flow) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const Vec v_0 = velocity(flow, at(fluid.x, i));
    product += fluid.m[i] * v_0.dot(at(fluid.v, i));
    square += fluid.m[i] * v_0.squaredNorm();
  }
  return square > 0 ? product / square : 0.0;
}

double flow_error(const Particles& fluid, const InitialFlow& flow, double share) {
  double sum = 0;
  for (std::size_t i = 0; i < fluid.count; ++i)
    sum += (at(fluid.v, i) - share * velocity(flow, at(fluid.x, i))).squaredNorm();
  return std::sqrt(sum / static_cast<double>(fluid.count)) / std::abs(flow.speed);
}

double largest_void(const Particles& fluid, const std::vector<Boundary>& walls, const Box& box,
                    double spacing, const Period& period) {
  const double reach = 2 * spacing;
  const Box around{box.min - Vec::Constant(reach), box.max + Vec::Constant(reach)};
  std::vector<Vec> near;
  const auto add = [&](const VecField& x, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      for (const Vec& shift : period.shifts())
        if (const Vec image = at(x, i) + shift; around.contains(image)) near.push_back(image);
  };
  add(fluid.x, fluid.count);
  for (const auto& wall : walls) add(wall.x, wall.count);
  return farthest_from_any(std::move(near), box, 0.1 * spacing, reach) / spacing;
}

Observation observe(const Observer& observer, const Observed& now) {
  const Parameters& p = now.parameters;
  const char* flow_unit = now.geometry == Geometry::plane ? "m2/s" : "m3/s";
  switch (observer.quantity) {
    case Quantity::front_x:
      return {observer.name, "m", front_x(now.fluid, p.spacing)};
    case Quantity::pressure:
      return {observer.name, "Pa",
              pressure_at(observer.point, now.fluid, now.kernel, now.state, now.period) + now.p_offset};
    case Quantity::flow_rate:
      return {observer.name, flow_unit, flow_rate(now.fluid, *observer.box, observer.axis, now.geometry)};
    case Quantity::flow_amplitude:
      return {observer.name, "1", flow_amplitude(now.fluid, *p.initial_flow)};
    case Quantity::flow_error: {
      const double nu = p.laminar_viscosity->dynamic_viscosity / p.density;
      return {observer.name, "1",
              flow_error(now.fluid, *p.initial_flow, decay(*p.initial_flow, nu, now.time))};
    }
    case Quantity::volume_flux:
      return {observer.name, flow_unit, volume_flux(now.fluid, *observer.box, observer.axis, now.geometry)};
    case Quantity::largest_void:
      return {observer.name, "1", largest_void(now.fluid, now.walls, *observer.box, p.spacing, now.period)};
  }
  return {};
}

}  // namespace toryu::fluid
