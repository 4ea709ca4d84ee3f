/// Reads the parts of a model file by the table of part rules.
#include "io/part_reader.hpp"
#include "io/observed.hpp"

#include <algorithm>

#include "base/nearest.hpp"
#include "io/field_values.hpp"
#include "io/key_rules.hpp"
#include "io/matrix_reader.hpp"
#include "model/fault.hpp"

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
      if (rule.kind == "base") read_homes();
    }
    check_bases_are_used();
    read_matrices(tree_, root_, coordinates_, definition_);
    return std::move(states_);
  }

 private:
  void read_kind(const PartRule& rule) {
    const auto* list = root_.find(rule.kind);
    const std::string kind(rule.kind);
    if (kind == "coordinate" && list == nullptr) return read_coordinates({});
    if (list == nullptr) return;
    if (list->kind != TomlNode::Kind::list)
      tree_.fail(list->line, kind, std::string("expected [[") + kind + "]], found " + list->kind_name());
    tree_.check_count(*list, list->items.size(), kind);
    if (kind == "observable") gather_observed();
    auto& parts = definition_.parts[kind];
    for (std::size_t i = 0; i < list->items.size(); ++i) parts.push_back(part(list->items[i], rule, i));
    if (kind == "coordinate") return read_coordinates(std::move(parts));
    if (kind == "base") keep_bases(parts);
    if (kind == "maxwell" || kind == "jenkins") keep_inner(kind, parts);
    if (kind == "observable") check_observables(parts);
  }

  /// Those of [[coordinate]], and then the rows of [matrix] that have none.
  void read_coordinates(std::vector<Part> parts) {
    for (auto& row : matrix_rows(tree_, root_, definition_.source))
      if (std::none_of(parts.begin(), parts.end(), [&](const Part& part) { return part.name == row.name; }))
        parts.push_back(std::move(row));
    if (parts.empty()) return;
    keep_coordinates(parts);
    definition_.parts["coordinate"] = std::move(parts);
  }

  /// A sweep's table has a column for its parameter beside those of the state.
  void keep_coordinates(const std::vector<Part>& parts) {
    Model names_only;
    for (const auto& part : parts) {
      if (is_reserved(part.name))  // before another part is told that it knows no such coordinate
        tree_.fail(part.line, "coordinate " + in_quotes(part.name),
                   "this name is reserved (it is a column of tables, or the surroundings)");
      if (Expression::reserves(part.name))  // an observable could not name it
        tree_.fail(part.line, "coordinate " + in_quotes(part.name), "a function or constant has this name");
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
    if (matrix != nullptr && matrix->find("mass") != nullptr) return;  // the matrix may give all of them
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

  /// The inner coordinates of elements: numbers of the state behind those of the coordinates.
  void keep_inner(const std::string& kind, const std::vector<Part>& parts) {
    for (const Part& part : parts) {
      const std::string s = inner_name(part.name), where = kind + " " + in_quotes(part.name);
      for (const std::string& name : {s, velocity_name(s)}) {
        if (std::find(states_.begin(), states_.end(), name) != states_.end())
          tree_.fail(part.line, where, "name " + in_quotes(name) + " is used twice");
        if (tree_.is_parameter(name)) tree_.fail(part.line, where, "a parameter has the name " + in_quotes(name));
        states_.push_back(name);
      }
    }
  }

  /// The bases that coordinates are measured from.
  void read_homes() {
    const auto found = definition_.parts.find("coordinate");
    if (found == definition_.parts.end()) return;
    for (auto& part : found->second) {
      const auto text = part.texts.find("base");
      if (text == part.texts.end()) continue;
      const auto base = std::find(bases_.begin(), bases_.end(), text->second);
      if (base == bases_.end())
        tree_.fail(part.line, "coordinate " + in_quotes(part.name) + ": base",
                   "unknown base " + in_quotes(text->second) + suggestion(text->second, bases_));
      part.b = base_end(static_cast<int>(base - bases_.begin()));
    }
  }

  /// What an end moves with when its own number stands still: a base, or the ground.
  [[nodiscard]] int home(int end) const {
    return end >= 0 ? definition_.of("coordinate")[static_cast<std::size_t>(end)].b : end;
  }

  void demand_one_home(const Part& part, int line, const std::string& where, const char* what) const {
    const int a = home(part.a), b = home(part.b);
    if (a == b) return;
    const auto name = [&](int of) { return bases_[static_cast<std::size_t>(base_end(of))]; };
    const auto shown = [&](int of) { return of == ground ? "the ground" : in_quotes(name(of)); };
    tree_.fail(line, where,
               "its sides move with " + shown(a) + " and with " + shown(b) + ": " + what + " would depend on time. " +
                   "Measure the coordinates from the base: base = \"" + name(a == ground ? b : a) +
                   "\" in [[coordinate]]");
  }

  /// What an observable may name besides quantities: parameters, the state, bases, the gaps of stops, and time.
  void gather_observed() {
    definition_.observed = tree_.parameters();
    for (const auto* names : {&states_, &bases_})
      definition_.observed.insert(definition_.observed.end(), names->begin(), names->end());
    for (const char* kind : {"stop", "compliant_stop"})
      for (const auto& part : definition_.of(kind)) {
        if (part.flag("two_sided")) definition_.observed.push_back(gap_name(part.name + "_lower"));
        definition_.observed.push_back(gap_name(part.flag("two_sided") ? part.name + "_upper" : part.name));
      }
    definition_.observed.emplace_back("time");
  }

  /// An observable is a column beside the state, and must not be taken for something else.
  void check_observables(const std::vector<Part>& parts) const {
    auto used = definition_.observed;
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
    for (const char* kind : {"friction", "freewheel", "stop", "compliant_stop"})
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
    for (const auto& part : definition_.of("coordinate"))
      if (is_base(part.b)) used[static_cast<std::size_t>(base_end(part.b))] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i])
        tree_.fail(definition_.of("base")[i].line, "base " + in_quotes(bases_[i]),
                   "no spring or damper is attached to it and no coordinate measured from it, so it moves nothing");
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
    if (rule.ends == Ends::between)
      demand_one_home(part, node.find("between")->line, where + ": between",
                      rule.kind == "maxwell" || rule.kind == "jenkins" ? "its stretch" : "the gap or the sliding");
    read_fields(node, rule, where, part);
    if (rule.kind == "signal") read_signal(tree_, node, where, definition_.source, part);
    check_signal_name(node, where);
    for (const char* key : {"characteristic", "within"})
      if (const auto* bent = node.find(key); bent != nullptr)
        demand_one_home(part, bent->line, where + ": " + key, "the corners");
    if (node.find("clearance_lower") != nullptr && !part.flag("two_sided"))
      tree_.fail(node.find("clearance_lower")->line, where + ": clearance_lower", "this key needs two_sided = true");
    return part;
  }

  /// The signal that a force or a base names.
  void check_signal_name(const TomlNode& node, const std::string& where) const {
    const auto* named = node.find("signal");
    if (named == nullptr) return;
    std::vector<std::string> known;
    for (const auto& signal : definition_.of("signal")) known.push_back(signal.name);
    if (std::find(known.begin(), known.end(), named->text) == known.end())
      tree_.fail(named->line, where + ": signal",
                 "unknown signal " + in_quotes(named->text) + suggestion(named->text, known));
  }

  void read_fields(const TomlNode& node, const PartRule& rule, const std::string& where, Part& part) const {
    for (const auto& field : rule.fields) {
      const std::string key(field.key), place = where + ": " + key;
      const auto* value = node.find(key);
      if (value == nullptr) {
        if (field.required && !replaced(node, rule, field.key))
          tree_.fail(node.line, where, in_quotes(key) + " is missing");
        continue;
      }
      if (const std::string other = first_present(node, field.instead_of); !other.empty())
        tree_.fail(value->line, place, "this key stands in place of " + in_quotes(other) + ": give one of the two");
      if (!field.needs.empty() && first_present(node, field.needs).empty())
        tree_.fail(value->line, place,
                   "this key belongs to a " + in_quotes(field.needs.substr(0, field.needs.find('|'))) +
                       ", and the part has no such key");
      read_value(node, rule, field, *value, where, part);
    }
  }

  void read_value(const TomlNode& node, const PartRule& rule, const FieldRule& field, const TomlNode& value,
                  const std::string& where, Part& part) const {
    const std::string key(field.key), place = where + ": " + key;
    switch (field.holds) {
      case Holds::number:
        part.fields[key] = tree_.scalar(value, place);
        break;
      case Holds::observed:
        part.fields[key] = tree_.scalar(value, place, "name", observable_names(definition_, value.text));
        break;
      case Holds::flag:
        part.flags[key] = tree_.flag(value, place);
        break;
      case Holds::text:
        part.texts[key] = tree_.text(node, key.c_str(), where);
        break;
      case Holds::harmonics:
        part.harmonics = harmonics(value, place);
        break;
      case Holds::points:
        part.points = read_points(tree_, value, place,
                                  key == "restitution_over_speed" ? "[speed, restitution]"
                                  : rule.kind == "signal"         ? "[time, value]"
                                                                  : "[x, force]");
        break;
      case Holds::interval:
        part.within = read_interval(tree_, value, place);
        break;
      case Holds::contact_law:
        part.texts[key] = contact_laws()[tree_.word(value, place, contact_laws())];
        break;
      case Holds::shape:
        part.texts[key] = signal_shapes()[tree_.word(value, place, signal_shapes())];
        break;
      case Holds::stribeck:
        part.stribeck = read_stribeck(tree_, value, place);
        break;
      case Holds::band:
        part.band = read_band(tree_, value, place);
        break;
      case Holds::load:
        read_load(tree_, value, place, states_, part);
        break;
      case Holds::ratio:
        part.ratio = read_ratio(tree_, value, place, home(part.a) == ground && home(part.b) == ground);
        break;
    }
  }

  std::vector<Part> harmonics(const TomlNode& list, const std::string& where) const {
    tree_.expect(list, TomlNode::Kind::list, where);
    tree_.check_count(list, list.items.size(), where);
    if (list.items.empty()) tree_.fail(list.line, where, "nothing is in it");
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
      if (presses(*value, rule)) part.presses = value->text;
      if (part.presses.empty()) part.a = end(*value, rule, where + ": on");
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

  /// Is a force on a friction contact, and on no coordinate? Contacts are read after forces.
  bool presses(const TomlNode& on, const PartRule& rule) const {
    if (rule.kind != "force" || on.kind != TomlNode::Kind::text) return false;
    if (std::find(coordinates_.begin(), coordinates_.end(), on.text) != coordinates_.end()) return false;
    const TomlNode* contacts = root_.find("friction");
    if (contacts == nullptr || contacts->kind != TomlNode::Kind::list) return false;
    return std::any_of(contacts->items.begin(), contacts->items.end(), [&](const TomlNode& contact) {
      const TomlNode* name = contact.find("name");
      return name != nullptr && name->kind == TomlNode::Kind::text && name->text == on.text;
    });
  }

  int end(const TomlNode& node, const PartRule& rule, const std::string& where) const {
    tree_.expect(node, TomlNode::Kind::text, where);
    if (node.text == "ground") return ground;
    const auto found = std::find(coordinates_.begin(), coordinates_.end(), node.text);
    if (found != coordinates_.end()) return static_cast<int>(found - coordinates_.begin());
    const auto base = std::find(bases_.begin(), bases_.end(), node.text);
    if (base != bases_.end()) {
      if (rule.ends == Ends::on)
        tree_.fail(node.line, where,
                   in_quotes(node.text) + " is a base: its motion is given, a force cannot change it");
      return base_end(static_cast<int>(base - bases_.begin()));
    }
    if (coordinates_.empty()) tree_.fail(1, "model", "the model has no coordinates");
    auto known = coordinates_;
    if (rule.ends != Ends::on) known.insert(known.end(), bases_.begin(), bases_.end());
    known.emplace_back("ground");
    tree_.fail(node.line, where, "unknown coordinate " + in_quotes(node.text) + suggestion(node.text, known));
  }

  const TreeReader& tree_;
  const TomlNode& root_;
  Definition& definition_;
  std::vector<std::string> coordinates_, bases_;  // names by index
  std::vector<std::string> states_;               // names of displacements and velocities
};

}  // namespace

std::vector<std::string> read_parts(const TreeReader& tree, const TomlNode& root, Definition& definition) {
  return PartReader(tree, root, definition).read();
}

}  // namespace slapstick
