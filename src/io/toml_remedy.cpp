/// Says what the author of a line that is no TOML most likely meant.
#include "io/toml_remedy.hpp"

#include <cctype>
#include <optional>

#include "base/ranges.hpp"
#include "base/text.hpp"

namespace slapstick {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool word(char c) { return digit(c) || std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::string_view last_word(std::string_view text) {
  text = trimmed(text);
  std::size_t begin = text.size();
  while (begin > 0 && word(text[begin - 1])) --begin;
  return text.substr(begin);
}

/// The value that begins the text: up to a comment, the end of its table, or the next `, key =`.
std::string_view value_of(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    depth += (c == '(') - (c == ')');
    if (c == '#' || c == '}') return trimmed(text.substr(0, i));
    if (c != ',' || depth > 0) continue;
    const auto rest = trimmed(text.substr(i + 1));
    const auto end = ranges::find_if_not(rest, word) - rest.begin();
    if (end > 0 && trimmed(rest.substr(static_cast<std::size_t>(end))).starts_with('='))
      return trimmed(text.substr(0, i));
  }
  return trimmed(text);
}

/// How many characters from `begin` are digits.
std::size_t digits(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && digit(text[end])) ++end;
  return end - begin;
}

/// "0,5" as "0.5".
std::optional<std::string> with_point(std::string_view value) {
  const std::size_t sign = value.starts_with('-') || value.starts_with('+') ? 1 : 0;
  const std::size_t whole = digits(value, sign), comma = sign + whole;
  if (whole == 0 || comma >= value.size() || value[comma] != ',') return std::nullopt;
  const std::size_t part = digits(value, comma + 1);
  if (part == 0 || comma + 1 + part != value.size()) return std::nullopt;
  std::string text(value);
  text[comma] = '.';
  return text;
}

/// "1 kg", "0.5mm": a number, then a word.
bool has_unit(std::string_view value) {
  std::size_t end = 0;
  while (end < value.size() && (digit(value[end]) || value[end] == '.')) ++end;
  const auto rest = trimmed(value.substr(end));
  return end > 0 && !rest.empty() && std::isalpha(static_cast<unsigned char>(rest[0])) != 0 &&
         rest.find_first_of("+*(") == std::string_view::npos;
}

/// Something that TOML reads: text, lists and tables, true, false, a number or date.
bool readable(std::string_view value) {
  if (value.empty() || std::string_view("\"'[{").find(value[0]) != std::string_view::npos) return true;
  if (value == "true" || value == "false") return true;
  const std::size_t sign = value.starts_with('-') || value.starts_with('+') ? 1 : 0;
  return sign < value.size() && digit(value[sign]) &&
         value.find_first_not_of("0123456789.eE+-_:TZ", sign) == std::string_view::npos;
}

}  // namespace

std::string toml_remedy(std::string_view line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0' || c == '"' || c == '\'') {
      if (quote == '\0' || quote == c) quote = quote == '\0' ? c : '\0';
      continue;
    }
    if (c == '#') break;
    if (c != '=') continue;
    const auto key = last_word(line.substr(0, i)), value = value_of(line.substr(i + 1));
    if (key.empty() || value.size() > 200) continue;
    if (const auto number = with_point(value))
      return std::string(key) + ": write " + *number + ", not " + std::string(value);
    if (readable(value)) continue;
    const std::string what = std::string(key) + ": " + in_quotes(value) + " is no number";
    if (has_unit(value)) return what + ": a number has no unit; a parameter may have a key 'unit'";
    if (value.find_first_of("\"'") != std::string_view::npos) return {};
    return what + ": an expression or text stands in quotes, " + std::string(key) + " = \"" + std::string(value) + "\"";
  }
  return {};
}

}  // namespace slapstick
