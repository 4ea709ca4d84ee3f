#pragma once
/// Numbers as decimal text and back, correctly rounded, in every locale: the one door to <charconv>, which not every
/// C++ library has for doubles.
#include <string>
#include <string_view>
#include <system_error>

namespace slapstick {

/// The shortest text that reads back as the same double, in the shorter of its two notations: "0.1", "100", "1e+05".
[[nodiscard]] std::string shortest_decimal(double value);

/// With this number of digits behind the point, as printf's %.*f.
[[nodiscard]] std::string fixed_decimal(double value, int decimals);

/// Appends with at most this number of significant digits, as printf's %.*g. 17 digits read back as the same double.
void append_digits(std::string& out, double value, int digits);

/// Reads a text that is a number from end to end: no blanks, no leading `+`, no hexadecimals; "inf", "nan" are some.
/// Returns errc{}, invalid_argument, or result_out_of_range where the nearest double is infinite, or wrongly zero. Only
/// errc{} sets `value`.
[[nodiscard]] std::errc read_decimal(std::string_view text, double& value);
[[nodiscard]] std::errc read_decimal(std::string_view text, long long& value);

/// The same with printf and strtod, for a C++ library without <charconv> of doubles. These functions need a locale with
/// a decimal point.
namespace with_c {
[[nodiscard]] std::string shortest_decimal(double value);
[[nodiscard]] std::string fixed_decimal(double value, int decimals);
void append_digits(std::string& out, double value, int digits);
[[nodiscard]] std::errc read_decimal(std::string_view text, double& value);
}  // namespace with_c

}  // namespace slapstick
