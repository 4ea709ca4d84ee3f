/// Reads a model file into its parts.
#include <algorithm>
#include <array>

#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "io/matrix_reader.hpp"
#include "io/part_reader.hpp"
#include "io/scale.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

using Kind = TomlNode::Kind;

/// Fills a Definition from a tree.
class ModelReader {
 public:
  explicit ModelReader(const std::string& source) : tree_(source) { definition_.source = source; }

  Definition read(const TomlNode& root) {
    tree_.check_keys(root, "", top_keys());
    definition_.name = tree_.text(root, "name", "model");
    if (definition_.name.empty()) tree_.fail(1, "model", "'name' is missing");
    definition_.summary = tree_.text(root, "summary", "model");
    definition_.notes = notes(root);
    know_scale(root);
    know_states(root);
    read_parameters(root);
    read_groups(root);
    const auto states = read_parts(tree_, root, definition_);
    if (const auto* omega = root.find("omega")) definition_.omega = tree_.scalar(*omega, "omega");
    if (const auto* law = root.find("impact_law"))
      definition_.impact_law = static_cast<ImpactLaw>(tree_.word(*law, "impact_law", impact_laws()));
    if (const auto* scale = root.find("scale")) read_scale(*scale);
    if (const auto* start = root.find("start")) read_start(*start, states);
    return std::move(definition_);
  }

 private:
  /// The only text with several lines.
  std::string notes(const TomlNode& root) const {
    const auto* node = root.find("notes");
    if (node == nullptr) return {};
    tree_.expect(*node, Kind::text, "notes");
    std::string kept = node->text;
    kept.erase(std::remove(kept.begin(), kept.end(), '\r'), kept.end());
    for (std::size_t begin = 0; begin <= kept.size();) {
      const auto end = std::min(kept.find('\n', begin), kept.size());
      tree_.check_text(*node, std::string_view(kept).substr(begin, end - begin), "notes",
                       TreeReader::longest_notes_line);
      begin = end + 1;
    }
    return kept;
  }

  /// Expressions may name what 1 is.
  void know_scale(const TomlNode& root) {
    const auto* table = root.find("scale");
    if (table == nullptr) return;
    for (const auto& key : scale_keys())
      if (table->find(key) != nullptr) tree_.know_parameter(scale_name(key));
  }

  /// Before anything is read, as every expression may name one by mistake.
  void know_states(const TomlNode& root) {
    tree_.know_state("time");
    tree_.know_state("t");
    for (const auto& row : matrix_rows(tree_, root, definition_.source)) {
      tree_.know_state(row.name);
      tree_.know_state(velocity_name(row.name));
    }
    const auto* list = root.find("coordinate");
    if (list == nullptr) return;
    for (const auto& item : list->items)
      if (const auto* name = item.find("name"); name != nullptr && name->kind == Kind::text) {
        tree_.know_state(name->text);
        tree_.know_state(velocity_name(name->text));
      }
  }

  void read_parameters(const TomlNode& root) {
    const auto* table = root.find("parameters");
    if (table == nullptr) return;
    tree_.expect(*table, Kind::table, "parameters");
    tree_.check_count(*table, table->entries.size(), "parameters");
    for (const auto& [name, node] : table->entries) {
      tree_.check_new_name(name, node.line, "parameter");
      if (tree_.is_parameter(name))
        tree_.fail(node.line, "parameter " + in_quotes(name), "expressions call the value of [scale] by this name");
      tree_.know_parameter(name);
    }
    for (const auto& [name, node] : table->entries) definition_.parameters.push_back(parameter(name, node));
  }

