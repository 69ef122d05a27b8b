/// SIMD lanes: as many particles as fit one register of the processor that the build aims at. A pair loop
/// holds `lane_count` particles i in lanes and meets one particle j at a time, so that there are no gathers,
/// no sums across lanes and no races, and each particle's sum has a fixed order whatever the number of
/// threads.
///
/// The type is the compiler's own vector with every call forced inline: std::experimental::simd of GCC 12
/// leaves broadcasts and maxima as calls in loops of this size, which took 1.7 times as long.
#pragma once

#include <cmath>
#include <cstddef>
#include <new>
#include <vector>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#if defined(__OPTIMIZE__)
#define TORYU_INLINE [[gnu::always_inline]] inline
/// The same behind the parameters of a lambda.
#define TORYU_INLINE_LAMBDA __attribute__((always_inline))
#else
// Without optimisation it wins nothing, and takes four times as long to compile under the sanitizers.
#define TORYU_INLINE inline
#define TORYU_INLINE_LAMBDA
#endif

namespace toryu {

#if defined(__AVX512F__)
inline constexpr std::size_t lane_count = 8;
#elif defined(__AVX__)
inline constexpr std::size_t lane_count = 4;
#else
inline constexpr std::size_t lane_count = 2;
#endif

/// One number a lane. Arithmetic and comparisons work lane by lane; a plain number stands for itself in each
/// lane.
struct Lanes {
  using Vector [[gnu::vector_size(lane_count * sizeof(double))]] = double;
  using Mask [[gnu::vector_size(lane_count * sizeof(double))]] = long long;

  Lanes() = default;
  TORYU_INLINE Lanes(double number) : value(number - Vector{}) {}
  TORYU_INLINE explicit Lanes(Vector vector) : value(vector) {}

  TORYU_INLINE double operator[](std::size_t lane) const { return value[lane]; }

  TORYU_INLINE friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.value + b.value); }
  TORYU_INLINE friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.value - b.value); }
  TORYU_INLINE friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.value * b.value); }
  TORYU_INLINE friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.value / b.value); }
  TORYU_INLINE friend Lanes operator-(Lanes a) { return Lanes(-a.value); }
  TORYU_INLINE Lanes& operator+=(Lanes b) { return *this = *this + b; }
  TORYU_INLINE Lanes& operator-=(Lanes b) { return *this = *this - b; }
  TORYU_INLINE Lanes& operator*=(Lanes b) { return *this = *this * b; }

  TORYU_INLINE friend Mask operator<(Lanes a, Lanes b) { return a.value < b.value; }
  TORYU_INLINE friend Mask operator>(Lanes a, Lanes b) { return a.value > b.value; }
  TORYU_INLINE friend Mask operator<=(Lanes a, Lanes b) { return a.value <= b.value; }
  TORYU_INLINE friend Mask operator>=(Lanes a, Lanes b) { return a.value >= b.value; }

  Vector value;
};

/// `a` in the lanes where the mask holds, `b` in the others.
TORYU_INLINE Lanes select(Lanes::Mask mask, Lanes a, Lanes b) {
  return Lanes(mask ? a.value : b.value);
}
TORYU_INLINE Lanes max(Lanes a, Lanes b) {
#if defined(__AVX512F__)
  // the same, which GCC 12 makes a comparison and a blend of
  return Lanes(static_cast<Lanes::Vector>(
      _mm512_maskz_max_pd(0xff, static_cast<__m512d>(a.value), static_cast<__m512d>(b.value))));
#else
  return Lanes(a.value > b.value ? a.value : b.value);
#endif
}
TORYU_INLINE Lanes min(Lanes a, Lanes b) {
#if defined(__AVX512F__)
  return Lanes(static_cast<Lanes::Vector>(
      _mm512_maskz_min_pd(0xff, static_cast<__m512d>(a.value), static_cast<__m512d>(b.value))));
#else
  return Lanes(a.value < b.value ? a.value : b.value);
#endif
}
TORYU_INLINE Lanes positive_part(Lanes a) {
  return max(a, 0.0);
}
TORYU_INLINE Lanes negative_part(Lanes a) {
  return min(a, 0.0);
}

