#pragma once
/// Several arguments from one text.
#include <string>
#include <string_view>
#include <vector>

namespace slapstick::fuzz {

/// The parts between line breaks; a NUL byte stands for a line break in one.
inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c == '\0' ? '\n' : c;
  }
  return lines;
}

}  // namespace slapstick::fuzz
