#include "fluid_solver/energy_balance.hpp"

namespace toryu::fluid {

void EnergyBalance::add(double time, const std::vector<Power>& powers) {
  std::vector<double> now;
  now.reserve(powers.size());
  for (const Power& power : powers) now.push_back(power.value);
  const std::vector<double>& before = state_.power ? *state_.power : now;
  for (std::size_t n = 0; n < now.size(); ++n)
    state_.energy[n] += 0.5 * (before[n] + now[n]) * (time - state_.time);
  state_.power = std::move(now);
  state_.time = time;
}

double EnergyBalance::taken(Taken kind, double time) const {
  double sum = 0;
  for (std::size_t n = 0; n < terms_.size(); ++n)
    if (terms_[n].taken == kind) sum += taken_by(n, time);
  return sum;
}

std::vector<Observation> EnergyBalance::observe(double gained, double time, const std::string& unit) const {
  const double stored = taken(Taken::stored, time), dissipated = taken(Taken::dissipated, time);
  std::vector<Observation> row{{"dissipated_energy", unit, -gained - stored}};
  for (std::size_t n = 0; n < terms_.size(); ++n) {
    const std::string verb = terms_[n].taken == Taken::stored ? "stored_by_" : "dissipated_by_";
    row.push_back({verb + terms_[n].term, unit, taken_by(n, time)});
  }
  row.push_back({"energy_remainder", unit, gained + stored + dissipated});
  return row;
}

}  // namespace toryu::fluid
