#pragma once
/// A TOML text as a plain tree with line numbers. toml++ lives behind this file and nowhere else.
#include <string>
#include <string_view>
#include <vector>

namespace slapstick {

struct TomlEntry;

struct TomlNode {
  enum class Kind { text, number, boolean, date, list, table };
  Kind kind = Kind::table;
  std::string text;
  double number = 0.0;             ///< of a number; of a boolean 1 or 0
  std::vector<TomlNode> items;     ///< of a list
  std::vector<TomlEntry> entries;  ///< of a table, in the file's order
  int line = 0;

  [[nodiscard]] const TomlNode* find(std::string_view key) const;
  [[nodiscard]] const char* kind_name() const;  ///< "a number", "a list", ...
};

struct TomlEntry {
  std::string key;
  TomlNode node;
};

/// Largest text that is read, and the most dots or open brackets in one place of a line that is longer than an ordinary
/// one. These bound time, memory and nesting for hostile files: of nested tables the parser needs time by their square.
inline constexpr std::size_t toml_size_limit = std::size_t{1} << 20, toml_ordinary_line = 4096;
inline constexpr int toml_deepest_line = 64;

/// @throws InputError "SOURCE:LINE: what" for anything that is not TOML or exceeds a limit
[[nodiscard]] TomlNode parse_toml(std::string_view text, const std::string& source);

}  // namespace slapstick
