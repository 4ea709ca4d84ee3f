/// Reads [scale] and the units of a model file, and computes the factors of tables.
#include "io/scale.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "io/unit.hpp"
#include "model/fault.hpp"

namespace slapstick {
namespace {

const std::string* unit_text(const Part& part) {
  const auto found = part.texts.find("unit");
  return found == part.texts.end() ? nullptr : &found->second;
}

/// All checks that need no values.
class UnitCheck {
 public:
  explicit UnitCheck(const Definition& definition) : definition_(definition) {}

  void check() const {
    if (!definition_.scale.empty())
      check_scaled();
    else
      check_unscaled();
  }

 private:
  [[noreturn]] void fail(int line, const std::string& where, const std::string& what) const {
    throw InputError(definition_.place(line), where + ": " + what);
  }

  Unit parsed(const std::string& text, int line, const std::string& where) const {
    try {
      return parse_unit(text);
    } catch (const InputError& error) {
      fail(line, where, error.what());
    }
  }

  void check_scaled() const {
    std::array<Unit, 3> scales;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& key = scale_keys()[i];
      const auto found = definition_.scale.find(key);
      if (found == definition_.scale.end()) {
        if (key != "mass") fail(definition_.scale.begin()->second.line, "scale", in_quotes(key) + " is missing");
        continue;
      }
      const std::string where = "scale: " + key;
      scales[i] = parsed(found->second.unit, found->second.line, where);
      Unit base;
      base.powers[i] = 1;
      if (!scales[i].same_dimension(base))
        fail(found->second.line, where, "unit " + in_quotes(found->second.unit) + " is not one of " + key);
    }
    for (const auto& part : definition_.of("coordinate")) check_length(part);
    for (const auto& entry : definition_.parameters) check_parameter(entry, scales);
    for (const auto& part : definition_.of("observable")) {
      const std::string where = "observable " + in_quotes(part.name);
      const auto* text = unit_text(part);
      if (text == nullptr)
        fail(part.line, where,
             "'unit' is missing: [scale] cannot turn it into a physical quantity (write \"1\" for a ratio)");
      demand_mass(parsed(*text, part.line, where), *text, part.line, where);
    }
  }

  Unit check_length(const Part& part) const {
    const std::string where = "coordinate " + in_quotes(part.name);
    const auto* text = unit_text(part);
    if (text == nullptr) return {};
    const Unit unit = parsed(*text, part.line, where);
    if (!unit.same_dimension({1.0, {1, 0, 0}}))
      fail(part.line, where, "unit " + in_quotes(*text) + " is not one of length");
    return unit;
  }

  void demand_mass(const Unit& unit, const std::string& text, int line, const std::string& where) const {
    if (unit.powers[2] != 0 && !definition_.scale.contains("mass"))
      fail(line, where, "unit " + in_quotes(text) + " has a mass in it, and [scale] has none");
  }

  /// Expressions calculate with bare numbers: a parameter in mm beside a scale in m would be wrong by 1000 without a
  /// word.
  void check_parameter(const ParameterEntry& entry, const std::array<Unit, 3>& scales) const {
    const auto& text = entry.shown.unit;
    if (text.empty()) return;
    const std::string where = "parameter " + in_quotes(entry.shown.name);
    const Unit unit = parsed(text, entry.value.line, where);
    demand_mass(unit, text, entry.value.line, where);
    double coherent = 1.0;
    for (std::size_t i = 0; i < 3; ++i) coherent *= fixed::power(scales[i].factor, unit.powers[i]);
    if (std::abs(unit.factor / coherent - 1.0) < 1e-12) return;
    fail(entry.value.line, where,
         "unit " + in_quotes(text) + " is mixed with those of [scale]: expressions do not convert, so give " +
             (unit.powers == Unit{}.powers ? "a plain number, of an angle in rad"
                                           : "the number in " + unit_of_scale(definition_, unit.powers)));
  }

  /// Without [scale] units are what the numbers are in: all coordinates have one, or none has, and equal dimensions
  /// have equal units.
  void check_unscaled() const {
    const auto& coordinates = definition_.of("coordinate");
    std::vector<std::pair<Unit, std::string>> seen;
    const Part* bare = nullptr;
    const Part* with = nullptr;
    for (const auto& part : coordinates) {
      const auto* text = unit_text(part);
      (text == nullptr ? bare : with) = &part;
      if (text == nullptr) continue;
      demand_one(seen, *text, part.line, "coordinate " + in_quotes(part.name), true);
    }
    if (bare && with)
      fail(bare->line, "coordinate " + in_quotes(bare->name),
           "'unit' is missing: coordinate " + in_quotes(with->name) + " has one");
    const bool measured = !seen.empty();
    for (const auto& entry : definition_.parameters) {
      const std::string where = "parameter " + in_quotes(entry.shown.name);
      if (entry.shown.unit.empty()) continue;
      if (measured)
        demand_one(seen, entry.shown.unit, entry.value.line, where, false);
      else
        (void)parsed(entry.shown.unit, entry.value.line, where);
    }
  }

