/// Checks the nodes of a file's tree, and says where one is wrong.
#include "io/tree_reader.hpp"

#include <algorithm>
#include <cmath>

#include "base/nearest.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

bool TreeReader::is_parameter(const std::string& name) const { return holds(parameters_, name); }

void TreeReader::fail(int line, const std::string& where, const std::string& what) const {
  throw InputError(source_ + ":" + std::to_string(line) + ": " + where + (where.empty() ? "" : ": ") + what);
}

void TreeReader::expect(const TomlNode& node, Kind kind, const std::string& where) const {
  TomlNode wanted;
  wanted.kind = kind;
  if (node.kind != kind)
    fail(node.line, where, std::string("expected ") + wanted.kind_name() + ", found " + node.kind_name());
}

void TreeReader::check_keys(const TomlNode& table, const std::string& where,
                            const std::vector<std::string>& known) const {
  for (const auto& [key, node] : table.entries)
    if (!holds(known, key)) fail(node.line, where, "unknown key " + in_quotes(key) + suggestion(key, known));
}

void TreeReader::check_count(const TomlNode& node, std::size_t count, const std::string& where) const {
  if (count > most_entries) fail(node.line, where, "more than " + std::to_string(most_entries) + " entries");
}

void TreeReader::check_text(const TomlNode& node, std::string_view line, const std::string& where,
                            std::size_t longest) const {
  if (line.size() > longest) fail(node.line, where, "longer than " + std::to_string(longest) + " bytes");
  for (const char c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      fail(node.line, where, "control character in " + in_quotes(line));
}

void TreeReader::check_new_name(const std::string& name, int line, const std::string& what) const {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const bool plain = !name.empty() && name.size() <= 64 && letter(name[0]) &&
                     std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
  if (!plain)
    fail(line, what + " " + in_quotes(name), "a name is 1 to 64 letters, digits and '_', beginning with a letter");
  if (Expression::reserves(name)) fail(line, what + " " + in_quotes(name), "a function or constant has this name");
}

std::string TreeReader::text(const TomlNode& table, const char* key, const std::string& where) const {
  const auto* node = table.find(key);
  if (node == nullptr) return {};
  expect(*node, Kind::text, where + ": " + key);
  check_text(*node, node->text, where + ": " + key, longest_text);
  return node->text;
}

std::size_t TreeReader::word(const TomlNode& node, const std::string& where,
                             const std::vector<std::string>& words) const {
  expect(node, Kind::text, where);
  const auto found = std::find(words.begin(), words.end(), node.text);
  if (found == words.end())
    fail(node.line, where, "unknown word " + in_quotes(node.text) + suggestion(node.text, words));
  return static_cast<std::size_t>(found - words.begin());
}

bool TreeReader::flag(const TomlNode& node, const std::string& where) const {
  if (node.kind != Kind::boolean)
    fail(node.line, where, std::string("expected true or false, found ") + node.kind_name());
  return node.number != 0.0;
}

double TreeReader::plain_number(const TomlNode& node, const std::string& where) const {
  expect(node, Kind::number, where);
  if (!std::isfinite(node.number)) fail(node.line, where, shown(node.number) + " is not a finite number");
  return node.number;
}

Scalar TreeReader::scalar(const TomlNode& node, const std::string& where) const {
  return scalar(node, where, "parameter", parameters_);
}

Scalar TreeReader::scalar(const TomlNode& node, const std::string& where, const char* what,
                          const std::vector<std::string>& known) const {
  Scalar scalar;
  scalar.line = node.line;
  if (node.kind != Kind::text) {
    if (node.kind != Kind::number)
      fail(node.line, where, std::string("expected a number or an expression, found ") + node.kind_name());
    scalar.number = plain_number(node, where);
    return scalar;
  }
  try {
    scalar.expression.emplace(node.text);
  } catch (const InputError& error) {
    fail(node.line, where, error.what());
  }
  for (const auto& name : scalar.expression->names()) {
    const auto meanings = std::count(known.begin(), known.end(), name);
    const std::string expression = "expression " + in_quotes(node.text) + ": ";
    if (meanings == 0 && &known == &parameters_ && holds(states_, name))
      fail(
          node.line, where,
          expression + in_quotes(name) +
              " changes with the motion: coefficients cannot depend on the state or on time, because a model is linear "
              "between events (an [[observable]] can)");
    if (meanings == 0)
      fail(node.line, where, expression + "unknown " + what + " " + in_quotes(name) + suggestion(name, known));
    if (meanings > 1) fail(node.line, where, expression + in_quotes(name) + " has two meanings here");
  }
  return scalar;
}

}  // namespace slapstick
