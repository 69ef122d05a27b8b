/// A sum that has the same bits in whatever order, and by however many threads and processes, its parts are
/// added.
#pragma once

#include <cmath>
#include <limits>

namespace toryu {

/// In whole multiples of 2^-90, at which parts are cut: exact for parts that have 53 bits above it, as those
/// of 2^-37 = 7e-12 and more. Parts and sums on the way are below 2^37 = 1.4e11, or the sum is not a number.
class ExactSum {
 public:
  void add(double part) {
    if (std::abs(part) < limit)
      add(static_cast<Whole>(part * scale));
    else
      lost_ = true;
  }
  void add(const ExactSum& other) {
    add(other.whole_);
    lost_ |= other.lost_;
  }
  double value() const {
    return lost_ ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(whole_) / scale;
  }

 private:
  __extension__ using Whole = __int128;
  void add(Whole part) { lost_ |= __builtin_add_overflow(whole_, part, &whole_); }
  static constexpr double scale = 0x1p90, limit = 0x1p37;
  Whole whole_ = 0;
  bool lost_ = false;
};

}  // namespace toryu
