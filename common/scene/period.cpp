#include "common/scene/period.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toryu {

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
    throw BadKey("case.periodic", fmt::format("the domain repeats itself in {} after {:.6g} m, which {}",
                                              "xy"[axis], length, fault));
}

}  // namespace

Period::Period(const Scene& scene) : begin_(scene.domain.min) {
  for (int axis = 0; axis < dim; ++axis) {
    if (!repeats(scene.periodic, axis)) continue;
    length_[axis] = std::max(scene.domain.max[axis] - scene.domain.min[axis], 0.0);
    const Vec move = length_[axis] * Vec::Unit(axis);
    for (std::size_t k = 0, count = shifts_.size(); k < count; ++k)
      for (const double side : {-1.0, 1.0}) shifts_.push_back(shifts_[k] + side * move);
  }
}

Period::Period(const Scene& scene, double spacing, double reach) : Period(scene) {
  for (int axis = 0; axis < dim; ++axis)
    if (repeats(scene.periodic, axis)) check(axis, length_[axis], spacing, reach);
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

std::vector<Vec> with_images(const std::vector<Vec>& points, const std::vector<Vec>& shifts) {
  std::vector<Vec> all;
  for (const Vec& shift : shifts)
    for (const Vec& x : points) all.push_back(x + shift);
  return all;
}

std::vector<Box> with_images(const std::vector<Box>& boxes, const std::vector<Vec>& shifts) {
  std::vector<Box> all;
  for (const Vec& shift : shifts)
    for (const Box& box : boxes) all.push_back(shift.isZero(0) ? box : box.moved(shift));
  return all;
}

std::vector<Box> images_in(const std::vector<Box>& bodies, const std::vector<Box>& holes,
                           const Period& period, double least) {
  std::vector<Box> images = with_images(holes, period.shifts());
  images.erase(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(holes.size()));
  std::erase_if(images, [&](const Box& image) {
    return std::none_of(bodies.begin(), bodies.end(), [&](const Box& body) {
      return (image.max.cwiseMin(body.max) - image.min.cwiseMax(body.min)).minCoeff() > least;
    });
  });
  return images;
}

}  // namespace toryu
