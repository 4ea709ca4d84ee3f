#pragma once
/// Numbers of 400 bits (MPFR), and how far a double is from one.
#include <mpfr.h>

#include <algorithm>
#include <cmath>

#include "base/double_double.hpp"

namespace slapstick::testing {

struct Number {
  Number() { mpfr_init2(value, 400); }
  explicit Number(double x) : Number() { mpfr_set_d(value, x, MPFR_RNDN); }
  explicit Number(DoubleDouble x) : Number(x.hi) { mpfr_add_d(value, value, x.lo, MPFR_RNDN); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  ~Number() { mpfr_clear(value); }
  [[nodiscard]] double rounded() const { return mpfr_get_d(value, MPFR_RNDN); }

  mpfr_t value;
};

/// |x - exact| in ulps of `exact`.
inline double ulps(double x, const Number& exact) {
  Number difference;
  mpfr_sub_d(difference.value, exact.value, x, MPFR_RNDN);
  int exponent = 0;
  std::frexp(exact.rounded(), &exponent);
  return std::abs(std::ldexp(difference.rounded(), -std::max(exponent - 53, -1074)));
}

/// |x - exact| / |exact| in units of u^2, u = 2^-53.
inline double squares(DoubleDouble x, const Number& exact) {
  const Number computed(x);
  Number difference;
  mpfr_sub(difference.value, computed.value, exact.value, MPFR_RNDN);
  if (mpfr_zero_p(difference.value) != 0) return 0.0;
  mpfr_div(difference.value, difference.value, exact.value, MPFR_RNDN);
  return std::abs(difference.rounded()) * 0x1p106;
}

}  // namespace slapstick::testing
