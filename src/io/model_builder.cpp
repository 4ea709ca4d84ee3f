/// Builds a Model from the parts of a model file and the values of its parameters.
#include "io/model_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "io/model_numbers.hpp"
#include "model/fault.hpp"
#include "base/text.hpp"

namespace slapstick {

/// Calls `add(part)` for every part of a kind; kind_ and index_ say which one it is, for messages.
template <class Add>
void ModelBuilder::each(const char* kind, Add add) {
  kind_ = kind;
  index_ = 0;
  for (const auto& part : definition_.of(kind)) {
    add(part);
    ++index_;
  }
}

double ModelBuilder::number(const Scalar& scalar, const std::string& where) const {
  if (!scalar.expression) return scalar.number;
  try {
    const double value = scalar.expression->evaluate(values_);
    if (numbers_ != nullptr) numbers_->demand(*scalar.expression);
    return value;
  } catch (const InputError& error) {
    throw InputError(definition_.place(scalar.line), where + ": " + error.what());
  }
}

Dual ModelBuilder::dual(const Scalar& scalar, const std::string& where) const {
  if (rates_ == nullptr || !scalar.expression) return {number(scalar, where)};
  const Dual result = scalar.expression->differentiated(*rates_);
  if (std::isfinite(result.rate) && std::isfinite(result.value)) return result;
  std::string with, broken;
  for (const auto& name : scalar.expression->names()) {
    with += (with.empty() ? " with " : ", ") + name + " = " + shown(values_.at(name));
    if (!std::isfinite(rates_->at(name).rate)) broken = ", as " + in_quotes(name) + " has none";
  }
  throw InputError(definition_.place(scalar.line), where + ": expression " + in_quotes(scalar.expression->text()) +
                   ": it has no derivative" + with + broken);
}

std::string ModelBuilder::where(std::string_view key) const {
  return part_label(kind_, index_, definition_.of(kind_)[index_]).append(": ").append(key);
}

Dual ModelBuilder::at(const Part& part, std::string_view key, const Dual& fallback, const std::string& place) const {
  const auto found = part.fields.find(key);
  return found == part.fields.end() ? fallback : dual(found->second, place);
}

Dual ModelBuilder::field(const Part& part, std::string_view key, const Dual& fallback) const {
  return at(part, key, fallback, where(key));
}

/// `harmonic` of a force or of one term of a base.
int ModelBuilder::harmonic(const Part& part, const std::string& place) const {
  const Dual number = at(part, "harmonic", Dual{1.0}, place);
  const double value = number.value;
  const bool whole = value >= 0.0 && value <= 1e6 && value == std::floor(value);
  if (whole && !number.varies) return static_cast<int>(value);
  throw InputError(definition_.place(part.fields.find("harmonic")->second.line), place + " = " + shown(value) +
                   (whole ? " is a whole number, which has no derivative" : " is not a whole number in [0, 1000000]"));
}

/// Springs and dampers; to a base they are springs and dampers to ground, and a force for its motion.
void ModelBuilder::add_links(Model& model) {
  const auto end = [](int index) { return is_base(index) ? ground : index; };
  each("spring", [&](const Part& part) {
    const Dual stiffness = field(part, "stiffness");
    model.springs.push_back({end(part.a), end(part.b), written(stiffness)});
    add_motion(model, part, stiffness, false);
  });
  each("damper", [&](const Part& part) {
    const Dual coefficient = field(part, "coefficient");
    model.dampers.push_back({end(part.a), end(part.b), written(coefficient)});
    add_motion(model, part, coefficient, true);
  });
}

/// What a base passes on: strength * x_base, or strength * x_base' with
/// x_base' = sum amplitude harmonic omega sin(harmonic omega t + phase + pi / 2).
void ModelBuilder::add_motion(Model& model, const Part& part, const Dual& strength, bool velocity) {
  const int base = is_base(part.a) ? part.a : part.b;
  if (!is_base(base)) return;
  const int coordinate = is_base(part.a) ? part.b : part.a;
  for (const Term& term : bases_[static_cast<std::size_t>(base_end(base))]) {
    if (velocity && term.harmonic == 0) continue;  // a constant displacement has no velocity
    const Dual frequency = velocity ? Dual{static_cast<double>(term.harmonic)} * omega_ : Dual{1.0};
    const Dual phase = velocity ? term.phase + Dual{std::numbers::pi / 2} : term.phase;
    model.forces.push_back({coordinate, term.harmonic, written(strength * frequency * term.amplitude), written(phase)});
    origins_["force"].push_back({kind_, index_});
  }
}

double ModelBuilder::base(std::size_t k, double omega, double time) const {
  double sum = 0.0;
  for (const Term& term : bases_[k])
    sum +=
        term.amplitude.value * (term.harmonic == 0 ? 1.0 : fixed::sin(term.harmonic * omega * time + term.phase.value));
  return sum;
}

/// A two-sided stop stands for two: NAME_upper as it is written, and NAME_lower on x_b - x_a.
void ModelBuilder::add_contacts(Model& model) {
  each("friction", [&](const Part& part) {
    const Dual limit = field(part, "static");
    model.frictions.push_back({part.name, part.a, part.b, written(part, "belt_speed"), written(limit),
                               written(field(part, "kinetic", limit))});
  });
  const auto sides = [&](const Part& part, auto& stops, auto stop) {
    auto& origins = origins_[std::string(kind_)];
    origins.push_back({kind_, index_});
    stops.push_back(stop);
    if (!part.flag("two_sided")) return;
    stops.back().name += "_upper";
    stop.name += "_lower";
    std::swap(stop.a, stop.b);
    stop.clearance = written(field(part, "clearance_lower", field(part, "clearance")));
    origins.push_back({kind_, index_, true});
    stops.push_back(stop);
  };
  each("stop", [&](const Part& part) {
    sides(part, model.stops, Stop{part.name, part.a, part.b, written(part, "clearance"), written(part, "restitution")});
  });
  each("compliant_stop", [&](const Part& part) {
    sides(part, model.compliant_stops,
          CompliantStop{part.name, part.a, part.b, written(part, "clearance"), written(part, "stiffness"),
                        written(part, "damping"), part.flag("pulls")});
  });
}

void ModelBuilder::add_matrices(Model& model) const {
  const auto n = static_cast<std::size_t>(model.size());
  for (const auto& [key, matrix] : definition_.matrices) {
    auto& entries = key == "mass" ? model.mass : key == "damping" ? model.damping : model.stiffness;
    for (std::size_t i = 0; i < n * n; ++i)
      entries.push_back(written(dual(matrix.entries[i], "matrix: " + key + "[" + model.coordinates[i / n].name + ", " +
                                                            model.coordinates[i % n].name + "]")));
  }
}

Model ModelBuilder::assembled() {
  Model model;
  model.name = definition_.name;
  model.impact_law = definition_.impact_law.value_or(ImpactLaw::moreau);
  if (definition_.omega) omega_ = dual(*definition_.omega, "omega");
  model.omega = written(omega_);
  each("coordinate", [&](const Part& part) { model.coordinates.push_back({part.name, written(part, "mass")}); });
  each("base", [&](const Part& part) {
    auto& terms = bases_.emplace_back();
    for (const auto& term : part.harmonics) {
      const auto place = where("harmonics ") + std::to_string(terms.size() + 1) + ": ";
      terms.push_back({at(term, "amplitude", {}, place + "amplitude"), harmonic(term, place + "harmonic"),
                       at(term, "phase", {}, place + "phase")});
    }
  });
  each("force", [&](const Part& part) {
    origins_["force"].push_back({kind_, index_});
    model.forces.push_back(
        {part.a, harmonic(part, where("harmonic")), written(part, "amplitude"), written(part, "phase")});
  });
  add_links(model);
  add_contacts(model);
  add_matrices(model);
  return model;
}

Model ModelBuilder::model() {
  Model model = assembled();
  if (!definition_.omega) demand_no_forcing(model);
  if (const auto fault = first_fault(model)) throw refusal(*fault, model);
  return model;
}

/// Without `omega` there can be no harmonic > 0; the first one is named.
void ModelBuilder::demand_no_forcing(const Model& model) const {
  const auto found = ranges::find_if(model.forces, [](const Force& force) { return force.harmonic > 0; });
  if (found == model.forces.end()) return;
  const Origin& from = origins_.at("force")[static_cast<std::size_t>(found - model.forces.begin())];
  const auto& part = definition_.of(from.kind)[from.index];
  throw InputError(definition_.place(part.line), part_label(from.kind, from.index, part) +
                   (from.kind == "force" ? ": harmonic " : ": its base moves with harmonic ") +
                   std::to_string(found->harmonic) + " of the forcing frequency, and the file has no 'omega'" +
                   (values_.contains("omega") ? ": write omega = \"omega\" above [parameters]" : ""));
}

const ModelBuilder::Origin* ModelBuilder::origin(const Fault& fault) const {
  const auto found = origins_.find(fault.part);
  return fault.index < 0 || found == origins_.end() ? nullptr : &found->second[static_cast<std::size_t>(fault.index)];
}

/// The fault at its line. Of a part that stands for another (a force for a base's spring) the line is the other's.
InputError ModelBuilder::refusal(const Fault& fault, const Model& model) const {
  int line = 1;
  std::string place = fault.place(model);
  if (fault.part == "matrix") {
    line = definition_.matrices.find(fault.field)->second.line;
  } else if (fault.index < 0) {
    line = fault.field == "omega" && definition_.omega ? definition_.omega->line : 1;
  } else {
    const auto* from = origin(fault);
    const std::string_view kind = from ? from->kind : std::string_view{fault.part};
    const auto index = from ? from->index : static_cast<std::size_t>(fault.index);
    const auto& part = definition_.of(kind)[index];
    place = part_label(kind, index, part);
    auto found = part.fields.find(fault.field);
    if (from && from->lower && fault.field == "clearance" && part.fields.contains("clearance_lower"))
      found = part.fields.find("clearance_lower");
    line = found == part.fields.end() ? part.line : found->second.line;
    if (kind != fault.part) place += ": with its base's motion, as a force";
  }
  return InputError(definition_.place(line), place + ": " + fault.what);
}

State ModelBuilder::start(const Model& model) const {
  const auto names = state_names(model);
  State state(names.size(), 0.0);
  int line = 1;
  for (const auto& [name, scalar] : definition_.start) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    state[static_cast<std::size_t>(at)] = number(scalar, "start: " + name);
    line = scalar.line;
  }
  if (const auto fault = first_fault(model, state)) {
    if (fault->behind_stop) throw BehindStop(definition_.place(line), "start: " + fault->what);
    throw InputError(definition_.place(line), "start: " + fault->what);
  }
  return state;
}

}  // namespace slapstick
