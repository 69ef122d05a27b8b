#include "solid_solver/mixed_solid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solid_solver/rigid/meeting_bodies.hpp"

namespace toryu::solid {

namespace {

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

/// The share of values that lie one after the other, particle by particle; empty stays empty.
std::vector<double> slice(const std::vector<double>& values, std::size_t begin, std::size_t end,
                          std::size_t components) {
  if (values.empty()) return {};
  const auto at = [&](std::size_t particle) {
    return values.begin() + static_cast<std::ptrdiff_t>(components * particle);
  };
  return {at(begin), at(end)};
}

InterfaceLoad slice(const InterfaceLoad& load, std::size_t begin, std::size_t end) {
  InterfaceLoad share;
  share.pressure = slice(load.pressure, begin, end, 1);
  share.force = slice(load.force, begin, end, dim);
  share.friction_force = slice(load.friction_force, begin, end, dim);
  share.impedance = slice(load.impedance, begin, end, dim);
  share.velocity = slice(load.velocity, begin, end, dim);
  return share;
}

}  // namespace

MixedSolid::MixedSolid(std::unique_ptr<SolidModel> elastic, std::unique_ptr<SolidModel> rigid)
    : parts_{std::move(elastic), std::move(rigid)} {}

std::size_t MixedSolid::particle_count() const {
  return elastic().particle_count() + rigid().particle_count();
}

void MixedSolid::advance(double dt) {
  constexpr std::array names{"elastic part", "rigid part"};
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const auto scope = timers_.measure(names[n]);
    parts_[n]->advance(dt);
  }
}

void MixedSolid::save() {
  for (auto& part : parts_) part->save();
}

void MixedSolid::restore() {
  for (auto& part : parts_) part->restore();
}

void MixedSolid::accept() {
  for (auto& part : parts_) part->accept();
}

void MixedSolid::write_state(std::ostream& stream) const {
  for (const auto& part : parts_) part->write_state(stream);
}

void MixedSolid::read_state(std::istream& stream) {
  for (auto& part : parts_) part->read_state(stream);
}

void MixedSolid::check(double time) const {
  for (const auto& part : parts_) part->check(time);
  std::vector<Vec> x;
  std::vector<std::uint32_t> part_of;
  for (std::uint32_t n = 0; n < parts_.size(); ++n)
    for (std::size_t i = 0; i < parts_[n]->particle_count(); ++i) {
      x.push_back(parts_[n]->body().X[i] + parts_[n]->displacement(i));
      part_of.push_back(n);
    }
  const double nearest = least_gap * elastic().body().spacing;
  const auto met = meeting_particles(x, part_of, nearest);
  if (!met) return;
  const auto [i, j] = std::minmax(met->first, met->second);
  throw PhysicsFailure("solid", i, time,
                       fmt::format("distance of '{}' and '{}'", elastic().region_of(i),
                                   rigid().region_of(j - elastic().particle_count())),
                       fmt::format("{:.4g} m", (x[i] - x[j]).norm()),
                       fmt::format("above {:.4g} m: rigid bodies do not push elastic ones", nearest));
}

Frame MixedSolid::frame() const {
  Frame frame = elastic().frame();
  const Frame of_rigid = rigid().frame();
  append(frame.positions, of_rigid.positions);
  for (FrameField& field : frame.fields) {
    const auto same = std::find_if(of_rigid.fields.begin(), of_rigid.fields.end(),
                                   [&](const FrameField& other) { return other.name == field.name; });
    if (same != of_rigid.fields.end())
      append(field.values, same->values);
    else
      field.values.resize(static_cast<std::size_t>(field.components) * particle_count(), 0.0);
  }
  FrameField is_rigid{"rigid", "1", "1 where the particle is of a rigid body, which has no stress", 1, {}};
  is_rigid.values.resize(elastic().particle_count(), 0.0);
  is_rigid.values.resize(particle_count(), 1.0);
  frame.fields.push_back(std::move(is_rigid));
  return frame;
}

std::vector<Observation> MixedSolid::observe() const {
  std::vector<Observation> row = elastic().places(), sums = elastic().balance();
  for (Observation& place : rigid().places()) row.push_back(std::move(place));
  for (Observation& own : rigid().balance()) {
    const auto same =
        std::find_if(sums.begin(), sums.end(), [&](const Observation& sum) { return sum.name == own.name; });
    if (same == sums.end())
      sums.push_back(std::move(own));
    else
      same->value += own.value;
  }
  row.insert(row.end(), sums.begin(), sums.end());
  return row;
}

std::vector<ActiveTerm> MixedSolid::active_terms() const {
  std::vector<ActiveTerm> terms = elastic().active_terms();
  for (ActiveTerm& own : rigid().active_terms()) {
    const bool told = std::any_of(terms.begin(), terms.end(), [&](const ActiveTerm& term) {
      return term.name == own.name && term.parameters == own.parameters;
    });
    if (!told) terms.push_back(std::move(own));
  }
  return terms;
}

std::size_t MixedSolid::count_of_elastic(const std::vector<std::uint32_t>& particles) const {
  const auto end = std::partition_point(particles.begin(), particles.end(),
                                        [&](std::uint32_t i) { return i < elastic().particle_count(); });
  return static_cast<std::size_t>(end - particles.begin());
}

std::array<std::vector<std::uint32_t>, 2> MixedSolid::shares(
    const std::vector<std::uint32_t>& particles) const {
  const auto middle = particles.begin() + static_cast<std::ptrdiff_t>(count_of_elastic(particles));
  std::array<std::vector<std::uint32_t>, 2> shares{std::vector(particles.begin(), middle),
                                                   std::vector(middle, particles.end())};
  for (std::uint32_t& i : shares[1]) i -= static_cast<std::uint32_t>(elastic().particle_count());
  return shares;
}

Interface MixedSolid::interface(double reach) const {
  Interface both = elastic().interface(reach);
  const Interface more = rigid().interface(reach);
  for (const auto i : more.id) both.id.push_back(i + static_cast<std::uint32_t>(elastic().particle_count()));
  append(both.position, more.position);
  append(both.volume, more.volume);
  append(both.area_vector, more.area_vector);
  append(both.mass, more.mass);
  return both;
}

InterfaceMotion MixedSolid::motion(const std::vector<std::uint32_t>& particles) const {
  const auto of_part = shares(particles);
  InterfaceMotion both = elastic().motion(of_part[0]);
  const InterfaceMotion more = rigid().motion(of_part[1]);
  append(both.position, more.position);
  append(both.velocity, more.velocity);
  return both;
}

Vec MixedSolid::set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load) {
  const std::size_t middle = count_of_elastic(particles);
  const auto of_part = shares(particles);
  return parts_[0]->set_interface_load(of_part[0], slice(load, 0, middle)) +
         parts_[1]->set_interface_load(of_part[1], slice(load, middle, particles.size()));
}

std::vector<double> MixedSolid::excess_impulse() const {
  std::vector<double> impulse = elastic().excess_impulse();
  append(impulse, rigid().excess_impulse());
  return impulse;
}

double MixedSolid::work_of_excess_impulse() const {
  return elastic().work_of_excess_impulse() + rigid().work_of_excess_impulse();
}

Health MixedSolid::health() const {
  Health sum = elastic().health();
  const Health more = rigid().health();
  sum.kinetic_energy += more.kinetic_energy;
  sum.potential_energy += more.potential_energy;
  sum.momentum += more.momentum;
  return sum;
}

}  // namespace toryu::solid
