/// Prints a model file.
#include <cmath>

#include "base/decimal.hpp"
#include "io/definition.hpp"

namespace slapstick {
namespace {

/// Shortest text that reads back as the same double; never one that TOML would take for an integer out of range or lose
/// the sign of -0.
std::string toml_number(double value) {
  std::string out = shortest_decimal(value);
  const bool whole = out.find_first_of(".e") == std::string::npos;
  return whole && (out.size() > 15 || out == "-0") ? out + ".0" : out;
}

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// Several lines between """: the first line break after the opening is not part of the text.
std::string toml_notes(const std::string& text) {
  std::string out = "\"\"\"\n";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"\"\"";
}

class Printer {
 public:
  Printer(const Definition& definition, const Overrides& overrides) : definition_(definition), overrides_(overrides) {}

  std::string print() {
    line("name", toml_string(definition_.name));
    if (!definition_.summary.empty()) line("summary", toml_string(definition_.summary));
    if (!definition_.notes.empty()) line("notes", toml_notes(definition_.notes));
    if (definition_.omega) line("omega", scalar_text(*definition_.omega));
    if (definition_.impact_law)
      line("impact_law", toml_string(impact_laws()[static_cast<std::size_t>(*definition_.impact_law)]));
    for (const auto& entry : definition_.parameters) parameter(entry);
    groups();
    for (const auto& rule : part_rules())
      for (const auto& part : definition_.of(rule.kind)) print_part(rule, part);
    matrices();
    scale();
    start();
    return std::move(out_);
  }

 private:
  void line(std::string_view key, std::string_view value) { out_.append(key).append(" = ").append(value).append("\n"); }

  static std::string scalar_text(const Scalar& scalar) {
    return scalar.expression ? toml_string(scalar.expression->text()) : toml_number(scalar.number);
  }

  static std::string points_text(const std::vector<Point>& points) {
    std::string out = "[";
    for (std::size_t i = 0; i < points.size(); ++i) {
      out += i == 0 ? "" : i % 8 == 0 ? ",\n  " : ", ";  // a line has at most 4096 bytes
      out += "[" + scalar_text(points[i].at) + ", " + scalar_text(points[i].force) + "]";
    }
    return out + "]";
  }

  static std::string table_text(const std::vector<std::pair<std::string, Scalar>>& numbers, const std::string& stop) {
    std::string out;
    for (const auto& [key, number] : numbers) out += (out.empty() ? "" : ", ") + key + " = " + scalar_text(number);
    if (!stop.empty()) out += (out.empty() ? "" : ", ") + std::string("compliant_stop = ") + toml_string(stop);
    return "{ " + out + " }";
  }

  void parameter(const ParameterEntry& entry) {
    const auto& shown = entry.shown;
    out_.append("\n[parameters.").append(shown.name).append("]\n");
    const auto given = overrides_.find(shown.name);
    line("value", given == overrides_.end() ? scalar_text(entry.value) : toml_number(given->second));
    if (std::isfinite(shown.min)) line(shown.min_open ? "above" : "min", toml_number(shown.min));
    if (std::isfinite(shown.max)) line(shown.max_open ? "below" : "max", toml_number(shown.max));
    if (!shown.unit.empty()) line("unit", toml_string(shown.unit));
    if (!shown.description.empty()) line("description", toml_string(shown.description));
  }

  void groups() {
    if (definition_.groups.empty()) return;
    out_ += "\n[groups]\n";
    for (const auto& entry : definition_.groups) {
      std::string members;
      for (const auto& member : entry.shown.members) members += "\n  " + toml_string(member) + ",";
      line(entry.shown.name, entry.shown.members.size() > 6 ? "[" + members + "\n]" : short_list(entry.shown.members));
    }
  }

  static std::string short_list(const std::vector<std::string>& members) {
    std::string out = "[";
    for (const auto& member : members) out.append(out.size() > 1 ? ", " : "").append(toml_string(member));
    return out + "]";
  }

