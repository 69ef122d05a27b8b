/// Fills regions and walls with particles, and looks whether two bodies are in one place.

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/face_depths.hpp"
#include "fluid_solver/fluid_model.hpp"
#include "fluid_solver/initial_flow.hpp"
#include "fluid_solver/start_checks.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"
#include "fluid_solver/wall_rows.hpp"
#include "fluid_solver/work_piece.hpp"
#include "fluid_solver/worn_walls.hpp"

namespace toryu::fluid {

namespace {

/// Over the spacing: a particle nearer than this to another body's was placed twice. Rows that fit between
/// faces may be somewhat nearer than half a spacing to either.
constexpr double nearest_bodies = 0.4;

/// Of fluid in place of a press whose mass the case does not say: the fluid beside it answers in as much, so
/// it is stable by the fluid's steps and slow by no more than some rows.
constexpr double smoothing_lengths_of_press = 4;

/// Over the mass of fluid of a smoothing length in its place: of a heavier one the speed changes by less in a
/// step than what rounding leaves of the forces.
constexpr double heaviest_press = 1e12;

/// Moves one point after the other off its lattice at random, each time alike.
class Disorder {
 public:
  explicit Disorder(double largest) : largest_(largest) {}
  Vec moved(Vec x) {
    if (largest_ > 0)
      for (double& component : x) component += largest_ * (2.0 * random_() / std::mt19937::max() - 1);
    return x;
  }

 private:
  double largest_;
  std::mt19937 random_;
};

/// The lattice of a wall, and what stands where of it.
struct WallParticles {
  std::vector<Vec> lattice;
  std::vector<const Outline*> outlines;  ///< that the points fit; null on a lattice
  std::vector<std::size_t> stands;       ///< points of the lattice that have a particle
  std::vector<Vec> places;
  std::vector<double> volumes;  ///< [m2]

  WallParticles() = default;
  WallParticles(const Wall& wall, const Filling& filling)
      : lattice(filling.points), outlines(lattice.size(), wall.box.outline.get()) {
    const auto worn = worn_places(wall, lattice);
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      if (!worn[k]) continue;
      stands.push_back(k);
      places.push_back(*worn[k]);
      volumes.push_back(filling.cells[k].prod());
    }
  }
  void join(const WallParticles& other) {
    for (const std::size_t k : other.stands) stands.push_back(lattice.size() + k);
    const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(lattice, other.lattice);
    append(outlines, other.outlines);
    append(places, other.places);
    append(volumes, other.volumes);
  }
  template <class Value>
  std::vector<Value> kept(const std::vector<Value>& of_lattice) const {
    std::vector<Value> values;
    for (const std::size_t k : stands) values.push_back(of_lattice[k]);
    return values;
  }
  FaceDepths kept(const FaceDepths& depths) const {
    FaceDepths of_those{kept(depths.up), kept(depths.down)};
    if (depths.to_outline.empty()) return of_those;
    of_those.to_outline = kept(depths.to_outline);
    of_those.curvature = kept(depths.curvature);
    return of_those;
  }
};

}  // namespace

