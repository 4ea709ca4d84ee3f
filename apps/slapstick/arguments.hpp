#pragma once
/// The arguments of one verb. CLI11 lives behind this header, in arguments.cpp, and nowhere else.
///
/// A verb declares what it takes; each declaration binds a variable, whose present value is the default. Every mistake
/// of the user becomes an InputError that names the argument.
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace slapstick::app {

/// The numbers that an option takes.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  ///< the end itself is left out

  [[nodiscard]] bool all() const;
  [[nodiscard]] bool has(double value) const;
  [[nodiscard]] std::string text() const;  ///< "(0, 0.2]"
};
constexpr NumberRange positive{.least = 0.0, .above = true};
constexpr NumberRange not_negative{.least = 0.0};

/// What a verb declares of one argument: help, documents and completion come from these.
struct ArgumentFact {
  enum class Kind { positional, text, repeated, number, count, choice, flag };
  Kind kind = Kind::text;
  std::string name, value, help;        ///< "--out", "FILE"; the value is empty of a flag
  std::vector<std::string> words = {};  ///< of a choice
  long long least = 0, most = 0;        ///< of a count
  NumberRange range = {};               ///< of a number
  bool required = false;                ///< may not be left out
  /// Other options: one of each group of `with` must be there too, none of `without` may. "--plot", or a value:
  /// "--level full".
  std::vector<std::vector<std::string>> with = {};
  std::vector<std::string> without = {};

  /// The help with these rules: "the panels [with --plot]".
  [[nodiscard]] std::string described() const;
};
/// "positional", "text", "repeated", "number", "count", "choice", "flag".
[[nodiscard]] std::string_view name(ArgumentFact::Kind kind);

class Arguments {
  struct Parser;

 public:
  /// An option that was declared, to say beside which others it has a meaning (ArgumentFact::with, without).
  class Declared {
   public:
    Declared(Parser& parser, std::size_t index) : parser_(parser), index_(index) {}
    Declared& with(std::vector<std::string> one_of);  ///< a second call adds a second condition
    Declared& without(const std::vector<std::string>& others);
    Declared& required();

   private:
    friend struct Parser;
    void describe();
    Parser& parser_;
    std::size_t index_;
  };

  Arguments(const std::string& verb, const std::string& summary);
  ~Arguments();
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  /// A required argument without a dash: "MODEL".
  void positional(const std::string& name, std::string& target, const std::string& help);
  /// One that may be left out: `target` stays as it is.
  void optional_positional(const std::string& name, std::string& target, const std::string& help);
  /// Any number of arguments without a dash: "FILE..".
  void positionals(const std::string& name, std::vector<std::string>& target, const std::string& help);
  /// `--name VALUE` with any text. `value` is what the help calls it: "FILE".
  Declared text(const std::string& name, std::string& target, const std::string& value, const std::string& help);
  /// The same, and may be repeated.
  Declared repeated(const std::string& name, std::vector<std::string>& target, const std::string& value,
                    const std::string& help);
  /// A finite number.
  Declared number(const std::string& name, double& target, const std::string& value, const std::string& help,
                  NumberRange range = {});
  /// A whole number in [least, most].
  Declared count(const std::string& name, long long& target, long long least, long long most, const std::string& help);
  /// One of several words.
  Declared choice(const std::string& name, std::string& target, const std::vector<std::string>& words,
                  const std::string& help);
  /// `--name` alone.
  Declared flag(const std::string& name, bool& target, const std::string& help);
  /// A paragraph at the end of the help.
  void footer(const std::string& text);

  /// True if the user gave this option (after `parse`).
  [[nodiscard]] bool given(const std::string& name) const;
  [[nodiscard]] std::string help() const;
  /// All that was declared, in order, and the text of `footer`.
  [[nodiscard]] const std::vector<ArgumentFact>& facts() const;
  [[nodiscard]] const std::string& notes() const;

  /// Reads the words after the verb. @returns false if help was asked for. @throws InputError of one line
  [[nodiscard]] bool parse(std::vector<std::string> words);
  /// What was read keeps the rules between options. @throws InputError of one line
  void check_rules() const;

 private:
  std::unique_ptr<Parser> parser_;
};

/// What may help somebody whose `text` begins like a number but is not one: " (decimals have a point: 0.5, not 0,5)";
/// or nothing.
[[nodiscard]] std::string number_advice(const std::string& text);
/// The finite number that `text` is, or that the expression `text` gives ("pi/2").
/// @throws InputError "ARGUMENT: 'text' is not a number"
[[nodiscard]] double parse_number(const std::string& argument, const std::string& text);
/// The same for a whole number in [least, most].
[[nodiscard]] long long parse_integer(const std::string& argument, const std::string& text, long long least,
                                      long long most);

}  // namespace slapstick::app
