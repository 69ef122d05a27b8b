#include "solid_solver/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/scene/bodies.hpp"
#include "solid_solver/observers.hpp"

namespace toryu::solid {

Drive::Drive(const Parameters& parameters, const Body& body, const Scene& scene)
    : scene_(scene),
      changes_(scene.gravity_change.has_value()),
      steady_(body.size(), scene.gravity),
      forced_(body.size(), 0) {
  for (const BoxLoad& load : parameters.loads) {
    const auto particles = body.inside(load.box);
    if (load.changes()) changing_.push_back({load, particles});
    for (const auto i : particles) {
      const double mass = body.mass(i);
      if (!load.force.isZero(0)) forced_[i] = 1;
      if (load.changes())
        changing_.back().masses.push_back(mass);
      else
        steady_[i] += load.force / (static_cast<double>(particles.size()) * mass);
    }
  }
  changes_ = changes_ || !changing_.empty();
  bear_pressures(parameters, body);
  std::vector<const Clamp*> clamp_of(body.size(), nullptr);  // the last one that has a particle holds it
  for (const Clamp& clamp : parameters.clamps)
    for (const auto i : body.inside(clamp.box)) clamp_of[i] = &clamp;
  for (const Clamp& clamp : parameters.clamps) {
    if (!clamp.motion) continue;
    turns_ = turns_ || clamp.motion->turns();
    MovingClamp& moving = clamps_.emplace_back(MovingClamp{*clamp.motion, {}});
    for (std::uint32_t i = 0; i < body.size(); ++i)
      if (clamp_of[i] == &clamp) moving.particles.push_back(i);
  }
}

void Drive::bear_pressures(const Parameters& parameters, const Body& body) {
  for (const BoxLoad& load : parameters.loads) {
    if (load.pressure == 0) continue;
    for (const SurfacePiece& piece : body.surface(load.box)) {
      const MaterialPoint point(piece.place, body.X, 2.0 * parameters.h(), body.shape, body.shifts);
      point.share([&](std::uint32_t i, double weight) {
        steady_[i] -= weight * load.pressure / body.mass(i) * piece.area;
      });
    }
  }
}

Vec Drive::gravity(double t) const {
  return scene_.gravity_at(t);
}

std::vector<Vec> Drive::accelerations(double t) const {
  std::vector<Vec> a = steady_;
  const Vec change = scene_.gravity_at(t) - scene_.gravity;
  if (scene_.gravity_change)
    for (Vec& a_i : a) a_i += change;
  for (const auto& [load, particles, masses] : changing_) {
    const Vec each = load.factor_at(t) / static_cast<double>(particles.size()) * load.force;
    for (std::size_t n = 0; n < particles.size(); ++n) a[particles[n]] += each / masses[n];
  }
  return a;
}

double Drive::fastest_sine() const {
  double frequency = 0;
  const auto look = [&](const auto& sines, auto sine_of) {
    for (const auto& each : sines) frequency = std::max(frequency, std::abs(sine_of(each).frequency));
  };
  const auto itself = [](const Sine& sine) { return sine; };
  for (const Share& share : changing_) look(share.load.sine, itself);
  if (const auto& change = scene_.gravity_change) {
    look(change->sine, [](const DirectedSine& shake) { return shake.sine; });
    if (change->turning) look(change->turning->sine, itself);
  }
  return 2 * std::numbers::pi * frequency;
}

double Drive::shortest_interval() const {
  double shortest = std::numeric_limits<double>::infinity();
  const auto look = [&](const Rows& rows) {
    for (std::size_t k = 1; k < rows.size(); ++k) shortest = std::min(shortest, rows[k][0] - rows[k - 1][0]);
  };
  for (const Share& share : changing_) look(share.load.factor);
  if (const auto& change = scene_.gravity_change) {
    look(change->acceleration);
    if (change->turning) look(change->turning->angle), look(change->turning->angular_velocity);
  }
  return shortest;
}

Pose Drive::pose(double t) const {
  return turns() ? clamps_.front().motion.pose_at(t) : Pose();
}

std::vector<std::pair<std::size_t, std::string>> clamp_faults(const Parameters& parameters) {
  std::vector<std::pair<std::size_t, std::string>> faults;
  const Clamp* turning = nullptr;
  for (const Clamp& clamp : parameters.clamps)
    if (!turning && clamp.motion && clamp.motion->turns()) turning = &clamp;
  for (std::size_t k = 0; k < parameters.clamps.size(); ++k) {
    const auto& motion = parameters.clamps[k].motion;
    if (motion && parameters.formulation == Formulation::updated_lagrangian)
      faults.emplace_back(k, "a clamp that moves needs formulation = \"total_lagrangian\"");
    else if (turning && (!motion || *motion != *turning->motion))
      faults.emplace_back(k, "where a clamp turns, all of a case move as one: this one does not move as '" +
                                 turning->name + "' does");
  }
  return faults;
}

void take_motions(CaseFile& file, const Scene& scene, Parameters& parameters) {
  const auto motions = clamp_motions(file, scene);
  for (std::size_t k = 0; k < std::min(motions.size(), parameters.clamps.size()); ++k) {
    Clamp& clamp = parameters.clamps[k];
    clamp.motion = motions[k];
    if (!clamp.moves_with.empty() && !shared_motion(scene, clamp.moves_with))
      file.fault(fmt::format("solid.clamp.{}.moves_with", k), no_motion(scene, clamp.moves_with));
  }
  for (const auto& [k, message] : clamp_faults(parameters))
    file.fault(fmt::format("solid.clamp.{}", k), message);
}

}  // namespace toryu::solid
