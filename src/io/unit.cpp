/// Parses units of measurement and multiplies them.
#include "io/unit.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "base/elementary.hpp"
#include "base/nearest.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

struct Named {
  const char* name;
  Unit unit;
};

const std::vector<Named>& known_units() {
  static const std::vector<Named> units = {
      {"m", {1.0, {1, 0, 0}}},     {"km", {1e3, {1, 0, 0}}},    {"cm", {1e-2, {1, 0, 0}}},
      {"mm", {1e-3, {1, 0, 0}}},   {"um", {1e-6, {1, 0, 0}}},   {"nm", {1e-9, {1, 0, 0}}},
      {"in", {0.0254, {1, 0, 0}}}, {"ft", {0.3048, {1, 0, 0}}}, {"s", {1.0, {0, 1, 0}}},
      {"ms", {1e-3, {0, 1, 0}}},   {"us", {1e-6, {0, 1, 0}}},   {"min", {60.0, {0, 1, 0}}},
      {"h", {3600.0, {0, 1, 0}}},  {"kg", {1.0, {0, 0, 1}}},    {"g", {1e-3, {0, 0, 1}}},
      {"mg", {1e-6, {0, 0, 1}}},   {"t", {1e3, {0, 0, 1}}},     {"N", {1.0, {1, -2, 1}}},
      {"mN", {1e-3, {1, -2, 1}}},  {"kN", {1e3, {1, -2, 1}}},   {"MN", {1e6, {1, -2, 1}}},
      {"J", {1.0, {2, -2, 1}}},    {"mJ", {1e-3, {2, -2, 1}}},  {"kJ", {1e3, {2, -2, 1}}},
      {"W", {1.0, {2, -3, 1}}},    {"kW", {1e3, {2, -3, 1}}},   {"Pa", {1.0, {-1, -2, 1}}},
      {"kPa", {1e3, {-1, -2, 1}}}, {"MPa", {1e6, {-1, -2, 1}}}, {"GPa", {1e9, {-1, -2, 1}}},
      {"Hz", {1.0, {0, -1, 0}}},   {"rad", {1.0, {0, 0, 0}}},   {"deg", {std::numbers::pi / 180, {0, 0, 0}}},
      {"1", {1.0, {0, 0, 0}}},     {"%", {1e-2, {0, 0, 0}}},
  };
  return units;
}

const Unit* find_unit(std::string_view name) {
  for (const auto& known : known_units())
    if (name == known.name) return &known.unit;
  return nullptr;
}

/// "Nmm" as "N mm", "m/s2" as "m/s^2": two known names, or a name and its power, written together.
std::string taken_apart(const std::string& name) {
  constexpr std::size_t longest = 3;  // of the known names
  if (name.size() > 2 * longest) return {};
  for (std::size_t i = 1; i < name.size(); ++i) {
    const std::string head = name.substr(0, i), tail = name.substr(i);
    if (find_unit(head) == nullptr) continue;
    if (i + 1 == name.size() && tail[0] >= '2' && tail[0] <= '9') return head + "^" + tail;
    if (tail != "1" && !head.ends_with(tail) && find_unit(tail) != nullptr) return head + " " + tail;
  }
  return {};
}

/// What was meant, or else every name.
std::string hint(const std::string& name) {
  if (name == "rpm") return "; a speed of rotation is in rad/s (1 rpm = 0.10471975511965977 rad/s) or 1/min";
  if (const auto parts = taken_apart(name); !parts.empty()) return "; did you mean " + in_quotes(parts) + "?";
  std::vector<std::string> names;
  std::string all;
  for (const auto& known : known_units()) {
    names.emplace_back(known.name);
    all += (all.empty() ? "; known: " : " ") + names.back();
  }
  const std::string best = name.size() > 2 ? nearest(name, names) : "";
  return best.empty() ? all : "; did you mean " + in_quotes(best) + "? (docs/reference/model_file.md lists them)";
}

Unit named_unit(const std::string& name) {
  if (const Unit* unit = find_unit(name)) return *unit;
  throw InputError("unknown unit " + in_quotes(name) + hint(name));
}

/// Both characters that look like it, the micro sign and the Greek mu, as the u of "um".
std::string with_ascii_micro(std::string text) {
  for (const std::string_view micro : {"\u00b5", "\u03bc"})
    for (auto at = text.find(micro); at != std::string::npos; at = text.find(micro, at))
      text.replace(at, micro.size(), "u");
  return text;
}

/// "s" or "s^2" or "s^-2".
void multiply(Unit& product, const std::string& factor, int sign) {
  const auto caret = factor.find('^');
  const Unit unit = named_unit(factor.substr(0, caret));
  int power = 1;
  if (caret != std::string::npos) {
    const std::string text = factor.substr(caret + 1);
    char* end = nullptr;
    const long number = std::strtol(text.c_str(), &end, 10);
    if (text.empty() || *end != '\0' || number < -9 || number > 9)
      throw InputError("unit " + in_quotes(factor) + ": a power is a whole number in [-9, 9]");
    power = static_cast<int>(number);
  }
  power *= sign;
  product.factor *= fixed::power(unit.factor, power);
  for (std::size_t i = 0; i < product.powers.size(); ++i) product.powers[i] += power * unit.powers[i];
}

}  // namespace

Unit parse_unit(const std::string& given) {
  const std::string text = with_ascii_micro(given);
  Unit product;
  std::string factor;
  int sign = 1;
  bool wanted = true;  // after the beginning, '*' or '/'
  const auto finish = [&] {
    if (factor.empty()) return;
    multiply(product, factor, sign);
    factor.clear();
    sign = 1;
    wanted = false;
  };
  for (const char c : text) {
    if (c != ' ' && c != '*' && c != '/') {
      factor += c;
      continue;
    }
    finish();
    if (c == ' ') continue;
    if (wanted) throw InputError("unit " + in_quotes(text) + ": a unit is missing before '" + c + "'");
    wanted = true;
    sign = c == '/' ? -1 : 1;
  }
  finish();
  if (wanted)
    throw InputError("unit " + in_quotes(text) + ": a unit is missing at its end (write \"1\" for a plain number)");
  if (!(product.factor >= 1e-100 && product.factor <= 1e100))
    throw InputError("unit " + in_quotes(text) + " is too large or too small: beyond 1e100 of the basic units");
  return product;
}

}  // namespace slapstick
