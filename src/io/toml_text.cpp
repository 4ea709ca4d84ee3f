#include "io/toml_text.hpp"

#include <algorithm>

#include "io/toml_tree.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick {
namespace {

void check_limits(std::string_view text, const std::string& source) {
  if (text.size() > toml_size_limit)
    throw InputError(source + ": larger than " + std::to_string(toml_size_limit) + " bytes");
  std::size_t line = 1, begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\0') throw InputError(toml_place(source, line) + "a NUL byte");
    if (text[i] == '\n') {
      ++line;
      begin = i + 1;
    }
    if (i + 1 - begin > toml_line_limit)
      throw InputError(toml_place(source, line) + "a line longer than " + std::to_string(toml_line_limit) + " bytes");
  }
}

/// Whether a quote at `at` can begin a string. One in the middle of a word cannot, and toml++ looks for the end of the word.
bool may_begin(std::string_view text, std::size_t at) {
  return at == 0 || std::string_view(" \t\r\n=[,{.").find(text[at - 1]) != std::string_view::npos;
}

/// The end of the string that begins with the quote at `at`; in a text that is no TOML, of the line.
std::size_t string_end(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool several_lines = text.substr(at, 3) == std::string(3, quote);
  for (std::size_t i = at + (several_lines ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (several_lines && text.substr(i, 3) == std::string(3, quote)) {
      return std::min(text.find_first_not_of(quote, i), i + 5);  // the string itself may end with two quotes
    } else if (!several_lines && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    }
  }
  return text.size();
}

void check_ascii(std::string_view text, const std::string& source) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  for (std::size_t i = text.substr(0, mark.size()) == mark ? mark.size() : 0; i < text.size();) {
    if ((text[i] == '"' || text[i] == '\'') && may_begin(text, i)) {
      i = string_end(text, i);
    } else if (text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (static_cast<unsigned char>(text[i]) < 0x80) {
      ++i;
    } else {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
      const auto length = std::max<std::size_t>(printable_bytes(text.substr(i)), 1);
      throw InputError(toml_place(source, static_cast<std::size_t>(line)) + "character " +
                       in_quotes(text.substr(i, length)) + " has no meaning outside of quotes");
    }
  }
}

}  // namespace

std::string toml_place(const std::string& source, std::size_t line) {
  return source + ":" + std::to_string(line) + ": ";
}

void check_toml_text(std::string_view text, const std::string& source) {
  check_limits(text, source);
  check_ascii(text, source);
}

}  // namespace slapstick
