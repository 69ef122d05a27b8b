/// Points in storage order, with an index to find those near a place.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sph/points.hpp"
#include "common/sph/strip_order.hpp"

namespace toryu {

static_assert(dim == 2, "points are sorted into strips of the plane");

class SortedPoints {
 public:
  /// `reach` [m] is about how far `near` will look.
  SortedPoints(const std::vector<Vec>& points, double reach) : strips_(reach) {
    resize(sorted_, points.size());
    for (std::size_t k = 0; k < points.size(); ++k) set(sorted_, k, points[k]);
    order_ = strips_.sort(sorted_[0], sorted_[1], points.size());
    for (std::size_t k = 0; k < points.size(); ++k) set(sorted_, k, points[order_[k]]);
    strips_.index(sorted_[0], points.size());
  }

  /// Calls visit(j) for the numbers of all points nearer than `reach` [m] to `point`.
  template <class Visit>
  void near(const Vec& point, double reach, Visit&& visit) const {
    strips_.in_box(sorted_[1], point[0] - reach, point[0] + reach, point[1] - reach, point[1] + reach,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t k = begin; k < end; ++k)
                       if ((at(sorted_, k) - point).squaredNorm() < reach * reach) visit(order_[k]);
                   });
  }

 private:
  StripOrder strips_;
  std::vector<std::uint32_t> order_;
  VecField sorted_;
};

}  // namespace toryu
