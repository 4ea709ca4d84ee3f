/// The streams of a lane: sines of multiples of the phase.
#include "batch/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slapstick::batch {
namespace {

/// j t in an exact product, less its whole turns; 2 pi in 64 bits. docs/developers/proofs.md, section 11, counts on the
/// bound for every harmonic.
TEST(BatchSeries, SinesOfHarmonicsAreWithinTheirBound) {
  if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double is no wider than double";
  constexpr long double two_pi = 6.283185307179586476925286766559L;
  std::mt19937_64 random(11);
  double worst = 0.0;
  for (const int j : {1, 2, 3, 5, 7, 64, 1000})
    for (int k = 0; k < 20'000; ++k) {
      const double t = static_cast<double>(random() >> 11) * 0x1p-53;
      const long double turns = static_cast<long double>(t) * j, angle = (turns - std::round(turns)) * two_pi;
      double sine = 0.0, cosine = 0.0;
      sine_cosine(t, static_cast<double>(j), sine, cosine);
      worst = std::max({worst, static_cast<double>(std::abs(sine - std::sin(angle))),
                        static_cast<double>(std::abs(cosine - std::cos(angle)))});
    }
  RecordProperty("worst_in_units", std::to_string(worst * 0x1p53));
  EXPECT_LE(worst, 4.0 * 0x1p-53);
}

}  // namespace
}  // namespace slapstick::batch
