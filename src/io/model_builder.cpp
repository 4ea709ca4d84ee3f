/// Builds a Model from the parts of a model file and the values of its parameters.
#include "io/model_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/model_numbers.hpp"
#include "model/fault.hpp"

namespace slapstick {

double ModelBuilder::number(const Scalar& scalar, const LazyText& where) const {
  if (!scalar.expression) return scalar.number;
  try {
    const double value = scalar.expression->evaluate(values_);
    if (numbers_ != nullptr) numbers_->demand(*scalar.expression);
    return value;
  } catch (const InputError& error) {
    throw InputError(definition_.place(scalar.line), where() + ": " + error.what());
  }
}

Dual ModelBuilder::dual(const Scalar& scalar, const LazyText& where) const {
  if (rates_ == nullptr || !scalar.expression) return {number(scalar, where)};
  const Dual result = scalar.expression->differentiated(*rates_);
  if (std::isfinite(result.rate) && std::isfinite(result.value)) return result;
  std::string with, broken;
  for (const auto& name : scalar.expression->names()) {
    with += (with.empty() ? " with " : ", ") + name + " = " + shown(values_.at(name));
    if (!std::isfinite(rates_->at(name).rate)) broken = ", as " + in_quotes(name) + " has none";
  }
  throw InputError(definition_.place(scalar.line), where() + ": expression " + in_quotes(scalar.expression->text()) +
                                                       " has no derivative" + with + broken);
}

std::string ModelBuilder::where(std::string_view key) const {
  return part_label(kind_, index_, definition_.of(kind_)[index_]).append(": ").append(key);
}

Dual ModelBuilder::at(const Part& part, std::string_view key, const Dual& fallback, const LazyText& place) const {
  const auto found = part.fields.find(key);
  return found == part.fields.end() ? fallback : dual(found->second, place);
}

Dual ModelBuilder::field(const Part& part, std::string_view key, const Dual& fallback) const {
  return at(part, key, fallback, [&] { return where(key); });
}

/// `harmonic` of a force or of one term of a base.
int ModelBuilder::harmonic(const Part& part, const LazyText& place) const {
  const Dual number = at(part, "harmonic", Dual{1.0}, place);
  const double value = number.value;
  const bool whole = value >= 0.0 && value <= 1e6 && value == std::floor(value);
  if (whole && !number.varies) return static_cast<int>(value);
  throw InputError(
      definition_.place(part.fields.find("harmonic")->second.line),
      place() + " = " + shown(value) +
          (whole ? " is a whole number, which has no derivative" : " is not a whole number in [0, 1000000]"));
}

namespace {

/// In coordinates that are measured from a base it is the ground.
int end(int index) { return is_base(index) ? ground : index; }

}  // namespace

/// Springs and dampers; to a base they are springs and dampers to ground, and a force for its motion.
void ModelBuilder::add_links(Model& model) {
  each("spring", [&](const Part& part) {
    if (!part.points.empty()) return add_bends(model, part, Characteristic::Over::displacement);
    origins_["spring"].push_back({kind_, index_});
    const Dual stiffness = field(part, "stiffness");
    const auto name = part.texts.find("name");
    model.springs.push_back(
        {end(part.a), end(part.b), written(stiffness), name != part.texts.end() ? name->second : ""});
    model.springs.back().motion = add_motion(model, part, "stiffness", 0);
    model.springs.back().ratio = ratio_of(part);
  });
  each("damper", [&](const Part& part) {
    if (!part.points.empty()) return add_bends(model, part, Characteristic::Over::velocity);
    const Dual coefficient = field(part, "coefficient");
    if (!part.within.empty()) return add_zones(model, part, coefficient);
    origins_["damper"].push_back({kind_, index_});
    const auto name = part.texts.find("name");
    model.dampers.push_back({end(part.a), end(part.b), written(coefficient), part.flag("feeds"),
                             name != part.texts.end() ? name->second : ""});
    model.dampers.back().motion = add_motion(model, part, "coefficient", 1);
    model.dampers.back().ratio = ratio_of(part);
  });
}

/// The inner coordinate of an element, whose numbers are positive.
int ModelBuilder::add_inner(Model& model, const Part& part) {
  for (const auto& [key, scalar] : part.fields)
    if (const Dual value = field(part, key); !(value.value >= smallest && value.value <= largest))
      throw InputError(definition_.place(scalar.line),
                       where(key) + " = " + shown(value.value) + " is not a positive number in [1e-50, 1e50]");
  origins_["coordinate"].push_back({kind_, index_});
  model.coordinates.push_back({inner_name(part.name), 0.0});
  return model.size() - 1;
}

/// Maxwell's: a spring between the ends and, in series with it, an inner coordinate on a damper. Jenkins': a polyline
/// over y - s that is flat outside +-limit / stiffness, and s a slider.
void ModelBuilder::add_elements(Model& model) {
  each("maxwell", [&](const Part& part) {
    const int inner = add_inner(model, part);
    for (const char* kind : {"spring", "damper"}) origins_[kind].push_back({kind_, index_});
    model.springs.push_back({end(part.a), end(part.b), written(part, "stiffness"), part.name});
    model.springs.back().ratio = ratio_of(part);
    model.springs.back().inner = inner;
    model.dampers.push_back({inner, ground, written(part, "damping")});
  });
  each("jenkins", [&](const Part& part) {
    const int inner = add_inner(model, part);
    const Dual limit = field(part, "limit"), at = limit / field(part, "stiffness");
    add(model, bent(part, part.name, Characteristic::Over::displacement), {{{-at, -limit}, {at, limit}}, {}, {}});
    model.characteristics.back().inner = inner;
  });
}

std::vector<std::pair<Dual, Dual>> ModelBuilder::points(const Part& part, std::string_view key) const {
  std::vector<std::pair<Dual, Dual>> all;
  for (const Point& point : part.points) {
    const std::string place = where(key) + ": point " + std::to_string(all.size() + 1);
    all.emplace_back(dual(point.at, place + ": x"), dual(point.force, place + ": force"));
    if (all.size() > 1 && !(all.back().first.value > all[all.size() - 2].first.value))
      throw InputError(definition_.place(point.at.line),
                       place + ": " + shown(all.back().first.value) + " is not above the " +
                           shown(all[all.size() - 2].first.value) + " of the point before");
  }
  return all;
}

void ModelBuilder::add(Model& model, Characteristic head, const Bends& bends) {
  for (const auto& [at, force] : bends.corners) head.corners.push_back({written(at), written(force)});
  head.slope_below = written(bends.below);
  head.slope_above = written(bends.above);
  origins_["characteristic"].push_back({kind_, index_});
  model.characteristics.push_back(std::move(head));
}

/// Of a spring or damper. Where no slope beyond an end is given the last piece goes on, and the end is no corner.
void ModelBuilder::add_bends(Model& model, const Part& part, Characteristic::Over over) {
  const auto all = points(part);
  const auto slope = [&](std::size_t i) {
    return (all[i + 1].second - all[i].second) / (all[i + 1].first - all[i].first);
  };
  const bool below = part.fields.contains("slope_below"), above = part.fields.contains("slope_above");
  Bends bends{{all.begin() + (below ? 0 : 1), all.end() - (above ? 0 : 1)},
              below ? field(part, "slope_below") : slope(0),
              above ? field(part, "slope_above") : slope(all.size() - 2)};
  if (bends.corners.empty())
    throw InputError(
        definition_.place(part.line),
        where("characteristic") + ": two points are a straight line: give a third one, or slope_below or slope_above");
  const auto name = part.texts.find("name");
  const std::string own = std::string(kind_) + std::to_string(index_ + 1);
  add(model, bent(part, name != part.texts.end() ? name->second : own, over), bends);
}

/// A damper of one coefficient within an interval of x_a - x_b, and another outside.
void ModelBuilder::add_zones(Model& model, const Part& part, const Dual& inside) {
  const Dual from = dual(part.within[0], where("within") + ": from"),
             to = dual(part.within[1], where("within") + ": to");
  if (!(from.value < to.value))
    throw InputError(
        definition_.place(part.within[0].line),
        where("within") + ": " + shown(to.value) + " is not above the " + shown(from.value) + " before it");
  const Dual outside = field(part, "coefficient_outside");
  if (!part.flag("feeds"))
    for (const auto& [key, value] : {std::pair("coefficient", inside), std::pair("coefficient_outside", outside)})
      if (value.value < 0.0)
        throw InputError(
            definition_.place(part.line),
            where(key) + " = " + shown(value.value) + " is negative; a damper that may feed energy says feeds = true");
  const auto name = part.texts.find("name");
  const std::string own = std::string(kind_) + std::to_string(index_ + 1);
  add(model, bent(part, name != part.texts.end() ? name->second : own, Characteristic::Over::zones),
      {{{from, inside}, {to, outside}}, outside, outside});
}

/// The base of a contact or of a polyline is the ground: both sides are measured from the base.
void ModelBuilder::stand_still(Model& model) {
  const auto each_of = [](auto& parts) {
    for (auto& part : parts) {
      part.a = end(part.a);
      part.b = end(part.b);
    }
  };
  each_of(model.frictions);
  each_of(model.stops);
  each_of(model.compliant_stops);
  each_of(model.characteristics);
}

/// Between two ends the surroundings move apart by x_base of one less x_base of the other.
BaseMotion ModelBuilder::add_motion(Model& model, const Part& part, std::string_view strength, int order) {
  const int first = static_cast<int>(model.forces.size());
  if (home(part.a) == home(part.b)) return {};
  const Dual size = field(part, strength);
  const bool silent = always_zero(part, strength);
  for (const auto& [coordinate, other] : {std::pair{part.a, part.b}, std::pair{part.b, part.a}}) {
    if (coordinate < 0) continue;
    push(model, coordinate, home(other), size, order, silent);
    push(model, coordinate, home(coordinate), -size, order, silent);
  }
  return {first, static_cast<int>(model.forces.size()) - first};
}

/// x_base   = sum amplitude sin(harmonic omega t + phase)
/// x_base'  = sum amplitude harmonic omega sin(harmonic omega t + phase + pi / 2)
/// x_base'' = sum -amplitude (harmonic omega)^2 sin(harmonic omega t + phase)
void ModelBuilder::push(Model& model, int coordinate, int base, const Dual& strength, int order, bool silent) {
  if (!is_base(base)) return;
  for (const Term& term : bases_[static_cast<std::size_t>(base_end(base))]) {
    if (term.signal >= 0) {
      const std::string& name = definition_.of("base")[static_cast<std::size_t>(base_end(base))].name;
      const bool still = silent || silent_signal(term.signal);
      const int signal = order < 2 || still ? term.signal : acceleration_of(model, term.signal, name);
      add_force(model, {coordinate, 0, written(strength * term.amplitude), 0.0, 0.0, signal, order == 1}, still);
      continue;
    }
    const bool own = term.frequency.value != 0.0;
    if (order > 0 && term.harmonic == 0 && !own) continue;  // a constant displacement has no velocity
    const Dual turning = own ? term.frequency : Dual{static_cast<double>(term.harmonic)} * omega_;
    const Dual frequency = order > 0 ? turning : Dual{1.0};
    const Dual phase = order == 1 ? term.phase + Dual{std::numbers::pi / 2} : term.phase;
    const Dual size =
        order == 2 ? -(strength * term.amplitude * (frequency * frequency)) : strength * frequency * term.amplitude;
    add_force(model, {coordinate, term.harmonic, written(size), written(phase), written(term.frequency)},
              silent || term.silent);
  }
}

void ModelBuilder::add_inertia(Model& model) {
  each("coordinate", [&](const Part& part) {
    const int i = static_cast<int>(index_);
    if (part.fields.contains("mass")) push(model, i, part.b, -field(part, "mass"), 2, always_zero(part, "mass"));
    const auto n = definition_.of("coordinate").size();
    for (int order = 0; order < 3; ++order) {
      const char* key = order == 2 ? "mass" : order == 1 ? "damping" : "stiffness";
      const auto matrix = definition_.matrices.find(key);
      if (matrix == definition_.matrices.end()) continue;
      for (std::size_t j = 0; j < n; ++j) {
        const int base = definition_.of("coordinate")[j].b;
        if (!is_base(base)) continue;
        const Scalar& entry = matrix->second.entries[index_ * n + j];
        if (!always_zero(entry)) push(model, i, base, -dual(entry, std::string("matrix: ") + key), order, false);
      }
    }
  });
}

void ModelBuilder::add_matrices(Model& model) const {
  const auto all = static_cast<std::size_t>(model.size()), n = definition_.of("coordinate").size();
  for (const auto& [key, matrix] : definition_.matrices) {
    auto& entries = key == "mass" ? model.mass : key == "damping" ? model.damping : model.stiffness;
    entries.assign(all * all, 0.0);  // inner coordinates have no rows
    for (std::size_t i = 0; i < n * n; ++i)
      entries[i / n * all + i % n] =
          written(dual(matrix.entries[i], "matrix: " + key + "[" + model.coordinates[i / n].name + ", " +
                                              model.coordinates[i % n].name + "]"));
  }
}

Model ModelBuilder::assembled() {
  Model model;
  model.name = definition_.name;
  model.impact_law = definition_.impact_law.value_or(ImpactLaw::moreau);
  if (definition_.omega) omega_ = dual(*definition_.omega, "omega");
  round_ = common_round();
  if (round_) omega_ = Dual{2.0 * std::numbers::pi} / *round_;
  model.omega = written(omega_);
  each("coordinate", [&](const Part& part) {
    origins_["coordinate"].push_back({kind_, index_});
    model.coordinates.push_back({part.name, written(part, "mass")});
  });
  add_signals(model);
  add_bases();
  add_forces(model);
  add_impulses(model);
  add_links(model);
  add_elements(model);
  add_inertia(model);
  add_contacts(model);
  add_matrices(model);
  stand_still(model);
  return model;
}

Model ModelBuilder::model() {
  Model model = assembled();
  if (!definition_.omega && !round_) demand_no_forcing(model);
  demand_resolved_records(model);
  if (const auto fault = first_fault(model)) throw refusal(*fault, model);
  if (!leave_out_silent(model)) return model;
  if (const auto fault = first_fault(model)) throw refusal(*fault, model);  // without drives the clock is another one
  return model;
}

Model ModelBuilder::rate() {
  Model model = assembled();
  (void)leave_out_silent(model);
  return model;
}

/// Without `omega` there can be no harmonic > 0; the first one is named.
void ModelBuilder::demand_no_forcing(const Model& model) const {
  const auto found = ranges::find_if(model.forces, [](const Force& force) { return force.harmonic > 0; });
  if (found == model.forces.end()) return;
  const Origin& from = origins_.at("force")[static_cast<std::size_t>(found - model.forces.begin())];
  const auto& part = definition_.of(from.kind)[from.index];
  throw InputError(definition_.place(part.line),
                   part_label(from.kind, from.index, part) +
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
    if (fault.part == "force" && kind != fault.part && kind != "impulse" && kind != "freewheel")
      place += ": with its base's motion, as a force";
  }
  return InputError(definition_.place(line), place + ": " + fault.what);
}

State ModelBuilder::start(const Model& model) const {
  const auto names = state_names(model);
  State state(names.size(), 0.0);
  int line = 1;
  for (const auto& [name, scalar] : definition_.start) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    if (at % 2 == 1 && model.is_inner(static_cast<int>(at / 2)))
      throw InputError(definition_.place(scalar.line),
                       "start: " + in_quotes(name) + " follows from the displacements: leave it out");
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
