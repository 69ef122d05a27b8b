/// Fills regions and walls with particles, and looks whether two bodies are in one place.

#include <cmath>
#include <numeric>
#include <random>

#include "common/scene/occupancy_index.hpp"
#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/initial_flow.hpp"
#include "fluid_solver/start_checks.hpp"
#include "fluid_solver/wall_extrapolation.hpp"
#include "fluid_solver/work_piece.hpp"

namespace toryu::fluid {

namespace {

// A particle nearer than this to another body's was placed twice.
double nearest_bodies(const Parameters& p) {
  return 0.5 * p.spacing;
}

/// Moves points off their lattice at random, each time alike.
void disorder(std::vector<Vec>& points, double largest) {
  if (largest == 0) return;
  std::mt19937 random;
  const auto draw = [&] { return largest * (2.0 * random() / std::mt19937::max() - 1); };
  for (Vec& x : points)
    for (double& component : x) component += draw();
}

}  // namespace

void FluidModel::fill_regions() {
  std::vector<Box> boxes;
  for (const auto& region : parameters_.regions) boxes.push_back(region.box);
  const auto lattice = fill(boxes, parameters_.holes, parameters_.spacing);
  auto points = lattice;
  disorder(points, parameters_.start_disorder * parameters_.spacing);
  if (points.empty())
    throw BadInput({{"[fluid.region]", 0, 0, "the regions hold no particle at this spacing"}});

  auto& f = state_.fluid;
  f.count = points.size();
  f.id.resize(f.count);
  std::iota(f.id.begin(), f.id.end(), 0u);
  resize_fields(f, padded(f.count));

  const double volume = std::pow(parameters_.spacing, dim), g = scene_.gravity.norm();
  for (std::size_t i = 0; i < f.count; ++i) {
    set(f.x, i, points[i]);
    for (const auto& region : parameters_.regions)
      if (region.box.contains(lattice[i])) set(f.v, i, region.velocity);
    f.rho[i] = parameters_.density;
    if (const auto& start = parameters_.hydrostatic_start; start && g > 0) {
      const double depth = start->surface_level + scene_.gravity.dot(points[i]) / g;
      f.rho[i] = density_at_depth(parameters_, g, depth);
    }
    start_flow(i);
    f.m[i] = f.rho[i] * volume;
    f.V[i] = volume;
  }
}

void FluidModel::start_flow(std::size_t i) {
  if (!parameters_.initial_flow) return;
  const InitialFlow& flow = *parameters_.initial_flow;
  const EquationOfState& state = equation_of_state_;
  const double central_rate = parameters_.central_force ? parameters_.central_force->rate : 0.0;
  const Vec x = at(state_.fluid.x, i);
  const double p_rho = pressure_over_density(flow, parameters_.regions.front().box, central_rate, x);
  set(state_.fluid.v, i, at(state_.fluid.v, i) + velocity(flow, x));
  state_.fluid.rho[i] *= state.density(state.p_b + state.rho_0 * p_rho) / state.rho_0;
}

void FluidModel::fill_walls() {
  std::vector<Vec> still;
  const double volume = std::pow(parameters_.spacing, dim);
  const auto add = [&](const std::string& name, const std::vector<Vec>& points, const Wall* wall) {
    Boundary& boundary = state_.boundaries.emplace_back();
    boundary.name = name;
    if (wall && wall->motion)
      boundary.motion = PrescribedMotion{*wall->motion, points, reach() / parameters_.sound_speed};
    boundary.place(points, std::vector<double>(points.size(), volume), parameters_.density,
                   parameters_.strip_width());
    if (parameters_.wall_model.extrapolation == WallExtrapolation::fit)
      boundary.know_faces(lattice_face_depths(points, parameters_.spacing, 2 * reach()));
    if (wall && wall->work_piece) boundary.make_work_piece(lattice_area_vectors(points, parameters_.spacing));
  };
  OccupancyIndex taken(nearest_bodies(parameters_));
  for (const auto& wall : scene_.walls) {
    const auto points = fill({wall.box}, {}, parameters_.spacing);
    const std::string place = fmt::format("[[wall]] '{}'", wall.name);
    const bool on_its_own = wall.motion || wall.work_piece;
    if (points.empty()) throw BadInput({{place, 0, 0, "holds no particle at this spacing"}});
    if (on_its_own && (wall.name == "walls" || wall.name == "interface"))
      throw BadInput({{place, 0, 0,
                       "results call the walls at rest 'walls', the solid 'interface'; this "
                       "one, a body of its own, needs another name"}});
    if (const auto overlap = taken.take(points, wall.name))
      throw BadInput(
          {{place, 0, 0,
            fmt::format("overlaps the wall '{}' near ({:.6g}, {:.6g}) m: particles of two walls must be "
                        "at least half a spacing apart",
                        overlap->with, overlap->place[0], overlap->place[1])}});
    if (on_its_own)
      add(wall.name, points, &wall);
    else
      still.insert(still.end(), points.begin(), points.end());
  }
  if (!still.empty()) add("walls", still, nullptr);
  move_boundaries(0.0);
  for (auto& boundary : state_.boundaries)
    if (boundary.is_work_piece() && !boundary.moves())
      cover_faces(boundary, parameters_.spacing, state_.boundaries, parameters_.spacing);
}

void FluidModel::check_overlaps() const {
  const double nearest = nearest_bodies(parameters_);
  StripOrder strips(parameters_.strip_width());
  const auto order = strips.sort(state_.fluid.x[0], state_.fluid.x[1], state_.fluid.count);
  VecField x = state_.fluid.x;
  Field scratch;
  for (auto& component : x) reorder(component, order, scratch);
  strips.index(x[0], state_.fluid.count);
  for (const auto& boundary : state_.boundaries) {
    ClusterList touching;
    touching.build(boundary.x, boundary.count, x, strips, nearest, period_.shifts());
    if (touching.active().empty()) continue;
    const Vec place = at(x, touching.near(touching.active().front()).back().sources.front());
    throw BadInput(
        {{"[fluid.region]", 0, 0,
          fmt::format("overlaps a wall near ({:.6g}, {:.6g}) m: fluid and wall particles must be at least "
                      "half a spacing apart",
                      place[0], place[1])}});
  }
}

}  // namespace toryu::fluid