TORYU_INLINE bool any_of(Lanes::Mask mask) {
  long long any = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) any |= mask[lane];
  return any != 0;
}
TORYU_INLINE bool all_of(Lanes::Mask mask) {
  long long all = -1;
  for (std::size_t lane = 0; lane < lane_count; ++lane) all &= mask[lane];
  return all != 0;
}
TORYU_INLINE double sum_of(Lanes a) {
  double sum = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) sum += a[lane];
  return sum;
}
TORYU_INLINE double largest_of(Lanes a) {
  double largest = a[0];
  for (std::size_t lane = 1; lane < lane_count; ++lane) largest = a[lane] > largest ? a[lane] : largest;
  return largest;
}
TORYU_INLINE double smallest_of(Lanes a) {
  return -largest_of(-a);
}

/// c - a b, rounded once where the processor can. Left to itself the compiler fuses it in one loop and not in
/// another, and both sides of a pair must find the same.
TORYU_INLINE Lanes less_product(Lanes c, Lanes a, Lanes b) {
#if defined(__AVX512F__)
  return Lanes(static_cast<Lanes::Vector>(_mm512_fnmadd_pd(
      static_cast<__m512d>(a.value), static_cast<__m512d>(b.value), static_cast<__m512d>(c.value))));
#else
  return c - a * b;
#endif
}
TORYU_INLINE double less_product(double c, double a, double b) {
  return c - a * b;
}

/// 1/sqrt(a) to within two units in the last place: the hardware's estimate and two Newton steps, which cost
/// a fraction of a division and a square root. Where there is no such estimate, as written.
TORYU_INLINE Lanes inverse_sqrt(Lanes a) {
#if defined(__AVX512F__)
  Lanes y(static_cast<Lanes::Vector>(_mm512_maskz_rsqrt14_pd(0xff, static_cast<__m512d>(a.value))));
  const Lanes half_a = 0.5 * a;
  y = y * (1.5 - half_a * y * y);
  return y * (1.5 - half_a * y * y);
#else
  Lanes root;
  for (std::size_t lane = 0; lane < lane_count; ++lane) root.value[lane] = std::sqrt(a[lane]);
  return 1.0 / root;
#endif
}

/// sqrt(a) likewise, exactly 0 for a = 0.
TORYU_INLINE Lanes square_root(Lanes a) {
  return a * inverse_sqrt(max(a, 1e-300));
}

/// 1/a, likewise.
TORYU_INLINE Lanes inverse(Lanes a) {
#if defined(__AVX512F__)
  Lanes y(static_cast<Lanes::Vector>(_mm512_maskz_rcp14_pd(0xff, static_cast<__m512d>(a.value))));
  y = y * (2.0 - a * y);
  return y * (2.0 - a * y);
#else
  return 1.0 / a;
#endif
}

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

/// Smallest multiple of the lane count that holds `count` particles.
constexpr std::size_t padded(std::size_t count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

TORYU_INLINE Lanes load(const double* first) {
  using Aliasing [[gnu::may_alias]] = Lanes::Vector;
  return Lanes(*reinterpret_cast<const Aliasing*>(first));
}
TORYU_INLINE void store(Lanes a, double* first) {
  using Aliasing [[gnu::may_alias]] = Lanes::Vector;
  *reinterpret_cast<Aliasing*>(first) = a.value;
}
TORYU_INLINE Lanes load(const Field& field, std::size_t first) {
  return load(field.data() + first);
}
TORYU_INLINE void store(Lanes a, Field& field, std::size_t first) {
  store(a, field.data() + first);
}

}  // namespace toryu
