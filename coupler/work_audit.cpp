#include "coupler/work_audit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
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

}  // namespace

void WorkAudit::note(const InterfaceLoad& given, const std::vector<double>& fluid, const InterfaceLoad& taken,
                     const std::vector<double>& solid, double kinetic_energy) {
  given_ += work(given, fluid_, fluid);
  taken_ += work(taken, solid_, solid);
  largest_given_ = std::max(largest_given_, std::abs(given_));
  largest_kinetic_energy_ = std::max(largest_kinetic_energy_, kinetic_energy);
  if (std::has_single_bit(++windows_)) made_before_ = std::exchange(made_at_power_of_two_, made());
  const bool suspicious = made() > std::max({bearable_share * largest_given_, largest_kinetic_energy_,
                                             least_growth * made_before_});
  suspicious_ = suspicious ? suspicious_ + 1 : 0;
  fluid_ = fluid;
  solid_ = solid;
}

}  // namespace toryu::coupling
