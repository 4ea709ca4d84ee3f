/// Looks for keys that exclude, replace or need each other.
#include "io/key_rules.hpp"

#include <algorithm>

namespace slapstick {

std::string first_present(const TomlNode& table, std::string_view keys) {
  for (std::size_t begin = 0; begin < keys.size();) {
    const auto end = std::min(keys.find('|', begin), keys.size());
    if (const auto key = keys.substr(begin, end - begin); table.find(key) != nullptr) return std::string(key);
    begin = end + 1;
  }
  return "";
}

bool replaced(const TomlNode& table, const PartRule& rule, std::string_view key) {
  return std::any_of(rule.fields.begin(), rule.fields.end(), [&](const FieldRule& field) {
    return table.find(field.key) != nullptr &&
           ("|" + std::string(field.instead_of) + "|").find("|" + std::string(key) + "|") != std::string::npos;
  });
}

}  // namespace slapstick
