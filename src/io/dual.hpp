#pragma once
/// A number and its derivative with respect to a parameter, in the arithmetic of expressions: forward differentiation,
/// exact up to rounding.
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace slapstick {

/// `rate` is nan where there is no derivative: a kink, a jump, an end of the domain. A number that does not vary may
/// stand on one.
struct Dual {
  double value = 0.0;
  double rate = 0.0;
  bool varies = false;  ///< the number depends on the parameter, even where its derivative happens to be 0
};

using Duals = std::map<std::string, Dual>;

Dual operator-(const Dual& a);
Dual operator+(const Dual& a, const Dual& b);
Dual operator-(const Dual& a, const Dual& b);
Dual operator*(const Dual& a, const Dual& b);
Dual operator/(const Dual& a, const Dual& b);
Dual power(const Dual& base, const Dual& exponent);

/// "<", "<=", ">", ">=", "==" or "!=": 1 or 0, which does not vary, but jumps where the sides are equal and one of them
/// varies.
Dual compare(std::string_view relation, const Dual& a, const Dual& b);
Dual both(const Dual& a, const Dual& b);
Dual either(const Dual& a, const Dual& b);
/// condition ? a : b. At a jump of the condition it has a derivative if a and b agree in value and derivative.
Dual choose(const Dual& condition, const Dual& a, const Dual& b);

/// A function of expressions, and of how many numbers it may be.
struct Function {
  std::string_view name;
  std::size_t least, most;
};
/// "sqrt", "atan2", "min", ..; null if there is no such function.
const Function* function_named(std::string_view name);
/// Its value and derivative at as many numbers.
Dual call(std::string_view function, std::span<const Dual> arguments);

}  // namespace slapstick
