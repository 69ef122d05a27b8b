#include "solid_solver/solid_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error/failure.hpp"
#include "common/run/snapshot.hpp"
#include "common/sph/strip_order.hpp"
#include "solid_solver/stability_warnings.hpp"

namespace toryu::solid {

namespace {

/// After so many steps the bonds are looked at: what tears takes longer, and the look costs little.
constexpr long steps_between_looks = 50;

}  // namespace

double Stress::von_mises() const {
  const double a = xx - yy, b = yy - zz, c = zz - xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * xy * xy);
}

SolidModel::SolidModel(const Parameters& parameters, const Body& body, const Scene& scene)
    : parameters_(parameters), body_(body), gravity_(scene.gravity), domain_(scene.domain) {
  const std::size_t count = body_.size(), size = padded(count);
  for (auto* field : {&X_, &u_, &v_, &a_, &external_, &constant_}) resize(*field, size);
  mobile_.resize(size, 0.0);

  VecField X;
  resize(X, size);
  for (std::size_t i = 0; i < count; ++i) set(X, i, body_.X[i]);
  number_ = StripOrder(strip_width()).sort(X[0], X[1], count);
  find_slots();
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t i = number_[std::min(k, count - 1)];  // padding repeats the last particle, held
    set(X_, k, body_.X[i]);
    mobile_[k] = k < count && !body_.held[i] ? 1.0 : 0.0;
    set(v_, k, mobile_[k] * initial_velocity(i));
    set(constant_, k, gravity_);
  }
  for (const auto& load : parameters_.loads) {
    const auto particles = body_.inside(load.box);
    for (const auto i : particles)
      set(constant_, slot_[i],
          at(constant_, slot_[i]) + load.force / (static_cast<double>(particles.size()) * mass(i)));
  }
  external_ = constant_;
  for (const auto& observer : parameters_.observers)
    observers_.emplace_back(observer, MaterialPoint(observer.point, body_.X, 2.0 * parameters_.h()));
  if (parameters_.wall_contact)
    walls_.emplace(scene.walls, *parameters_.wall_contact, parameters_.material, body_.spacing,
                   parameters_.h());
  if (walls_) resize(push_, size);
  first_energy_ = kinetic_energy();
  for (std::uint32_t i = 0; i < count; ++i)
    if (body_.held[i]) held_.push_back(i);
  load_sum_ = sum_of_loads();
  if (parameters_.detachment) detachment_.emplace(body_, parameters_);
  if (parameters_.detachment || parameters_.bonds) watch_bonds();
}

Vec SolidModel::initial_velocity(std::size_t particle) const {
  const auto& of_region = parameters_.regions[body_.region[particle]].initial_velocity;
  const auto& velocity = of_region ? of_region : parameters_.initial_velocity;
  return velocity ? velocity->at(body_.X[particle]) : Vec(Vec::Zero());
}

/// All that a step or a load changes, here and in what a formulation adds.
void SolidModel::save() {
  restore_ = snapshot(time_, number_, slot_, X_, u_, v_, a_, external_, constant_, mobile_, walls_, loaded_,
                      load_, u_at_load_, past_work_, load_sum_, push_, impulses_, bodies_, detachment_,
                      bonds_, energy_, steps_);
}

void SolidModel::find_slots() {
  slot_.resize(number_.size());
  for (std::uint32_t k = 0; k < number_.size(); ++k) slot_[number_[k]] = k;
}

void SolidModel::reorder_particles(const std::vector<std::uint32_t>& order) {
  Field scratch;
  for (auto* field : {&X_, &u_, &v_, &a_, &external_, &constant_})
    for (auto& component : *field) reorder(component, order, scratch);
  reorder(mobile_, order, scratch);
  std::vector<std::uint32_t> number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[k] = number_[order[k]];
  number_ = number;
  find_slots();
}

void SolidModel::fail(std::size_t slot, double time, const std::string& quantity, const std::string& value,
                      const std::string& limit) const {
  throw PhysicsFailure("solid", static_cast<long>(number_[slot]), time, quantity, value, limit);
}

void SolidModel::check(double time) const {
  const double speed = parameters_.limits.speed > 0 ? parameters_.limits.speed
                                                    : parameters_.material.longitudinal_sound_speed();
  const Lanes speed_2 = speed * speed;
  for (std::size_t k = 0; k < particle_count(); k += lane_count) {
    const VecLanes v = load(v_, k), u = load(u_, k), X = load(X_, k);
    auto good = dot(v, v) <= speed_2;
    for (int a = 0; a < dim; ++a)
      good = good && X[a] + u[a] >= domain_.min[a] && X[a] + u[a] <= domain_.max[a];
    if (all_of(good)) continue;
    for (std::size_t i = k; i < std::min(k + lane_count, particle_count()); ++i) {
      const Vec x = at(X_, i) + at(u_, i);
      if (!(at(v_, i).norm() <= speed))
        fail(i, time, "speed", fmt::format("{:.4g} m/s", at(v_, i).norm()), fmt::format("{:.4g} m/s", speed));
      if (!(x.array() >= domain_.min.array()).all() || !(x.array() <= domain_.max.array()).all())
        fail(i, time, "position", fmt::format("({:.4g}, {:.4g}) m", x[0], x[1]), "the domain of the case");
    }
  }
  check_strain(time);
}

Interface SolidModel::interface(double reach) const {
  Interface result;
  result.id = body_.near_surface(reach);
  result.spacing = body_.spacing;
  for (const auto i : result.id) {
    result.volume.push_back(body_.volume(i));
    result.mass.push_back(mass(i));
    for (int a = 0; a < dim; ++a) {
      result.position.push_back(body_.X[i][a]);
      result.area_vector.push_back(body_.area_vector[i][a]);
    }
  }
  return result;
}

