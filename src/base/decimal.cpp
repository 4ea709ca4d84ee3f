/// Numbers as decimal text and back.
#include "base/decimal.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <version>

namespace slapstick {
namespace {

constexpr std::size_t longest =
    400;  // of -1.8e308 with all its digits; printf's fixed notation has up to 80 decimals beside

template <class Number>
std::errc read_whole(std::string_view text, Number& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return rest != end ? std::errc::invalid_argument : error;
}

}  // namespace

std::errc read_decimal(std::string_view text, long long& value) { return read_whole(text, value); }

#if defined(__cpp_lib_to_chars)

std::string shortest_decimal(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string fixed_decimal(double value, int decimals) {
  char text[longest];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr};
}

void append_digits(std::string& out, double value, int digits) {
  char text[40];
  out.append(text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr);
}

std::errc read_decimal(std::string_view text, double& value) {
  double read = 0.0;
  const std::errc error = read_whole(text, read);
  if (error == std::errc{}) value = read;
  return error;
}

#else

std::string shortest_decimal(double value) { return with_c::shortest_decimal(value); }
std::string fixed_decimal(double value, int decimals) { return with_c::fixed_decimal(value, decimals); }
void append_digits(std::string& out, double value, int digits) { with_c::append_digits(out, value, digits); }
std::errc read_decimal(std::string_view text, double& value) { return with_c::read_decimal(text, value); }

#endif

namespace with_c {
namespace {

std::string printed(const char* format, int precision, double value) {
  char text[longest];
  std::snprintf(text, sizeof text, format, precision, value);
  return text;
}

}  // namespace

std::string shortest_decimal(double value) {
  std::string scientific;
  int decimals = -1;
  do {
    scientific = printed("%.*e", ++decimals, value);
  } while (decimals < 16 && std::strtod(scientific.c_str(), nullptr) != value);
  if (!std::isfinite(value)) return scientific;
  const int exponent = static_cast<int>(std::strtol(scientific.c_str() + scientific.find('e') + 1, nullptr, 10));
  const std::string fixed = printed("%.*f", decimals > exponent ? decimals - exponent : 0, value);
  return scientific.size() < fixed.size() ? scientific : fixed;
}

std::string fixed_decimal(double value, int decimals) { return printed("%.*f", decimals, value); }

void append_digits(std::string& out, double value, int digits) { out += printed("%.*g", digits, value); }

std::errc read_decimal(std::string_view text, double& value) {
  const std::string copy(text);  // strtod wants an end
  const std::size_t sign = text.starts_with("-") ? 1 : 0;
  if (text.size() == sign || std::string_view("0123456789.iInN").find(text[sign]) == std::string_view::npos ||
      text.find_first_of("xX") != std::string_view::npos)
    return std::errc::invalid_argument;
  char* end = nullptr;
  const double read = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::errc::invalid_argument;
  const bool infinity = text.find_first_of("nN") != std::string_view::npos;
  const bool zero = text.find_first_of("123456789") >= text.find_first_of("eE");
  if ((std::isinf(read) && !infinity) || (read == 0.0 && !zero)) return std::errc::result_out_of_range;
  value = read;
  return std::errc{};
}

}  // namespace with_c
}  // namespace slapstick
