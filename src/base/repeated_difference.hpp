#pragma once
/// Many rounded subtractions of one number at once: where within its windows a long flight is looked at.
#include <cmath>
#include <cstdint>

namespace slapstick {

/// `while (s > h) s -= h;` to the last bit, for 0 < h and s / h < 2^52. @returns how often it subtracts.
///
/// In one binade, where ulp is that of s, the differences are multiples of ulp. So every difference after the first
/// takes away the same number: h rounded to a multiple of ulp (a tie goes to the even one, and after the first
/// difference always from an even one). All that end above the binade's lowest number, below which an ulp is finer, are
/// one difference of integers.
/// Cost: a few dozen nanoseconds for each power of two in s / h.
inline std::int64_t subtract_repeatedly(double& s, double h) {
  constexpr std::int64_t least = std::int64_t{1} << 52;  // of a binade, in ulps
  std::int64_t count = 0;
  while (s > h) {
    int exponent = 0;
    (void)std::frexp(s, &exponent);
    const double ulp = std::ldexp(1.0, exponent - 53);
    const double first = s - h, second = first - h;
    const double bottom = std::ldexp(1.0, exponent - 1);
    if (bottom > h && second >= bottom) {
      const auto begin = static_cast<std::int64_t>(first / ulp), next = static_cast<std::int64_t>(second / ulp);
      const std::int64_t times = (begin - least - 1) / (begin - next);
      s = static_cast<double>(begin - times * (begin - next)) * ulp;
      count += times + 1;
    } else {
      s = first;
      ++count;
    }
  }
  return count;
}

}  // namespace slapstick
