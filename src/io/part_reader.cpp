/// Reads the parts of a model file by the table of part rules.
#include "io/part_reader.hpp"

#include <algorithm>

#include "model/fault.hpp"
#include "base/nearest.hpp"

namespace slapstick {
namespace {

class PartReader {
 public:
  PartReader(const TreeReader& tree, const TomlNode& root, Definition& definition)
      : tree_(tree), root_(root), definition_(definition) {}

  std::vector<std::string> read() {
    for (const auto& rule : part_rules()) {
      if (rule.kind == "observable") check_contact_names();  // before gaps get their names
      read_kind(rule);
    }
    check_bases_are_used();
    read_matrices();
    return std::move(states_);
  }

 private:
  void read_kind(const PartRule& rule) {
    const auto* list = root_.find(rule.kind);
    const std::string kind(rule.kind);
    if (list == nullptr) return;
    if (list->kind != TomlNode::Kind::list)
      tree_.fail(list->line, kind, std::string("expected [[") + kind + "]], found " + list->kind_name());
    tree_.check_count(*list, list->items.size(), kind);
    if (kind == "observable") gather_observed();
    auto& parts = definition_.parts[kind];
    for (std::size_t i = 0; i < list->items.size(); ++i) parts.push_back(part(list->items[i], rule, i));
    if (kind == "coordinate") keep_coordinates(parts);
    if (kind == "base") keep_bases(parts);
    if (kind == "observable") check_observables(parts);
  }

  /// A sweep's table has a column for its parameter beside those of the state.
  void keep_coordinates(const std::vector<Part>& parts) {
    Model names_only;
    for (const auto& part : parts) {
      if (is_reserved(part.name))  // before another part is told that it knows no such coordinate
        tree_.fail(part.line, "coordinate " + in_quotes(part.name),
                   "this name is reserved (it is a column of tables, or the surroundings)");
      if (Expression::reserves(part.name))  // an observable could not name it
        tree_.fail(part.line, "coordinate " + in_quotes(part.name), "this is the name of a function or constant");
      coordinates_.push_back(part.name);
      names_only.coordinates.push_back({part.name, 1.0});
    }
    states_ = state_names(names_only);
    for (std::size_t i = 0; i < states_.size(); ++i)  // before anything follows from it
      if (std::find(states_.begin(), states_.begin() + static_cast<std::ptrdiff_t>(i), states_[i]) !=
          states_.begin() + static_cast<std::ptrdiff_t>(i))
        tree_.fail(
            parts[i / 2].line, part_label("coordinate", i / 2, parts[i / 2]),
            std::string(i % 2 == 0 ? "name " : "its velocity's name ") + in_quotes(states_[i]) + " is used twice");
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (tree_.is_parameter(states_[i]))
        tree_.fail(parts[i / 2].line, part_label("coordinate", i / 2, parts[i / 2]),
                   "a parameter has the name " + in_quotes(states_[i]));
    const auto* matrix = root_.find("matrix");
    if (matrix != nullptr && matrix->find("mass") != nullptr) return;  // which may give them all
    for (const auto& part : parts)
      if (!part.fields.contains("mass"))
        tree_.fail(part.line, "coordinate " + in_quotes(part.name), "'mass' is missing");
  }

  /// `between` takes coordinates and bases by name: no name may mean two things.
  void keep_bases(const std::vector<Part>& parts) {
    for (const auto& part : parts) {
      const std::string where = "base " + in_quotes(part.name);
      tree_.check_new_name(part.name, part.line, "base");
      if (is_reserved(part.name))
        tree_.fail(part.line, where, "this name is reserved (it is a column of tables, or the surroundings)");
      if (tree_.is_parameter(part.name)) tree_.fail(part.line, where, "a parameter has this name");
      for (const auto* used : {&states_, &bases_})
        if (std::find(used->begin(), used->end(), part.name) != used->end())
          tree_.fail(part.line, where, "name " + in_quotes(part.name) + " is used twice");
      bases_.push_back(part.name);
    }
  }

  /// What an observable may name: parameters, the state, bases, the gaps of stops, and time.
  void gather_observed() {
    observed_ = tree_.parameters();
    for (const auto* names : {&states_, &bases_}) observed_.insert(observed_.end(), names->begin(), names->end());
    for (const char* kind : {"stop", "compliant_stop"})
      for (const auto& part : definition_.of(kind)) {
        if (part.flag("two_sided")) observed_.push_back(gap_name(part.name + "_lower"));
        observed_.push_back(gap_name(part.flag("two_sided") ? part.name + "_upper" : part.name));
      }
    observed_.emplace_back("time");
  }

