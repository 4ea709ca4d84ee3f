/// Parses the arguments of one verb; the only source that includes CLI11.
#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/decimal.hpp"
#include "base/nearest.hpp"
#include "io/expression.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

struct Arguments::Parser {
  CLI::App app;
  std::vector<std::string> names;  // of the options, with dashes
  std::vector<ArgumentFact> facts;
  std::string notes;
  std::vector<std::function<void()>> conversions;  // texts into numbers, after parsing
};

namespace {

/// The text on one line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

Arguments::Arguments(const std::string& verb, const std::string& summary) : parser_(std::make_unique<Parser>()) {
  CLI::App& app = parser_->app;
  app.name("slapstick " + verb);
  app.description(summary);
  app.set_help_flag("-h,--help", "this text");
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("REQUIRED", "");
  parser_->names = {"--help"};
}

Arguments::~Arguments() = default;

void Arguments::positional(const std::string& name, std::string& target, const std::string& help) {
  parser_->app.add_option(name, target, help)->required()->type_name("");
  parser_->facts.push_back({ArgumentFact::Kind::positional, name, "", help});
  parser_->facts.back().required = true;
}

void Arguments::positionals(const std::string& name, std::vector<std::string>& target, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("");
  parser_->facts.push_back({ArgumentFact::Kind::positional, name, "", help});
}

void Arguments::optional_positional(const std::string& name, std::string& target, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("");
  parser_->facts.push_back({ArgumentFact::Kind::positional, name, "", help});
}

void Arguments::text(const std::string& name, std::string& target, const std::string& value, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name(value);
  parser_->names.push_back(name);
  parser_->facts.push_back({ArgumentFact::Kind::text, name, value, help});
}

void Arguments::repeated(const std::string& name, std::vector<std::string>& target, const std::string& value,
                         const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name(value)->allow_extra_args(false);
  parser_->names.push_back(name);
  parser_->facts.push_back({ArgumentFact::Kind::repeated, name, value, help});
}

void Arguments::number(const std::string& name, double& target, const std::string& value, const std::string& help) {
  auto words = std::make_shared<std::string>();
  text(name, *words, value, help);
  parser_->facts.back().kind = ArgumentFact::Kind::number;
  parser_->conversions.emplace_back([this, name, words, &target] {
    if (given(name)) target = parse_number(name, *words);
  });
}

void Arguments::count(const std::string& name, long long& target, long long least, long long most,
                      const std::string& help) {
  auto words = std::make_shared<std::string>();
  text(name, *words, "N", help);
  ArgumentFact& fact = parser_->facts.back();
  fact.kind = ArgumentFact::Kind::count;
  fact.least = least;
  fact.most = most;
  parser_->conversions.emplace_back([this, name, words, least, most, &target] {
    if (given(name)) target = parse_integer(name, *words, least, most);
  });
}

void Arguments::choice(const std::string& name, std::string& target, const std::vector<std::string>& words,
                       const std::string& help) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : "|") + word;
  text(name, target, list, help);
  parser_->facts.back().kind = ArgumentFact::Kind::choice;
  parser_->facts.back().words = words;
  parser_->conversions.emplace_back([name, words, &target] {
    if (std::find(words.begin(), words.end(), target) == words.end())
      throw InputError(name + ": " + in_quotes(target) + " is not one of its words" + suggestion(target, words));
  });
}

void Arguments::flag(const std::string& name, bool& target, const std::string& help) {
  parser_->app.add_flag(name, target, help);
  parser_->names.push_back(name);
  parser_->facts.push_back({ArgumentFact::Kind::flag, name, "", help});
}

void Arguments::footer(const std::string& text) {
  parser_->notes = text;
  parser_->app.footer("\n" + text);
}

const std::vector<ArgumentFact>& Arguments::facts() const { return parser_->facts; }
const std::string& Arguments::notes() const { return parser_->notes; }

std::string_view name(ArgumentFact::Kind kind) {
  constexpr std::array<std::string_view, 7> words = {"positional", "text",   "repeated", "number",
                                                     "count",      "choice", "flag"};
  return words[static_cast<std::size_t>(kind)];
}

bool Arguments::given(const std::string& name) const { return parser_->app.get_option(name)->count() > 0; }

std::string Arguments::help() const { return parser_->app.help(); }

bool Arguments::parse(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    parser_->app.parse(words);
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ExtrasError&) {
    const std::string word = parser_->app.remaining().front();
    const bool option = word.size() > 1 && word[0] == '-';
    const std::string bare = word.substr(0, word.find('='));
    if (option) throw InputError("unknown option " + in_quotes(bare) + suggestion(bare, parser_->names));
    throw InputError("unexpected argument " + in_quotes(word));
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = one_line(error.what());
    const bool twice = what.find("received") != std::string::npos;
    throw InputError(what.substr(0, what.find(':')) + (twice ? " is given more than once" : " needs a value"));
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + " (see " + parser_->app.get_name() + " --help)");
  }
  for (const auto& convert : parser_->conversions) convert();
  return true;
}

std::string number_advice(const std::string& text) {
  const std::size_t digits = text.find_first_not_of("+-.");
  if (digits == std::string::npos || text[digits] < '0' || text[digits] > '9') return {};
  const std::size_t end = text.find_first_not_of("0123456789.eE+-");
  if (end == std::string::npos) return {};
  if (text[end] == ',' && text.find_first_not_of("0123456789", end + 1) == std::string::npos)
    return " (decimals have a point: 0.5, not 0,5)";
  if (text[end] == ',' || text[end] == ';') return " (one number is expected here)";
  return " (only the number, in the model's units: no unit)";
}

namespace {

/// The value of an expression of numbers, as "pi/2"; nothing if `text` is no such expression.
std::optional<double> constant(const std::string& text) {
  try {
    const Expression expression(text);
    if (expression.names().empty()) return expression.value({});
  } catch (const InputError&) {
  }
  return std::nullopt;
}

/// "1e6" and "1000000.0" are whole numbers too.
std::optional<long long> whole(const std::string& text) {
  constexpr double exact = 9007199254740992.0;  // 2^53: up to here a double is the number that was written
  double value = 0.0;
  if (read_decimal(text, value) != std::errc() || std::floor(value) != value || std::abs(value) > exact)
    return std::nullopt;
  return static_cast<long long>(value);
}

}  // namespace

double parse_number(const std::string& argument, const std::string& text) {
  const std::size_t begin = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  double value = 0.0;
  const std::errc error = read_decimal(std::string_view(text).substr(begin), value);
  if (error == std::errc::result_out_of_range)
    throw InputError(argument + ": " + in_quotes(text) + " is too large or too small for a number");
  if (error != std::errc()) {
    const std::optional<double> computed = constant(text);
    if (!computed) throw InputError(argument + ": " + in_quotes(text) + " is not a number" + number_advice(text));
    value = *computed;
  }
  if (!std::isfinite(value)) throw InputError(argument + ": " + in_quotes(text) + " is not finite");
  return value;
}

long long parse_integer(const std::string& argument, const std::string& text, long long least, long long most) {
  long long value = 0;
  const std::errc error = read_decimal(text, value);
  const std::optional<long long> read = error == std::errc::invalid_argument ? whole(text) : std::nullopt;
  if (error == std::errc::invalid_argument && !read)
    throw InputError(argument + ": " + in_quotes(text) + " is not a whole number");
  value = read.value_or(value);
  if ((error != std::errc() && !read) || value < least || value > most)
    throw InputError(argument + ": " + in_quotes(text) + " is outside [" + std::to_string(least) + ", " +
                     std::to_string(most) + "]");
  return value;
}

}  // namespace slapstick::app
