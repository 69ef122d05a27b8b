/// Where the particles are at the start, and how long a step may be.
#include <fmt/format.h>

#include <cmath>

#include "parameters.hpp"

namespace toryu::lammps_fluid {

namespace {

/// A centre within this share of a spacing of an edge is on it: rounding moves edges by less.
constexpr double rounding = 1e-6;

/// Calls visit(x) for the points of the lattice through `origin` in a box, row by row.
template <class Visit>
long over_lattice(const Box& box, const Vec& origin, double spacing, Visit&& visit) {
  const auto first_at_or_above = [&](double x, int axis) {
    return std::lround(std::ceil((x - origin[axis]) / spacing - 0.5 - rounding));
  };
  const auto centre = [&](long k, int axis) {
    return origin[axis] + (static_cast<double>(k) + 0.5) * spacing;
  };
  long count = 0;
  for (long n = first_at_or_above(box.min[1], 1); n < first_at_or_above(box.max[1], 1); ++n)
    for (long m = first_at_or_above(box.min[0], 0); m < first_at_or_above(box.max[0], 0); ++m, ++count)
      visit(Vec(centre(m, 0), centre(n, 1)));
  return count;
}

bool contains(const Box& box, const Vec& x, double margin) {
  return (x.array() >= box.min.array() - margin).all() && (x.array() < box.max.array() - margin).all();
}

[[noreturn]] void refuse(const std::string& place, const std::string& message) {
  throw BadInput({{.place = place, .line = 0, .column = 0, .message = message}});
}

Physics physics_of(const Case& of) {
  const Parameters& p = of.parameters;
  Physics physics{.spacing = p.spacing,
                  .h = p.h(),
                  .rho_0 = p.density,
                  .c_0 = p.sound_speed,
                  .gamma = p.stiffness_exponent,
                  .delta = p.diffusion ? p.diffusion->delta : 0,
                  .alpha = p.artificial ? p.artificial->alpha : 0,
                  .beta = p.artificial ? p.artificial->beta : 0,
                  .mu = p.laminar ? p.laminar->dynamic_viscosity : 0,
                  .skin = 2 * p.h() * p.neighbour_skin,
                  .largest_speed = p.limits.speed > 0 ? p.limits.speed : p.sound_speed,
                  .largest_change = p.limits.density_change,
                  .wendland = p.kernel == Kernel::wendland_c2,
                  .renormalised = p.diffusion && p.diffusion->gradient == Diffusion::Gradient::renormalised,
                  .no_slip = p.wall_model.slip == WallModel::Slip::no_slip,
                  .suction = p.wall_model.suction,
                  .midpoint = p.integrator == Integrator::midpoint};
  for (int a = 0; a < dim; ++a) {
    physics.gravity[a] = of.scene.gravity[a];
    physics.low[a] = of.scene.domain.min[a];
    physics.high[a] = of.scene.domain.max[a];
  }
  return physics;
}

void add(Start& start, const Vec& x, const Vec& v, double rho, double volume) {
  for (int a = 0; a < dim; ++a) {
    start.position.push_back(x[a]);
    start.velocity.push_back(v[a]);
  }
  start.density.push_back(rho);
  start.mass.push_back(rho * volume);
}

void fill_regions(const Case& of, const Vec& origin, Start& start) {
  const Parameters& p = of.parameters;
  const double g = of.scene.gravity.norm();
  for (std::size_t r = 0; r < p.regions.size(); ++r) {
    const auto add_particle = [&](const Vec& x) {
      for (std::size_t other = 0; other < r; ++other)
        if (contains(p.regions[other].box, x, rounding * p.spacing)) return;
      double rho = p.density;
      if (p.hydrostatic_start && g > 0)
        rho = start.physics.density_at_depth(
            g, p.hydrostatic_start->surface_level + of.scene.gravity.dot(x) / g);
      if (!(std::abs(rho / p.density - 1) < p.limits.density_change))
        refuse("[fluid.hydrostatic_start]", fmt::format("the density at the start would be {:g} kg/m3", rho));
      add(start, x, p.regions[r].velocity, rho, p.spacing * p.spacing);
      ++start.physics.fluid_count;
    };
    if (over_lattice(p.regions[r].box, origin, p.spacing, add_particle) == 0)
      refuse(fmt::format("[[fluid.region]] '{}'", p.regions[r].name), "holds no particle at this spacing");
  }
}

/// A wall that holds the solid may lie where the solid's clamp does: particles in a cell of it are left out.
void fill_walls(const Case& of, const Vec& origin, const std::vector<double>& interface,
                const std::vector<double>& volume, Start& start) {
  const Parameters& p = of.parameters;
  std::vector<Box> filled;
  const auto is_free = [&](const Vec& x) {
    for (const Box& box : filled)
      if (contains(box, x, rounding * p.spacing)) return false;
    for (std::size_t k = 0; k < volume.size(); ++k)
      if (((x - Eigen::Map<const Vec>(&interface[dim * k])).cwiseAbs().array() < 0.5 * std::sqrt(volume[k]))
              .all())
        return false;
    return true;
  };
  for (const Wall& wall : of.walls) {
    const auto add_particle = [&](const Vec& x) {
      if (!is_free(x)) return;
      add(start, x, Vec::Zero(), p.density, p.spacing * p.spacing);
      ++start.physics.wall_count;
    };
    if (over_lattice(wall.box, origin, p.spacing, add_particle) == 0)
      refuse(fmt::format("[[wall]] '{}'", wall.name), "holds no particle at this spacing");
    filled.push_back(wall.box);
  }
}

}  // namespace

Start fill(const Case& of, const std::vector<double>& interface_position,
           const std::vector<double>& interface_volume) {
  Start start{.physics = physics_of(of), .position = {}, .velocity = {}, .density = {}, .mass = {}};
  Vec origin = of.parameters.regions.front().box.min;
  for (const Region& region : of.parameters.regions) origin = origin.cwiseMin(region.box.min);
  fill_regions(of, origin, start);
  fill_walls(of, origin, interface_position, interface_volume, start);
  for (std::size_t k = 0; k < interface_volume.size(); ++k)
    add(start, Eigen::Map<const Vec>(&interface_position[dim * k]), Vec::Zero(), of.parameters.density,
        interface_volume[k]);
  start.physics.interface_count = static_cast<int>(interface_volume.size());
  for (std::size_t k = 0; k < start.density.size(); ++k)
    if (!contains(of.scene.domain, Eigen::Map<const Vec>(&start.position[dim * k]), 0))
      refuse("[case.domain]", "a particle of the fluid, a wall or the solid is outside at the start");
  return start;
}

double Parameters::time_step_limit(double speed, double acceleration) const {
  const double acoustic = 0.25 * h() / (sound_speed + speed);
  double limit = time_step_share * acoustic;
  double nu = (laminar ? laminar->dynamic_viscosity : 0) / density;
  if (artificial) nu += 0.049 * artificial->alpha * h() * sound_speed;  // what it acts like in sheared flow
  if (nu > 0) {
    const double viscous = 0.125 * h() * h() / nu;
    limit = std::min(limit, std::min(time_step_share, 2.0) * viscous);
    if (integrator == Integrator::symplectic) {  // sound that is damped, found half a step late
      const double edge = 6.7 * acoustic, half = 0.5 * edge * edge / (2.4 * viscous);
      limit = std::min(limit, std::sqrt(half * half + 0.9 * edge * edge) - half);
    }
  }
  if (acceleration > 0) limit = std::min(limit, time_step_share * 0.25 * std::sqrt(h() / acceleration));
  return limit;
}

}  // namespace toryu::lammps_fluid
