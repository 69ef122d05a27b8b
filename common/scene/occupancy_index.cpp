#include "common/scene/occupancy_index.hpp"

#include <cmath>

namespace toryu {

OccupancyIndex::Cell OccupancyIndex::cell_of(const Vec& x) const {
  const auto index = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / distance_));
  };
  return {index(x[0]), index(x[1])};
}

const OccupancyIndex::Taken* OccupancyIndex::near(const Vec& x) const {
  const auto [column, row] = cell_of(x);
  for (auto c = column - 1; c <= column + 1; ++c)
    for (auto r = row - 1; r <= row + 1; ++r) {
      const auto [first, last] = taken_.equal_range({c, r});
      for (auto it = first; it != last; ++it)
        if ((it->second.place - x).norm() < distance_) return &it->second;
    }
  return nullptr;
}

std::optional<Overlap> OccupancyIndex::take(const std::vector<Vec>& points, const std::string& body) {
  for (const Vec& x : points)
    if (const Taken* other = near(x)) return Overlap{x, bodies_[other->body]};
  bodies_.push_back(body);
  for (const Vec& x : points) taken_.emplace(cell_of(x), Taken{x, bodies_.size() - 1});
  return {};
}

}  // namespace toryu
