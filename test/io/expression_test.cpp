/// Formulas of parameters: right values, and one-line refusals.
#include "io/expression.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

std::string refusal(const std::string& text, std::map<std::string, double> values = {}) {
  try {
    const Expression expression(text);
    for (const auto& name : expression.names()) values.emplace(name, 1.0);
    (void)expression.evaluate(values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The list of docs/reference/model_file.md.
TEST(Expression, precedence_and_functions_are_as_documented) {
  for (const auto& [text, value] : std::vector<std::pair<const char*, double>>{{"-2^2", -4},
                                                                               {"2^3^2", 512},
                                                                               {"2^-1", 0.5},
                                                                               {"8 / 4 / 2", 1},
                                                                               {"5 - 3 - 1", 1},
                                                                               {"1 || 1 && 0", 1},
                                                                               {"1 + 2 < 4 && 2 != 3", 1},
                                                                               {"0 ? 1 : 0 ? 2 : 3", 3},
                                                                               {"log(exp(2))", 2},
                                                                               {"ln(exp(2))", 2},
                                                                               {"log2(8)", 3},
                                                                               {"log10(1000)", 3},
                                                                               {"sign(-3)", -1},
                                                                               {"rint(2.7)", 3},
                                                                               {"max(3, 1, 2)", 3},
                                                                               {"min(3, 1, 2)", 1},
                                                                               {"sum(1, 2, 3)", 6},
                                                                               {"avg(1, 2, 3)", 2}})
    EXPECT_DOUBLE_EQ(Expression(text).evaluate({}), value) << text;
  EXPECT_DOUBLE_EQ(Expression("atan2(1, -1)").evaluate({}), std::atan2(1, -1));
  for (const char* absent : {"floor", "ceil", "round", "pow", "mod", "e", "cbrt"})
    EXPECT_FALSE(Expression::reserves(absent)) << absent;
}

TEST(Expression, arithmetic) {
  EXPECT_EQ(Expression("2 * a * b").evaluate({{"a", 0.1}, {"b", 5}}), 2 * 0.1 * 5);
  EXPECT_EQ(Expression("-a^2").evaluate({{"a", 3}}), -9);
  EXPECT_EQ(Expression("1 - a").evaluate({{"a", 0.25}}), 0.75);
  EXPECT_EQ(Expression("pi / 2").evaluate({}), std::acos(0.0));
  EXPECT_EQ(Expression("a > 1 ? 2 : 3").evaluate({{"a", 2}}), 2);
  EXPECT_EQ(Expression("min(a, -1)").evaluate({{"a", 2}}), -1);
  EXPECT_EQ(Expression("0.1").evaluate({}), 0.1);
  EXPECT_EQ(Expression("1e-3").evaluate({}), 1e-3);
  EXPECT_EQ(Expression("b + a").names(), (std::vector<std::string>{"a", "b"}));
}

TEST(Expression,
     fractions_are_true_among_constants_too) {  // a parser that joins constants as integers makes 0.5 && 2 zero
  const std::vector<std::string> numbers = {"0", "0.5", "-0.25", "1e-300", "1e300", "2"};
  for (const auto& p : numbers)
    for (const auto& q : numbers) {
      const bool both = p != "0" && q != "0", either = p != "0" || q != "0";
      const std::map<std::string, double> values = {{"a", std::stod(p)}, {"b", std::stod(q)}};
      for (const auto& [left, right] :
           std::vector<std::pair<std::string, std::string>>{{p, q}, {"a", q}, {p, "b"}, {"a", "b"}}) {
        EXPECT_EQ(Expression(left + " && " + right).evaluate(values), both ? 1.0 : 0.0) << left << " " << right;
        EXPECT_EQ(Expression(left + " || " + right).evaluate(values), either ? 1.0 : 0.0) << left << " " << right;
      }
    }
}

TEST(Expression, refusals_are_one_line_and_name_the_trouble) {
  EXPECT_EQ(refusal("1 / a", {{"a", 0}}), "expression '1 / a': its value is inf with a = 0");
  EXPECT_EQ(refusal("sqrt(a) + b", {{"a", -1}, {"b", 2}}).substr(0, 42), "expression 'sqrt(a) + b': its value is -na");
  EXPECT_EQ(refusal(""), "expression '': empty");
  EXPECT_EQ(refusal("0,1"), "expression '0,1': a ',' separates two values (write 0.5, not 0,5)");
  EXPECT_EQ(refusal("a = 3", {{"a", 1}}), "expression 'a = 3': '=' has no meaning here");
  EXPECT_EQ(refusal("\"a\""), "expression '\"a\"': character '\"' has no meaning here");
  EXPECT_EQ(refusal("1\n+1"), "expression '1\\x0a+1': character '\\x0a' has no meaning here");
  EXPECT_NE(refusal(std::string(401, '1')).find("longer than 400 characters"), std::string::npos);
  for (const char* bad :
       {"1 +", "(1", "1)", "2 a", "foo(1)", "1..2", "*", "a b", "sin()", "min()", "?:", "1 ? 2", "0x", "$", "1e999"}) {
    const auto message = refusal(bad, {{"a", 1}, {"b", 1}});
    EXPECT_EQ(message.rfind("expression '", 0), 0U) << bad << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Expression, refusals_name_the_token_and_its_place) {
  const std::string product = " (a product is written with *, and a number has no unit)";
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"1 +", "unexpected end of expression at position 4"},
           {"(1", "missing parenthesis"},
           {"1)", "unexpected parenthesis \")\" at position 1"},
           {"2 a", "unexpected variable \"a\" found at position 2" + product},
           {"2e", "unexpected variable \"e\" found at position 1" + product},
           {"foo(1)", "unexpected parenthesis \"(\" at position 3"},
           {"1..2", "unexpected value \".2\" found at position 2"},
           {"2 pi", "unexpected value \"pi\" found at position 2"},
           {"a sin(b)", "unexpected function \"sin\" at position 2"},
           {"1 + * 2", "unexpected operator \"*\" found at position 4"},
           {"2 + - - 3", "unexpected operator \"-\" found at position 6"},
           {"a % b", "unexpected token \"%\" found at position 2"},
           {"sin()", "too few parameters for function \"sin\" at expression position 4"},
           {"atan2(1)", "too few parameters for function \"atan2\" at expression position 7"},
           {"sin(1, 2)", "too many parameters for function \"sin\" at expression position 8"},
           {"sum(1,, 2)", "unexpected argument separator at position 6"},
           {"a ? b", "if-then-else operator is missing an else clause"},
           {"a : b", "misplaced colon at position 2"},
           {"? a", "the \"?\" operator must be preceded by a closing bracket"},
           {"1e999", "number 1e999 is out of range"}})
    EXPECT_EQ(refusal(text), "expression '" + text + "': " + what);
}

TEST(Expression, what_has_no_value_is_not_hidden_by_a_choice_of_the_larger) {
  for (const char* text : {"max(0, sqrt(a))", "max(sqrt(a), 0)", "min(0, ln(a))", "min(asin(3), 1)"})
    EXPECT_TRUE(std::isnan(Expression(text).value({{"a", -1}}))) << text;
}

TEST(Expression, random_text_never_crashes) {
  const std::vector<std::string> words = {"1",    "a",   "b",   "(",   ")",   ",",  "+",   "-",   "*",    "/",
                                          "^",    "sin", "min", "sum", "?",   ":",  "==",  "<",   "&&",   "||",
                                          ".",    "0x",  "pi",  "e",   "_",   "if", " ",   "!=",  "1e30", "avg",
                                          "rint", ">=",  "!",   "#1",  "0b1", "\\", "max", "sqrt"};
  std::mt19937 random(3);
  for (int i = 0; i < 30000; ++i) {
    std::string text;
    for (auto length = random() % 14; length-- > 0;) text += words[random() % words.size()];
    try {
      const Expression expression(text);
      std::map<std::string, double> values;
      for (const auto& name : expression.names()) values[name] = 0.5;
      EXPECT_TRUE(std::isfinite(expression.evaluate(values))) << text;
    } catch (const InputError&) {
    }
  }
  (void)refusal(std::string(200, '(') + "1" + std::string(200, ')'));
  (void)refusal(std::string(400, '-'));
  (void)refusal(std::string(400, '('));
}

TEST(Expression, threads_do_not_disturb_each_other) {
  const Expression expression("a * 2 + b");
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 5000; ++i)
        if (expression.evaluate({{"a", t}, {"b", i}}) != 2.0 * t + i) ++wrong;
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace slapstick
