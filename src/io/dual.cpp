/// Differentiates arithmetic: numbers with their derivatives.
#include "io/dual.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace slapstick {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// f of a Dual by the chain rule; what does not vary is not asked for its slope, which may be infinite.
Dual chain(const Dual& x, double value, double slope) { return {value, x.varies ? slope * x.rate : 0.0, x.varies}; }

/// A number that is constant around here, but for a jump exactly here.
Dual step(double value, bool jumps) { return {value, jumps ? none : 0.0, jumps}; }

/// Whether a condition may be another one nearby.
bool unsure(const Dual& condition) {
  return condition.varies && (condition.value == 0.0 || std::isnan(condition.rate));
}
bool surely(bool truth, const Dual& condition) { return !unsure(condition) && (condition.value != 0.0) == truth; }

/// The larger for sign = 1, the smaller for -1. Where they are equal it has a derivative if theirs agree.
Dual extreme(const Dual& a, const Dual& b, double sign) {
  const double value = sign > 0.0 ? std::fmax(a.value, b.value) : std::fmin(a.value, b.value);
  if (a.value != b.value) return a.value == value ? a : b;
  const bool varies = a.varies || b.varies;
  return {value, a.rate == b.rate ? a.rate : none, varies};
}

Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.value * x.value + y.value * y.value;
  const bool jumps = y.varies && y.value == 0.0 && x.value <= 0.0;
  const double rate = jumps ? none : (x.value * y.rate - y.value * x.rate) / square;
  const bool varies = x.varies || y.varies;
  return {std::atan2(y.value, x.value), varies ? rate : 0.0, varies};
}

struct Function {
  std::string_view name;
  double (*value)(double);
  double (*slope)(double);
};

constexpr auto functions = std::to_array<Function>({
    {"sqrt", [](double x) { return std::sqrt(x); }, [](double x) { return 0.5 / std::sqrt(x); }},
    {"abs", [](double x) { return std::abs(x); }, [](double x) { return x == 0.0 ? none : std::copysign(1.0, x); }},
    {"exp", [](double x) { return std::exp(x); }, [](double x) { return std::exp(x); }},
    {"ln", [](double x) { return std::log(x); }, [](double x) { return 1.0 / x; }},
    {"log", [](double x) { return std::log(x); }, [](double x) { return 1.0 / x; }},
    {"log2", [](double x) { return std::log2(x); }, [](double x) { return std::numbers::log2e / x; }},
    {"log10", [](double x) { return std::log10(x); }, [](double x) { return std::numbers::log10e / x; }},
    {"sin", [](double x) { return std::sin(x); }, [](double x) { return std::cos(x); }},
    {"cos", [](double x) { return std::cos(x); }, [](double x) { return -std::sin(x); }},
    {"tan", [](double x) { return std::tan(x); }, [](double x) { return 1.0 / (std::cos(x) * std::cos(x)); }},
    {"asin", [](double x) { return std::asin(x); }, [](double x) { return 1.0 / std::sqrt((1.0 - x) * (1.0 + x)); }},
    {"acos", [](double x) { return std::acos(x); }, [](double x) { return -1.0 / std::sqrt((1.0 - x) * (1.0 + x)); }},
    {"atan", [](double x) { return std::atan(x); }, [](double x) { return 1.0 / (1.0 + x * x); }},
    {"sinh", [](double x) { return std::sinh(x); }, [](double x) { return std::cosh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }, [](double x) { return std::sinh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }, [](double x) { return 1.0 / (std::cosh(x) * std::cosh(x)); }},
    {"asinh", [](double x) { return std::asinh(x); }, [](double x) { return 1.0 / std::hypot(1.0, x); }},
    {"acosh", [](double x) { return std::acosh(x); }, [](double x) { return 1.0 / std::sqrt((x - 1.0) * (x + 1.0)); }},
    {"atanh", [](double x) { return std::atanh(x); }, [](double x) { return 1.0 / ((1.0 - x) * (1.0 + x)); }},
});

}  // namespace

Dual operator-(const Dual& a) { return {-a.value, -a.rate, a.varies}; }
Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.rate + b.rate, a.varies || b.varies}; }
Dual operator-(const Dual& a, const Dual& b) { return a + -b; }

Dual operator*(const Dual& a, const Dual& b) {
  const double rate = (a.varies ? a.rate * b.value : 0.0) + (b.varies ? a.value * b.rate : 0.0);
  return {a.value * b.value, rate, a.varies || b.varies};
}

Dual operator/(const Dual& a, const Dual& b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.rate - (b.varies ? quotient * b.rate : 0.0)) / b.value, a.varies || b.varies};
}

/// x^y. Where the exponent varies only a positive base has a derivative: x^y (y' ln x + y x' / x).
Dual power(const Dual& x, const Dual& y) {
  const double value = std::pow(x.value, y.value);
  if (!y.varies) return chain(x, value, y.value == 0.0 ? 0.0 : y.value * std::pow(x.value, y.value - 1.0));
  if (x.value == 0.0 && !x.varies && y.value > 0.0) return {value, 0.0, true};
  if (!(x.value > 0.0)) return {value, none, true};
  return {value, value * y.rate * std::log(x.value) + y.value * std::pow(x.value, y.value - 1.0) * x.rate, true};
}

Dual compare(std::string_view relation, const Dual& a, const Dual& b) {
  const bool less = a.value < b.value, equal = a.value == b.value;
  bool holds = false;
  if (relation == "<") holds = less;
  if (relation == "<=") holds = less || equal;
  if (relation == ">") holds = a.value > b.value;
  if (relation == ">=") holds = a.value >= b.value;
  if (relation == "==") holds = equal;
  if (relation == "!=") holds = !equal;
  return step(holds ? 1.0 : 0.0, equal && (a.varies || b.varies));
}

Dual both(const Dual& a, const Dual& b) {
  const double value = a.value != 0.0 && b.value != 0.0 ? 1.0 : 0.0;
  return step(value, !surely(false, a) && !surely(false, b) && (unsure(a) || unsure(b)));
}

Dual either(const Dual& a, const Dual& b) {
  const double value = a.value != 0.0 || b.value != 0.0 ? 1.0 : 0.0;
  return step(value, !surely(true, a) && !surely(true, b) && (unsure(a) || unsure(b)));
}

Dual choose(const Dual& condition, const Dual& a, const Dual& b) {
  const Dual& chosen = condition.value != 0.0 ? a : b;
  if (!unsure(condition)) return chosen;
  return {chosen.value, a.value == b.value && a.rate == b.rate ? a.rate : none, true};
}

Dual call(std::string_view function, const std::vector<Dual>& arguments) {
  Dual result = arguments.front();
  const double x = result.value;
  for (const Function& known : functions)
    if (known.name == function) return chain(result, known.value(x), known.slope(x));
  if (function == "sign") return step(x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0, result.varies && x == 0.0);
  if (function == "rint") return step(std::rint(x), result.varies && std::abs(x - std::trunc(x)) == 0.5);
  if (function == "atan2" && arguments.size() == 2) return atan2(arguments[0], arguments[1]);
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (function == "max" || function == "min") result = extreme(result, arguments[i], function == "max" ? 1.0 : -1.0);
    if (function == "sum" || function == "avg") result = result + arguments[i];
  }
  if (function == "max" || function == "min" || function == "sum") return result;
  if (function == "avg") return result / Dual{static_cast<double>(arguments.size())};
  return {none, none, true};
}

}  // namespace slapstick
