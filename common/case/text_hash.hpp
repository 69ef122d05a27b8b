/// A hash of texts: FNV-1a (Fowler, Noll, Vo), the same on every machine.
#pragma once

#include <cstdint>
#include <string_view>

namespace toryu {

class TextHash {
 public:
  void add(std::string_view text) {
    for (const char c : text) mix(static_cast<unsigned char>(c));
    mix(0xffu);  // no UTF-8 text holds this byte: it ends a text
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t byte) { value_ = (value_ ^ byte) * 1099511628211u; }
  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace toryu
