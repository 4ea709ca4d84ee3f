/// The table of edits, and those that are about numbers and names.
#include "neutral/edits.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>

namespace slapstick::neutral {

const std::vector<Edit>& edits() {
  static const std::vector<Edit> all = {
      {"order-of-coordinates", "coordinates in another order", other_order_of_coordinates},
      {"order-of-links", "springs, dampers, Maxwell elements and forces in another order", other_order_of_links},
      {"order-of-contacts", "contacts in another order, but for stops under `sequence`", other_order_of_contacts},
      {"names", "other names of coordinates, contacts, bases, signals and parameters", other_names},
      {"units-of-two", "length, mass and time in units that are powers of four", units_of_two},
      {"units", "length, mass and time in other units", other_units},
      {"parallel-springs", "a spring as two parallel ones", parallel_springs},
      {"collinear-corner", "a corner more on a straight piece of a polyline", collinear_corner},
      {"parameter", "a constant as a parameter", constant_as_parameter},
      {"force-as-base", "a force as the motion of a base at the end of a spring", force_as_base},
      {"pressed-by-one", "fixed limits as coefficients, and a force of 1 that presses", pressed_by_one},
      {"friction-as-freewheel", "equal limits as those of a freewheel", friction_as_freewheel},
      {"far-stop", "a stop that is never reached", far_stop},
      {"far-pad", "a friction contact that is never pressed", far_pad},
      {"far-compliant-stop", "a compliant stop that is never reached", far_compliant_stop},
      {"zero-force", "a harmonic force of size zero", zero_force},
      {"zero-tone", "a tone of size zero", zero_tone},
      {"zero-signal", "a signal of size zero", zero_signal},
      {"zero-impulse", "an impulse of momentum zero", zero_impulse},
      {"machine-at-rest", "an uncoupled machine at rest beside it", machine_at_rest},
      {"twin", "a copy of the machine beside it", twin_machine},
      {"joined-twin", "a copy beside it, joined by weak springs", joined_twin},
      {"mirror", "the mirrored machine", mirror},
      {"lever", "a coordinate at the other end of a lever", lever},
      {"clock", "another phase and a clock that is later by as much", later_clock},
      {"show", "the file that `show` writes", written_by_show},
  };
  return all;
}

const Edit& find_edit(const std::string& name) {
  const auto found = std::ranges::find_if(edits(), [&](const Edit& edit) { return name == edit.name; });
  if (found == edits().end()) throw std::out_of_range("no edit " + name);
  return *found;
}

Edited in_units(const Definition& file, double l, double t, double m) {
  Edited edited{file, {}};
  edited.rule.length = l, edited.rule.time = t, edited.rule.mass = m;
  each_number(edited.file, [&](Scalar& scalar, Dimension d) {
    const double factor = std::pow(l, d.length) * std::pow(t, d.time) * std::pow(m, d.mass);
    if (factor != 1.0) multiply(scalar, factor);
  });
  return edited;
}

namespace {

/// An expression with a prefix before each of these names.
void rename(Scalar& scalar, const std::vector<ParameterEntry>& parameters, const std::string& prefix) {
  if (!scalar.expression) return;
  std::string text = scalar.expression->text();
  for (const ParameterEntry& entry : parameters)
    text = std::regex_replace(text, std::regex("\\b" + entry.shown.name + "\\b"), prefix + entry.shown.name);
  scalar.expression = Expression(text);
}

}  // namespace

std::optional<Edited> units_of_two(const Definition& file, campaign::Random& random) {
  const auto power = [&] { return std::exp2(2 * random.below(5) - 4); };  // of four: square roots are of two
  const double l = power(), t = power(), m = power();
  Edited edited = in_units(file, l, has_harmonics(file) ? t : 1.0, m);
  // A signal's pieces are rounded in time units. So is the clock's last tick where a load by a velocity is zero.
  const bool loaded = std::ranges::any_of(file.of("friction"), [](const Part& p) {
    return std::ranges::any_of(p.load, [](const auto& term) { return term.first.starts_with("v"); });
  });
  edited.rule.bits = file.of("signal").empty() && file.of("impulse").empty() && !loaded;
  return edited;
}

std::optional<Edited> other_units(const Definition& file, campaign::Random& random) {
  const double l = random.decades(-1, 1), t = random.decades(-1, 1), m = random.decades(-1, 1);
  return in_units(file, l, t, m);
}

std::optional<Edited> other_names(const Definition& file, campaign::Random&) {
  const std::string prefix = "n_";
  Edited edited{file, {}};
  edited.rule.prefix = prefix;
  edited.rule.bits = true;
  Definition& after = edited.file;
  each_number(after, [&](Scalar& scalar, Dimension) { rename(scalar, file.parameters, prefix); });
  for (ParameterEntry& entry : after.parameters)
    rename(entry.value, file.parameters, prefix), entry.shown.name = prefix + entry.shown.name;
  const auto state_name = [&](const std::string& name) {
    for (const Part& coordinate : file.of("coordinate"))
      if (name == velocity_name(coordinate.name)) return velocity_name(prefix + coordinate.name);
    return prefix + name;
  };
  for (auto& [kind, all] : after.parts)
    for (Part& part : all) {
      if (!part.name.empty()) part.name = prefix + part.name;
      for (const char* key : {"name", "base", "signal"})
        if (const auto found = part.texts.find(key); found != part.texts.end()) found->second = prefix + found->second;
      if (!part.load_stop.empty()) part.load_stop = prefix + part.load_stop;
      if (!part.presses.empty()) part.presses = prefix + part.presses;
      for (auto& [name, scalar] : part.load)
        if (name != "constant") name = state_name(name);
    }
  for (auto& [name, scalar] : after.start) name = state_name(name);
  return edited;
}

std::optional<Edited> constant_as_parameter(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  edited.rule.bits = true;
  std::vector<Scalar*> plain;
  each_number(edited.file, [&](Scalar& scalar, Dimension d) {
    if (!scalar.expression && d != dim::pure) plain.push_back(&scalar);
  });
  if (plain.empty()) return std::nullopt;
  Scalar& chosen = *plain[static_cast<std::size_t>(random.below(static_cast<int>(plain.size())))];
  ParameterEntry entry;
  entry.shown.name = "given";
  entry.value = number(chosen.number);
  edited.file.parameters.push_back(entry);
  chosen = {0.0, Expression("given"), 0};
  return edited;
}

std::optional<Edited> written_by_show(const Definition& file, campaign::Random&) {
  Edited edited{read_definition(read(file).to_toml(), "random.toml"), {}};
  edited.rule.bits = true;
  return edited;
}

double sample_grid(const Model& model) { return model.forced() ? model.forcing_period() / 4.0 : 0.75; }

}  // namespace slapstick::neutral
