/// Doubles as text and back: by <charconv>, and the same by printf and strtod for libraries that lack it.
#include "base/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace slapstick {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers that people write, the ends of the range, and all magnitudes.
std::vector<double> numbers() {
  std::vector<double> all = {0.0,      -0.0,     0.1,      -2.5,     100.0,     12345.0,
                             1e5,      123456.0, 1e15,     1e16,     1e22,      1e23,
                             -1e-5,    0.0001,   0.001234, 1e300,    5e-324,    2e-308,
                             0x1p1023, 0x1p53,   1.0 / 3,  infinity, -infinity, std::numeric_limits<double>::max()};
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double bits = std::bit_cast<double>(random());
    if (std::isfinite(bits)) all.push_back(bits);
    all.push_back(std::ldexp(static_cast<double>(random() % 100000), -static_cast<int>(random() % 40)));
    all.push_back(static_cast<double>(random() % 1000000) / 1000.0);
  }
  return all;
}

double read(std::errc (*reader)(std::string_view, double&), const std::string& text) {
  double value = std::nan("");
  EXPECT_EQ(reader(text, value), std::errc{}) << text;
  return value;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

TEST(Decimal, the_shortest_reads_back_by_both_readers) {
  for (const double x : numbers()) {
    const std::string text = shortest_decimal(x);
    EXPECT_TRUE(same(read(read_decimal, text), x)) << text;
    EXPECT_TRUE(same(read(with_c::read_decimal, text), x)) << text;
  }
}

TEST(Decimal, both_writers_write_the_same) {
  for (const double x : numbers()) {
    EXPECT_EQ(with_c::shortest_decimal(x), shortest_decimal(x));
    EXPECT_EQ(with_c::fixed_decimal(x, 3), fixed_decimal(x, 3));
    for (const int digits : {9, 15, 17}) {
      std::string c, standard;
      with_c::append_digits(c, x, digits);
      append_digits(standard, x, digits);
      EXPECT_EQ(c, standard);
    }
  }
}

TEST(Decimal, notations_are_those_of_the_shorter_text) {
  for (const auto writer : {&shortest_decimal, &with_c::shortest_decimal}) {
    EXPECT_EQ(writer(0.1), "0.1");
    EXPECT_EQ(writer(100.0), "100");
    EXPECT_EQ(writer(100000.0), "1e+05");
    EXPECT_EQ(writer(123456.0), "123456");
    EXPECT_EQ(writer(5e-324), "5e-324");
    EXPECT_EQ(writer(-0.0), "-0");
    EXPECT_EQ(writer(-infinity), "-inf");
  }
}

TEST(Decimal, a_number_is_read_from_end_to_end) {
  for (const auto reader :
       {static_cast<std::errc (*)(std::string_view, double&)>(&read_decimal), &with_c::read_decimal}) {
    for (const char* const text : {"", " 1", "1 ", "+1", "--1", "-", "1e", "1x", "0x10", "1,5", "abc", "e5", "1.2.3"}) {
      double value = 7.0;
      EXPECT_EQ(reader(text, value), std::errc::invalid_argument) << text;
      EXPECT_EQ(value, 7.0) << text;
    }
    for (const char* const text : {"1e400", "-1e400", "1e-400", "0.0001e-330"}) {
      double value = 7.0;
      EXPECT_EQ(reader(text, value), std::errc::result_out_of_range) << text;
      EXPECT_EQ(value, 7.0) << text;
    }
    EXPECT_EQ(read(reader, "0e-999"), 0.0);
    EXPECT_EQ(read(reader, "-.5"), -0.5);
    EXPECT_EQ(read(reader, "5."), 5.0);
    EXPECT_EQ(read(reader, "inf"), infinity);
    EXPECT_TRUE(std::isnan(read(reader, "nan")));
    EXPECT_EQ(read(reader, "2.4703282292062328e-324"), 5e-324);  // just above half the least number
  }
}

TEST(Decimal, whole_numbers_are_read_from_end_to_end) {
  long long value = 0;
  EXPECT_EQ(read_decimal("-12", value), std::errc{});
  EXPECT_EQ(value, -12);
  EXPECT_EQ(read_decimal("12.0", value), std::errc::invalid_argument);
  EXPECT_EQ(read_decimal("99999999999999999999", value), std::errc::result_out_of_range);
}

}  // namespace
}  // namespace slapstick
