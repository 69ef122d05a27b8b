#include "solid_solver/solid_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/error/failure.hpp"
#include "common/sph/strip_order.hpp"
#include "common/state/serialize.hpp"
#include "solid_solver/stability_warnings.hpp"

namespace toryu::solid {

namespace {

/// After so many steps the bonds are checked: what tears takes longer, and the check costs little.
constexpr long steps_between_checks = 50;

}  // namespace

double Stress::von_mises() const {
  const double a = xx - yy, b = yy - zz, c = zz - xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * xy * xy);
}

SolidModel::SolidModel(const Parameters& parameters, const Body& body, const Scene& scene)
    : parameters_(parameters), body_(body), gravity_(scene.gravity), domain_(scene.domain), period_(scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < dim; ++axis)
    if (period_.along(axis)) domain_.min[axis] = -infinity, domain_.max[axis] = infinity;
  const std::size_t count = body_.size(), size = padded(count);
  VecField X;
  resize(X, size);
  for (std::size_t i = 0; i < count; ++i) set(X, i, body_.X[i]);
  state_.number = StripOrder(strip_width()).sort(X[0], X[1], count);
  resize_fields(state_, size);
  resize(X_, size);
  mobile_.resize(size);
  inverse_rho_.resize(size);
  find_slots();
  for (std::size_t k = 0; k < size; ++k)
    set(state_.v, k, mobile_[k] * initial_velocity(state_.number[std::min(k, count - 1)]));
  drive_ = Drive(parameters_, body_, scene);
  gravity_ = drive_.gravity(0);
  constant_ = drive_.changes() ? drive_.accelerations(0) : drive_.steady();
  move_clamps();
  state_.idle_external = constant_[state_.number.back()];
  find_external();
  state_.load_sum = sum_of_loads();
  for (const auto& observer : parameters_.observers)
    observers_.emplace_back(
        observer, MaterialPoint(observer.point, body_.X, 2.0 * parameters_.h(), body_.shape, body_.shifts));
  if (parameters_.wall_contact) {
    walls_.emplace(scene.walls, *parameters_.wall_contact, parameters_.material_in_contact(), body_.spacing,
                   parameters_.h(), period_);
    state_.walls = walls_->start();
    resize(state_.push, size);
  } else if (!scene.walls.empty()) {
    passed_.emplace(scene.walls, body_.X, body_.spacing);
  }
  first_energy_ = kinetic_energy();
  for (std::uint32_t i = 0; i < count; ++i)
    if (body_.held[i]) held_.push_back(i);
  if (parameters_.detachment) {
    detachment_.emplace(body_, parameters_);
    state_.detachment = detachment_->start();
  }
  if (parameters_.detachment || parameters_.bonds) watch_bonds();
}

Vec SolidModel::initial_velocity(std::size_t particle) const {
  const auto& of_region = parameters_.regions[body_.region[particle]].initial_velocity;
  const auto& velocity = of_region ? of_region : parameters_.initial_velocity;
  return velocity ? velocity->at(body_.X[particle]) : Vec(Vec::Zero());
}

void SolidModel::save() {
  saved_ = state_;
}

void SolidModel::restore() {
  state_ = saved_;
  find_slots();
  if (drive_.changes()) find_driven(state_.time_of_drive);
}

void SolidModel::write_state(std::ostream& stream) const {
  write_states(stream, state_);
}

void SolidModel::read_state(std::istream& stream) {
  read_states(stream, state_);
  find_slots();
  if (drive_.changes()) find_driven(state_.time_of_drive);
  find_external();
  if (walls_) walls_->complete(state_.walls, particle_count());
  if (bodies_) bodies_->find_pairs(state_.bodies);
  recorded_detached_.reset();
}

void SolidModel::find_slots() {
  const auto& number = state_.number;
  slot_.resize(number.size());
  for (std::uint32_t k = 0; k < number.size(); ++k) slot_[number[k]] = k;
  for (std::size_t k = 0; k < mobile_.size(); ++k) {
    const std::size_t i = number[std::min(k, number.size() - 1)];  // padding repeats the last particle
    set(X_, k, body_.X[i]);
    mobile_[k] = body_.held[i] ? 0.0 : 1.0;
    inverse_rho_[k] = 1.0 / body_.density[body_.material[i]];
  }
}

