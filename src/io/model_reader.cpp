#include <algorithm>
#include <cmath>

#include "io/definition.hpp"
#include "io/toml_tree.hpp"
#include "model/fault.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/nearest.hpp"

namespace slapstick {
namespace {

constexpr std::size_t most_entries =
    1000;  // of one kind; also bounds the depth of expressions that refer to each other
constexpr std::size_t longest_text = 500;
constexpr std::size_t longest_notes_line = 1000;

using Kind = TomlNode::Kind;

/// Fills a Definition from a tree. `where` in every function is the part, for messages: "spring 2", "parameter 'omega'".
class Reader {
 public:
  explicit Reader(const std::string& source) { definition_.source = source; }

  Definition read(const TomlNode& root) {
    check_keys(root, "", top_keys());
    definition_.name = text(root, "name", "model", longest_text);
    if (definition_.name.empty()) fail(1, "model", "'name' is missing");
    definition_.summary = text(root, "summary", "model", longest_text);
    definition_.notes = notes(root);
    read_parameters(root);
    read_groups(root);
    for (const auto& rule : part_rules()) read_parts(root, rule);
    if (const auto* omega = root.find("omega")) definition_.omega = scalar(*omega, "omega");
    if (const auto* start = root.find("start")) read_start(*start);
    return std::move(definition_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& where, const std::string& what) const {
    throw InputError(definition_.place(line) + where + (where.empty() ? "" : ": ") + what);
  }

  static std::vector<std::string> top_keys() {
    std::vector<std::string> keys = {"name", "summary", "notes", "omega", "parameters", "groups", "start"};
    for (const auto& rule : part_rules()) keys.emplace_back(rule.kind);
    return keys;
  }

  void expect(const TomlNode& node, Kind kind, const std::string& where) const {
    TomlNode wanted;
    wanted.kind = kind;
    if (node.kind != kind)
      fail(node.line, where, std::string("expected ") + wanted.kind_name() + ", found " + node.kind_name());
  }

  void check_keys(const TomlNode& table, const std::string& where, const std::vector<std::string>& known) const {
    for (const auto& [key, node] : table.entries)
      if (std::find(known.begin(), known.end(), key) == known.end())
        fail(node.line, where, "unknown key " + in_quotes(key) + suggestion(key, known));
  }

  void check_count(const TomlNode& node, std::size_t count, const std::string& where) const {
    if (count > most_entries) fail(node.line, where, "more than " + std::to_string(most_entries) + " entries");
  }

  /// A one-line text, or "" if the key is absent.
  std::string text(const TomlNode& table, const char* key, const std::string& where, std::size_t longest) const {
    const auto* node = table.find(key);
    if (node == nullptr) return {};
    expect(*node, Kind::text, where + ": " + key);
    check_text(*node, node->text, where + ": " + key, longest);
    return node->text;
  }

  void check_text(const TomlNode& node, std::string_view line, const std::string& where, std::size_t longest) const {
    if (line.size() > longest) fail(node.line, where, "longer than " + std::to_string(longest) + " bytes");
    for (const char c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        fail(node.line, where, "control character in " + in_quotes(line));
  }

  /// The only text with several lines.
  std::string notes(const TomlNode& root) const {
    const auto* node = root.find("notes");
    if (node == nullptr) return {};
    expect(*node, Kind::text, "notes");
    std::string kept = node->text;
    kept.erase(std::remove(kept.begin(), kept.end(), '\r'), kept.end());
    for (std::size_t begin = 0; begin <= kept.size();) {
      const auto end = std::min(kept.find('\n', begin), kept.size());
      check_text(*node, std::string_view(kept).substr(begin, end - begin), "notes", longest_notes_line);
      begin = end + 1;
    }
    return kept;
  }

  double plain_number(const TomlNode& node, const std::string& where) const {
    expect(node, Kind::number, where);
    if (!std::isfinite(node.number)) fail(node.line, where, shown(node.number) + " is not a finite number");
    return node.number;
  }

  /// A number or an expression of parameters that exist.
  Scalar scalar(const TomlNode& node, const std::string& where) const {
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
    for (const auto& name : scalar.expression->names())
      if (std::find(names_.begin(), names_.end(), name) == names_.end())
        fail(
            node.line, where,
            "expression " + in_quotes(node.text) + ": unknown parameter " + in_quotes(name) + suggestion(name, names_));
    return scalar;
  }

  void read_parameters(const TomlNode& root) {
    const auto* table = root.find("parameters");
    if (table == nullptr) return;
    expect(*table, Kind::table, "parameters");
    check_count(*table, table->entries.size(), "parameters");
    for (const auto& [name, node] : table->entries) {
      check_new_name(name, node.line, "parameter");
      names_.push_back(name);
    }
    for (const auto& [name, node] : table->entries) definition_.parameters.push_back(parameter(name, node));
  }

  void check_new_name(const std::string& name, int line, const std::string& what) const {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const bool plain =
        !name.empty() && name.size() <= 64 && letter(name[0]) &&
        std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
    if (!plain)
      fail(line, what + " " + in_quotes(name), "a name is 1 to 64 letters, digits and '_', beginning with a letter");
    if (Expression::reserves(name))
      fail(line, what + " " + in_quotes(name), "this is the name of a function or constant");
  }

  ParameterEntry parameter(const std::string& name, const TomlNode& node) const {
    const std::string where = "parameter " + in_quotes(name);
    ParameterEntry entry;
    entry.shown.name = name;
    if (node.kind == Kind::table) {
      check_keys(node, where, {"value", "min", "max", "above", "below", "description", "unit"});
      const auto* value = node.find("value");
      if (value == nullptr) fail(node.line, where, "'value' is missing");
      entry.value = scalar(*value, where + ": value");
      entry.shown.description = text(node, "description", where, longest_text);
      entry.shown.unit = text(node, "unit", where, longest_text);
      read_bound(node, where, {"min", "above"}, entry.shown.min, entry.shown.min_open);
      read_bound(node, where, {"max", "below"}, entry.shown.max, entry.shown.max_open);
      const auto& shown = entry.shown;
      if (shown.min > shown.max || (shown.min == shown.max && (shown.min_open || shown.max_open)))
        fail(node.line, where, "the range " + shown.range() + " is empty");
    } else {
      entry.value = scalar(node, where);
    }
    if (entry.value.expression) entry.shown.expression = entry.value.expression->text();
    return entry;
  }

  /// `keys` are the closed and the open form of one bound.
  void read_bound(const TomlNode& node, const std::string& where, std::array<const char*, 2> keys, double& bound,
                  bool& open) const {
    const auto* closed_form = node.find(keys[0]);
    const auto* open_form = node.find(keys[1]);
    if (closed_form && open_form)
      fail(open_form->line, where, std::string("both '") + keys[0] + "' and '" + keys[1] + "' are given");
    open = open_form != nullptr;
    if (closed_form) bound = plain_number(*closed_form, where + ": " + keys[0]);
    if (open_form) bound = plain_number(*open_form, where + ": " + keys[1]);
  }

  void read_groups(const TomlNode& root) {
    const auto* table = root.find("groups");
    if (table == nullptr) return;
    expect(*table, Kind::table, "groups");
    check_count(*table, table->entries.size(), "groups");
    for (const auto& [name, node] : table->entries) {
      const std::string where = "group " + in_quotes(name);
      check_new_name(name, node.line, "group");
      if (std::find(names_.begin(), names_.end(), name) != names_.end())
        fail(node.line, where, "a parameter has this name");
      expect(node, Kind::list, where);
      GroupEntry group{{name, {}}, node.line};
      check_count(node, node.items.size(), where);
      for (const auto& item : node.items) {
        expect(item, Kind::text, where);
        if (std::find(names_.begin(), names_.end(), item.text) == names_.end())
          fail(item.line, where, "unknown parameter " + in_quotes(item.text) + suggestion(item.text, names_));
        group.shown.members.push_back(item.text);
      }
      if (group.shown.members.empty()) fail(node.line, where, "it is empty");
      definition_.groups.push_back(std::move(group));
    }
  }

  void read_parts(const TomlNode& root, const PartRule& rule) {
    const auto* list = root.find(rule.kind);
    const std::string kind(rule.kind);
    if (list == nullptr) return;
    if (list->kind != Kind::list)
      fail(list->line, kind, std::string("expected [[") + kind + "]], found " + list->kind_name());
    check_count(*list, list->items.size(), kind);
    auto& parts = definition_.parts[kind];
    for (std::size_t i = 0; i < list->items.size(); ++i) parts.push_back(part(list->items[i], rule, i));
    if (kind == "coordinate") keep_coordinates(parts);
  }

  /// A sweep's table has a column for its parameter beside those of the state.
  void keep_coordinates(const std::vector<Part>& parts) {
    Model names_only;
    for (const auto& part : parts) {
      if (is_reserved(part.name))  // before another part is told that it knows no such coordinate
        fail(part.line, "coordinate " + in_quotes(part.name),
             "this name is reserved (it is a column of tables, or the surroundings)");
      coordinates_.push_back(part.name);
      names_only.coordinates.push_back({part.name, 1.0});
    }
    states_ = state_names(names_only);
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (std::find(names_.begin(), names_.end(), states_[i]) != names_.end())
        fail(parts[i / 2].line, part_label("coordinate", i / 2, parts[i / 2]),
             "a parameter has the name " + in_quotes(states_[i]));
  }

  Part part(const TomlNode& node, const PartRule& rule, std::size_t index) const {
    Part part;
    part.line = node.line;
    std::string where = part_label(rule.kind, index, part);
    expect(node, Kind::table, where);
    std::vector<std::string> known = {"description"};
    if (rule.named) known.emplace_back("name");
    if (rule.ends != Ends::none) known.emplace_back(rule.ends == Ends::on ? "on" : "between");
    for (const auto& field : rule.fields) known.emplace_back(field.key);
    check_keys(node, where, known);
    part.description = text(node, "description", where, longest_text);
    part.name = rule.named ? text(node, "name", where, longest_text) : "";
    if (rule.named && part.name.empty()) fail(node.line, where, "'name' is missing");
    where = part_label(rule.kind, index, part);
    read_ends(node, rule.ends, where, part);
    for (const auto& field : rule.fields) {
      const std::string key(field.key);
      if (const auto* value = node.find(key))
        part.fields[key] = scalar(*value, where + ": " + key);
      else if (field.required)
        fail(node.line, where, "'" + key + "' is missing");
    }
    return part;
  }

  void read_ends(const TomlNode& node, Ends ends, const std::string& where, Part& part) const {
    if (ends == Ends::none) return;
    const std::string key = ends == Ends::on ? "on" : "between";
    const auto* value = node.find(key);
    if (value == nullptr) fail(node.line, where, "'" + key + "' is missing");
    if (ends == Ends::on) {
      part.a = end(*value, where + ": on");
      return;
    }
    expect(*value, Kind::list, where + ": between");
    if (value->items.size() != 2)
      fail(value->line, where + ": between", "expected two ends, found " + std::to_string(value->items.size()));
    part.a = end(value->items[0], where + ": between");
    part.b = end(value->items[1], where + ": between");
  }

  int end(const TomlNode& node, const std::string& where) const {
    expect(node, Kind::text, where);
    if (node.text == "ground") return ground;
    const auto found = std::find(coordinates_.begin(), coordinates_.end(), node.text);
    if (found != coordinates_.end()) return static_cast<int>(found - coordinates_.begin());
    auto known = coordinates_;
    known.emplace_back("ground");
    fail(node.line, where, "unknown coordinate " + in_quotes(node.text) + suggestion(node.text, known));
  }

  void read_start(const TomlNode& table) {
    expect(table, Kind::table, "start");
    check_keys(table, "start", states_);
    for (const auto& [name, node] : table.entries) definition_.start.emplace_back(name, scalar(node, "start: " + name));
  }

  Definition definition_;
  std::vector<std::string> names_;        // of the parameters
  std::vector<std::string> coordinates_;  // names by index
  std::vector<std::string> states_;       // names of displacements and velocities
};

}  // namespace

Definition read_definition(std::string_view text, const std::string& source) {
  return Reader(source).read(parse_toml(text, source));
}

}  // namespace slapstick
