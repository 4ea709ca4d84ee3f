#pragma once
/// Arithmetic on named numbers: "2 * damping_ratio * dashpot_ratio". Its functions are those of base/elementary.hpp,
/// the same bits everywhere.
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/dual.hpp"

namespace slapstick {

/// Operators + - * / ^ ( ) and comparisons with ?:, functions as sqrt, sin, exp, min, max, and the constant pi.
/// Immutable; may be evaluated from several threads.
class Expression {
 public:
  /// @throws InputError with the reason only ("'1 +': unexpected end ...")
  explicit Expression(const std::string& text);

  [[nodiscard]] const std::string& text() const;
  /// The names that it needs, in alphabetical order.
  [[nodiscard]] const std::vector<std::string>& names() const;
  /// @param values must hold all of `names`
  /// @throws InputError if the result is not finite; says with which values
  [[nodiscard]] double evaluate(const std::map<std::string, double>& values) const;
  /// The same, but whatever the result: inf, or nan where there is no value.
  [[nodiscard]] double value(const std::map<std::string, double>& values) const;

  /// Value and derivative.
  [[nodiscard]] Dual differentiated(const Duals& values) const;

  /// Whether a parameter may not have this name, because it is a function or constant here.
  static bool reserves(std::string_view name);

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace slapstick