void SolidModel::find_external() {
  for (std::size_t k = 0; k < particle_count(); ++k) set(state_.external, k, constant_[state_.number[k]]);
  for (std::size_t k = particle_count(); k < clusters() * lane_count; ++k)
    set(state_.external, k, state_.idle_external);
  for (std::size_t n = 0; n < state_.loaded.size(); ++n) {
    const auto i = state_.loaded[n];
    set(state_.external, slot_[i], constant_[i] + state_.load[n] / mass(i));
  }
}

void SolidModel::sort_particles(const std::vector<std::uint32_t>& order) {
  find_external();  // without the brake of the last step, which idle lanes would keep
  state_.idle_external = at(state_.external, order.back());
  reorder_fields(state_, order);
  std::vector<std::uint32_t> scratch;
  reorder(state_.number, order, scratch);
  find_slots();
  find_external();
}

void SolidModel::fail(std::size_t slot, double time, const std::string& quantity, const std::string& value,
                      const std::string& limit) const {
  throw PhysicsFailure("solid", static_cast<long>(body_.first + state_.number[slot]), time, quantity, value,
                       limit);
}

void SolidModel::check(double time) const {
  const double speed = parameters_.largest_speed();
  const Lanes speed_2 = speed * speed;
  for (std::size_t k = 0; k < particle_count(); k += lane_count) {
    const VecLanes v = load(state_.v, k), u = load(state_.u, k), X = load(X_, k);
    auto good = dot(v, v) <= speed_2;
    for (int a = 0; a < dim; ++a)
      good = good && X[a] + u[a] >= domain_.min[a] && X[a] + u[a] <= domain_.max[a];
    if (all_of(good)) continue;
    for (std::size_t i = k; i < std::min(k + lane_count, particle_count()); ++i) {
      const Vec x = at(X_, i) + at(state_.u, i);
      if (!(at(state_.v, i).norm() <= speed))
        fail(i, time, "speed", fmt::format("{:.4g} m/s", at(state_.v, i).norm()),
             fmt::format("{:.4g} m/s", speed));
      if (!(x.array() >= domain_.min.array()).all() || !(x.array() <= domain_.max.array()).all())
        fail(i, time, "position", fmt::format("({:.4g}, {:.4g}) m", x[0], x[1]),
             fmt::format(
                 "the domain of the case, ({:g}, {:g}) to ({:g}, {:g}) m; {}, or a larger [case] domain "
                 "lets it go on",
                 domain_.min[0], domain_.min[1], domain_.max[0], domain_.max[1], what_holds()));
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
  return mobile_[k] * (at(state_.a, k) + at(state_.external, k));
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
  state_.past_work = interface_work();
  state_.loaded = particles;
  state_.load.clear();
  state_.u_at_load.clear();
  Vec sum = Vec::Zero();
  for (std::size_t n = 0; n < particles.size(); ++n) {
    Vec force = Eigen::Map<const Vec>(&load.force[dim * n]);
    if (!load.friction_force.empty()) force += Eigen::Map<const Vec>(&load.friction_force[dim * n]);
    state_.load.push_back(force);
    state_.u_at_load.push_back(displacement(particles[n]));
    sum += force;
  }
  state_.impedance.clear();
  state_.impedance_work = 0;
  for (std::size_t n = 0; dim * n < load.velocity.size(); ++n) {
    const Vec z = vector_of(load.impedance, n);
    const double value = z.norm();
    state_.impedance.push_back(
        {value > 0 ? Vec(z / value) : Vec(Vec::Zero()), value, vector_of(load.velocity, n)});
  }
  find_external();
  state_.load_sum = sum_of_loads();
  return sum;
}

void SolidModel::brake_by_impedance(double dt, double kept) {
  for (std::size_t n = 0; n < state_.impedance.size(); ++n) {
    Impedance& z = state_.impedance[n];
    if (z.value == 0) continue;
    const auto i = state_.loaded[n];
    const std::size_t k = slot_[i];
    const Vec rest = constant_[i] + state_.load[n] / mass(i);
    const Vec w = kept * at(state_.v, k) + 0.5 * dt * mobile_[k] * (at(state_.a, k) + rest);
    const double rate = z.value / mass(i);
    const double brake = rate / (1.0 + 0.5 * dt * mobile_[k] * rate) * z.normal.dot(z.velocity - w);
    set(state_.external, k, rest + brake * z.normal);
    const double impulse = dt * mass(i) * brake;
    z.impulse += impulse;
    state_.impedance_work += impulse * (z.normal.dot(w) + 0.5 * dt * mobile_[k] * brake);
    state_.impulses.loads += impulse * z.normal;
  }
}

std::vector<double> SolidModel::excess_impulse() const {
  std::vector<double> impulse;
  for (const Impedance& z : state_.impedance)
    for (int a = 0; a < dim; ++a) impulse.push_back(z.impulse * z.normal[a]);
  return impulse;
}

Vec SolidModel::sum_of_loads() const {
  Vec sum = Vec::Zero();
  for (std::size_t i = 0; i < particle_count(); ++i) sum += mass(i) * at(state_.external, slot_[i]);
  return sum;
}

void SolidModel::count_impulses(double dt) {
  Impulses& impulses = state_.impulses;
  impulses.loads += dt * state_.load_sum;
  for (const auto i : held_)
    impulses.clamps -= dt * mass(i) * (at(state_.a, slot_[i]) + at(state_.external, slot_[i]));
  if (walls_)
    for (std::size_t i = 0; i < particle_count(); ++i)
      impulses.walls += dt * mass(i) * at(state_.push, slot_[i]);
}

double SolidModel::interface_work() const {
  double work = state_.past_work + state_.impedance_work;
  for (std::size_t n = 0; n < state_.loaded.size(); ++n)
    work += state_.load[n].dot(displacement(state_.loaded[n]) - state_.u_at_load[n]);
  return work;
}

void SolidModel::place_in_domain(VecField& x, std::size_t cluster) const {
  const std::size_t first = cluster * lane_count;
  for (int a = 0; a < dim; ++a) store(load(X_[a], first) + load(state_.u[a], first), x[a], first);
  for (std::size_t k = first; period_.any() && k < first + lane_count; ++k)
    set(x, k, period_.inside(at(x, k)));
}

void SolidModel::add_wall_contact(const VecField& x) {
#pragma omp single
  walls_->prepare(state_.walls, x, particle_count(), state_.time);
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < clusters(); ++c) {
    const std::size_t i = c * lane_count;
    const VecLanes push = walls_->acceleration(state_.walls, x, c, load(inverse_rho_, i));
    store(push, state_.push, i);
    for (int a = 0; a < dim; ++a) store(load(state_.a[a], i) + push[a], state_.a[a], i);
  }
}

double SolidModel::contact_energy() const {
  double sum = bodies_ ? bodies_->energy(state_.bodies) : 0.0;
  if (!walls_) return sum;
  VecField x = X_;
  for (std::size_t c = 0; c < clusters(); ++c) {
    place_in_domain(x, c);
    const Lanes density = walls_->energy_density(state_.walls, x, c);
    for (std::size_t k = c * lane_count; k < std::min((c + 1) * lane_count, particle_count()); ++k)
      sum += body_.volume(state_.number[k]) * density[k - c * lane_count];
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
  for (std::size_t i = 0; i < particle_count(); ++i) sum -= mass(i) * drive_.steady()[i].dot(displacement(i));
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

void SolidModel::record_detached(const RecordDetached& record) {
  record_detached_ = record;
  find_detached();
  accept();
}

void SolidModel::accept() {
  const auto& list = state_.detachment.list;
  if (!record_detached_ || recorded_detached_ == list.size()) return;
  recorded_detached_ = list.size();
  record_detached_(list);
}

void SolidModel::find_detached() {
  if (!detachment_ || state_.time < state_.detachment.next) return;
  const auto scope = timers_.measure("detachment");
  detachment_->record(state_.detachment, positions(), state_.time);
}

/// Positions that are rounded in the last of 53 bits give accelerations, and these velocities of about 1e-16
/// of the sound speed a step; ten thousand times that is no motion yet [J per metre of depth].
double SolidModel::energy_of_rounding() const {
  const double v = 1e-12 * parameters_.fastest_sound();
  return 0.5 * total_mass() * v * v;
}

void SolidModel::watch_bonds() {
  if (!bonds_) bonds_.emplace(body_, parameters_.bonds.value_or(BondLimits{}), stress_edges(parameters_));
}

void SolidModel::end_step() {
  find_detached();
  if (++state_.steps % steps_between_checks != 0) return;
  if (passed_) passed_->check(positions(), state_.time);
  if (!bonds_) return;
  const auto scope = timers_.measure("bonds");
  bonds_->check(state_.bonds, positions(), state_.time);
  if (!walls_)  // the work of moving ones is not known
    state_.energy.warn_of_gain(kinetic_energy(),
                               first_energy_ + interface_work() + state_.work_of_clamps +
                                   state_.work_of_changes - potential_energy(),
                               energy_of_rounding(), state_.time);
}

}  // namespace toryu::solid