  void demand_one(std::vector<std::pair<Unit, std::string>>& seen, const std::string& text, int line,
                  const std::string& where, bool adds) const {
    const Unit unit = parsed(text, line, where);
    for (const auto& [other, name] : seen) {
      if (!unit.same_dimension(other)) continue;
      if (std::abs(unit.factor / other.factor - 1.0) < 1e-12) return;
      fail(line, where, "unit " + in_quotes(text) + " is mixed with " + in_quotes(name) + " of a coordinate");
    }
    if (adds) seen.emplace_back(unit, text);
  }

  const Definition& definition_;
};

}  // namespace

std::string unit_of_scale(const Definition& definition, const std::array<int, 3>& powers) {
  std::string over, under;
  for (const std::size_t i : {2U, 0U, 1U}) {  // kg m/s^2
    if (powers[i] == 0) continue;
    std::string& text = powers[i] > 0 ? over : under;
    if (&text == &under || !text.empty()) text += powers[i] > 0 ? " " : "/";
    text += definition.scale.at(scale_keys()[i]).unit;
    if (std::abs(powers[i]) > 1) text += "^" + std::to_string(std::abs(powers[i]));
  }
  return (over.empty() ? "1" : over) + under;
}

void check_units(const Definition& definition) { UnitCheck(definition).check(); }

std::string unit_of_inner(const Definition& definition, const Part& element) {
  std::optional<std::string> common;
  for (const int end : {element.a, element.b}) {
    if (end < 0) continue;
    const std::string* own = unit_text(definition.of("coordinate")[static_cast<std::size_t>(end)]);
    const std::string unit = own == nullptr ? "" : *own;
    if (common && *common != unit) return "";
    common = unit;
  }
  return element.ratio.value_or(Ratio{}) == Ratio{} ? common.value_or("") : "";
}

/// The unit of the coordinates that contacts act on, if they agree: the column w holds relative velocities of all
/// contacts.
static std::string common_length(const Definition& definition) {
  const auto& fallback = definition.scale.find("length")->second.unit;
  const auto& coordinates = definition.of("coordinate");
  std::optional<std::string> common;
  for (const char* kind : {"friction", "freewheel", "stop", "compliant_stop"})
    for (const auto& part : definition.of(kind))
      for (const int end : {part.a, part.b}) {
        if (end < 0) continue;
        const auto* own = unit_text(coordinates[static_cast<std::size_t>(end)]);
        const auto& unit = own ? *own : fallback;
        if (common && *common != unit) return fallback;
        common = unit;
      }
  return common.value_or(fallback);
}

std::optional<PhysicalUnits> physical_units(const Definition& definition, const Values& values) {
  if (definition.scale.empty()) return std::nullopt;
  const ModelBuilder builder(definition, values);
  std::array<double, 3> scale{1.0, 1.0, 1.0};  // in m, s, kg
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& key = scale_keys()[i];
    const auto found = definition.scale.find(key);
    if (found == definition.scale.end()) continue;
    const double value = builder.number(found->second.value, "scale: " + key);
    if (!(value >= smallest && value <= largest))
      throw InputError(definition.place(found->second.value.line),
                       "scale: " + key + ": value = " + shown(value) + " is outside [1e-50, 1e50]");
    scale[i] = value * parse_unit(found->second.unit).factor;
  }
  const auto column = [&](const std::string& text, int line) {
    const Unit unit = parse_unit(text);
    double factor = 1.0 / unit.factor;
    for (std::size_t i = 0; i < 3; ++i) factor *= fixed::power(scale[i], unit.powers[i]);
    if (!(factor >= 1e-200 && factor <= 1e200))
      throw InputError(definition.place(line), "scale: 1 is " + shown(factor) + " " + text + ", which is out of range");
    return PhysicalUnits::Column{text, factor};
  };
  const auto& length = definition.scale.find("length")->second;
  const auto& time = definition.scale.find("time")->second;
  PhysicalUnits units{
      column(time.unit, time.line), column(common_length(definition) + "/" + time.unit, length.line), {}, {}};
  for (const auto& part : definition.of("coordinate")) {
    const auto* own = unit_text(part);
    const auto& text = own ? *own : length.unit;
    units.state.push_back(column(text, part.line));
    units.state.push_back(column(text + "/" + time.unit, part.line));
  }
  for (const char* kind : {"maxwell", "jenkins"})
    for (const auto& part : definition.of(kind)) {
      const std::string own = unit_of_inner(definition, part), &text = own.empty() ? length.unit : own;
      units.state.push_back(column(text, part.line));
      units.state.push_back(column(text + "/" + time.unit, part.line));
    }
  for (const auto& part : definition.of("observable")) units.observables.push_back(column(*unit_text(part), part.line));
  return units;
}

}  // namespace slapstick
