/// Turns names of a model into the text of a picture, in gnuplot's enhanced notation.
#include "axis_text.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/ranges.hpp"

namespace slapstick::app {

std::string axis_text(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '_' ? std::string("\\_") : std::string(1, c);
  return text;
}

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 34> greek = {
    {{"alpha", "\u03b1"},  {"beta", "\u03b2"},   {"gamma", "\u03b3"}, {"delta", "\u03b4"},   {"epsilon", "\u03b5"},
     {"zeta", "\u03b6"},   {"eta", "\u03b7"},    {"theta", "\u03b8"}, {"iota", "\u03b9"},    {"kappa", "\u03ba"},
     {"lambda", "\u03bb"}, {"mu", "\u03bc"},     {"nu", "\u03bd"},    {"xi", "\u03be"},      {"pi", "\u03c0"},
     {"rho", "\u03c1"},    {"sigma", "\u03c3"},  {"tau", "\u03c4"},   {"upsilon", "\u03c5"}, {"phi", "\u03c6"},
     {"chi", "\u03c7"},    {"psi", "\u03c8"},    {"omega", "\u03c9"}, {"Gamma", "\u0393"},   {"Delta", "\u0394"},
     {"Theta", "\u0398"},  {"Lambda", "\u039b"}, {"Xi", "\u039e"},    {"Pi", "\u03a0"},      {"Sigma", "\u03a3"},
     {"Phi", "\u03a6"},    {"Psi", "\u03a8"},    {"Omega", "\u03a9"}, {"varphi", "\u03d5"}}};

/// The letter of a symbol: of a Greek name, or a single letter; "" for a word.
std::string letter(std::string_view name) {
  for (const auto& [word, sign] : greek)
    if (name == word) return std::string(sign);
  return name.size() == 1 ? std::string(name) : "";
}

}  // namespace

std::string parameter_symbol(const std::string& name) {
  const std::size_t cut = name.find('_');
  const std::string first = name.substr(0, cut), sign = letter(first);
  if (sign.empty()) {
    const std::size_t digits = name.find_first_of("0123456789");
    const std::string before = letter(name.substr(0, digits));
    if (digits != std::string::npos && !before.empty() &&
        name.find_first_not_of("0123456789", digits) == std::string::npos)
      return "{/:Italic " + before + "}_{" + name.substr(digits) + "}";
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
  }
  if (cut == std::string::npos) return "{/:Italic " + sign + "}";
  std::string below;
  for (std::size_t begin = cut + 1; begin <= name.size();) {
    const std::size_t end = std::min(name.find('_', begin), name.size());
    const std::string part = name.substr(begin, end - begin), part_sign = letter(part);
    below += (below.empty() ? "" : " ") + (part_sign.empty() ? part : part_sign);
    begin = end + 1;
  }
  return "{/:Italic " + sign + "}_{" + below + "}";
}

std::string parameter_axis(const ModelDefinition& definition, const std::string& name) {
  std::vector<std::string> members = {name};
  for (const Group& group : definition.groups())
    if (group.name == name) members = group.members;
  std::set<std::string> units;
  for (const Parameter& parameter : definition.parameters())
    if (ranges::find(members, parameter.name) != members.end()) units.insert(parameter.unit);
  const bool one = units.size() == 1 && !units.begin()->empty() && *units.begin() != "1";
  return parameter_symbol(name) + (one ? " [" + axis_text(*units.begin()) + "]" : "");
}

std::string axis_symbol(const std::string& name) {
  if (name.size() > 2 && name.starts_with("v_")) return "v_{" + axis_symbol(name.substr(2)) + "}";
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == 1 && name.find_first_not_of("0123456789", digits) == std::string::npos)
    return name.substr(0, 1) + "_{" + name.substr(1) + "}";
  return axis_text(name);
}

}  // namespace slapstick::app