void FluidModel::fill_regions() {
  const Blocks fluid = blocks_of(parameters_);
  const auto& boxes = fluid.boxes;
  Filling filling = fill_to_faces(fluid, parameters_.spacing);
  std::vector<Vec> home;  // where each particle is in its region, if that is not where it stands
  if (any_is_worn(scene_.walls)) {
    home = filling.points;
    fill_worn_space(filling, home, scene_.walls, parameters_.spacing);
  }
  misfits_ = filling.misfits;
  Disorder disorder(parameters_.start_disorder * parameters_.spacing);

  auto& f = state_.fluid;
  f.count = filling.points.size();
  f.id.resize(f.count);
  std::iota(f.id.begin(), f.id.end(), 0u);
  resize_fields(f, room_of(f.count, scene_.geometry));

  const Vec gravity = scene_.gravity_at(0);
  const double g = gravity.norm();
  std::vector<char> filled(boxes.size(), 0);
  for (std::size_t i = 0; i < f.count; ++i) {
    const Vec x = disorder.moved(filling.points[i]);
    set(f.x, i, x);
    for (std::size_t r = 0; r < boxes.size(); ++r)
      if (boxes[r].contains(home.empty() ? filling.points[i] : home[i])) {
        set(f.v, i, parameters_.regions[r].velocity);
        filled[r] = 1;
      }
    f.rho[i] = parameters_.density;
    if (const auto& start = parameters_.hydrostatic_start; start && g > 0) {
      const double depth = start->surface_level + gravity.dot(x) / g;
      f.rho[i] = density_at_depth(parameters_, g, depth);
    }
    start_flow(i);
    f.V[i] = filling.cells[i].prod();
    f.m[i] = f.rho[i] * f.V[i];
    if (scene_.geometry == Geometry::axisymmetric) f.m[i] *= circumference(x[1]);
  }
  for (std::size_t r = 0; r < boxes.size(); ++r)
    if (!filled[r])
      throw BadKey(fmt::format("fluid.region.{}.{}", r, parameters_.regions[r].shape.place()),
                   fmt::format("region '{}' holds no particle at this spacing", parameters_.regions[r].name));
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

PressedMotion FluidModel::pressed(const Wall& wall, const std::vector<Vec>& points) const {
  const double area = pressing_area(wall, scene_.geometry),
               fluid = parameters_.density * area * parameters_.h();
  const bool explicit_steps = parameters_.model == Model::weakly_compressible;
  if (explicit_steps && wall.press->mass > 0 && wall.press->mass < fluid)
    throw BadKey(fmt::format("wall.{}.press.mass", &wall - scene_.walls.data()),
                 fmt::format("a press of {:g} kg/m is too light beside the fluid for steps like its: give it "
                             "{:.3g} kg/m or more, or leave 'mass' out",
                             wall.press->mass, fluid));
  if (wall.press->mass > heaviest_press * fluid)
    throw BadKey(
        fmt::format("wall.{}.press.mass", &wall - scene_.walls.data()),
        fmt::format("a press of {:g} kg/m is too heavy: what moves it is lost in rounding; give it at "
                    "most {:.3g} kg/m, or a wall without a 'press'",
                    wall.press->mass, heaviest_press * fluid));
  return {.press = *wall.press,
          .start = points,
          .area = area,
          .mass = wall.press->mass > 0 ? wall.press->mass : smoothing_lengths_of_press * fluid};
}

void FluidModel::fill_walls() {
  WallParticles still;
  std::map<std::string, WallParticles> groups;  // of walls that share a motion, by its name
  const auto add = [&](const std::string& name, const WallParticles& made, const Wall* wall) {
    Boundary& boundary = state_.boundaries.emplace_back();
    boundary.name = name;
    if (wall && wall->motion)
      boundary.motion = PrescribedMotion{*wall->motion, made.places, reach() / parameters_.sound_speed};
    if (wall && wall->press) boundary.motion = pressed(*wall, made.places);
    boundary.place(made.places, made.volumes, parameters_.density, parameters_.strip_width(),
                   scene_.geometry);
    const bool fit = parameters_.wall_model.extrapolation == WallExtrapolation::fit;
    if (fit || parameters_.wall_slip)
      boundary.know_faces(made.kept(face_depths(made.lattice, made.outlines, parameters_.spacing, 2 * reach(),
                                                period_.shifts())),
                          fit);
    if (wall && wall->work_piece)
      boundary.make_work_piece(
          made.kept(faces_of(*wall, made.lattice, parameters_.spacing, period_.shifts(), scene_.geometry)));
  };
  for (const auto& wall : scene_.walls) {
    WallParticles made(wall, fill_wall(wall, parameters_, scene_.gravity));
    for (Vec& x : made.places) x = period_.inside(x);
    const bool on_its_own = wall.motion || wall.press || wall.work_piece;
    const bool in_group = !wall.moves_with.empty() && !wall.work_piece;
    const std::string key = fmt::format("wall.{}.", &wall - scene_.walls.data());
    if (made.places.empty())
      throw BadKey(key + wall.shape.place(),
                   fmt::format("wall '{}' holds no particle at this spacing", wall.name));
    if (on_its_own && (wall.name == "walls" || wall.name == "interface"))
      throw BadKey(key + "name",
                   fmt::format("results call the walls at rest 'walls', the solid 'interface'; '{}', a body "
                               "of its own, needs another name",
                               wall.name));
    if (in_group)
      groups[wall.moves_with].join(made);
    else if (on_its_own)
      add(wall.name, made, &wall);
    else
      still.join(made);
  }
  for (const auto& [name, made] : groups) {
    const Wall as_one{.name = name, .box = {}, .motion = *shared_motion(scene_, name)};
    add(name, made, &as_one);
  }
  if (!still.places.empty()) add("walls", still, nullptr);
  move_boundaries(0.0);
  for (auto& boundary : state_.boundaries)
    if (boundary.is_work_piece())
      cover_faces(boundary, parameters_.spacing, state_.boundaries, parameters_.spacing, period_.shifts());
}

/// A wall that holds the solid lies where the solid's clamp does: either would act on the fluid as a wall. Of
/// the wall go the particles of which the solid covers more than a half.
void FluidModel::leave_out_walls_in(const Boundary& solid, double spacing) {
  for (Boundary& wall : state_.boundaries) {
    if (wall.moves()) continue;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t k = 0; k < wall.count; ++k) {
      const double quarter = 0.25 * std::sqrt(wall.V[k]);
      int covered = 0;
      for (int axis = 0; axis < dim; ++axis)
        for (const double side : {-quarter, quarter})
          covered += solid.covers(at(wall.x, k) + side * Vec::Unit(axis), spacing, period_.shifts());
      if (covered < 2 * dim) kept.push_back(k);
    }
    if (kept.size() < wall.count) wall.keep(kept);
  }
  std::erase_if(state_.boundaries, [](const Boundary& wall) { return wall.count == 0; });
}

void FluidModel::check_overlaps() const {
  const double nearest = nearest_bodies * parameters_.spacing;
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
    throw BadKey(
        "fluid.region",
        fmt::format("the fluid overlaps {} near ({:.6g}, {:.6g}) m: their particles must be at least {:g} "
                    "spacings apart",
                    boundary.is_interface() ? "the solid" : "the wall '" + boundary.name + "'", place[0],
                    place[1], nearest_bodies));
  }
}

}  // namespace toryu::fluid
