/// Parses the arguments of one verb; the only source that includes CLI11.
#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/decimal.hpp"
#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/expression.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

struct Arguments::Parser {
  CLI::App app;
  std::vector<std::string> names;  // of the options, with dashes
  std::vector<ArgumentFact> facts;
  std::string notes;
  std::vector<std::function<void()>> conversions;   // texts into numbers, after parsing
  std::map<std::string, const std::string*> texts;  // of options whose value a rule may name

  [[nodiscard]] bool given(const std::string& name) const { return app.get_option(name)->count() > 0; }
  [[nodiscard]] bool holds(const std::string& condition) const;
  void check_rules() const;
  Declared note(ArgumentFact fact);
};

namespace {

/// The text on one line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// "--a, --b or --c".
std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? last : last == "; " ? last : ", ") + words[i];
  return text;
}

}  // namespace

/// "--plot": is it given? "--level full": is this its value, given or not?
bool Arguments::Parser::holds(const std::string& condition) const {
  const std::size_t space = condition.find(' ');
  if (space == std::string::npos) return given(condition);
  return *texts.at(condition.substr(0, space)) == condition.substr(space + 1);
}

void Arguments::Parser::check_rules() const {
  const auto met = [this](const std::string& condition) { return holds(condition); };
  for (const ArgumentFact& fact : facts) {
    if (fact.kind == ArgumentFact::Kind::positional) continue;
    if (fact.required && !given(fact.name)) throw InputError(fact.name + " " + fact.value + " is required");
    if (!given(fact.name)) continue;
    for (const std::vector<std::string>& one_of : fact.with)
      if (ranges::none_of(one_of, met)) throw InputError(fact.name + ": only with " + listed(one_of, " or "));
    if (const auto other = ranges::find_if(fact.without, met); other != fact.without.end())
      throw InputError(fact.name + ": not with " + *other);
  }
}

bool NumberRange::all() const { return std::isinf(least) && std::isinf(most); }

bool NumberRange::has(double value) const {
  return (above ? value > least : value >= least) && (below ? value < most : value <= most);
}

std::string NumberRange::text() const {
  const std::string from = std::isinf(least) ? "(-inf" : (above ? "(" : "[") + shown(least);
  return from + ", " + (std::isinf(most) ? "inf)" : shown(most) + (below ? ")" : "]"));
}

std::string ArgumentFact::described() const {
  std::vector<std::string> rules;
  if (required && kind != Kind::positional) rules.push_back("required");
  if (!range.all()) rules.push_back("in " + range.text());
  for (const std::vector<std::string>& one_of : with) rules.push_back("with " + listed(one_of, " or "));
  if (!without.empty()) rules.push_back("not with " + listed(without, ", "));
  return rules.empty() ? help : help + " [" + listed(rules, "; ") + "]";
}

Arguments::Declared& Arguments::Declared::with(std::vector<std::string> one_of) {
  parser_.facts[index_].with.push_back(std::move(one_of));
  describe();
  return *this;
}

Arguments::Declared& Arguments::Declared::without(const std::vector<std::string>& others) {
  std::vector<std::string>& all = parser_.facts[index_].without;
  all.insert(all.end(), others.begin(), others.end());
  describe();
  return *this;
}

Arguments::Declared& Arguments::Declared::required() {
  parser_.facts[index_].required = true;
  describe();
  return *this;
}

void Arguments::Declared::describe() {
  const ArgumentFact& fact = parser_.facts[index_];
  parser_.app.get_option(fact.name)->description(fact.described());
}

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

Arguments::Declared Arguments::Parser::note(ArgumentFact fact) {
  names.push_back(fact.name);
  facts.push_back(std::move(fact));
  Declared declared(*this, facts.size() - 1);
  declared.describe();
  return declared;
}

Arguments::Declared Arguments::text(const std::string& name, std::string& target, const std::string& value,
                                    const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name(value);
  parser_->texts[name] = &target;
  return parser_->note({ArgumentFact::Kind::text, name, value, help});
}

Arguments::Declared Arguments::repeated(const std::string& name, std::vector<std::string>& target,
                                        const std::string& value, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name(value)->allow_extra_args(false);
  return parser_->note({ArgumentFact::Kind::repeated, name, value, help});
}

Arguments::Declared Arguments::number(const std::string& name, double& target, const std::string& value,
                                      const std::string& help, NumberRange range) {
  auto words = std::make_shared<std::string>();
  parser_->app.add_option(name, *words, help)->type_name(value);
  parser_->conversions.emplace_back([this, name, words, range, &target] {
    if (!given(name)) return;
    target = parse_number(name, *words);
    if (!range.has(target)) throw InputError(name + ": " + shown(target) + " is outside " + range.text());
  });
  return parser_->note(
      {.kind = ArgumentFact::Kind::number, .name = name, .value = value, .help = help, .range = range});
}

Arguments::Declared Arguments::count(const std::string& name, long long& target, long long least, long long most,
                                     const std::string& help) {
  auto words = std::make_shared<std::string>();
  parser_->app.add_option(name, *words, help)->type_name("N");
  parser_->conversions.emplace_back([this, name, words, least, most, &target] {
    if (given(name)) target = parse_integer(name, *words, least, most);
  });
  return parser_->note(
      {.kind = ArgumentFact::Kind::count, .name = name, .value = "N", .help = help, .least = least, .most = most});
}

Arguments::Declared Arguments::choice(const std::string& name, std::string& target,
                                      const std::vector<std::string>& words, const std::string& help) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : "|") + word;
  parser_->app.add_option(name, target, help)->type_name(list);
  parser_->texts[name] = &target;
  parser_->conversions.emplace_back([name, words, &target] {
    if (std::find(words.begin(), words.end(), target) == words.end())
      throw InputError(name + ": " + in_quotes(target) + " is not one of its words" + suggestion(target, words));
  });
  return parser_->note({.kind = ArgumentFact::Kind::choice, .name = name, .value = list, .help = help, .words = words});
}

Arguments::Declared Arguments::flag(const std::string& name, bool& target, const std::string& help) {
  parser_->app.add_flag(name, target, help);
  return parser_->note({ArgumentFact::Kind::flag, name, "", help});
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

bool Arguments::given(const std::string& name) const { return parser_->given(name); }

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

void Arguments::check_rules() const { parser_->check_rules(); }

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
