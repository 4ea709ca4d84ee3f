/// Builds the contacts of a Model: friction with its laws and normal forces, stops, compliant stops.
#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"
#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/model_builder.hpp"
#include "io/stribeck_law.hpp"

namespace slapstick {
namespace {

using Law = std::vector<std::pair<Dual, Dual>>;

}  // namespace

Law ModelBuilder::stribeck(const Part& part, double* error) const {
  constexpr int most_corners = 100;
  const auto number = [&](const char* key, const Dual& fallback) {
    const auto found = part.stribeck.find(key);
    return found == part.stribeck.end() ? fallback : dual(found->second, where("stribeck") + ": " + key);
  };
  const auto refuse = [&](const char* key, const Dual& value, const std::string& what) {
    const auto found = part.stribeck.find(key);
    throw InputError(definition_.place(found == part.stribeck.end() ? part.line : found->second.line),
                     where("stribeck") + ": " + key + " = " + shown(value.value) + what);
  };
  const Dual corners = number("corners", Dual{20.0}), exponent = number("exponent", Dual{1.0}),
             speed = number("speed", {}), high = number("static", {}), low = number("kinetic", {});
  if (corners.varies ||
      !(corners.value >= 1.0 && corners.value <= most_corners && corners.value == std::floor(corners.value)))
    refuse("corners", corners, " is not a fixed whole number in [1, 100]");
  if (exponent.varies || !(exponent.value >= 0.5 && exponent.value <= 10.0))
    refuse("exponent", exponent, " is not a fixed number in [0.5, 10]");
  if (!(speed.value > 0.0)) refuse("speed", speed, " is not positive");
  if (!(low.value >= 0.0)) refuse("kinetic", low, " is negative");
  if (!(high.value >= low.value)) refuse("kinetic", low, " exceeds static = " + shown(high.value));
  const StribeckFall fall = stribeck_fall(static_cast<int>(corners.value), exponent.value);
  Law law = {{Dual{0.0}, low + (high - low)}};
  for (std::size_t j = 0; j < fall.at.size(); ++j)
    law.emplace_back(speed * Dual{fall.at[j]}, low + (high - low) * Dual{fall.left[j]});
  if (error != nullptr) *error = (high.value - low.value) * fall.error;
  return law;
}

std::vector<LaidLaw> ModelBuilder::laid_laws() {
  std::vector<LaidLaw> all;
  each("friction", [&](const Part& part) {
    if (part.stribeck.empty()) return;
    double most = 0.0;
    static_cast<void>(stribeck(part, &most));
    const double load = part.load.empty() ? 1.0 : dual(part.load.front().second, where("normal_force: constant")).value;
    all.push_back({part.name, load * most});
  });
  return all;
}

/// The force of slip over the speed: points, or one that holds for all speeds.
Law ModelBuilder::friction_law(const Part& part) const {
  if (!part.stribeck.empty()) return stribeck(part);
  if (part.points.empty()) return {{Dual{0.0}, field(part, "kinetic", field(part, "static"))}};
  Law law = points(part);
  if (law.front().first.value != 0.0 || law.front().first.varies)
    throw InputError(definition_.place(part.points.front().at.line),
                     where("characteristic") + ": point 1: the first speed is not 0");
  for (std::size_t i = 0; i < law.size(); ++i)
    if (!(law[i].second.value >= 0.0))
      throw InputError(definition_.place(part.points[i].force.line), where("characteristic") + ": point " +
                                                                         std::to_string(i + 1) + ": force " +
                                                                         shown(law[i].second.value) + " is negative");
  return law;
}

/// Friction f(|w|) is Coulomb friction of kinetic value f(0) and an odd characteristic f(|w|) - f(0) of the same pair.
void ModelBuilder::add_falling_friction(Model& model, const Part& part, const Law& law) {
  const Dual belt_speed = field(part, "belt_speed");
  Bends bends;
  for (std::size_t i = law.size() - 1; i > 0; --i)
    bends.corners.emplace_back(belt_speed - law[i].first, law[0].second - law[i].second);
  for (std::size_t i = 1; i < law.size(); ++i)
    bends.corners.emplace_back(belt_speed + law[i].first, law[i].second - law[0].second);
  add(model, bent(part, part.name + "_speed", Characteristic::Over::velocity), bends);
}

NormalForce ModelBuilder::load(const Part& part, const Model& model) const {
  const std::vector<std::string> states = state_names(model);
  NormalForce normal;
  for (const auto& [key, scalar] : part.load) {
    const double value = written(dual(scalar, where("normal_force: ") + key));
    if (key == "constant") {
      normal.constant = value;
      continue;
    }
    const auto at = static_cast<int>(ranges::find(states, key) - states.begin());
    normal.terms.push_back({at / 2, at % 2 == 0 ? value : 0.0, at % 2 == 0 ? 0.0 : value});
  }
  if (part.load_stop.empty()) return normal;
  std::vector<std::string> names;
  for (const CompliantStop& stop : model.compliant_stops) names.push_back(stop.name);
  const auto found = ranges::find(names, part.load_stop);
  if (found == names.end())
    throw InputError(definition_.place(part.line), where("normal_force") + ": unknown compliant stop " +
                                                       in_quotes(part.load_stop) + suggestion(part.load_stop, names));
  normal.compliant_stop = static_cast<int>(found - names.begin());
  return normal;
}

/// A normal force that is constant makes forces of the coefficients.
void ModelBuilder::add_friction(Model& model, const Part& part) {
  Dual limit = part.stribeck.empty() ? field(part, "static")
                                     : dual(part.stribeck.find("static")->second, where("stribeck") + ": static");
  Law law = friction_law(part);
  std::optional<NormalForce> normal;
  const bool constant = part.load_stop.empty() && part.load.size() == 1 && part.load.front().first == "constant";
  if (constant && !model.is_pressed(static_cast<int>(model.frictions.size()))) {
    const Dual load = dual(part.load.front().second, where("normal_force: constant"));
    if (!(load.value >= 0.0))
      throw InputError(definition_.place(part.load.front().second.line),
                       where("normal_force") + ": constant = " + shown(load.value) + " is negative");
    limit = limit * load;
    for (auto& [speed, force] : law) force = force * load;
  } else if (!part.load.empty() || !part.load_stop.empty()) {
    if (law.size() > 1)
      throw InputError(definition_.place(part.line),
                       where("normal_force") +
                           ": the force changes with the state or with time, and friction over the speed too: their "
                           "product is not linear in the state; give one number for kinetic");
    normal = load(part, model);
  }
  origins_["friction"].push_back({kind_, index_});
  model.frictions.push_back({part.name, part.a, part.b, written(part, "belt_speed"), written(limit),
                             written(law.front().second), std::move(normal), ratio_of(part)});
  if (law.size() > 1) add_falling_friction(model, part, law);
}

/// Where a runs faster than b, F = drag; where it is held, -holds <= F <= drag; where it is overcome, F = -holds. So
/// F = (drag - holds) / 2 + f, with friction f of the limit (drag + holds) / 2.
void ModelBuilder::add_freewheel(Model& model, const Part& part) {
  const Dual holds = field(part, "holds"), drag = field(part, "drag");
  for (const auto& [key, value] : {std::pair("holds", holds), std::pair("drag", drag)})
    if (!(value.value >= 0.0))
      throw InputError(definition_.place(part.fields.find(key)->second.line),
                       where(key) + " = " + shown(value.value) + " is negative");
  const double limit = written((holds + drag) * Dual{0.5}), constant = written((drag - holds) * Dual{0.5});
  const Ratio ratio = ratio_of(part);
  const auto contact = static_cast<int>(model.frictions.size());
  origins_["friction"].push_back({kind_, index_});
  model.frictions.push_back({part.name, part.a, part.b, 0.0, limit, limit, std::nullopt, ratio});
  for (const auto& [end, size] : {std::pair(part.a, -ratio.a), std::pair(part.b, ratio.b)}) {
    if (end < 0) continue;
    Force force{end, 0, size * constant};
    force.contact = contact;
    add_force(model, force, false);
  }
}

Stop ModelBuilder::stop(const Part& part) const {
  Stop stop{part.name, part.a, part.b, written(part, "clearance"), 0.0};
  stop.ratio = ratio_of(part);
  if (part.points.empty()) {
    stop.restitution = written(part, "restitution");
    return stop;
  }
  for (const auto& [speed, restitution] : points(part, "restitution_over_speed")) {
    const Point& point = part.points[stop.corners.size()];
    const std::string place = where("restitution_over_speed") + ": point " + std::to_string(stop.corners.size() + 1);
    if (!(speed.value > 0.0))
      throw InputError(definition_.place(point.at.line),
                       place + ": speed = " + shown(speed.value) + " is not positive");
    if (!(restitution.value >= 0.0 && restitution.value <= 1.0))
      throw InputError(definition_.place(point.force.line),
                       place + ": restitution = " + shown(restitution.value) + " is outside [0, 1]");
    stop.corners.push_back({written(speed), written(restitution)});
  }
  stop.restitution = stop.corners.front().restitution;
  return stop;
}

CompliantStop ModelBuilder::compliant_stop(const Part& part) const {
  const auto found = part.texts.find("law");
  const std::string law = found == part.texts.end() ? "" : found->second;
  Dual stiffness = field(part, "stiffness");
  if (part.fields.contains("unloading_stiffness")) {
    const Dual back = field(part, "unloading_stiffness");
    if (!(back.value > 0.0 && back.value <= stiffness.value))
      throw InputError(definition_.place(part.fields.find("unloading_stiffness")->second.line),
                       where("unloading_stiffness") + " = " + shown(back.value) +
                           " is outside (0, stiffness]: beyond, each contact would feed energy");
    stiffness = (stiffness + back) * Dual{0.5};
  }
  return {part.name,
          part.a,
          part.b,
          written(part, "clearance"),
          written(stiffness),
          written(part, "damping"),
          part.flag("pulls") || law == "pulls",
          law == "bounded",
          ratio_of(part)};
}

/// Stiffness k of loading and k_u of unloading: a spring (k + k_u) / 2 whose force N is the normal force of friction on
/// the same pair, with the coefficient (k - k_u) / (k + k_u).
void ModelBuilder::add_hysteresis(Model& model) {
  const auto& origins = origins_["compliant_stop"];
  for (std::size_t i = 0; i < model.compliant_stops.size(); ++i) {
    kind_ = origins[i].kind;
    index_ = origins[i].index;
    const Part& part = definition_.of(kind_)[index_];
    if (!part.fields.contains("unloading_stiffness")) continue;
    const Dual forth = field(part, "stiffness"), back = field(part, "unloading_stiffness");
    const double coefficient = written((forth - back) / (forth + back));
    const CompliantStop& stop = model.compliant_stops[i];
    NormalForce normal;
    normal.compliant_stop = static_cast<int>(i);
    origins_["friction"].push_back({kind_, index_});
    model.frictions.push_back(
        {stop.name + "_hysteresis", stop.a, stop.b, 0.0, coefficient, coefficient, normal, stop.ratio});
  }
}

/// A two-sided stop stands for two: NAME_upper as it is written, and NAME_lower on x_b - x_a.
void ModelBuilder::add_contacts(Model& model) {
  const auto sides = [&](const Part& part, auto& stops, auto stop) {
    auto& origins = origins_[std::string(kind_)];
    origins.push_back({kind_, index_});
    stops.push_back(stop);
    if (!part.flag("two_sided")) return;
    stops.back().name += "_upper";
    stop.name += "_lower";
    std::swap(stop.a, stop.b);
    std::swap(stop.ratio.a, stop.ratio.b);
    stop.clearance = written(field(part, "clearance_lower", field(part, "clearance")));
    origins.push_back({kind_, index_, true});
    stops.push_back(stop);
  };
  each("stop", [&](const Part& part) { sides(part, model.stops, stop(part)); });
  each("compliant_stop", [&](const Part& part) { sides(part, model.compliant_stops, compliant_stop(part)); });
  each("friction", [&](const Part& part) { add_friction(model, part); });
  add_hysteresis(model);
  each("freewheel", [&](const Part& part) { add_freewheel(model, part); });
}

}  // namespace slapstick
