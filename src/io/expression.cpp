/// Evaluates expressions; the only source that includes muParser.
#include "io/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>

#include "slapstick/base/error.hpp"
#include "base/text.hpp"

namespace slapstick {

namespace {

constexpr std::size_t longest = 400;

class FormulaParser : public mu::Parser {
 public:
  FormulaParser() {
    ClearConst();
    DefineConst("pi", std::numbers::pi);
  }
};

/// muParser also knows strings and assignments; neither has a place in a formula.
std::optional<std::string> foreign(const std::string& text) {
  if (text.size() > longest) return "longer than " + std::to_string(longest) + " characters";
  if (text.find_first_not_of(" \t") == std::string::npos) return "empty";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool printable = (c >= ' ' && c <= '~') || c == '\t';
    if (!printable || c == '"') return "character " + in_quotes(std::string(1, c)) + " has no meaning here";
    if (c != '=') continue;
    const bool comparison =
        (i > 0 && std::string_view("=<>!").find(text[i - 1]) != std::string_view::npos) || text.substr(i + 1, 1) == "=";
    if (!comparison) return "'=' has no meaning here";
  }
  return std::nullopt;
}

/// muParser's optimizer joins constants by && and || as integers: 0.5 && 2 would be 0. Formulas without these keep it,
/// and their rounding.
bool has_logic(const std::string& text) {
  return text.find("&&") != std::string::npos || text.find("||") != std::string::npos;
}

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw InputError("expression " + in_quotes(text) + ": " + what);
}

std::string lowered(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  while (!text.empty() && text.back() == '.') text.pop_back();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace

struct Expression::Compiled {
  std::string text;
  std::vector<std::string> names;
  std::vector<double> values;  // what the parser's variables point to
  FormulaParser parser;
  std::mutex mutex;  // guards values and parser
};

Expression::Expression(const std::string& text) {
  if (const auto reason = foreign(text)) refuse(text, *reason);
  compiled_ = std::make_shared<Compiled>();
  auto& compiled = *compiled_;
  compiled.text = text;
  try {
    if (has_logic(text)) compiled.parser.EnableOptimizer(false);
    compiled.parser.SetExpr(text);
    for (const auto& [name, unused] : compiled.parser.GetUsedVar()) compiled.names.push_back(name);
    compiled.values.assign(compiled.names.size(), 1.0);
    for (std::size_t i = 0; i < compiled.names.size(); ++i)
      compiled.parser.DefineVar(compiled.names[i], &compiled.values[i]);
    int results = 0;
    compiled.parser.Eval(results);
    if (results != 1) refuse(text, "a ',' separates two values (write 0.5, not 0,5)");
  } catch (const mu::ParserError& error) {
    const bool product = error.GetCode() == mu::ecUNEXPECTED_VAR;  // 1 kg, 2 x
    refuse(text, lowered(error.GetMsg()) + (product ? " (a product is written with *, and a number has no unit)" : ""));
  }
}

const std::string& Expression::text() const { return compiled_->text; }

const std::vector<std::string>& Expression::names() const { return compiled_->names; }

double Expression::evaluate(const std::map<std::string, double>& values) const {
  const double result = value(values);
  if (std::isfinite(result)) return result;
  std::string with;
  for (const auto& name : compiled_->names)
    with += (with.empty() ? " with " : ", ") + name + " = " + shown(values.at(name));
  refuse(compiled_->text, "its value is " + shown(result) + with);
}

double Expression::value(const std::map<std::string, double>& values) const {
  auto& compiled = *compiled_;
  const std::scoped_lock lock(compiled.mutex);
  for (std::size_t i = 0; i < compiled.names.size(); ++i) compiled.values[i] = values.at(compiled.names[i]);
  try {
    return compiled.parser.Eval();
  } catch (const mu::ParserError&) {  // a function has no value there
    return std::numeric_limits<double>::quiet_NaN();
  }
}

bool Expression::reserves(std::string_view name) {
  static const FormulaParser parser;
  return name == "pi" || parser.GetFunDef().count(std::string(name)) != 0;
}

}  // namespace slapstick
