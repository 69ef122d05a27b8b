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

double ExchangeAudit::compare(const InterfaceLoad& of_fluid, const InterfaceLoad& applied,
                              const Vec& impulse_taken, double dt) {
  const Vec impulse_of_fluid = dt * (sum_of(of_fluid.force) + sum_of(of_fluid.friction_force));
  const Vec impulse_applied = dt * (sum_of(applied.force) + sum_of(applied.friction_force));
  const double scale_of_fluid =
      dt * (sum_of_lengths(of_fluid.force) + sum_of_lengths(of_fluid.friction_force));
  const double scale_applied = dt * (sum_of_lengths(applied.force) + sum_of_lengths(applied.friction_force));
  const double error = std::max(relative(impulse_of_fluid + of_fluid.impulse_on_fluid, scale_of_fluid),
                                relative(impulse_applied - impulse_taken, scale_applied));
  state_.largest = std::max(state_.largest, error);
  return error;
}

}  // namespace toryu::coupling
