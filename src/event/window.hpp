#pragma once
/// One window of one guard: a polynomial of degree 23 on x in [0, 1], its values and its derivatives.
///
/// The coefficients are kept in three groups of eight so that a value is
///     h(x) = sum_{j<8} x^j (a_j + x^8 (a_{8+j} + x^8 a_{16+j})),
/// a dozen operations deep instead of the 46 of Horner's rule. The operations and their order are the same for every
/// instruction set (the compiler maps Lane8 to whatever vectors the target has; contraction to FMA is off).
///
/// Sources compiled for different instruction sets include this (event/kernels.hpp). So each has functions of its own:
/// they are static, and members always inlined. A function that the linker may take from any object could be one with
/// instructions that this processor lacks.
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace slapstick::event {

inline constexpr int terms = 24;  ///< Taylor coefficients of a window
inline constexpr int degree = terms - 1;
inline constexpr double unit_roundoff = 0x1p-53;

/// Eight doubles that are worked on together.
typedef double Lane8 __attribute__((vector_size(64), aligned(64)));

/// Coefficients of one window polynomial, three groups of eight.
struct Coefficients {
  Lane8 group[3];

  [[gnu::always_inline]] Lane8& operator[](int g) { return group[g]; }
  [[gnu::always_inline]] const Lane8& operator[](int g) const { return group[g]; }
  [[gnu::always_inline]] Lane8* data() { return group; }
  [[nodiscard, gnu::always_inline]] const Lane8* data() const { return group; }
};

/// Storage of groups at the alignment that Lane8 promises: a template argument forgets it.
template <class T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  LaneAllocator() = default;
  template <class U>
  LaneAllocator(const LaneAllocator<U>&) {}  // NOLINT(google-explicit-constructor): what an allocator must offer
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  friend bool operator==(const LaneAllocator&, const LaneAllocator&) { return true; }
};
using Lanes = std::vector<Lane8, LaneAllocator<Lane8>>;

static inline Lane8 magnitude(const Lane8& v) { return v < 0.0 ? -v : v; }
static inline Lane8 smaller(const Lane8& a, const Lane8& b) { return a < b ? a : b; }
static inline Lane8 larger(const Lane8& a, const Lane8& b) { return a > b ? a : b; }

/// Halves and quarters of the same.
typedef double Lane4 __attribute__((vector_size(32)));
typedef double Lane2 __attribute__((vector_size(16)));
static inline Lane4 lower(const Lane8& v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
static inline Lane4 upper(const Lane8& v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
static inline Lane2 lower(const Lane4& v) { return __builtin_shufflevector(v, v, 0, 1); }
static inline Lane2 upper(const Lane4& v) { return __builtin_shufflevector(v, v, 2, 3); }

/// Least and greatest lane, and the sum of all lanes, each in a fixed order: halves, quarters, neighbours.
static inline double least(const Lane8& v) {
  const Lane4 low = lower(v), high = upper(v), half = low < high ? low : high;
  const Lane2 left = lower(half), right = upper(half), quarter = left < right ? left : right;
  return quarter[0] < quarter[1] ? quarter[0] : quarter[1];
}
static inline double greatest(const Lane8& v) { return -least(-v); }
/// True if every lane is above `bound`; false for NaN.
static inline bool all_above(const Lane8& v, double bound) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(v, _mm512_set1_pd(bound), _CMP_GT_OQ) == 0xff;
#endif
  constexpr Lane8 yes = {1, 1, 1, 1, 1, 1, 1, 1};
  return least(v > bound ? yes : Lane8{}) > 0.0;
}
static inline double sum(const Lane8& v) {
  const Lane4 half = lower(v) + upper(v);
  const Lane2 quarter = lower(half) + upper(half);
  return quarter[0] + quarter[1];
}

/// Lane j is v[j + 1], and lane 7 is next[0]: in parts as wide as the target's registers, since gcc 12 takes a wider
/// vector apart in memory, number by number.
static inline Lane8 moved_down(const Lane8& v, const Lane8& next) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(v, next, 1, 2, 3, 4, 5, 6, 7, 8);
#elif defined(__AVX__)
  union Parts {
    Lane8 whole;
    Lane4 half[2];
  };
  const Parts a = {v}, b = {next};
  Parts moved;
  moved.half[0] = __builtin_shufflevector(a.half[0], a.half[1], 1, 2, 3, 4);
  moved.half[1] = __builtin_shufflevector(a.half[1], b.half[0], 1, 2, 3, 4);
  return moved.whole;
#else
  union Parts {
    Lane8 whole;
    Lane2 pair[4];
  };
  const Parts a = {v}, b = {next};
  Parts moved;
  for (int k = 0; k < 4; ++k)
    moved.pair[k] = __builtin_shufflevector(a.pair[k], k < 3 ? a.pair[k + 1] : b.pair[0], 1, 2);
  return moved.whole;
#endif
}

/// Lane j of group g is coefficient 8 g + j + 1; zero past the end.
static inline Lane8 shifted(const Coefficients& a, int g) { return moved_down(a[g], g < 2 ? a[g + 1] : Lane8{}); }

/// x^0 .. x^7 and x^8, shared by every polynomial evaluated at x.
struct Powers {
  Lane8 low;
  double x8;
  [[gnu::always_inline]] explicit Powers(double x) {
    constexpr Lane8 one = {1, 1, 1, 1, 1, 1, 1, 1};
    constexpr Lane8 odd = {0, 1, 0, 1, 0, 1, 0, 1}, pairs = {0, 0, 1, 1, 0, 0, 1, 1}, upper = {0, 0, 0, 0, 1, 1, 1, 1};
    const double x2 = x * x, x4 = x2 * x2;
    low = (odd > 0.5 ? one * x : one) * (pairs > 0.5 ? one * x2 : one) * (upper > 0.5 ? one * x4 : one);
    x8 = x4 * x4;
  }
};

/// sum_n a_n x^n; rounding error at most 8 u sum_n |a_n| x^n (see docs/developers/proofs.md).
static inline double value(const Coefficients& a, const Powers& p) {
  const Lane8 nested = a[0] + p.x8 * (a[1] + p.x8 * a[2]);
  return sum(nested * p.low);
}

/// Coefficients of (h - a_0) / x: a_{n+1}.
static inline Coefficients divided_by_x(const Coefficients& a) { return {shifted(a, 0), shifted(a, 1), shifted(a, 2)}; }

/// Coefficients of the derivative: d_n = (n + 1) a_{n+1}, d_23 = 0.
static inline Coefficients derivative(const Coefficients& a) {
  Coefficients d;
  for (int g = 0; g < 3; ++g) {
    const double n = 8.0 * g;
    d[g] = shifted(a, g) * Lane8{n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7, n + 8};
  }
  return d;
}

}  // namespace slapstick::event
