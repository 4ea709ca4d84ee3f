/// Reads and evaluates expressions: recursive descent into a program for a stack, which works on numbers with
/// derivatives.
#include "io/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/decimal.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

namespace {

constexpr std::size_t longest = 400;

/// One step of a program: it pushes a number or a parameter, or replaces the last `operands` of the stack by what
/// `symbol` makes of them.
struct Step {
  std::string_view symbol;
  std::size_t operands = 0;
  double number = 0.0;
  std::size_t parameter = 0;
};
constexpr std::string_view a_number = "number", a_parameter = "parameter", choice = "?";

/// What has no place in a formula at all.
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

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw InputError("expression " + in_quotes(text) + ": " + what);
}

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool in_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

/// Reads a text, one function for each level of precedence, loosest first. Positions count from 0.
class Reader {
 public:
  Reader(const std::string& text, std::vector<Step>& program, std::vector<std::string>& parameters)
      : text_(text), program_(program), parameters_(parameters) {}

  void read() {
    conditional();
    if (!at_end()) unexpected(Within::whole);
  }

 private:
  enum class Within { whole, parentheses, arguments, branch };

  [[nodiscard]] char here(std::size_t further = 0) const {
    return at_ + further < text_.size() ? text_[at_ + further] : '\0';
  }
  bool at_end() {
    while (here() == ' ' || here() == '\t') ++at_;
    return at_ == text_.size();
  }
  /// Takes the token if it is next.
  bool take(std::string_view token) {
    if (at_end() || text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  template <std::size_t n>
  std::string_view take_one_of(const std::array<std::string_view, n>& tokens) {
    const auto found = std::find_if(tokens.begin(), tokens.end(), [&](auto token) { return take(token); });
    return found == tokens.end() ? std::string_view() : *found;
  }
  void apply(std::string_view symbol, std::size_t operands) { program_.push_back({symbol, operands}); }

  void conditional() {
    binary<0>();
    if (!take("?")) return;
    conditional();
    if (!take(":")) unexpected(Within::branch);
    conditional();
    apply(choice, 3);
  }

  /// Operators of two numbers by precedence, loosest first; all go from the left.
  template <std::size_t level>
  void binary() {
    using Tokens = std::array<std::string_view, 6>;
    constexpr std::string_view no = "\n";  // which no expression has
    constexpr std::array<Tokens, 5> levels = {{{"||", no, no, no, no, no},
                                               {"&&", no, no, no, no, no},
                                               {"<=", ">=", "==", "!=", "<", ">"},
                                               {"+", "-", no, no, no, no},
                                               {"*", "/", no, no, no, no}}};
    if constexpr (level == levels.size()) {
      signed_power();
    } else {
      binary<level + 1>();
      for (std::string_view symbol; !(symbol = take_one_of(levels[level])).empty(); apply(symbol, 2))
        binary<level + 1>();
    }
  }

  /// -a^b is -(a^b), a^-b^c is a^(-(b^c)).
  void signed_power() {
    const std::string_view sign = take_one_of(std::array<std::string_view, 2>{"-", "+"});
    if (!sign.empty() && !at_end() && (here() == '-' || here() == '+')) unexpected_operand();
    single();
    if (take("^")) {
      signed_power();
      apply("^", 2);
    }
    if (sign == "-") apply("-", 1);
  }

  void single() {
    if (take("(")) {
      conditional();
      if (!take(")")) unexpected(Within::parentheses);
      return;
    }
    const std::string token = at_end() ? "" : word();
    if (token.empty()) unexpected_operand();
    at_ += token.size();
    if (!in_name(token[0]) || is_digit(token[0])) return number(token);
    if (token == "pi") return program_.push_back({a_number, 0, std::numbers::pi});
    if (const Function* known = here() == '(' ? function_named(token) : nullptr) return arguments(*known);
    const auto found = std::find(parameters_.begin(), parameters_.end(), token);
    program_.push_back({a_parameter, 0, 0.0, static_cast<std::size_t>(found - parameters_.begin())});
    if (found == parameters_.end()) parameters_.push_back(token);
  }

  /// The number or name that is next, or nothing.
  [[nodiscard]] std::string word() const {
    std::size_t end = at_;
    if (!is_digit(here()) && !(here() == '.' && is_digit(here(1)))) {
      while (end < text_.size() && in_name(text_[end])) ++end;
      return text_.substr(at_, end - at_);
    }
    const auto digits = [&] {
      while (end < text_.size() && is_digit(text_[end])) ++end;
    };
    digits();
    if (end < text_.size() && text_[end] == '.') ++end;
    digits();
    std::size_t exponent = end + 1;
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      if (exponent < text_.size() && (text_[exponent] == '-' || text_[exponent] == '+')) ++exponent;
      if (exponent < text_.size() && is_digit(text_[exponent])) end = exponent;
      digits();
    }
    return text_.substr(at_, end - at_);
  }

  void number(const std::string& token) {
    double value = 0.0;
    if (read_decimal(token, value) != std::errc{}) refuse(text_, "number " + token + " is out of range");
    program_.push_back({a_number, 0, value});
  }

  void arguments(const Function& function) {
    const std::string name = "parameters for function \"" + std::string(function.name) + "\" at expression position ";
    take("(");
    std::size_t count = 0;
    if (!at_end() && here() == ')') refuse(text_, "too few " + name + std::to_string(at_));
    do {
      conditional();
      ++count;
    } while (take(","));
    if (!take(")")) unexpected(Within::arguments);
    if (count < function.least) refuse(text_, "too few " + name + std::to_string(at_ - 1));
    if (count > function.most) refuse(text_, "too many " + name + std::to_string(at_ - 1));
    apply(function.name, count);
  }

  [[noreturn]] void refuse_token(const std::string& what, const std::string& token,
                                 const std::string& more = "") const {
    refuse(text_, "unexpected " + what + " \"" + token + "\" found at position " + std::to_string(at_) + more);
  }
  [[nodiscard]] std::string place() const { return std::to_string(at_); }

  /// Something else stands where a number should.
  [[noreturn]] void unexpected_operand() {
    if (at_end()) refuse(text_, "unexpected end of expression at position " + std::to_string(at_ + 1));
    const std::string symbol(take_one_of(
        std::array<std::string_view, 13>{"||", "&&", "<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/", "^"}));
    at_ -= symbol.size();
    if (!symbol.empty()) refuse_token("operator", symbol);
    if (here() == '?' || here() == ':')
      refuse(text_, std::string("the \"") + here() + "\" operator must be preceded by a closing bracket");
    unexpected(Within::parentheses);
  }

  /// Something else stands where an operator or an end should.
  [[noreturn]] void unexpected(Within within) {
    const std::string token = at_end() ? "" : word();
    const std::string next = token.empty() && !at_end() ? std::string(1, here()) : "";
    if (!token.empty()) {
      if (is_digit(token[0]) || token[0] == '.' || token == "pi") refuse_token("value", token);
      if (text_[std::min(at_ + token.size(), text_.size() - 1)] == '(' && function_named(token) != nullptr)
        refuse(text_, "unexpected function \"" + token + "\" at position " + place());
      refuse_token("variable", token, " (a product is written with *, and a number has no unit)");
    }
    if (within == Within::branch && (next.empty() || next == ")"))
      refuse(text_, "if-then-else operator is missing an else clause");
    if (next.empty()) refuse(text_, "missing parenthesis");
    if (next == "(" || next == ")") refuse(text_, "unexpected parenthesis \"" + next + "\" at position " + place());
    if (next == ":") refuse(text_, "misplaced colon at position " + place());
    if (next != ",") refuse_token("token", next);
    if (within == Within::whole) refuse(text_, "a ',' separates two values (write 0.5, not 0,5)");
    refuse(text_, "unexpected argument separator at position " + place());
  }

  const std::string& text_;
  std::vector<Step>& program_;
  std::vector<std::string>& parameters_;
  std::size_t at_ = 0;
};

Dual applied(std::string_view symbol, const Dual* x, std::size_t count) {
  if (symbol == choice) return choose(x[0], x[1], x[2]);
  if (in_name(symbol[0])) return call(symbol, {x, count});
  if (count == 1) return -x[0];
  if (symbol == "+") return x[0] + x[1];
  if (symbol == "-") return x[0] - x[1];
  if (symbol == "*") return x[0] * x[1];
  if (symbol == "/") return x[0] / x[1];
  if (symbol == "^") return power(x[0], x[1]);
  if (symbol == "&&") return both(x[0], x[1]);
  return symbol == "||" ? either(x[0], x[1]) : compare(symbol, x[0], x[1]);
}

}  // namespace

