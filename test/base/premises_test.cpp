/// A thread that does not round to the nearest is told so; CMakeLists.txt has the compilers that are.
#include <gtest/gtest.h>

#include <cfenv>
#include <string>

#include "base/floating_point.hpp"

namespace slapstick {
namespace {

/// What is said under this rounding, or nothing.
std::string refusal(int rounding) {
  std::fesetround(rounding);
  std::string said;
  try {
    require_ieee_arithmetic();
  } catch (const NumericalError& error) {
    said = error.what();
  }
  std::fesetround(FE_TONEAREST);
  return said;
}

TEST(Premises, only_rounding_to_the_nearest_is_accepted) {
  EXPECT_EQ(refusal(FE_TONEAREST), "");
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    EXPECT_NE(refusal(rounding).find("no rounding to the nearest"), std::string::npos) << rounding;
}

}  // namespace
}  // namespace slapstick
