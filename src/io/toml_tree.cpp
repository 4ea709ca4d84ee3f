// toml++ 3.3 aborts on "[" + newline unless NDEBUG is set here: an assertion of its own, the parser then reports the error.
#ifndef NDEBUG
#define NDEBUG
#endif
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#define TOML_MAX_NESTED_VALUES 8
#include "io/toml_tree.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "io/toml_text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

constexpr int deepest = 16;

std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f)
      out += c;
    else if (c == '\n')
      out += ' ';
  }
  return out;
}

class Converter {
 public:
  explicit Converter(const std::string& source) : source_(source) {}

  TomlNode convert(const toml::node& from, std::size_t line, int depth) const {
    TomlNode node;
    if (from.source().begin.line > line) line = from.source().begin.line;
    node.line = static_cast<int>(line);
    if (depth > deepest)
      throw InputError(toml_place(source_, line) + "nested more than " + std::to_string(deepest) + " deep");
    if (const auto* table = from.as_table()) {
      convert_table(*table, node, depth);
    } else if (const auto* array = from.as_array()) {
      node.kind = TomlNode::Kind::list;
      for (const auto& item : *array) node.items.push_back(convert(item, line, depth + 1));
    } else {
      convert_scalar(from, node);
    }
    return node;
  }

 private:
  /// toml++ sorts keys by name; people's order is that of the lines.
  void convert_table(const toml::table& table, TomlNode& node, int depth) const {
    std::vector<std::tuple<std::size_t, std::size_t, const toml::key*, const toml::node*>> order;
    for (auto&& [key, value] : table)
      order.emplace_back(key.source().begin.line, key.source().begin.column, &key, &value);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
    });
    node.kind = TomlNode::Kind::table;
    for (const auto& [line, column, key, value] : order)
      node.entries.push_back({std::string(key->str()), convert(*value, line, depth + 1)});
  }

  static void convert_scalar(const toml::node& from, TomlNode& node) {
    node.kind = TomlNode::Kind::date;
    if (const auto* text = from.as_string()) {
      node.kind = TomlNode::Kind::text;
      node.text = text->get();
    } else if (from.is_boolean()) {
      node.kind = TomlNode::Kind::boolean;
      node.number = from.as_boolean()->get() ? 1.0 : 0.0;
    } else if (const auto* integer = from.as_integer()) {
      node.kind = TomlNode::Kind::number;
      node.number = static_cast<double>(integer->get());
    } else if (const auto* real = from.as_floating_point()) {
      node.kind = TomlNode::Kind::number;
      node.number = real->get();
    }
  }

  const std::string& source_;
};

}  // namespace

const TomlNode* TomlNode::find(std::string_view key) const {
  for (const auto& [name, node] : entries)
    if (name == key) return &node;
  return nullptr;
}

const char* TomlNode::kind_name() const {
  switch (kind) {
    case Kind::text:
      return "a string";
    case Kind::number:
      return "a number";
    case Kind::boolean:
      return "a boolean";
    case Kind::date:
      return "a date or time";
    case Kind::list:
      return "a list";
    case Kind::table:
      break;
  }
  return "a table";
}

TomlNode parse_toml(std::string_view text, const std::string& source) {
  check_toml_text(text, source);
  try {
    const toml::table table = toml::parse(text);
    return Converter(source).convert(table, 0, 0);
  } catch (const toml::parse_error& error) {
    throw InputError(toml_place(source, error.source().begin.line) + one_line(error.description()));
  }
}

}  // namespace slapstick
