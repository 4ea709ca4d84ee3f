#include "property/property.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace slapstick::test {
namespace {

long environment(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 1 : std::max(1L, std::atol(text));
}

}  // namespace

void expect_of_all(const Shape& shape, int count, const Law& law) {
  rc::detail::TestParams params;
  params.seed = static_cast<std::uint64_t>(environment("SLAPSTICK_SEED"));
  params.maxSuccess = count * static_cast<int>(environment("SLAPSTICK_CAMPAIGN"));
  const rc::detail::TestResult result = rc::detail::checkTestable(
      [&] {
        const Machine machine = *machines(shape);
        const std::string wrong = law(machine);
        if (!wrong.empty()) RC_FAIL(wrong);
      },
      rc::detail::TestMetadata{}, params);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << text.str();
}

}  // namespace slapstick::test
