/// The order in which particles are stored: strips of equal width across x, each sorted along y, up one strip
/// and down the next. Any `lane_count` particles in a row are then close together, which is what makes lanes
/// work.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/vector.hpp"

namespace toryu {

static_assert(dim == 2, "strips lie side by side in a plane; in space they would be columns");

class StripOrder {
 public:
  /// `width` [m] of a strip: sqrt(lane_count) times the particle spacing gives compact clusters.
  explicit StripOrder(double width) : width_(width) {}

  /// The order of the first `count` points of x and y: `order[k]` is the point that comes k-th. Ties keep
  /// their order, so the result depends on nothing but the points.
  std::vector<std::uint32_t> sort(std::span<const double> x, std::span<const double> y,
                                  std::size_t count) const;

  /// Notes where each strip begins in points that are stored in this order.
  void index(std::span<const double> x, std::size_t count);

  /// Calls visit(first, last) for ranges of stored points that hold all points of the box [m] (and some
  /// beyond it in x), strip by strip. Needs `index` for the present order.
  template <class Visit>
  void in_box(std::span<const double> y, double x_min, double x_max, double y_min, double y_max,
              Visit&& visit) const {
    const auto count = static_cast<std::int64_t>(starts_.size()) - 1;
    const auto first = std::max<std::int64_t>(strip(x_min) - first_strip_, 0);
    const auto last = std::min<std::int64_t>(strip(x_max) - first_strip_, count - 1);
    for (auto s = first; s <= last; ++s) {
      const bool up = (s + first_strip_) % 2 == 0;
      const std::size_t begin = find(y, starts_[s], starts_[s + 1], up ? y_min : y_max, up, false);
      const std::size_t end = find(y, begin, starts_[s + 1], up ? y_max : y_min, up, true);
      if (begin < end) visit(begin, end);
    }
  }

 private:
  std::int64_t strip(double x) const;
  /// First point of a strip's range that does not come before (or, `behind`, that comes behind) y_0.
  static std::size_t find(std::span<const double> y, std::size_t first, std::size_t last, double y_0, bool up,
                          bool behind);

  double width_;
  std::int64_t first_strip_ = 0;
  std::vector<std::uint32_t> starts_;  ///< one more than there are strips
};

}  // namespace toryu
