#pragma once
/// Guard against flush-to-zero: some libraries switch the processor to a mode in which subnormal numbers become 0 and
/// leave it so. Results would then no longer be IEEE, and differ from thread to thread.
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cfloat>
#include <limits>

#include "slapstick/base/error.hpp"

#if defined(__FAST_MATH__)
#error "slapstick needs IEEE arithmetic: compile it without -ffast-math"
#endif

namespace slapstick {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53 &&
                  sizeof(double) == 8,
              "slapstick needs double to be IEEE 754 binary64");
static_assert(FLT_EVAL_METHOD == 0,
              "slapstick needs double to be computed as double: on 32-bit x86 compile with -msse2 -mfpmath=sse");

/// While it lives, this thread computes with subnormal numbers (MXCSR bits FTZ and DAZ off); the destructor restores
/// what it found. Does nothing on processors without SSE2. Cost: a nanosecond where nothing is to be restored.
class IeeeArithmetic {
 public:
#if defined(__SSE2__)
  IeeeArithmetic() : found_(_mm_getcsr()) {
    if (was_flushing()) _mm_setcsr(found_ & ~flush_bits);
  }
  ~IeeeArithmetic() {
    if (was_flushing()) _mm_setcsr(_mm_getcsr() | (found_ & flush_bits));
  }
  /// True if flush-to-zero was on when this object was made.
  [[nodiscard]] bool was_flushing() const { return (found_ & flush_bits) != 0; }
#else
  IeeeArithmetic() {}
  ~IeeeArithmetic() {}
  [[nodiscard]] bool was_flushing() const { return false; }
#endif
  IeeeArithmetic(const IeeeArithmetic&) = delete;
  IeeeArithmetic& operator=(const IeeeArithmetic&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned flush_bits = 0x8040;  // FTZ | DAZ
  unsigned found_;
#endif
};

/// @throws NumericalError if this thread, with IeeeArithmetic, flushes subnormal numbers to zero or does not round to
/// nearest
inline void require_ieee_arithmetic() {
  const IeeeArithmetic ieee;
  const volatile double tiny = 0x1p-1074, one = 1.0, half_ulp = 0x1p-53, more = 0x1.8p-53;
  const bool subnormal = tiny * one == tiny && tiny > 0.0 && tiny + tiny == 2.0 * tiny;
  const bool nearest = one + half_ulp == one && one + more > one && -one - more < -one;
  if (!(subnormal && nearest))
    throw NumericalError("this processor does not compute as IEEE 754 says (" +
                         std::string(subnormal ? "no rounding to the nearest" : "subnormal numbers are zero") +
                         "); results would not be those of other machines");
}

}  // namespace slapstick
