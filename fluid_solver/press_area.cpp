#include "fluid_solver/press_area.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "common/error/failure.hpp"
#include "common/sph/neighbour_loop.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"

namespace toryu::fluid {

namespace {

/// Of the area that the medium meets to that of the face: corners take a tenth of a narrow one.
constexpr double largest_misfit = 0.5;

}  // namespace

double met_area(const Boundary& piston, const Particles& fluid, const Kernel& kernel, Geometry geometry,
                std::size_t b, const Ranks* ranks) {
  const Vec axis = std::get<PressedMotion>(piston.motion).press.axis();
  const bool rings = geometry == Geometry::axisymmetric;
  const auto of_mass = [&](const auto& body, std::size_t k) {
    return 1 / (body.rho[k] * body.rho[k] * (rings ? circumference(body.x[1][k]) : 1.0));
  };
  Field areas(padded(piston.count), 0.0);
  const auto find_cluster = [&](const auto& W, std::size_t first) {
    Lanes of_fluid = 0.0, of_wall = 0.0;
    over_neighbours(W, piston.list_for_wall.near(first / lane_count), load(piston.x, first),
                    pointers(fluid.x), [&](std::uint32_t f, const Neighbour& n) TORYU_INLINE_LAMBDA {
                      const VecLanes grad = n.gradient(fluid.m[f]);
                      const Lanes along = axis[0] * grad[0] + axis[1] * grad[1];
                      of_fluid += of_mass(fluid, f) * along;
                      of_wall += along;
                    });
    for (std::size_t w = first; w < std::min(first + lane_count, piston.count); ++w)
      areas[w] = piston.m[w] * (of_fluid[w - first] + of_mass(piston, w) * of_wall[w - first]);
  };
  kernel.visit([&](const auto& W) {
    for (const std::uint32_t cluster : piston.list_for_wall.active()) find_cluster(W, cluster * lane_count);
  });
  if (ranks) ranks->collect_at(b, {&areas});
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

void require_medium_before_face(const Boundary& piston, double met) {
  const auto& pressed = std::get<PressedMotion>(piston.motion);
  if (std::abs(met / pressed.area - 1) < largest_misfit) return;
  throw PhysicsFailure(fmt::format(
      "wall '{}' at t = {:.6g} s: along its press the medium meets it over {:.3g} % of its face: an enclosed "
      "medium is before the face of what presses it, and on no other side",
      piston.name, pressed.time, 100 * met / pressed.area));
}

}  // namespace toryu::fluid
