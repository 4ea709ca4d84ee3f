#pragma once
/// Small pieces of text for messages, which are always one line.
#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "base/decimal.hpp"

namespace slapstick {

/// A text for a message that may not be needed: a string, or a function that makes one. The source must outlive this.
class LazyText {
 public:
  template <class Source>
  LazyText(const Source& source)  // NOLINT: strings and functions are given as they are
      : source_(&source), make_([](const void* from) -> std::string {
          if constexpr (std::is_invocable_v<const Source&>)
            return (*static_cast<const Source*>(from))();
          else
            return *static_cast<const Source*>(from);
        }) {}
  [[nodiscard]] std::string operator()() const { return make_(source_); }

 private:
  const void* source_;
  std::string (*make_)(const void*);
};

/// Bytes of the character that the text begins with, or 0 if that is a control character or no UTF-8.
[[nodiscard]] inline std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : '\0'); };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) >= 0xc0) return 0;
  const bool control = first == 0xc2 && second < 0xa0;
  const bool longer_than_needed = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool no_character = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  return control || longer_than_needed || no_character ? 0 : length;
}

/// The text in single quotes; control characters and bytes that are no UTF-8 appear as \xNN and more than 100 bytes are
/// cut, so that hostile names stay on one line.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 100;
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "'";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = printable_bytes(text.substr(i));
    if (i + std::max<std::size_t>(length, 1) > most) return out + "...'";
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length > 0)
      out += text.substr(i, length);
    else
      out.append("\\x").append(1, digits[byte >> 4]).append(1, digits[byte & 15]);
    i += std::max<std::size_t>(length, 1);
  }
  return out + "'";
}

[[nodiscard]] inline std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text.append(i == 0 ? "" : separator).append(parts[i]);
  return text;
}

/// Splits at every `separator`; an empty text gives one empty part.
[[nodiscard]] inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The shortest usual notation that reads back as the same double: "0.1", "1e+300", "nan".
[[nodiscard]] inline std::string shown(double value) {
  std::string text;
  double read = 0.0;
  for (int digits = 15; digits <= 17; ++digits) {
    text.clear();
    append_digits(text, value, digits);
    if (read_decimal(text, read) == std::errc{} && read == value) break;
  }
  return text;
}

}  // namespace slapstick
