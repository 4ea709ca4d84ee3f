#pragma once
/// The content of a model file: what `model_reader` fills, `model_builder` evaluates and `model_printer` writes.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/expression.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {

/// A number or an expression, and where it stands.
struct Scalar {
  double number = 0.0;
  std::optional<Expression> expression;
  int line = 0;
};

/// What a key of a [[part]] holds: a Scalar, a Scalar whose expression may name states as well, true or false, one line
/// of text; a list of tables with fields of their own, a list of points [x, force], a list of two Scalars; a word of
/// `contact_laws` or `signal_shapes`, a table of `stribeck_keys`, a table of `constant`, states and a `compliant_stop`,
/// a table of `band_keys`, or two plain numbers.
enum class Holds {
  number,
  observed,
  flag,
  text,
  harmonics,
  points,
  interval,
  contact_law,
  shape,
  stribeck,
  load,
  band,
  ratio
};

struct FieldRule {
  std::string_view key;
  bool required = false;
  Holds holds = Holds::number;
  std::string_view instead_of = {};  ///< keys that this one replaces, with '|' between them
  std::string_view needs = {};       ///< keys without one of which this one means nothing, in the same way
};

/// How a [[part]] says what it acts on: not at all, `on = "x"`, or `between = ["x", "ground"]`, where a [[base]] may
/// stand too. Between the ends of a contact, and of a characteristic, the surroundings may not move: both are measured
/// from the same base, or from none. `moving` admits other ends.
enum class Ends { none, on, between, moving };

/// The grammar of one kind of [[part]]; reader, evaluation and printer all follow this table.
struct PartRule {
  std::string_view kind;
  bool named;
  Ends ends;
  std::vector<FieldRule> fields;
};

/// A point of a characteristic.
struct Point {
  Scalar at, force;
};

/// One [[part]] of the file.
struct Part {
  std::string name, description;
  int a = ground, b = ground;  // a coordinate, `ground`, or base_end(k); of a coordinate b is what it is measured from
  std::map<std::string, Scalar, std::less<>> fields;
  std::map<std::string, bool, std::less<>> flags;
  std::map<std::string, std::string, std::less<>> texts;
  std::vector<Part> harmonics;
  std::vector<Point> points;                       ///< of its characteristic, of its restitution, or of a signal ..
  std::vector<std::pair<double, double>> samples;  ///< .. whose file has many
  std::string record;                              ///< the file of a signal ..
  std::vector<int> rows;                           ///< .. and the line in it of each point
  std::vector<Scalar> within;
  std::optional<Ratio> ratio;  ///< no parameters: which contacts are on one pair must not depend on them
  std::map<std::string, Scalar, std::less<>> stribeck;  // by stribeck_keys()
  std::map<std::string, Scalar, std::less<>> band;      // by band_keys()
  std::vector<std::pair<std::string, Scalar>> load;     // of a normal force, in the file's order
  std::string load_stop;                                // the compliant stop whose force it is
  std::string presses;                                  // the friction contact that a force is on; a is then `ground`
  int line = 0;

  [[nodiscard]] bool flag(std::string_view key) const {
    const auto found = flags.find(key);
    return found != flags.end() && found->second;
  }
};

/// The number that stands in Part::a and b for the k-th [[base]]; the same turns it back into k.
constexpr int base_end(int k) { return -2 - k; }
constexpr bool is_base(int end) { return end <= -2; }

/// A parameter; `shown.value` is filled when all of them are known.
struct ParameterEntry {
  Parameter shown;
  Scalar value;
};

struct GroupEntry {
  Group shown;
  int line = 0;
};

/// One key of [scale].
struct ScaleEntry {
  Scalar value;
  std::string unit;
  int line = 0;
};

/// One key of [matrix]: n x n entries by rows.
struct MatrixEntry {
  std::vector<Scalar> entries;
  int line = 0;
};

struct Definition {
  std::string source, name, summary, notes;
  std::optional<Scalar> omega;
  std::optional<ImpactLaw> impact_law;
  std::vector<ParameterEntry> parameters;
  std::vector<GroupEntry> groups;
  std::map<std::string, std::vector<Part>, std::less<>> parts;  // by kind
  std::map<std::string, MatrixEntry, std::less<>> matrices;     // by matrix_keys()
  std::map<std::string, ScaleEntry, std::less<>> scale;         // by scale_keys()
  std::vector<ParameterEntry> ones;                   // the same as parameters that no one sets: scale_length, ..
  std::vector<std::pair<std::string, Scalar>> start;  // by state name, in the file's order
  std::vector<std::string> observed;                  // what observables may name besides quantities
  std::vector<Parameter> shown_parameters;            // the same, as the public interface gives them
  std::vector<Group> shown_groups;
  std::vector<Observable> shown_observables;

  [[nodiscard]] std::string place(int line) const { return source + ":" + std::to_string(line) + ": "; }
  [[nodiscard]] const std::vector<Part>& of(std::string_view kind) const {
    static const std::vector<Part> none;
    const auto found = parts.find(kind);
    return found == parts.end() ? none : found->second;
  }
};

/// The kinds of parts, in the order in which they are read and printed.
[[nodiscard]] const std::vector<PartRule>& part_rules();

/// Every key of a [[part]] of this kind, and of the file itself, a parameter, a harmonic of a base, and [matrix].
[[nodiscard]] std::vector<std::string> part_keys(const PartRule& rule);
[[nodiscard]] const std::vector<std::string>& top_keys();
[[nodiscard]] const std::vector<std::string>& parameter_keys();
[[nodiscard]] const std::vector<std::string>& matrix_keys();
/// Of [scale], in the order length, time, mass; and of each of its tables.
[[nodiscard]] const std::vector<std::string>& scale_keys();
[[nodiscard]] const std::vector<std::string>& quantity_keys();
[[nodiscard]] const PartRule& harmonic_rule();

/// The keys of a `stribeck` table, of a `band`, and the words of `law` of a compliant stop.
[[nodiscard]] const std::vector<std::string>& stribeck_keys();
[[nodiscard]] const std::vector<std::string>& band_keys();
[[nodiscard]] const std::vector<std::string>& contact_laws();
[[nodiscard]] const std::vector<std::string>& signal_shapes();
/// The words of `impact_law`, in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& impact_laws();

/// What expressions call the value of a key of [scale]: "scale_length".
[[nodiscard]] std::string scale_name(const std::string& key);

/// What an observable's expression calls the gap of a stop: "gap_wall".
[[nodiscard]] std::string gap_name(const std::string& stop);

/// What the inner coordinate of a Maxwell or Jenkins element is called: "s_mount".
[[nodiscard]] std::string inner_name(const std::string& element);

/// "spring 2" or "stop 'wall'".
[[nodiscard]] std::string part_label(std::string_view kind, std::size_t index, const Part& part);

/// Reads a file's text; names and keys are checked, numbers are not. @throws InputError
[[nodiscard]] Definition read_definition(std::string_view text, const std::string& source);

/// The file's text with these overrides (parameters only, groups resolved) as defaults.
[[nodiscard]] std::string print_definition(const Definition& definition, const Overrides& overrides);

/// The values of all parameters and of scale_length, .. . @throws InputError with the file's line
[[nodiscard]] std::map<std::string, double> all_values(const Definition& definition, const Overrides& resolved);

/// That a model has no parameter or group of this name; the nearest one is suggested.
[[noreturn]] void refuse_parameter(const Definition& definition, const std::string& name);

/// Groups replaced by their members, every name and number checked. @throws InputError
[[nodiscard]] Overrides resolve(const Definition& definition, const Overrides& overrides);

}  // namespace slapstick