  std::string end_text(int index) const {
    if (index == ground) return "ground";
    if (is_base(index)) return definition_.of("base")[static_cast<std::size_t>(base_end(index))].name;
    return definition_.of("coordinate")[static_cast<std::size_t>(index)].name;
  }

  void print_part(const PartRule& rule, const Part& part) {
    out_.append("\n[[").append(rule.kind).append("]]\n");
    if (rule.named) line("name", toml_string(part.name));
    if (!part.description.empty()) line("description", toml_string(part.description));
    if (rule.ends == Ends::on) line("on", toml_string(part.presses.empty() ? end_text(part.a) : part.presses));
    if (rule.ends == Ends::between || rule.ends == Ends::moving)
      line("between", short_list({end_text(part.a), end_text(part.b)}));
    print_fields(rule, part);
    for (const auto& harmonic : part.harmonics) {
      out_.append("\n[[").append(rule.kind).append(".harmonics]]\n");
      print_fields(harmonic_rule(), harmonic);
    }
  }

  void print_fields(const PartRule& rule, const Part& part) {
    for (const auto& field : rule.fields) {
      const auto number = part.fields.find(field.key);
      if (number != part.fields.end()) line(field.key, scalar_text(number->second));
      if (field.holds == Holds::points && !part.points.empty()) line(field.key, points_text(part.points));
      if (field.holds == Holds::interval && !part.within.empty())
        line(field.key, "[" + scalar_text(part.within[0]) + ", " + scalar_text(part.within[1]) + "]");
      if (field.holds == Holds::ratio && part.ratio)
        line(field.key, "[" + toml_number(part.ratio->a) + ", " + toml_number(part.ratio->b) + "]");
      if (field.holds == Holds::stribeck && !part.stribeck.empty())
        line(field.key, table_text({part.stribeck.begin(), part.stribeck.end()}, ""));
      if (field.holds == Holds::band && !part.band.empty())
        line(field.key, table_text({part.band.begin(), part.band.end()}, ""));
      if (field.holds == Holds::load && (!part.load.empty() || !part.load_stop.empty()))
        line(field.key, table_text(part.load, part.load_stop));
      const auto flag = part.flags.find(field.key);
      if (flag != part.flags.end()) line(field.key, flag->second ? "true" : "false");
      const auto text = part.texts.find(field.key);
      if (text != part.texts.end() && !text->second.empty()) line(field.key, toml_string(text->second));
    }
  }

  void matrices() {
    if (definition_.matrices.empty()) return;
    out_ += "\n[matrix]\n";
    const auto n = definition_.of("coordinate").size();
    for (const auto& key : matrix_keys()) {
      const auto found = definition_.matrices.find(key);
      if (found == definition_.matrices.end()) continue;
      std::string rows = "[";
      for (std::size_t i = 0; i < n * n; ++i) {
        rows += i % n == 0 ? "\n  [" : i % n % 16 == 0 ? ",\n    " : ", ";  // a line has at most 4096 bytes
        rows += scalar_text(found->second.entries[i]);
        if (i % n == n - 1) rows += "],";
      }
      line(key, rows + "\n]");
    }
  }

  void scale() {
    for (const auto& key : scale_keys()) {
      const auto found = definition_.scale.find(key);
      if (found == definition_.scale.end()) continue;
      out_.append("\n[scale.").append(key).append("]\n");
      line("value", scalar_text(found->second.value));
      line("unit", toml_string(found->second.unit));
    }
  }

  void start() {
    if (definition_.start.empty()) return;
    out_ += "\n[start]\n";
    for (const auto& [name, scalar] : definition_.start) line(name, scalar_text(scalar));
  }

  const Definition& definition_;
  const Overrides& overrides_;
  std::string out_;
};

}  // namespace

std::string print_definition(const Definition& definition, const Overrides& overrides) {
  return Printer(definition, overrides).print();
}

}  // namespace slapstick
