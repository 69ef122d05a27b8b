#include "fluid_solver/fluid_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/run/log.hpp"
#include "common/run/snapshot.hpp"
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

}  // namespace

FluidSolver::FluidSolver(const Parameters& parameters, const Scene& scene)
    : parameters_(parameters),
      scene_(scene),
      dynamics_(parameters, scene.gravity),
      period_(scene, parameters.spacing, (1 + parameters.neighbour_skin) * 2 * parameters.h()),
      neighbours_(2 * parameters.h(), parameters.neighbour_skin * 2 * parameters.h(),
                  parameters.strip_width(), period_.shifts()) {
  if (parameters.particle_shifting)
    shifting_.emplace(*parameters.particle_shifting, parameters.spacing, dynamics_.kernel());
  else
    suction_watch_.emplace(parameters.spacing, dynamics_.equation_of_state());
  fill_regions();
  fill_walls();
  check_overlaps();
  largest_.viscosity = dynamics_.viscosity_at_rest();
  start_momentum_ = momentum();
  note_extremes();
}

void FluidSolver::attach(const Interface& interface) {
  interface_boundary_ = boundaries_.size();
  moving_walls_.push_back(nullptr);
  wall_start_.emplace_back();
  interface_.attach(interface, boundaries_.emplace_back(), parameters_.density, parameters_.strip_width(),
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

void FluidSolver::move_back_into_domain() {
  if (!period_.any()) return;
  for (std::size_t i = 0; i < fluid_.count; ++i) {
    const Vec x = at(fluid_.x, i);
    set(fluid_.x, i, x + period_.back_into_domain(x));
  }
  for (std::size_t b = 0; b < boundaries_.size(); ++b)
    if (boundaries_[b].moves)
      for (std::size_t k = 0; k < boundaries_[b].count; ++k)
        wall_start_[b][boundaries_[b].id[k]] += period_.back_into_domain(at(boundaries_[b].x, k));
  move_boundaries(time_);
}

/// All that a step changes. The lists are among it: what is summed in another order rounds otherwise.
void FluidSolver::save() {
  restore_ = snapshot(fluid_, boundaries_, neighbours_, given_, impulses_, gravity_impulse_, surface_record_,
                      interface_, time_, largest_, density_rate_known_);
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
  if (suction_watch_) watch_suction(time);
}

/// Who has a free surface in reach is not known in every run, and asked where it matters alone.
void FluidSolver::watch_suction(double time) {
  const auto suction = suction_watch_->look(fluid_, time);
  if (!suction) return;
  free_surface_.find_off_surface(fluid_, neighbours_.of_fluid(), boundaries_, dynamics_.kernel());
  if (!is_closed(fluid_)) return suction_watch_->forget();
  log::warn("{}", *suction);
  suction_watch_.reset();
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

void FluidSolver::write_state(std::ostream&) const {
  throw std::logic_error("not yet");
}

void FluidSolver::read_state(std::istream&) {
  throw std::logic_error("not yet");
}

}  // namespace toryu::fluid
