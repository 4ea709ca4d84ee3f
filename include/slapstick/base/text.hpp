#pragma once
/// Small pieces of text for messages, which are always one line.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace slapstick {

/// The text in single quotes; control characters appear as \xNN and more than 100 bytes are cut, so that hostile names stay on one line.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 100;
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "'";
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      out += "\\x";
      out += digits[byte >> 4];
      out += digits[byte & 15];
    }
  }
  return out + (text.size() > most ? "...'" : "'");
}

/// The shortest usual notation that reads back as the same double: "0.1", "1e+300", "nan".
[[nodiscard]] inline std::string shown(double value) {
  char text[40];
  for (int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

}  // namespace slapstick
