#include "fluid_solver/fluid_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/run/remember.hpp"
#include "fluid_solver/taken_places.hpp"
#include "fluid_solver/work_piece.hpp"

namespace toryu::fluid {

namespace {

// Shares of the limits, Monaghan 1992 and thesis section 5. A drag is stable up to 2 over its rate.
constexpr double acoustic_share = 0.25, viscous_share = 0.125, force_share = 0.25, friction_share = 0.5;

struct StepLimit {
  double value;  ///< [s]
  std::string_view rule;
};

StepLimit smallest_limit(const Parameters& p, const Extremes& largest) {
  const double h = p.h(), never = std::numeric_limits<double>::infinity();
  double nu = largest.viscosity / p.density;
  if (p.artificial_viscosity)
    nu += effective_kinematic_viscosity(p.artificial_viscosity->alpha, h, p.sound_speed);
  const std::array<StepLimit, 4> limits{
      {{acoustic_share * h / (p.sound_speed + largest.speed), "acoustic"},
       {nu > 0 ? viscous_share * h * h / nu : never, "viscous"},
       {largest.acceleration > 0 ? force_share * std::sqrt(h / largest.acceleration) : never, "force"},
       {largest.friction_rate > 0 ? friction_share / largest.friction_rate : never, "friction"}}};
  return *std::min_element(limits.begin(), limits.end(),
                           [](const auto& a, const auto& b) { return a.value < b.value; });
}

double strip_width(const Parameters& p) {
  return std::sqrt(static_cast<double>(lane_count)) * p.spacing;
}

// A particle nearer than this to another body's was placed twice.
double nearest_bodies(const Parameters& p) {
  return 0.5 * p.spacing;
}

}  // namespace

/// The state at the start of a step.
struct FluidSolver::Step {
  VecField x, v;
  Field rho;
};

FluidSolver::FluidSolver(const Parameters& parameters, const Scene& scene)
    : parameters_(parameters),
      scene_(scene),
      dynamics_(parameters, scene.gravity),
      neighbours_(2 * parameters.h(), parameters.neighbour_skin * 2 * parameters.h(),
                  strip_width(parameters)) {
  fill_regions();
  fill_walls();
  check_overlaps();
  largest_.viscosity = dynamics_.viscosity_at_rest();
  note_extremes();
}

void FluidSolver::fill_regions() {
  std::vector<Box> boxes;
  for (const auto& region : parameters_.regions) boxes.push_back(region.box);
  const auto points = fill(boxes, parameters_.holes, parameters_.spacing);
  if (points.empty())
    throw BadInput({{"[fluid.region]", 0, 0, "the regions hold no particle at this spacing"}});

  auto& f = fluid_;
  f.count = points.size();
  const std::size_t size = padded(f.count);
  f.id.resize(f.count);
  std::iota(f.id.begin(), f.id.end(), 0u);
  for (auto* field : {&f.x, &f.v, &f.a}) resize(*field, size);
  for (auto* field : {&f.rho, &f.m, &f.V, &f.p, &f.p_rho2, &f.drho}) field->assign(size, 0.0);
  const auto& diffusion = parameters_.density_diffusion;
  if (diffusion && diffusion->gradient == DiffusionGradient::renormalised) resize(f.grad_rho, size);
  if (dynamics_.viscosity_varies()) {
    f.gdot.assign(size, 0.0);
    f.eta.assign(size, dynamics_.viscosity_at_rest());
    resize(f.eta_grad_v, size);
  }

  const auto& state = dynamics_.equation_of_state();
  const double volume = std::pow(parameters_.spacing, dim), g = scene_.gravity.norm();
  for (std::size_t i = 0; i < f.count; ++i) {
    set(f.x, i, points[i]);
    for (const auto& region : parameters_.regions)
      if (region.box.contains(points[i])) set(f.v, i, region.velocity);
    f.rho[i] = parameters_.density;
    if (const auto& start = parameters_.hydrostatic_start; start && g > 0) {
      // weight of a column whose density follows from its own pressure, equations of the hydrostatic tank
      const double depth = start->surface_level + scene_.gravity.dot(points[i]) / g;
      const double c_02 = state.c_0 * state.c_0, n = state.gamma - 1.0;
      f.rho[i] *= n > 0 ? std::pow(1.0 + n * g * depth / c_02, 1.0 / n) : std::exp(g * depth / c_02);
    }
    f.m[i] = f.rho[i] * volume;
  }
}

void FluidSolver::fill_walls() {
  std::vector<Vec> still;
  const double volume = std::pow(parameters_.spacing, dim);
  const auto add = [&](const std::string& name, const std::vector<Vec>& points, const Wall* wall) {
    Boundary& boundary = boundaries_.emplace_back();
    boundary.name = name;
    boundary.moves = wall && wall->motion;
    boundary.place(points, std::vector<double>(points.size(), volume), parameters_.density,
                   strip_width(parameters_));
    moving_walls_.push_back(boundary.moves ? wall : nullptr);
    wall_start_.push_back(boundary.moves ? points : std::vector<Vec>{});
    if (wall && wall->work_piece) boundary.make_work_piece(lattice_area_vectors(points, parameters_.spacing));
  };
  TakenPlaces taken(nearest_bodies(parameters_));
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
  for (auto& boundary : boundaries_)
    if (boundary.is_work_piece() && !boundary.moves)
      cover_faces(boundary, parameters_.spacing, boundaries_, parameters_.spacing);
}

void FluidSolver::check_overlaps() const {
  const double nearest = nearest_bodies(parameters_);
  StripOrder strips(strip_width(parameters_));
  const auto order = strips.sort(fluid_.x[0], fluid_.x[1], fluid_.count);
  VecField x = fluid_.x;
  Field scratch;
  for (auto& component : x) reorder(component, order, scratch);
  strips.index(x[0], fluid_.count);
  for (const auto& boundary : boundaries_) {
    ClusterList touching;
    touching.build(boundary.x, boundary.count, x, strips, nearest);
    if (touching.active().empty()) continue;
    const Vec place = at(x, touching.sources(touching.active().front()).front());
    throw BadInput(
        {{"[fluid.region]", 0, 0,
          fmt::format("overlaps a wall near ({:.6g}, {:.6g}) m: fluid and wall particles must be at least "
                      "half a spacing apart",
                      place[0], place[1])}});
  }
}

void FluidSolver::attach(const Interface& interface) {
  interface_boundary_ = boundaries_.size();
  moving_walls_.push_back(nullptr);
  wall_start_.emplace_back();
  interface_.attach(interface, boundaries_.emplace_back(), parameters_.density, strip_width(parameters_),
                    reach() / parameters_.sound_speed);
  cover_faces(boundaries_.back(), interface.spacing, boundaries_, parameters_.spacing);
  check_overlaps();
}

void FluidSolver::begin_window(const InterfaceMotion& motion, double dt) {
  interface_.begin_window(motion, time_, dt);
  interface_.move(boundaries_[*interface_boundary_], time_);
}

double FluidSolver::time_step_limit() const {
  return parameters_.time_step_share * smallest_limit(parameters_, largest_).value;
}

std::string_view FluidSolver::time_step_rule() const {
  return smallest_limit(parameters_, largest_).rule;
}

void FluidSolver::move_boundaries(double time) {
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    if (b == interface_boundary_) {
      interface_.move(boundaries_[b], time);
    } else if (moving_walls_[b]) {
      const Motion& motion = *moving_walls_[b]->motion;
      const Vec shift = motion.displacement_at(time), v = motion.velocity_at(time),
                a = motion.acceleration_at(time);
      boundaries_[b].move([&](std::uint32_t k) { return Kinematics{wall_start_[b][k] + shift, v, a}; });
    }
  }
}

