/// Writes a model as the page wants it.
#include "card.hpp"

#include <functional>

#include "slapstick/quantity/quantity.hpp"

namespace slapstick::web {
namespace {

Json parameters_of(const Choice& choice) {
  const auto values = choice.definition.values(choice.set);
  Json list = Json::list();
  for (const Parameter& one : choice.definition.parameters()) {
    Json item = Json::object();
    item.set("name", one.name).set("value", values.at(one.name)).set("unit", one.unit);
    item.set("meaning", one.description).set("expression", one.expression).set("range", one.range());
    item.set("min", one.min).set("max", one.max).set("minOpen", one.min_open).set("maxOpen", one.max_open);
    list.push(std::move(item));
  }
  return list;
}

Json groups_of(const ModelDefinition& definition) {
  Json list = Json::list();
  for (const Group& group : definition.groups()) {
    Json members = Json::list();
    for (const std::string& name : group.members) members.push(name);
    Json item = Json::object();
    item.set("name", group.name).set("members", std::move(members));
    list.push(std::move(item));
  }
  return list;
}

template <class Part>
Json between(const Part& part) {
  Json item = Json::object();
  item.set("a", part.a).set("b", part.b);
  if (part.ratio != Ratio{}) {
    Json ratio = Json::list();
    ratio.push(part.ratio.a).push(part.ratio.b);
    item.set("ratio", std::move(ratio));
  }
  return item;
}

/// A list of parts, each written by `write` into an object that has both ends.
/// @param drawn  whether a part is in the list
template <class Parts, class Write, class Drawn>
Json parts_of(const Parts& parts, const Write& write, const Drawn& drawn) {
  Json list = Json::list();
  for (const auto& part : parts) {
    if (!drawn(part)) continue;
    Json item = between(part);
    write(item, part);
    list.push(std::move(item));
  }
  return list;
}

template <class Parts, class Write>
Json parts_of(const Parts& parts, const Write& write) {
  return parts_of(parts, write, [](const auto&) { return true; });
}

/// Without inner ones: they are the last, and drawn in their elements.
Json coordinates_of(const Choice& choice, const Model& model) {
  const StatedUnits units = choice.definition.stated_units();
  Json list = Json::list();
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    if (model.is_inner(static_cast<int>(i))) continue;
    Json item = Json::object();
    item.set("name", model.coordinates[i].name).set("mass", model.coordinates[i].mass);
    item.set("unit", i < units.coordinates.size() ? units.coordinates[i] : "");
    list.push(std::move(item));
  }
  return list;
}

Json forces_of(const Model& model) {
  Json list = Json::list();
  for (const Force& force : model.forces) {
    if (force.presses >= 0 || force.contact >= 0) continue;  // drawn on coordinates
    Json item = Json::object();
    item.set("on", force.coordinate).set("harmonic", force.harmonic).set("amplitude", force.amplitude);
    item.set("constant", force.harmonic == 0 && force.frequency == 0.0 && force.signal < 0);
    list.push(std::move(item));
  }
  return list;
}

/// What a symmetric matrix couples: springs of no element, drawn as such.
Json couplings_of(const Model& model) {
  Json list = Json::list();
  const auto n = static_cast<std::size_t>(model.size());
  if (model.stiffness.empty()) return list;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j) row += model.stiffness[i * n + j];
    for (std::size_t j = i + 1; j < n; ++j)
      if (model.stiffness[i * n + j] != 0.0) list.push(between(Spring{static_cast<int>(i), static_cast<int>(j), 0.0}));
    if (row != 0.0) list.push(between(Spring{static_cast<int>(i), ground, 0.0}));
  }
  return list;
}

Json mechanism_of(const Choice& choice, const Model& model) {
  Json all = Json::object();
  all.set("coordinates", coordinates_of(choice, model)).set("forces", forces_of(model));
  const auto stiffness = [](Json& item, const Spring& spring) { item.set("stiffness", spring.stiffness); };
  const auto series = [](const Spring& spring) { return spring.inner >= 0; };
  all.set("springs", parts_of(model.springs, stiffness, std::not_fn(series)));
  all.set("maxwells", parts_of(model.springs, stiffness, series));
  all.set("couplings", couplings_of(model));
  all.set("dampers",
          parts_of(
              model.dampers, [](Json& item, const Damper& damper) { item.set("coefficient", damper.coefficient); },
              [&](const Damper& damper) { return !model.is_inner(damper.a) && !model.is_inner(damper.b); }));
  all.set("stops", parts_of(model.stops, [](Json& item, const Stop& stop) {
            item.set("name", stop.name).set("clearance", stop.clearance);
          }));
  all.set("frictions", parts_of(model.frictions, [](Json& item, const FrictionContact& contact) {
            item.set("name", contact.name).set("belt", contact.belt_speed);
          }));
  all.set("compliant", parts_of(model.compliant_stops, [](Json& item, const CompliantStop& stop) {
            item.set("name", stop.name).set("clearance", stop.clearance);
          }));
  all.set("characteristics", parts_of(model.characteristics, [](Json& item, const Characteristic& one) {
            item.set("name", one.name).set("damps", one.over != Characteristic::Over::displacement);
            item.set("slides", one.inner >= 0);
          }));
  return all;
}

/// In the order of System::contact_name.
Json contacts_of(const Model& model) {
  Json list = Json::list();
  const auto add = [&](const char* kind, const std::string& name) {
    list.push(Json::object().set("kind", kind).set("name", name));
  };
  for (const Stop& one : model.stops) add("stop", one.name);
  for (const FrictionContact& one : model.frictions) add("friction", one.name);
  for (const CompliantStop& one : model.compliant_stops) add("compliant", one.name);
  for (const Characteristic& one : model.characteristics) add("characteristic", one.name);
  for (const Signal& one : model.signals) add("signal", one.name);
  return list;
}

Json quantities_list(const Choice& choice) {
  Json list = Json::list();
  for (const Quantity& one : quantities(choice.definition, choice.set)) {
    if (one.kind == Quantity::Kind::parameter) continue;
    Json item = Json::object();
    item.set("name", one.name).set("unit", one.unit).set("kind", std::string(name(one.kind)));
    item.set("meaning", one.meaning).set("atImpacts", one.at_impacts());
    list.push(std::move(item));
  }
  return list;
}

}  // namespace

Json card_of(const Choice& choice) {
  const Model model = choice.model();
  Json card = Json::object();
  card.set("name", choice.definition.name()).set("summary", choice.definition.summary());
  card.set("notes", choice.definition.notes()).set("text", text_of(choice));
  card.set("parameters", parameters_of(choice)).set("groups", groups_of(choice.definition));
  card.set("mechanism", mechanism_of(choice, model)).set("quantities", quantities_list(choice));
  card.set("contacts", contacts_of(model));
  Json names = Json::list();
  for (const std::string& name : state_names(model)) names.push(name);
  card.set("state", std::move(names)).set("start", Json::list(choice.start_at()));
  card.set("period", model.forcing_period()).set("forced", model.forced()).set("periodic", model.periodic());
  return card;
}

Json list_of_models() {
  Json list = Json::list();
  for (const std::string& name : builtin_models()) {
    Json item = Json::object();
    item.set("name", name).set("summary", load_model(name).summary());
    list.push(std::move(item));
  }
  return list;
}

}  // namespace slapstick::web
