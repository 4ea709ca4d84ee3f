#pragma once
/// What is checked of a text before toml++ reads it: what bounds its work, and what it cannot bear.
#include <string>
#include <string_view>

namespace slapstick {

/// Size, length of lines, NUL bytes; and characters beyond ASCII outside of strings and comments, where TOML has none and toml++ 3.3 runs
/// into undefined behaviour for some.
/// @throws InputError "SOURCE:LINE: what"
void check_toml_text(std::string_view text, const std::string& source);

/// "SOURCE:LINE: "
[[nodiscard]] std::string toml_place(const std::string& source, std::size_t line);

}  // namespace slapstick