  /// An observable is a column beside the state, and must not be taken for something else.
  void check_observables(const std::vector<Part>& parts) const {
    auto used = observed_;
    for (const auto& part : parts) {
      const std::string where = "observable " + in_quotes(part.name);
      tree_.check_new_name(part.name, part.line, "observable");
      if (is_reserved(part.name))
        tree_.fail(part.line, where, "this name is reserved (it is a column of tables, or the surroundings)");
      if (tree_.is_parameter(part.name)) tree_.fail(part.line, where, "a parameter has this name");
      if (std::find(used.begin(), used.end(), part.name) != used.end())
        tree_.fail(part.line, where, "name " + in_quotes(part.name) + " is used twice");
      used.push_back(part.name);
    }
  }

  /// Contacts of all kinds share the column `contact` of tables; a two-sided one is there under two other names.
  void check_contact_names() const {
    std::vector<std::string> used;
    for (const char* kind : {"friction", "stop", "compliant_stop"})
      for (const auto& part : definition_.of(kind))
        for (const char* side : {"", "_upper", "_lower"}) {
          if (side[0] != '\0' && !part.flag("two_sided")) continue;
          const auto name = part.name + side;
          if (std::find(used.begin(), used.end(), name) != used.end())
            tree_.fail(part.line, std::string(kind) + " " + in_quotes(part.name),
                       "name " + in_quotes(name) + " is used twice");
          used.push_back(name);
        }
  }

  void check_bases_are_used() const {
    std::vector<bool> used(bases_.size(), false);
    for (const char* kind : {"spring", "damper"})
      for (const auto& part : definition_.of(kind))
        for (const int end : {part.a, part.b})
          if (is_base(end)) used[static_cast<std::size_t>(base_end(end))] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i])
        tree_.fail(definition_.of("base")[i].line, "base " + in_quotes(bases_[i]),
                   "no spring or damper is attached to it, so it moves nothing");
  }

  Part part(const TomlNode& node, const PartRule& rule, std::size_t index) const {
    Part part;
    part.line = node.line;
    std::string where = part_label(rule.kind, index, part);
    tree_.expect(node, TomlNode::Kind::table, where);
    tree_.check_keys(node, where, part_keys(rule));
    part.description = tree_.text(node, "description", where);
    part.name = rule.named ? tree_.text(node, "name", where) : "";
    if (rule.named && part.name.empty()) tree_.fail(node.line, where, "'name' is missing");
    where = part_label(rule.kind, index, part);
    read_ends(node, rule, where, part);
    read_fields(node, rule, where, part);
    if (node.find("clearance_lower") != nullptr && !part.flag("two_sided"))
      tree_.fail(node.find("clearance_lower")->line, where + ": clearance_lower", "it needs two_sided = true");
    return part;
  }

  void read_fields(const TomlNode& node, const PartRule& rule, const std::string& where, Part& part) const {
    for (const auto& field : rule.fields) {
      const std::string key(field.key), place = where + ": " + key;
      const auto* value = node.find(key);
      if (value == nullptr) {
        if (field.required) tree_.fail(node.line, where, in_quotes(key) + " is missing");
        continue;
      }
      switch (field.holds) {
        case Holds::number:
          part.fields[key] = tree_.scalar(*value, place);
          break;
        case Holds::observed:
          part.fields[key] = tree_.scalar(*value, place, "name", observed_);
          break;
        case Holds::flag:
          part.flags[key] = tree_.flag(*value, place);
          break;
        case Holds::text:
          part.texts[key] = tree_.text(node, key.c_str(), where);
          break;
        case Holds::harmonics:
          part.harmonics = harmonics(*value, place);
          break;
      }
    }
  }

  std::vector<Part> harmonics(const TomlNode& list, const std::string& where) const {
    tree_.expect(list, TomlNode::Kind::list, where);
    tree_.check_count(list, list.items.size(), where);
    if (list.items.empty()) tree_.fail(list.line, where, "it is empty");
    std::vector<Part> parts;
    for (const auto& item : list.items) {
      const auto each = where + " " + std::to_string(parts.size() + 1);
      Part part;
      part.line = item.line;
      tree_.expect(item, TomlNode::Kind::table, each);
      tree_.check_keys(item, each, part_keys(harmonic_rule()));
      read_fields(item, harmonic_rule(), each, part);
      parts.push_back(std::move(part));
    }
    return parts;
  }