Vec SolidModel::acceleration(std::size_t particle) const {
  const std::size_t k = slot_[particle];
  return mobile_[k] * (at(a_, k) + at(external_, k));
}

InterfaceMotion SolidModel::motion(const std::vector<std::uint32_t>& particles) const {
  InterfaceMotion result;
  for (auto* values : {&result.position, &result.velocity}) values->reserve(dim * particles.size());
  for (const auto i : particles) {
    const Vec x = body_.X[i] + displacement(i), v = velocity(i);
    result.position.insert(result.position.end(), x.begin(), x.end());
    result.velocity.insert(result.velocity.end(), v.begin(), v.end());
  }
  return result;
}

Vec SolidModel::set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load) {
  past_work_ = interface_work();
  loaded_ = particles;
  load_.clear();
  u_at_load_.clear();
  Vec sum = Vec::Zero();
  for (std::size_t n = 0; n < particles.size(); ++n) {
    Vec force = Eigen::Map<const Vec>(&load.force[dim * n]);
    if (!load.friction_force.empty()) force += Eigen::Map<const Vec>(&load.friction_force[dim * n]);
    const std::size_t k = slot_[particles[n]];
    set(external_, k, at(constant_, k) + force / mass(particles[n]));
    load_.push_back(force);
    u_at_load_.push_back(at(u_, k));
    sum += force;
  }
  load_sum_ = sum_of_loads();
  return sum;
}

Vec SolidModel::sum_of_loads() const {
  Vec sum = Vec::Zero();
  for (std::size_t i = 0; i < particle_count(); ++i) sum += mass(i) * at(external_, slot_[i]);
  return sum;
}

void SolidModel::count_impulses(double dt) {
  impulses_.load += dt * load_sum_;
  for (const auto i : held_) impulses_.clamps -= dt * mass(i) * (at(a_, slot_[i]) + at(external_, slot_[i]));
  if (walls_)
    for (std::size_t i = 0; i < particle_count(); ++i) impulses_.walls += dt * mass(i) * at(push_, slot_[i]);
}

double SolidModel::interface_work() const {
  double work = past_work_;
  for (std::size_t n = 0; n < loaded_.size(); ++n)
    work += load_[n].dot(displacement(loaded_[n]) - u_at_load_[n]);
  return work;
}

void SolidModel::add_wall_contact(const VecField& x) {
#pragma omp single
  walls_->prepare(x, particle_count(), time_);
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const VecLanes push = walls_->acceleration(x, c), a = load(a_, i);
    store(push, push_, i);
    store(VecLanes{a[0] + push[0], a[1] + push[1]}, a_, i);
  }
}

double SolidModel::contact_energy() const {
  double sum = bodies_ ? bodies_->energy() : 0.0;
  if (!walls_) return sum;
  VecField x = X_;
  for (int a = 0; a < dim; ++a)
    for (std::size_t k = 0; k < x[a].size(); ++k) x[a][k] += u_[a][k];
  for (std::size_t c = 0; c < clusters(); ++c) {
    const Lanes density = walls_->energy_density(x, c);
    for (std::size_t k = c * lane_count; k < std::min((c + 1) * lane_count, particle_count()); ++k)
      sum += body_.volume(number_[k]) * density[k - c * lane_count];
  }
  return sum;
}

double SolidModel::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < particle_count(); ++i) sum += 0.5 * mass(i) * velocity(i).squaredNorm();
  return sum;
}

double SolidModel::potential_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < particle_count(); ++i)
    sum -= mass(i) * at(constant_, slot_[i]).dot(displacement(i));
  return sum;
}

Vec SolidModel::momentum() const {
  Vec sum = Vec::Zero();
  for (std::size_t i = 0; i < particle_count(); ++i) sum += mass(i) * velocity(i);
  return sum;
}

std::vector<Vec> SolidModel::positions() const {
  std::vector<Vec> x(particle_count());
  for (std::size_t i = 0; i < particle_count(); ++i) x[i] = body_.X[i] + displacement(i);
  return x;
}

void SolidModel::tell_detached(const HearDetached& hear) {
  hear_detached_ = hear;
  look_for_detached();
  accept();
}

void SolidModel::accept() {
  if (!hear_detached_ || detachment_->list().size() == heard_detached_) return;
  heard_detached_ = detachment_->list().size();
  hear_detached_(detachment_->list());
}

void SolidModel::look_for_detached() {
  if (!detachment_ || !detachment_->due(time_)) return;
  const auto scope = timers_.measure("detachment");
  detachment_->look(positions(), time_);
}

void SolidModel::watch_bonds() {
  if (!bonds_) bonds_.emplace(body_, parameters_.bonds.value_or(BondLimits{}), stress_edges(parameters_));
}

void SolidModel::look_at_particles() {
  look_for_detached();
  if (!bonds_ || ++steps_ % steps_between_looks != 0) return;
  const auto scope = timers_.measure("bonds");
  bonds_->look(positions(), time_);
  if (!walls_)  // the work of moving ones is not known
    energy_.look(kinetic_energy(), first_energy_ + interface_work() - potential_energy(), time_);
}

void SolidModel::write_state(std::ostream&) const {
  throw std::logic_error("not yet");
}

void SolidModel::read_state(std::istream&) {
  throw std::logic_error("not yet");
}

}  // namespace toryu::solid
