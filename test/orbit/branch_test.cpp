/// Branches: what changes along them, by a second route each.
#include <gtest/gtest.h>

#include "families.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

TEST(Branch, RefusesAStartOutsideItsRange) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  EXPECT_THROW((void)orbit::follow(*posed.problem, first->orbit, {.from = 2.5, .to = 3.0}), InputError);
}

}  // namespace
}  // namespace slapstick::test