  void read_ends(const TomlNode& node, const PartRule& rule, const std::string& where, Part& part) const {
    if (rule.ends == Ends::none) return;
    const std::string key = rule.ends == Ends::on ? "on" : "between";
    const auto* value = node.find(key);
    if (value == nullptr) tree_.fail(node.line, where, "'" + key + "' is missing");
    if (rule.ends == Ends::on) {
      part.a = end(*value, rule, where + ": on");
      return;
    }
    tree_.expect(*value, TomlNode::Kind::list, where + ": between");
    if (value->items.size() != 2)
      tree_.fail(value->line, where + ": between", "expected two ends, found " + std::to_string(value->items.size()));
    part.a = end(value->items[0], rule, where + ": between");
    part.b = end(value->items[1], rule, where + ": between");
    const bool moves = part.a >= 0 || part.b >= 0;
    if ((is_base(part.a) || is_base(part.b)) && !moves)
      tree_.fail(value->line, where + ": between", "neither end is a coordinate, so it moves nothing");
  }

  int end(const TomlNode& node, const PartRule& rule, const std::string& where) const {
    tree_.expect(node, TomlNode::Kind::text, where);
    if (node.text == "ground") return ground;
    const auto found = std::find(coordinates_.begin(), coordinates_.end(), node.text);
    if (found != coordinates_.end()) return static_cast<int>(found - coordinates_.begin());
    const auto base = std::find(bases_.begin(), bases_.end(), node.text);
    if (base != bases_.end()) {
      if (rule.ends != Ends::moving) refuse_base(node, rule, where);
      return base_end(static_cast<int>(base - bases_.begin()));
    }
    if (coordinates_.empty()) tree_.fail(1, "model", "it has no coordinates");
    auto known = coordinates_;
    if (rule.ends == Ends::moving) known.insert(known.end(), bases_.begin(), bases_.end());
    known.emplace_back("ground");
    tree_.fail(node.line, where, "unknown coordinate " + in_quotes(node.text) + suggestion(node.text, known));
  }

  [[noreturn]] void refuse_base(const TomlNode& node, const PartRule& rule, const std::string& where) const {
    const std::string base = in_quotes(node.text);
    if (rule.ends == Ends::on)
      tree_.fail(node.line, where, base + " is a base: its motion is given, a force cannot change it");
    tree_.fail(node.line, where,
               base +
                   " is a base, which only springs and dampers may name: the gap or the sliding would depend on time. "
                   "Measure the coordinates from the base instead ('ground' is then the base) and give each one "
                   "its inertia force, [[force]] amplitude = mass * amplitude * (harmonic * omega)^2");
  }

  void read_matrices() {
    const auto* table = root_.find("matrix");
    if (table == nullptr) return;
    tree_.expect(*table, TomlNode::Kind::table, "matrix");
    tree_.check_keys(*table, "matrix", matrix_keys());
    for (const auto& [key, node] : table->entries) definition_.matrices[key] = matrix(node, "matrix: " + key);
  }

  MatrixEntry matrix(const TomlNode& node, const std::string& where) const {
    const auto n = coordinates_.size();
    MatrixEntry matrix{{}, node.line};
    const auto demand = [&](const TomlNode& list, const char* what, const std::string& whose) {
      tree_.expect(list, TomlNode::Kind::list, whose);
      if (list.items.size() != n)
        tree_.fail(list.line, whose,
                   "expected " + std::to_string(n) + " " + what + " (one per coordinate), found " +
                       std::to_string(list.items.size()));
    };
    demand(node, "rows", where);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = where + "[" + coordinates_[i] + "]";
      demand(node.items[i], "entries", row);
      for (std::size_t j = 0; j < n; ++j)
        matrix.entries.push_back(
            tree_.scalar(node.items[i].items[j], where + "[" + coordinates_[i] + ", " + coordinates_[j] + "]"));
    }
    return matrix;
  }

  const TreeReader& tree_;
  const TomlNode& root_;
  Definition& definition_;
  std::vector<std::string> coordinates_, bases_;  // names by index
  std::vector<std::string> states_;               // names of displacements and velocities
  std::vector<std::string> observed_;             // what observables may name
};

}  // namespace

std::vector<std::string> read_parts(const TreeReader& tree, const TomlNode& root, Definition& definition) {
  return PartReader(tree, root, definition).read();
}

}  // namespace slapstick
