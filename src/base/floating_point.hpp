#pragma once
/// Guard against flush-to-zero: some libraries switch the processor to a mode in which subnormal numbers become 0 and
/// leave it so. Results would then no longer be IEEE, and differ from thread to thread.
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace slapstick {

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

}  // namespace slapstick
