#include "common/sph/skin.hpp"

#include <algorithm>
#include <cmath>

namespace toryu {

namespace {

/// Square root of the largest squared length of `vector(i)` for i below `count`; `lanes(i)` has the vectors
/// from number i on. Compiled without fused products, so that both round alike.
template <class OfLanes, class OfOne>
double largest_length(std::size_t count, OfLanes&& lanes, OfOne&& vector) {
  const std::size_t whole = count / lane_count * lane_count;
  Lanes largest_lanes = 0.0;
  for (std::size_t i = 0; i < whole; i += lane_count) {
    const VecLanes a = lanes(i);
    largest_lanes = max(dot(a, a), largest_lanes);  // what is not a number is passed over, as below
  }
  double largest = largest_of(largest_lanes);
  for (std::size_t i = whole; i < count; ++i) largest = std::max(largest, Vec(vector(i)).squaredNorm());
  return std::sqrt(largest);
}

}  // namespace

double largest_norm(const VecField& v, std::size_t count) {
  return largest_length(
      count, [&](std::size_t i) { return load(v, i); }, [&](std::size_t i) { return at(v, i); });
}

double largest_distance(const VecField& x, const VecField& y, std::size_t count) {
  return largest_length(
      count,
      [&](std::size_t i) {
        VecLanes from = load(x, i);
        const VecLanes to = load(y, i);
        for (int a = 0; a < dim; ++a) from[a] -= to[a];
        return from;
      },
      [&](std::size_t i) { return Vec(at(x, i) - at(y, i)); });
}

}  // namespace toryu
