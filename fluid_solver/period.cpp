#include "fluid_solver/period.hpp"

#include <fmt/format.h>

#include <cmath>

namespace toryu::fluid {

namespace {

bool repeats(Periodic periodic, int axis) {
  return periodic == Periodic::xy || periodic == (axis == 0 ? Periodic::x : Periodic::y);
}

void check(int axis, double length, double spacing, double reach) {
  const double columns = length / spacing;
  std::string fault;
  if (std::abs(columns - std::round(columns)) > 1e-6)
    fault = fmt::format("is {:.6g} spacings; it must be a whole number of them", columns);
  else if (length < 2 * reach)
    fault = fmt::format("is shorter than {:.6g} m, twice the reach of the neighbour lists", 2 * reach);
  if (!fault.empty())
    throw BadInput({{"case.periodic", 0, 0,
                     fmt::format("the domain repeats itself in {} after {:.6g} m, which {}", "xy"[axis],
                                 length, fault)}});
}

}  // namespace

Period::Period(const Scene& scene, double spacing, double reach)
    : begin_(scene.domain.min), shifts_{Vec::Zero()} {
  for (int axis = 0; axis < dim; ++axis) {
    if (!repeats(scene.periodic, axis)) continue;
    length_[axis] = scene.domain.max[axis] - scene.domain.min[axis];
    check(axis, length_[axis], spacing, reach);
    const Vec move = length_[axis] * Vec::Unit(axis);
    for (std::size_t k = 0, count = shifts_.size(); k < count; ++k)
      for (const double side : {-1.0, 1.0}) shifts_.push_back(shifts_[k] + side * move);
  }
}

Vec Period::back_into_domain(const Vec& x) const {
  Vec move = Vec::Zero();
  for (int axis = 0; axis < dim; ++axis)
    if (length_[axis] > 0) move[axis] = -length_[axis] * std::floor((x[axis] - begin_[axis]) / length_[axis]);
  return move;
}

Vec Period::shortest(const Vec& x_ij) const {
  Vec nearest = x_ij;
  for (int axis = 0; axis < dim; ++axis)
    if (length_[axis] > 0) nearest[axis] -= length_[axis] * std::round(x_ij[axis] / length_[axis]);
  return nearest;
}

}  // namespace toryu::fluid
