/// SIMD lanes: as many particles as fit one register of the processor that the build aims at. A pair loop
/// holds `lane_count` particles i in lanes and meets one particle j at a time, so that there are no gathers,
/// no sums across lanes and no races, and each particle's sum has a fixed order whatever the number of
/// threads.
#pragma once

#include <cstddef>
#include <experimental/simd>
#include <new>
#include <vector>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace toryu {

namespace stdx = std::experimental;

using Lanes = stdx::native_simd<double>;
inline constexpr std::size_t lane_count = Lanes::size();

/// Allocates on the boundary that aligned loads of lanes need.
template <class T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  LaneAllocator() = default;
  template <class U>
  LaneAllocator(const LaneAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* pointer, std::size_t) { ::operator delete(pointer, alignment); }
  bool operator==(const LaneAllocator&) const { return true; }
};

/// One value a particle, padded to whole lanes.
using Field = std::vector<double, LaneAllocator<double>>;

inline Lanes load(const double* first) {
  return Lanes(first, stdx::vector_aligned);
}
inline Lanes load(const Field& field, std::size_t first) {
  return load(field.data() + first);
}
inline void store(const Lanes& value, double* first) {
  value.copy_to(first, stdx::vector_aligned);
}
inline void store(const Lanes& value, Field& field, std::size_t first) {
  store(value, field.data() + first);
}

/// Smallest multiple of the lane count that holds `count` particles.
constexpr std::size_t padded(std::size_t count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

inline Lanes positive_part(const Lanes& a) {
  return stdx::max(a, Lanes(0.0));
}
inline Lanes negative_part(const Lanes& a) {
  return stdx::min(a, Lanes(0.0));
}

/// 1/sqrt(a) to within two units in the last place: the hardware's estimate and two Newton steps, which cost
/// a fraction of a division and a square root.
inline Lanes inverse_sqrt(const Lanes& a) {
#if defined(__AVX512F__)
  Lanes y(_mm512_maskz_rsqrt14_pd(0xff, static_cast<__m512d>(a)));
  const Lanes half_a = 0.5 * a;
  y = y * (1.5 - half_a * y * y);
  return y * (1.5 - half_a * y * y);
#else
  return 1.0 / stdx::sqrt(a);
#endif
}

/// sqrt(a) likewise, exactly 0 for a = 0.
inline Lanes square_root(const Lanes& a) {
  return a * inverse_sqrt(stdx::max(a, Lanes(1e-300)));
}

/// 1/a, likewise.
inline Lanes inverse(const Lanes& a) {
#if defined(__AVX512F__)
  Lanes y(_mm512_maskz_rcp14_pd(0xff, static_cast<__m512d>(a)));
  y = y * (2.0 - a * y);
  return y * (2.0 - a * y);
#else
  return 1.0 / a;
#endif
}

}  // namespace toryu