void FluidSolver::advance_from(const Step& start, double dt) {
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < fluid_.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    for (int a = 0; a < dim; ++a) {
      // x before v: its rate is the velocity of the evaluation, not the new one
      store(load(start.x[a], first) + dt * load(fluid_.v[a], first), fluid_.x[a], first);
      store(load(start.v[a], first) + dt * load(fluid_.a[a], first), fluid_.v[a], first);
    }
    store(load(start.rho, first) + dt * load(fluid_.drho, first), fluid_.rho, first);
  }
}

void FluidSolver::advance(double dt) {
  {
    const auto timer = timers_.measure("neighbours");
    neighbours_.update(fluid_, boundaries_, dt);
  }
  const Step start{fluid_.x, fluid_.v, fluid_.rho};
  dynamics_.evaluate(fluid_, neighbours_.of_fluid(), boundaries_, given_, timers_);
  advance_from(start, 0.5 * dt);
  move_boundaries(time_ + 0.5 * dt);
  dynamics_.evaluate(fluid_, neighbours_.of_fluid(), boundaries_, given_, timers_);
  if (interface_boundary_) {
    const auto timer = timers_.measure("reaction on the interface");
    auto& boundary = boundaries_[*interface_boundary_];
    dynamics_.react(fluid_, boundary);
    interface_.add_load(boundary, given_[*interface_boundary_].force(), dt);
  }
  note_surface(dt);
  const auto timer = timers_.measure("step");
  count_impulses(dt);
  advance_from(start, dt);
  time_ += dt;
  move_boundaries(time_);
  note_extremes();
}

/// All that a step changes. The lists are among it: what is summed in another order rounds otherwise.
void FluidSolver::save() {
  restore_ = remember(fluid_, boundaries_, neighbours_, given_, impulses_, gravity_impulse_, surface_record_,
                      interface_, time_, largest_);
}

void FluidSolver::note_surface(double dt) {
  if (!surface_record_) return;
  const auto timer = timers_.measure("surface of the work pieces");
  for (std::size_t b = 0; b < boundaries_.size(); ++b)
    if (b != interface_boundary_) dynamics_.react_by_friction(fluid_, boundaries_[b]);
  surface_record_->add(boundaries_, fluid_, dynamics_.kernel(), dt);
}

void FluidSolver::record_surface(const std::filesystem::path& out) {
  if (!parameters_.removal) return;
  surface_record_.emplace(*parameters_.removal);
  surface_record_->attach(boundaries_);
  surface_record_->open(out);
}

void FluidSolver::record(double time) {
  if (surface_record_) surface_record_->write(time);
}

/// Counts what the corrector is about to do, so that the sum is the change of momentum to rounding.
void FluidSolver::count_impulses(double dt) {
  impulses_.resize(boundaries_.size());
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    impulses_[b].total += dt * given_[b].force();
    impulses_[b].friction += dt * given_[b].friction();
  }
  gravity_impulse_ += dt * std::reduce(fluid_.m.begin(), fluid_.m.end()) * scene_.gravity;
}

void FluidSolver::note_extremes() {
  largest_.speed = largest_norm(fluid_.v, fluid_.count);
  largest_.acceleration = largest_norm(fluid_.a, fluid_.count);
  if (dynamics_.viscosity_varies())
    largest_.viscosity = *std::max_element(fluid_.eta.begin(), fluid_.eta.begin() + fluid_.count);
  if (const auto& friction = dynamics_.friction()) {
    const double densest = *std::max_element(fluid_.rho.begin(), fluid_.rho.end());
    largest_.friction_rate =
        friction->rate(dynamics_.equation_of_state().pressure(densest), parameters_.density);
  }
}

}  // namespace toryu::fluid
