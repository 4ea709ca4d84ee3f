#pragma once
/// Numbers of several trajectories side by side: one, four or eight doubles that every operation treats alike.
///
/// All widths compute each lane by the same operations in the same order, so a lane's bits do not depend on the
/// width, on its neighbours or on the instruction set. Sources compiled for different instruction sets include this:
/// all functions are static and inlined (event/window.hpp says why).
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define SLAPSTICK_INLINE static inline __attribute__((always_inline))

namespace slapstick::batch {
namespace {

// ---- one lane
struct Mask1 {
  bool lanes;
};
typedef double Real1;

SLAPSTICK_INLINE Mask1 less(Real1 a, Real1 b) { return {a < b}; }
SLAPSTICK_INLINE Mask1 equal(Real1 a, Real1 b) { return {a == b}; }
SLAPSTICK_INLINE Mask1 operator&(Mask1 a, Mask1 b) { return {a.lanes && b.lanes}; }
SLAPSTICK_INLINE Mask1 operator|(Mask1 a, Mask1 b) { return {a.lanes || b.lanes}; }
SLAPSTICK_INLINE Mask1 operator~(Mask1 a) { return {!a.lanes}; }
SLAPSTICK_INLINE unsigned bits(Mask1 a) { return a.lanes ? 1U : 0U; }
SLAPSTICK_INLINE Real1 choose(Mask1 m, Real1 a, Real1 b) { return m.lanes ? a : b; }
SLAPSTICK_INLINE Real1 magnitude(Real1 a) { return __builtin_fabs(a); }
SLAPSTICK_INLINE void from_bits(Mask1& m, unsigned b) { m.lanes = (b & 1U) != 0; }

// ---- four lanes
typedef double Real4 __attribute__((vector_size(32)));
typedef long long Long4 __attribute__((vector_size(32)));
struct Mask4 {
  Long4 lanes;
};

SLAPSTICK_INLINE Mask4 less(const Real4& a, const Real4& b) { return {a < b}; }
SLAPSTICK_INLINE Mask4 equal(const Real4& a, const Real4& b) { return {a == b}; }
SLAPSTICK_INLINE Mask4 operator&(const Mask4& a, const Mask4& b) { return {a.lanes & b.lanes}; }
SLAPSTICK_INLINE Mask4 operator|(const Mask4& a, const Mask4& b) { return {a.lanes | b.lanes}; }
SLAPSTICK_INLINE Mask4 operator~(const Mask4& a) { return {~a.lanes}; }
SLAPSTICK_INLINE unsigned bits(const Mask4& a) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(a.lanes)));
#else
  unsigned all = 0;
  for (int i = 0; i < 4; ++i) all |= a.lanes[i] != 0 ? 1U << i : 0U;
  return all;
#endif
}
SLAPSTICK_INLINE Real4 choose(const Mask4& m, const Real4& a, const Real4& b) { return m.lanes ? a : b; }
SLAPSTICK_INLINE Real4 magnitude(const Real4& a) {
  return reinterpret_cast<Real4>(reinterpret_cast<Long4>(a) & (Long4{} + 0x7fffffffffffffffLL));
}
SLAPSTICK_INLINE void from_bits(Mask4& m, unsigned b) {
  const auto all = static_cast<long long>(b);
  m.lanes = (((Long4{} + all) >> Long4{0, 1, 2, 3}) & 1) != 0;
}

// ---- eight lanes
#if defined(__AVX512F__)
typedef double Real8 __attribute__((vector_size(64)));
struct Mask8 {
  __mmask8 lanes;
};

SLAPSTICK_INLINE Mask8 less(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a, b, _CMP_LT_OQ)}; }
SLAPSTICK_INLINE Mask8 equal(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ)}; }
SLAPSTICK_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.lanes & b.lanes)}; }
SLAPSTICK_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.lanes | b.lanes)}; }
SLAPSTICK_INLINE Mask8 operator~(Mask8 a) { return {static_cast<__mmask8>(~a.lanes)}; }
SLAPSTICK_INLINE unsigned bits(Mask8 a) { return a.lanes; }
SLAPSTICK_INLINE Real8 choose(Mask8 m, const Real8& a, const Real8& b) { return _mm512_mask_blend_pd(m.lanes, b, a); }
SLAPSTICK_INLINE Real8 magnitude(const Real8& a) { return _mm512_abs_pd(a); }
SLAPSTICK_INLINE void from_bits(Mask8& m, unsigned b) { m.lanes = static_cast<__mmask8>(b); }
#endif

/// The types that belong together.
template <int width>
struct Lanes;
template <>
struct Lanes<1> {
  using Real = Real1;
  using Mask = Mask1;
};
template <>
struct Lanes<4> {
  using Real = Real4;
  using Mask = Mask4;
};
#if defined(__AVX512F__)
template <>
struct Lanes<8> {
  using Real = Real8;
  using Mask = Mask8;
};
#endif

template <class Mask>
SLAPSTICK_INLINE bool any(const Mask& m) {
  return bits(m) != 0;
}
/// a < b ? a : b, and a > b ? a : b: what the processors' instructions for least and most do.
template <class Real>
SLAPSTICK_INLINE Real smaller(const Real& a, const Real& b) {
#if defined(__AVX512F__)
  if constexpr (sizeof(Real) == 64) return _mm512_maskz_min_pd(__mmask8{0xff}, a, b);
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 32) return _mm256_min_pd(a, b);
#endif
  return choose(less(a, b), a, b);
}
template <class Real>
SLAPSTICK_INLINE Real larger(const Real& a, const Real& b) {
#if defined(__AVX512F__)
  if constexpr (sizeof(Real) == 64) return _mm512_maskz_max_pd(__mmask8{0xff}, a, b);
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 32) return _mm256_max_pd(a, b);
#endif
  return choose(less(b, a), a, b);
}
/// The nearest whole number of |a| < 2^51, ties to even; and the greatest that is not above a.
template <class Real>
SLAPSTICK_INLINE Real nearest(const Real& a) {
  return (a + 0x1.8p52) - 0x1.8p52;
}
template <class Real>
SLAPSTICK_INLINE Real floor_of(const Real& a) {
  const Real n = nearest(a);
  return choose(less(a, n), n - 1.0, n);
}
template <class Real>
SLAPSTICK_INLINE Real load(const double* at) {
  return *reinterpret_cast<const Real*>(at);
}
template <class Real>
SLAPSTICK_INLINE void store(double* at, const Real& a) {
  *reinterpret_cast<Real*>(at) = a;
}

}  // namespace
}  // namespace slapstick::batch
