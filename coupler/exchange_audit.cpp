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

double ExchangeAudit::compare(const InterfaceLoad& given, const InterfaceLoad& felt, const Vec& impulse_taken,
                              double dt) {
  const Vec impulse_given = dt * (sum_of(given.force) + sum_of(given.friction_force));
  const Vec impulse_felt = dt * (sum_of(felt.force) + sum_of(felt.friction_force));
  const double scale_given = dt * (sum_of_lengths(given.force) + sum_of_lengths(given.friction_force));
  const double scale_felt = dt * (sum_of_lengths(felt.force) + sum_of_lengths(felt.friction_force));
  const double error = std::max(relative(impulse_given + given.impulse_on_fluid, scale_given),
                                relative(impulse_felt - impulse_taken, scale_felt));
  largest_ = std::max(largest_, error);
  return error;
}

}  // namespace toryu::coupling
