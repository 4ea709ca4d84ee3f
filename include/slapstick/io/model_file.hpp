#pragma once
/// Model files: a Model with named parameters, ranges and expressions, as a page of TOML. The reference is
/// `docs/reference/model_file.md`.
///
///     name = "impact"
///     omega = "omega"
///     [parameters]
///     omega = { value = 2.2, above = 0, description = "forcing frequency" }
///     [[coordinate]]
///     name = "x"
///     mass = 1
///     [[force]]
///     on = "x"
///     amplitude = "omega^2"        # any number may be an expression of the parameters
///     [[stop]]
///     name = "wall"
///     between = ["x", "ground"]    # x - ground <= clearance
///     clearance = 0
///     restitution = 0.8
///     [start]
///     x = -0.5
///
/// Every error is an InputError of one line: "FILE:LINE: PART: WHAT", and for an unknown name the nearest known one.
/// Cost: `build` evaluates all expressions of the file anew. Threads: all is const and safe to call at once.
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slapstick/model/family.hpp"

namespace slapstick {

/// A number of a model file that `--set` and sweeps may change.
struct Parameter {
  std::string name;
  double value = 0.0;  ///< the default; if `expression` is set, its value with all other defaults
  /// e.g. "static_friction": follows the other parameters until it is set itself; "" for a plain number
  std::string expression;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;  ///< true: `min` itself is outside (`above` in the file)
  bool max_open = false;  ///< true: `max` itself is outside (`below` in the file)
  std::string description;
  std::string unit;

  [[nodiscard]] bool admits(double number) const;
  [[nodiscard]] std::string range() const;  ///< "(0, inf)", "[0, 1]"
};

/// One name that sets several parameters to the same value: `friction` sets static_friction and kinetic_friction.
struct Group {
  std::string name;
  std::vector<std::string> members;
};

/// A quantity that is computed from the state for tables: "spring_force = stiffness * (x1 - x2)".
struct Observable {
  std::string name;
  std::string expression;  ///< of parameters, the state, bases, `gap_NAME` of stops and `time`; or a plain number
  std::string unit, description;
};

/// How tables in physical units follow from a motion: physical = factor * the model's number, a column each.
struct PhysicalUnits {
  struct Column {
    std::string unit;  ///< "mm/s"
    double factor = 1.0;
  };
  Column time, w;
  std::vector<Column> state, observables;
};

/// What the numbers of a model without [scale] are in, as far as its file says it. Empty texts: it does not, and so
/// with [scale], where they are no quantities.
struct StatedUnits {
  std::vector<std::string> coordinates;
  std::string time;  ///< of a velocity: that of its coordinate over this
  std::string mass;  ///< of a force: mass length / time^2; only with a time
};

/// Values given by name, as by `--set`. A parameter's own value wins over its group's.
using Overrides = std::map<std::string, double>;

struct Definition;  // the file's content
class Observer;     // slapstick/io/observer.hpp

/// A polyline that is laid along a curve: of which friction contact, and the largest error of its force.
struct LaidLaw {
  std::string friction;
  double largest_error = 0.0;
};

/// A model file that has been read and checked with its default values. Immutable, cheap to copy, safe to share between
/// threads.
class ModelDefinition {
 public:
  /// @param source  what messages call the text, usually the path
  /// @throws InputError for anything that is not a sound model file
  static ModelDefinition parse(std::string_view text, const std::string& source);

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const std::string& summary() const;                ///< one line, may be empty
  [[nodiscard]] const std::string& notes() const;                  ///< several lines, may be empty
  [[nodiscard]] const std::vector<Parameter>& parameters() const;  ///< in the file's order
  [[nodiscard]] const std::vector<Group>& groups() const;
  [[nodiscard]] const std::vector<Observable>& observables() const;  ///< in the file's order

  /// Every parameter's value. @throws InputError if an override is unknown, not finite or out of range, or an
  /// expression is not finite
  [[nodiscard]] std::map<std::string, double> values(const Overrides& overrides = {}) const;

  /// The present value of a parameter, or of a group whose members agree.
  /// @param set  how the caller's users set a value, before "NAME=VALUE" in messages: "--set "
  /// @throws InputError for an unknown name (the nearest is suggested), and for a group whose members differ or one of
  /// which is set by itself
  [[nodiscard]] double present_value(const std::string& name, const Overrides& overrides,
                                     const std::string& set = {}) const;

  /// May a parameter or group go from its present value to both ends of a range?
  /// @throws InputError if the range is empty, the value outside, or an end outside of what a parameter admits
  void check_range(const std::string& name, const Overrides& overrides, double from, double to,
                   const std::string& set = {}) const;

  /// The validated model. @throws InputError as `values`, and with the file's line for what `validate` refuses
  [[nodiscard]] Model build(const Overrides& overrides = {}) const;

  /// The derivative of `build` with respect to a parameter or group, at its present value: a Model of the same shape in
  /// which every number is the derivative of that number (names, indices, harmonics, impact law as in the model). Of a
  /// group the members move together that have no override of their own; parameters that follow others by an expression
  /// follow here too. Exact up to rounding, also at the ends of ranges.
  /// @throws InputError as `build`, for an unknown name, or naming a number that has no derivative (a kink of min, max,
  /// abs, ?:)
  [[nodiscard]] Model rate(const std::string& parameter, const Overrides& overrides = {}) const;

  /// The model as a function of some of its parameters or groups, the others as in `overrides`.
  [[nodiscard]] Family family(const std::vector<std::string>& parameters, const Overrides& overrides = {}) const;

  /// The default initial state (2n numbers), checked against the stops. @throws InputError
  [[nodiscard]] State start(const Overrides& overrides = {}) const;

  /// Of each friction contact with a `stribeck` law. @throws InputError as `build`
  [[nodiscard]] std::vector<LaidLaw> laid_laws(const Overrides& overrides = {}) const;

  /// What computes the observables along a motion. @throws InputError as `build`
  [[nodiscard]] Observer observer(const Overrides& overrides = {}) const;

  /// The physical units of tables, by the file's [scale]; nothing if it has none. @throws InputError as `values`
  [[nodiscard]] std::optional<PhysicalUnits> physical(const Overrides& overrides = {}) const;

  /// Coordinates state theirs. The unit of time is that of the parameters' units, if these are one system with the
  /// coordinates' and the model's numbers are in it: measured in another unit of time, they must change as masses,
  /// stiffnesses, forces and frequencies do.
  [[nodiscard]] StatedUnits stated_units() const;

  /// A complete file, with the overrides as the new defaults; reading it gives the same Model, and printing that the
  /// same text. Comments are not kept; descriptions and notes are. @throws InputError as `start`
  [[nodiscard]] std::string to_toml(const Overrides& overrides = {}) const;

 private:
  explicit ModelDefinition(std::shared_ptr<const Definition> definition);
  std::shared_ptr<const Definition> definition_;
};

/// A built-in model by name, or a model file by a path that ends in ".toml".
/// @throws InputError for an unknown name (the nearest is suggested), a file that is too large, or its content;
/// StorageError for a file that is not there or cannot be read
[[nodiscard]] ModelDefinition load_model(const std::string& name_or_path);

/// A commented file to start a model of one's own from: sound as it is, and with an example of every key, some switched
/// off.
/// @param name  letters, digits, '_' and '-'. @throws InputError
[[nodiscard]] std::string new_model(const std::string& name);

/// Names of the built-in models, in alphabetical order.
[[nodiscard]] std::vector<std::string> builtin_models();

}  // namespace slapstick
