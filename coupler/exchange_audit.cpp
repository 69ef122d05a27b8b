#include "coupler/exchange_audit.hpp"

#include <algorithm>
#include <limits>

namespace toryu::coupling {

namespace {

double relative(const Vec& difference, double scale) {
  if (difference.isZero(0)) return 0;
  return scale > 0 ? difference.norm() / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

Vec sum_of(const std::vector<double>& vectors) {
  Vec sum = Vec::Zero();
  for (std::size_t k = 0; k + dim <= vectors.size(); k += dim) sum += Eigen::Map<const Vec>(&vectors[k]);
  return sum;
}

double sum_of_lengths(const std::vector<double>& vectors) {
  double sum = 0;
  for (std::size_t k = 0; k + dim <= vectors.size(); k += dim)
    sum += Eigen::Map<const Vec>(&vectors[k]).norm();
  return sum;
}

double ExchangeAudit::compare(const InterfaceLoad& of_fluid, const std::vector<double>& returned,
                              const InterfaceLoad& applied, const std::vector<double>& excess,
                              const Vec& impulse_taken, double dt) {
  const auto impulse = [dt](const InterfaceLoad& load, const std::vector<double>& more) {
    return Vec(dt * (sum_of(load.force) + sum_of(load.friction_force)) + sum_of(more));
  };
  const auto scale = [dt](const InterfaceLoad& load, const std::vector<double>& more) {
    return dt * (sum_of_lengths(load.force) + sum_of_lengths(load.friction_force)) + sum_of_lengths(more);
  };
  const Vec impulse_of_fluid = impulse(of_fluid, returned), impulse_applied = impulse(applied, excess);
  const double scale_of_fluid = scale(of_fluid, returned), scale_applied = scale(applied, excess);
  const double error = std::max(relative(impulse_of_fluid + of_fluid.impulse_on_fluid, scale_of_fluid),
                                relative(impulse_applied - impulse_taken, scale_applied));
  state_.largest = std::max(state_.largest, error);
  return error;
}

}  // namespace toryu::coupling
