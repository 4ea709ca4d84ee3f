/// Prints libFuzzer's dictionary for model files: every key and word of the key table, and the tokens of TOML and of
/// expressions.
#include <cstdio>
#include <set>
#include <string>

#include "io/definition.hpp"

namespace slapstick {
namespace {

std::set<std::string> words() {
  std::set<std::string> all;
  const auto add = [&](const auto& list) { all.insert(list.begin(), list.end()); };
  for (const auto& list : {top_keys(), parameter_keys(), matrix_keys(), scale_keys(), quantity_keys(), impact_laws()})
    add(list);
  add(part_keys(harmonic_rule()));
  for (const auto& rule : part_rules()) {
    add(part_keys(rule));
    all.insert("\n[[" + std::string(rule.kind) + "]]\n");
  }
  for (const char* token :
       {"ground", "gap_", "time", "[[",   "]]",     "\n[",  "]\n",   " = ",        "\"\"\"",  "'''",  "true",
        "false",  "inf",  "-nan", "1e50", "1e-300", "0x1F", "1e999", "1979-05-27", "\\u00e9", "\r\n", "\xef\xbb\xbf",
        "sqrt(",  "min(", "?",    ":",    "^",      "<=",   "pi",    "kg m/s^2",   "mm",      "1",    "{ value = "})
    all.insert(token);
  return all;
}

void print(const std::string& word) {
  std::fputc('"', stdout);
  for (const char c : word) {
    const bool plain = c > ' ' && c <= '~' && c != '"' && c != '\\';
    std::printf(plain ? "%c" : "\\x%02x", static_cast<unsigned char>(c));
  }
  std::fputs("\"\n", stdout);
}

}  // namespace
}  // namespace slapstick

int main() {
  for (const std::string& word : slapstick::words()) slapstick::print(word);
}