struct Expression::Compiled {
  std::string text;
  std::vector<Step> program;
  std::vector<std::string> parameters, names;  ///< as they come; sorted

  template <class ValueOf>
  Dual run(ValueOf value_of) const {
    std::vector<Dual> stack;
    stack.reserve(program.size());
    for (const Step& step : program) {
      if (step.symbol == a_number) {
        stack.push_back({step.number});
      } else if (step.symbol == a_parameter) {
        stack.push_back(value_of(parameters[step.parameter]));
      } else {
        const std::size_t rest = stack.size() - step.operands;
        stack[rest] = applied(step.symbol, &stack[rest], step.operands);
        stack.resize(rest + 1);
      }
    }
    return stack.back();
  }
};

Expression::Expression(const std::string& text) {
  if (const auto reason = foreign(text)) refuse(text, *reason);
  const auto compiled = std::make_shared<Compiled>();
  compiled->text = text;
  Reader(compiled->text, compiled->program, compiled->parameters).read();
  compiled->names = compiled->parameters;
  std::sort(compiled->names.begin(), compiled->names.end());
  compiled_ = compiled;
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
  return compiled_->run([&](const std::string& name) { return Dual{values.at(name)}; }).value;
}

Dual Expression::differentiated(const Duals& values) const {
  return compiled_->run([&](const std::string& name) { return values.at(name); });
}

bool Expression::reserves(std::string_view name) { return name == "pi" || function_named(name) != nullptr; }

}  // namespace slapstick
