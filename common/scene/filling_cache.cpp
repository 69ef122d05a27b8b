#include "common/scene/filling_cache.hpp"

#include <fmt/format.h>

#include <charconv>

#include "common/case/text_hash.hpp"
#include "common/case/user_cache.hpp"
#include "common/sph/lanes.hpp"

namespace toryu {

namespace {

/// To be raised when outlines are filled in another way.
constexpr int version = 1;
#ifdef NDEBUG
constexpr const char* build = "release";
#else
constexpr const char* build = "debug";
#endif

/// Reads numbers one after the other.
class Numbers {
 public:
  explicit Numbers(const std::string& text) : at_(text.data()), end_(at_ + text.size()) {}
  std::optional<double> next() {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\n')) ++at_;
    double value = 0;
    const auto [rest, error] = std::from_chars(at_, end_, value);
    if (error != std::errc()) return std::nullopt;
    at_ = rest;
    return value;
  }

 private:
  const char *at_, *end_;
};

}  // namespace

std::filesystem::path cached_filling(const Outline& outline, double spacing) {
  TextHash hash;
  hash.add(fmt::format("{} {} {} {} {}", version, __VERSION__, build, lane_count, spacing));
  for (const auto& ring : outline.rings()) {
    hash.add("ring");
    for (const Vec& corner : ring) hash.add(fmt::format("{} {}", corner[0], corner[1]));
  }
  return cached_file(fmt::format("filling_{:016x}.txt", hash.value()));
}

std::optional<FittedFilling> read_filling(const std::filesystem::path& file) {
  const auto text = read_cached(file);
  if (!text) return std::nullopt;
  Numbers numbers(*text);
  FittedFilling filling;
  const auto count = numbers.next(), volume = numbers.next(), rounds = numbers.next(),
             spread = numbers.next();
  if (!spread) return std::nullopt;
  filling.volume = *volume;
  filling.rounds = static_cast<int>(*rounds);
  filling.spread = *spread;
  while (static_cast<double>(filling.points.size()) < *count) {
    const auto x = numbers.next(), y = numbers.next();
    if (!y) return std::nullopt;
    filling.points.emplace_back(*x, *y);
  }
  return filling;
}

void keep_filling(const FittedFilling& filling, const std::filesystem::path& file) {
  std::string text =
      fmt::format("{} {} {} {}\n", filling.points.size(), filling.volume, filling.rounds, filling.spread);
  for (const Vec& x : filling.points) text += fmt::format("{} {}\n", x[0], x[1]);
  keep_cached(file, text);
}

}  // namespace toryu
