/// Finds particles that would be placed twice.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/vector.hpp"

namespace toryu {

static_assert(dim == 2, "cells of the plane");

struct Overlap {
  Vec place;         ///< of the particle that is too near to another [m]
  std::string with;  ///< the body that was there first
};

class OccupancyIndex {
 public:
  /// Particles of two bodies must be `distance` [m] apart.
  explicit OccupancyIndex(double distance) : distance_(distance) {}

  /// The first of the points that is too near to a body that came before, if any. Takes the points for
  /// `body`.
  std::optional<Overlap> take(const std::vector<Vec>& points, const std::string& body);
  /// Whether `x` is too near to a point that was taken.
  bool taken(const Vec& x) const { return near(x) != nullptr; }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(cell.first) * 0x9e3779b97f4a7c15u ^
             static_cast<std::size_t>(cell.second);
    }
  };
  struct Taken {
    Vec place;
    std::size_t body;
  };
  Cell cell_of(const Vec& x) const;
  const Taken* near(const Vec& x) const;

  double distance_;
  std::unordered_multimap<Cell, Taken, Hash> taken_;
  std::vector<std::string> bodies_;
};

}  // namespace toryu
