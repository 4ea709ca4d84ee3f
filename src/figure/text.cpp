/// Quotes text for gnuplot, and estimates how wide a label will be.
#include "text.hpp"

#include <array>
#include <cstdio>

#include "base/decimal.hpp"

namespace slapstick::figure {
namespace {

double glyph_em(char c) {
  if (static_cast<unsigned char>(c) < 0x20) return 0;
  if ((c & 0xC0) == 0x80) return 0;  // continues a UTF-8 character
  if (std::string_view(" .,:;'|!ijlI()[]/ftr").find(c) != std::string_view::npos) return 0.40;
  if (std::string_view("mwMW@%").find(c) != std::string_view::npos) return 0.98;
  if (c >= 'A' && c <= 'Z') return 0.72;
  return 0.64;
}

char printable(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c; }

}  // namespace

std::string quote(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += "\u2019";
    else
      out += printable(c);
  }
  return out + "'";
}

std::string quote_file(const std::string& name) {
  std::string out = "'./";
  for (const char c : name) {
    if (c == '\'') out += '\'';
    out += c;
  }
  return out + "'";
}

std::string number(double value) { return shortest_decimal(value); }

std::string fixed(double value, int decimals) { return fixed_decimal(value, decimals); }

std::string quote_colour(Colour colour) {
  std::array<char, 12> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "'#%02x%02x%02x'", colour.red, colour.green, colour.blue);
  return buffer.data();
}

double width_em(std::string_view text) {
  double width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' && i + 1 < text.size() && text[i + 1] == '/') {  // {/Font text}: the font name is not printed
      while (i + 1 < text.size() && text[i] != ' ' && text[i] != '}') ++i;
    } else if (std::string_view("{}^_\\~").find(c) == std::string_view::npos) {
      width += glyph_em(c);
    }
  }
  return width;
}

}  // namespace slapstick::figure
