#pragma once
/// Over what `measure` and `spectrum` take a quantity: the cycle that the motion settles on, or a time after a
/// transient.
#include <optional>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "model_options.hpp"
#include "slapstick/quantity/span.hpp"
#include "verb.hpp"

namespace slapstick::app {

/// {"kind": "cycle", "class": .., "n": ..} or {"kind": "motion", "transient": .., "periods": ..}
[[nodiscard]] Json span_json(const Span& span);

struct SpanOptions {
  ModelOptions model;
  std::string of;  ///< --of
  long long transient = 500, periods = 0;
  double time = 0.0;
  std::string out;
  bool progress = false;

  void declare(Arguments& arguments);
  /// @throws InputError for --periods and --time together
  void check() const;
  /// Without --periods and --time the cycle, or where there is none `instead` periods.
  /// @returns nothing if it was stopped. @throws InputError, NumericalError as orbit::settle and Motion::advance
  [[nodiscard]] std::optional<Span> span(const ChosenModel& chosen, long long instead, const Context& context) const;
};

/// A name of --of and its statistic, "" if there is none.
struct Wanted {
  Quantity quantity;
  std::string statistic;
};

/// Reads "Q[:STAT],..". @throws InputError naming the argument
[[nodiscard]] std::vector<Wanted> parse_wanted(const std::string& argument, const std::string& text,
                                               const std::vector<Quantity>& all);

}  // namespace slapstick::app
