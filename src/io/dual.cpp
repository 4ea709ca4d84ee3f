/// Differentiates arithmetic: numbers with their derivatives.
#include "io/dual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/elementary.hpp"

namespace slapstick {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// f of a Dual by the chain rule; what does not vary is not asked for its slope, which may be infinite.
Dual chain(const Dual& x, double value, double slope) { return {value, x.varies ? slope * x.rate : 0.0, x.varies}; }

/// A number that is constant around here, apart from a jump exactly here.
Dual step(double value, bool jumps) { return {value, jumps ? none : 0.0, jumps}; }

/// Whether a condition may be another one nearby.
bool unsure(const Dual& condition) {
  return condition.varies && (condition.value == 0.0 || std::isnan(condition.rate));
}
bool surely(bool truth, const Dual& condition) { return !unsure(condition) && (condition.value != 0.0) == truth; }

/// The larger for sign = 1, the smaller for -1. Where they are equal it has a derivative if theirs agree.
Dual extreme(const Dual& a, const Dual& b, double sign) {
  const bool varies = a.varies || b.varies;
  if (std::isnan(a.value) || std::isnan(b.value)) return {none, varies ? none : 0.0, varies};
  if (a.value != b.value) return (a.value > b.value) == (sign > 0.0) ? a : b;
  return {a.value, a.rate == b.rate ? a.rate : none, varies};
}

Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.value * x.value + y.value * y.value;
  const bool jumps = y.varies && y.value == 0.0 && x.value <= 0.0;
  const double rate = jumps ? none : (x.value * y.rate - y.value * x.rate) / square;
  const bool varies = x.varies || y.varies;
  return {fixed::atan2(y.value, x.value), varies ? rate : 0.0, varies};
}

/// A function of one number and its derivative.
struct Smooth {
  std::string_view name;
  double (*value)(double);
  double (*slope)(double);
};

constexpr auto smooth = std::to_array<Smooth>({
    {"sqrt", [](double x) { return std::sqrt(x); }, [](double x) { return 0.5 / std::sqrt(x); }},
    {"abs", [](double x) { return std::abs(x); }, [](double x) { return x == 0.0 ? none : std::copysign(1.0, x); }},
    {"exp", fixed::exp, fixed::exp},
    {"ln", fixed::ln, [](double x) { return 1.0 / x; }},
    {"log", fixed::ln, [](double x) { return 1.0 / x; }},
    {"log2", fixed::log2, [](double x) { return std::numbers::log2e / x; }},
    {"log10", fixed::log10, [](double x) { return std::numbers::log10e / x; }},
    {"sin", fixed::sin, fixed::cos},
    {"cos", fixed::cos, [](double x) { return -fixed::sin(x); }},
    {"tan", fixed::tan, [](double x) { return 1.0 / (fixed::cos(x) * fixed::cos(x)); }},
    {"asin", fixed::asin, [](double x) { return 1.0 / std::sqrt((1.0 - x) * (1.0 + x)); }},
    {"acos", fixed::acos, [](double x) { return -1.0 / std::sqrt((1.0 - x) * (1.0 + x)); }},
    {"atan", fixed::atan, [](double x) { return 1.0 / (1.0 + x * x); }},
    {"sinh", fixed::sinh, fixed::cosh},
    {"cosh", fixed::cosh, fixed::sinh},
    {"tanh", fixed::tanh, [](double x) { return 1.0 / (fixed::cosh(x) * fixed::cosh(x)); }},
    {"asinh", fixed::asinh, [](double x) { return 1.0 / std::sqrt(1.0 + x * x); }},
    {"acosh", fixed::acosh, [](double x) { return 1.0 / std::sqrt((x - 1.0) * (x + 1.0)); }},
    {"atanh", fixed::atanh, [](double x) { return 1.0 / ((1.0 - x) * (1.0 + x)); }},
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
  const double value = fixed::power(x.value, y.value);
  if (!y.varies)
    return chain(x, value, y.value == 0.0 || !x.varies ? 0.0 : y.value * fixed::power(x.value, y.value - 1.0));
  if (x.value == 0.0 && !x.varies && y.value > 0.0) return {value, 0.0, true};
  if (!(x.value > 0.0)) return {value, none, true};
  return {value, value * y.rate * fixed::ln(x.value) + y.value * fixed::power(x.value, y.value - 1.0) * x.rate, true};
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

const Function* function_named(std::string_view name) {
  static constexpr std::size_t any = 400;
  static constexpr auto others = std::to_array<Function>({{"sign", 1, 1},
                                                          {"rint", 1, 1},
                                                          {"atan2", 2, 2},
                                                          {"min", 1, any},
                                                          {"max", 1, any},
                                                          {"sum", 1, any},
                                                          {"avg", 1, any}});
  static const std::vector<Function> all = [] {
    std::vector<Function> list(others.begin(), others.end());
    for (const Smooth& function : smooth) list.push_back({function.name, 1, 1});
    return list;
  }();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Function& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Dual call(std::string_view function, std::span<const Dual> arguments) {
  Dual result = arguments.front();
  const double x = result.value;
  for (const Smooth& known : smooth)
    if (known.name == function) return chain(result, known.value(x), result.varies ? known.slope(x) : 0.0);
  if (function == "sign") return step(x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0, result.varies && x == 0.0);
  if (function == "rint") return step(std::floor(x + 0.5), result.varies && std::abs(x - std::trunc(x)) == 0.5);
  if (function == "atan2") return atan2(arguments[0], arguments[1]);
  for (const Dual& next : arguments.subspan(1)) {
    if (function == "max" || function == "min") result = extreme(result, next, function == "max" ? 1.0 : -1.0);
    if (function == "sum" || function == "avg") result = result + next;
  }
  return function == "avg" ? result / Dual{static_cast<double>(arguments.size())} : result;
}

}  // namespace slapstick
