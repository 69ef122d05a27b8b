#include "coupler/work_audit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace toryu::coupling {

namespace {

/// Sum over the particles of force times the way from `from` to `to` [J/m].
double work(const InterfaceLoad& load, const std::vector<double>& from, const std::vector<double>& to) {
  double sum = 0;
  for (const auto* force : {&load.force, &load.friction_force})
    for (std::size_t k = 0; k < force->size(); ++k) sum += (*force)[k] * (to[k] - from[k]);
  return sum;
}

/// What the positions' rounding alone can make of it [J/m].
double rounding_of_work(const InterfaceLoad& load, const std::vector<double>& position) {
  double sum = 0;
  for (const auto* force : {&load.force, &load.friction_force})
    for (std::size_t k = 0; k < force->size(); ++k) sum += std::abs((*force)[k] * position[k]);
  return std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace

void WorkAudit::note(const InterfaceLoad& sent, const std::vector<double>& interface_start,
                     const std::vector<double>& interface_position, const InterfaceLoad& applied,
                     const InterfaceMotion& solid, double kinetic_energy) {
  State& s = state_;
  s.given += work(sent, interface_start.empty() ? s.fluid : interface_start, interface_position);
  s.given -= sent.work_of_impulse;
  s.taken += work(applied, s.solid, solid.position) + solid.work_of_impulse;
  s.rounding += rounding_of_work(sent, interface_position) + rounding_of_work(applied, solid.position);
  s.largest_given = std::max(s.largest_given, std::abs(s.given));
  s.largest_kinetic_energy = std::max(s.largest_kinetic_energy, kinetic_energy);
  if (std::has_single_bit(++s.windows)) s.made_before = std::exchange(s.made_at_power_of_two, made());
  const bool suspicious = made() > std::max({bearable_share * s.largest_given, s.largest_kinetic_energy,
                                             least_growth * s.made_before, s.rounding});
  s.suspicious = suspicious ? s.suspicious + 1 : 0;
  s.fluid = interface_position;
  s.solid = solid.position;
}

void WorkAudit::note_energies(double of_solid, double of_fluid) {
  State& s = state_;
  if (s.windows <= 1) s.first_energy = of_solid;
  s.largest_energy_change = std::max(s.largest_energy_change, std::abs(of_solid - s.first_energy));
  s.largest_fluid_energy = std::max(s.largest_fluid_energy, of_fluid);
}

}  // namespace toryu::coupling
