/// Parses an expression and evaluates it with its derivative.
#include "io/dual_expression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <numbers>

namespace slapstick {
namespace {

constexpr bool in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Evaluates by recursive descent, one function for each level of precedence, loosest first.
class Descent {
 public:
  Descent(std::string_view text, const Duals& names) : text_(text), names_(names) {}

  Dual conditional() {
    const Dual condition = disjunction();
    if (!take("?")) return condition;
    const Dual yes = conditional();
    take(":");
    return choose(condition, yes, conditional());
  }

 private:
  /// Skips blanks, then takes the token if it is next.
  bool take(std::string_view token) {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t"), text_.size()));
    if (text_.substr(0, token.size()) != token) return false;
    text_.remove_prefix(token.size());
    return true;
  }

  Dual disjunction() {
    Dual left = conjunction();
    while (take("||")) left = either(left, conjunction());
    return left;
  }

  Dual conjunction() {
    Dual left = comparison();
    while (take("&&")) left = both(left, comparison());
    return left;
  }

  Dual comparison() {
    constexpr auto relations = std::to_array<std::string_view>({"<=", ">=", "==", "!=", "<", ">"});
    Dual left = sum();
    for (;;) {
      const auto* const found = std::find_if(relations.begin(), relations.end(), [&](auto each) { return take(each); });
      if (found == relations.end()) return left;
      left = compare(*found, left, sum());
    }
  }

  Dual sum() {
    Dual left = product();
    for (;;) {
      if (take("+"))
        left = left + product();
      else if (take("-"))
        left = left - product();
      else
        return left;
    }
  }

  Dual product() {
    Dual left = signed_power();
    for (;;) {
      if (take("*"))
        left = left * signed_power();
      else if (take("/"))
        left = left / signed_power();
      else
        return left;
    }
  }

  /// -a^b is -(a^b), a^-b^c is a^(-(b^c)).
  Dual signed_power() {
    if (take("-")) return -signed_power();
    if (take("+")) return signed_power();
    const Dual base = single();
    return take("^") ? power(base, signed_power()) : base;
  }

  Dual single() {
    if (take("(")) {
      const Dual inner = conditional();
      take(")");
      return inner;
    }
    const auto end = std::find_if_not(text_.begin(), text_.end(), in_name) - text_.begin();
    const std::string_view name = text_.substr(0, static_cast<std::size_t>(end));
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) return number();
    text_.remove_prefix(name.size());
    if (take("(")) return function(name);
    if (name == "pi") return {std::numbers::pi};
    return names_.at(std::string(name));
  }

  Dual number() {
    Dual result{std::numeric_limits<double>::quiet_NaN()};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), result.value);
    text_.remove_prefix(error == std::errc{} ? static_cast<std::size_t>(end - text_.data()) : text_.size());
    return result;
  }

  Dual function(std::string_view name) {
    std::vector<Dual> arguments;
    do {
      arguments.push_back(conditional());
    } while (take(","));
    take(")");
    return call(name, arguments);
  }

  std::string_view text_;
  const Duals& names_;
};

}  // namespace

Dual differentiated(const Expression& expression, const Duals& names) {
  return Descent(expression.text(), names).conditional();
}

}  // namespace slapstick