  ParameterEntry parameter(const std::string& name, const TomlNode& node) const {
    const std::string where = "parameter " + in_quotes(name);
    ParameterEntry entry;
    entry.shown.name = name;
    if (node.kind == Kind::table) {
      tree_.check_keys(node, where, parameter_keys());
      const auto* value = node.find("value");
      if (value == nullptr) tree_.fail(node.line, where, "'value' is missing");
      entry.value = tree_.scalar(*value, where + ": value");
      entry.shown.description = tree_.text(node, "description", where);
      entry.shown.unit = tree_.text(node, "unit", where);
      read_bound(node, where, {"min", "above"}, entry.shown.min, entry.shown.min_open);
      read_bound(node, where, {"max", "below"}, entry.shown.max, entry.shown.max_open);
      const auto& shown = entry.shown;
      if (shown.min > shown.max || (shown.min == shown.max && (shown.min_open || shown.max_open)))
        tree_.fail(node.line, where, "the range " + shown.range() + " is empty");
    } else {
      entry.value = tree_.scalar(node, where);
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
      tree_.fail(open_form->line, where, std::string("both '") + keys[0] + "' and '" + keys[1] + "' are given");
    open = open_form != nullptr;
    if (closed_form) bound = tree_.plain_number(*closed_form, where + ": " + keys[0]);
    if (open_form) bound = tree_.plain_number(*open_form, where + ": " + keys[1]);
  }

  void read_groups(const TomlNode& root) {
    const auto* table = root.find("groups");
    if (table == nullptr) return;
    tree_.expect(*table, Kind::table, "groups");
    tree_.check_count(*table, table->entries.size(), "groups");
    for (const auto& [name, node] : table->entries) {
      const std::string where = "group " + in_quotes(name);
      tree_.check_new_name(name, node.line, "group");
      if (tree_.is_parameter(name)) tree_.fail(node.line, where, "a parameter has this name");
      tree_.expect(node, Kind::list, where);
      GroupEntry group{{name, {}}, node.line};
      tree_.check_count(node, node.items.size(), where);
      for (const auto& item : node.items) {
        tree_.expect(item, Kind::text, where);
        const auto has = [&](const auto& entry) { return entry.shown.name == item.text; };
        if (ranges::none_of(definition_.parameters, has))
          tree_.fail(item.line, where,
                     "unknown parameter " + in_quotes(item.text) + suggestion(item.text, tree_.parameters()));
        group.shown.members.push_back(item.text);
      }
      if (group.shown.members.empty()) tree_.fail(node.line, where, "nothing is in it");
      definition_.groups.push_back(std::move(group));
    }
  }

  void read_scale(const TomlNode& table) {
    tree_.expect(table, Kind::table, "scale");
    tree_.check_keys(table, "scale", scale_keys());
    if (table.entries.empty()) tree_.fail(table.line, "scale", "nothing is in it");
    for (const auto& [name, node] : table.entries) {
      const std::string where = "scale: " + name;
      tree_.expect(node, Kind::table, where);
      tree_.check_keys(node, where, quantity_keys());
      for (const auto& key : quantity_keys())
        if (node.find(key) == nullptr) tree_.fail(node.line, where, "'" + key + "' is missing");
      definition_.scale[name] = {tree_.scalar(*node.find("value"), where + ": value"), tree_.text(node, "unit", where),
                                 node.line};
      ParameterEntry one;
      one.shown.name = scale_name(name);
      one.shown.unit = definition_.scale[name].unit;
      one.value = definition_.scale[name].value;
      definition_.ones.push_back(std::move(one));
    }
  }

  void read_start(const TomlNode& table, const std::vector<std::string>& states) {
    tree_.expect(table, Kind::table, "start");
    if (states.empty()) tree_.fail(1, "model", "the model has no coordinates");
    for (const auto& [name, node] : table.entries)
      if (!ranges::any_of(states, [&name = name](const std::string& state) { return state == name; }))
        tree_.fail(node.line, "start", "unknown key " + in_quotes(name) + state_suggestion(name, states));
    for (const auto& [name, node] : table.entries)
      definition_.start.emplace_back(name, tree_.scalar(node, "start: " + name));
  }

  TreeReader tree_;
  Definition definition_;
};

}  // namespace

Definition read_definition(std::string_view text, const std::string& source) {
  auto definition = ModelReader(source).read(parse_toml(text, source));
  check_units(definition);
  return definition;
}

}  // namespace slapstick
