/// Finds numbered places near another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/scene/box.hpp"

namespace toryu {

static_assert(dim == 2, "cells of the plane");

/// Cells of one side in which places lie. What is beyond the bounds counts to the cells beside it.
class PlaceIndex {
 public:
  PlaceIndex(const Box& bounds, double side) : origin_(bounds.min), side_(side) {
    const Vec cells = (bounds.max - bounds.min) / side;
    columns_ = static_cast<long>(cells[0]) + 1;
    rows_ = static_cast<long>(cells[1]) + 1;
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  }

  void add(const Vec& x, std::uint32_t number) { cells_[cell(column(x[0]), row(x[1]))].push_back(number); }

  /// Calls take(number) for all that may be nearer to `x` than the side of a cell, and more.
  template <class Take>
  void about(const Vec& x, const Take& take) const {
    const long a = column(x[0]), b = row(x[1]);
    for (long r = std::max(b - 1, 0L); r <= std::min(b + 1, rows_ - 1); ++r)
      for (long c = std::max(a - 1, 0L); c <= std::min(a + 1, columns_ - 1); ++c)
        for (const std::uint32_t number : cells_[cell(c, r)]) take(number);
  }

 private:
  long column(double x) const { return at((x - origin_[0]) / side_, columns_); }
  long row(double y) const { return at((y - origin_[1]) / side_, rows_); }
  static long at(double place, long count) {
    return static_cast<long>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
  }
  std::size_t cell(long column, long row) const { return static_cast<std::size_t>(row * columns_ + column); }

  Vec origin_;
  double side_;
  long columns_, rows_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace toryu
