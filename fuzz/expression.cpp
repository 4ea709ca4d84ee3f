/// Bytes as an expression of a model file, and as a unit: the formulas and units that io/expression and io/unit take or
/// refuse.
#include "io/expression.hpp"

#include <cmath>
#include <map>

#include "io/unit.hpp"
#include "target.hpp"

namespace slapstick::fuzz {
namespace {

void check_expression(const std::string& text) {
  constexpr double numbers[] = {0.0, 1.0, -2.5, 1e300, 0.1};
  const Expression expression(text);
  demand(expression.text() == text, "an expression keeps its text");
  std::map<std::string, double> values;
  for (const auto& name : expression.names()) values[name] = numbers[values.size() % 5];
  const double value = expression.value(values), again = expression.value(values);
  demand(value == again || (std::isnan(value) && std::isnan(again)), "an expression has one value");
  demand(std::isfinite(expression.evaluate(values)), "a value is finite or refused");
}

void check_unit(const std::string& text) {
  const Unit unit = parse_unit(text);
  demand(unit.factor >= 1e-100 && unit.factor <= 1e100, "a unit's factor is in range");
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  const std::string text(text_of(data, size));
  (void)succeeds([&] { check_expression(text); });
  (void)succeeds([&] { check_unit(text); });
  (void)slapstick::Expression::reserves(text);
  return 0;
}
