#include "common/sph/strip_order.hpp"

#include <cmath>

namespace toryu {

std::int64_t StripOrder::strip(double x) const {
  return static_cast<std::int64_t>(std::floor(x / width_));
}

std::vector<std::uint32_t> StripOrder::sort(std::span<const double> x, std::span<const double> y,
                                            std::size_t count) const {
  struct Key {
    std::int64_t strip;
    double along;
    std::uint32_t point;
  };
  std::vector<Key> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [s, along] = place(x[i], y[i]);
    keys[i] = {s, along, static_cast<std::uint32_t>(i)};
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    if (a.strip != b.strip) return a.strip < b.strip;
    if (a.along != b.along) return a.along < b.along;
    return a.point < b.point;
  });
  std::vector<std::uint32_t> order(count);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.point; });
  return order;
}

void StripOrder::index(std::span<const double> x, std::size_t count) {
  strips_.clear();
  for (std::size_t i = 0; i < count; ++i)
    if (const std::int64_t s = strip(x[i]); strips_.empty() || strips_.back().number != s)
      strips_.push_back({s, i});
  strips_.push_back({0, count});
}

std::size_t StripOrder::find(std::span<const double> y, std::size_t first, std::size_t last, double y_0,
                             bool up, bool behind) {
  const auto before = [&](double a) {
    const double ahead = up ? y_0 - a : a - y_0;  // positive where `a` comes before y_0
    return behind ? ahead >= 0 : ahead > 0;
  };
  const auto begin = y.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = y.begin() + static_cast<std::ptrdiff_t>(last);
  return static_cast<std::size_t>(std::partition_point(begin, end, before) - y.begin());
}

}  // namespace toryu
