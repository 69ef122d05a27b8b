/// The order in which particles are stored: strips of equal width across x, each sorted along y, up one strip
/// and down the next. Any `lane_count` particles in a row are then close together, which is what makes lanes
/// work.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
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

  /// Where a point belongs: the strip, and how far along it [m].
  std::pair<std::int64_t, double> place(double x, double y) const {
    const std::int64_t s = strip(x);
    return {s, s % 2 == 0 ? y : -y};  // y up the even strips, -y up the odd ones
  }

  /// Notes where each strip begins in points that are stored in this order.
  void index(std::span<const double> x, std::size_t count);

  /// Calls visit(first, last) for ranges of stored points that hold all points of the box [m] (and some
  /// beyond it in x), strip by strip. Needs `index` for the present order.
  template <class Visit>
  void in_box(std::span<const double> y, double x_min, double x_max, double y_min, double y_max,
              Visit&& visit) const {
    const std::int64_t last = strip(x_max);
    const auto first = std::partition_point(strips_.begin(), strips_.end() - 1,
                                            [&, s = strip(x_min)](const Strip& a) { return a.number < s; });
    for (auto here = first; here != strips_.end() - 1 && here->number <= last; ++here) {
      const bool up = here->number % 2 == 0;
      const std::size_t strip_end = (here + 1)->begin;
      const std::size_t begin = find(y, here->begin, strip_end, up ? y_min : y_max, up, false);
      const std::size_t end = find(y, begin, strip_end, up ? y_max : y_min, up, true);
      if (begin < end) visit(begin, end);
    }
  }

 private:
  std::int64_t strip(double x) const;
  /// First point of a strip's range that does not come before (or, `behind`, that comes behind) y_0.
  static std::size_t find(std::span<const double> y, std::size_t first, std::size_t last, double y_0, bool up,
                          bool behind);

  struct Strip {
    std::int64_t number;
    std::size_t begin;  ///< its first point
  };
  double width_;
  std::vector<Strip> strips_{{0, 0}};  ///< those that hold points, and one behind them
};

}  // namespace toryu
