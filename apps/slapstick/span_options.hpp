#pragma once
/// Over what `measure` and `spectrum` take a quantity: the cycle that the motion settles on, a periodic orbit that the
/// options of orbit_choice.hpp say, or a time after a transient.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "model_options.hpp"
#include "orbit_choice.hpp"
#include "progress.hpp"
#include "slapstick/quantity/span.hpp"
#include "verb.hpp"

namespace slapstick::app {

/// {"kind": "cycle", "class": .., "n": ..} or {"kind": "motion", "transient": .., "periods": ..}
[[nodiscard]] Json span_json(const Span& span);

struct SpanOptions {
  static constexpr double not_given = std::numeric_limits<double>::infinity();
  ModelOptions model;
  OrbitOptions orbit;
  std::string of;                ///< --of
  double transient = not_given;  ///< forcing periods
  long long periods = 0;
  double time = 0.0;
  std::string out;
  bool progress = false;

  void declare(Arguments& arguments);
  /// @throws InputError for a negative transient, two lengths, or a length and an orbit
  void check() const;
  /// The orbit that is meant; without one and without --periods and --time the cycle, or where there is no cycle
  /// `instead` periods.
  /// @returns nothing if it was stopped. @throws InputError, NumericalError as orbit::find_orbit, orbit::settle and
  /// Motion::advance
  [[nodiscard]] std::optional<Span> span(const ChosenModel& chosen, long long instead, const Context& context,
                                         Progress* bar = nullptr) const;
  /// What of the motion is looked at. @throws InputError naming --transient where it leaves nothing of a record
  [[nodiscard]] Stretch stretch(const ChosenModel& chosen, long long instead) const;
  /// A bar over the transient and `length` periods; of a cycle the second part is not seen.
  [[nodiscard]] double whole(const ChosenModel& chosen, long long instead) const;
};

/// A name of --of and its statistic, "" if none was given.
struct Wanted {
  Quantity quantity;
  std::string statistic;
};

/// @throws InputError naming the argument if only a cycle has the statistic
void check_of_stretch(const std::string& argument, const Wanted& one);

/// Reads "Q[:STAT],..". @throws InputError naming the argument
[[nodiscard]] std::vector<Wanted> parse_wanted(const std::string& argument, const std::string& text,
                                               const std::vector<Quantity>& all);

/// Reads "Q,..": quantities that have a value at every instant; "" gives no quantity. @throws InputError naming the
/// argument
[[nodiscard]] std::vector<Quantity> functions_of_time(const std::string& argument, const std::string& text,
                                                      const ChosenModel& chosen);

/// --of of a verb that may go without, and what it says. @throws InputError naming --of
void declare_of(Arguments& arguments, std::string& of);
[[nodiscard]] std::vector<Wanted> parse_of(const std::string& of, const ChosenModel& chosen);

}  // namespace slapstick::app
