/// Enumerations of special points and ends as JSON.
#include "branch_json.hpp"

namespace slapstick::app {
namespace {

Json margin_json(const orbit::UsedMargin& margin, const System& system) {
  Json json = Json::object();
  json.set("kind", std::string(name(margin.kind))).set("leg", static_cast<long long>(margin.leg) + 1);
  if (margin.kind != orbit::UsedMargin::Kind::duration)
    json.set("guard", std::string(mode::name(margin.guard)))
        .set("contact", system.contact_name(mode::contact_index(margin.guard, margin.contact, system.model())));
  return json;
}

/// The events that meet at a special point: which leg each ends, what it is and of which contact.
Json events_json(const orbit::SpecialPoint& special, const System& system) {
  Json list = Json::list();
  for (const std::size_t i : orbit::events_at(special)) {
    const orbit::Leg& leg = special.solution.orbit.shape.legs[i];
    Json item = Json::object().set("leg", static_cast<long long>(i) + 1);
    if (leg.ending != orbit::Ending::cut)
      item.set("kind", std::string(name(leg.event))).set("contact", system.contact_name(leg.event_contact));
    list.push(std::move(item));
  }
  return list;
}

}  // namespace

Json typed_json(const orbit::SpecialPoint& special, const System& system) {
  Json json = Json::object();
  json.set("occurrence", std::string(name(special.occurrence)));
  if (special.occurrence == orbit::Occurrence::margin) {
    Json contacts = Json::list();
    for (const int contact : orbit::contacts_at(special, system.model())) contacts.push(system.contact_name(contact));
    json.set("margin", margin_json(special.margin, system)).set("contacts", std::move(contacts));
    json.set("events", events_json(special, system));
  }
  if (special.sliding != orbit::Sliding::unchanged) json.set("sliding", std::string(name(special.sliding)));
  json.set("passage", std::string(name(special.passage)));
  if (special.jump) {
    Json jump = Json::object().set("kind", std::string(name(special.jump->kind)));
    if (special.jump->kind == orbit::Jump::Kind::settles) jump.set("class", special.jump->label);
    if (special.jump->kind == orbit::Jump::Kind::wanders)
      jump.set("cycles", static_cast<long long>(special.jump->cycles));
    json.set("jump", std::move(jump));
  }
  return json;
}

Json end_json(const orbit::Branch& branch, const orbit::BranchEnd& end) {
  Json json = Json::object().set("kind", std::string(name(end.kind))).set("failed", end.failed);
  if (end.special)
    json.set("special", static_cast<long long>(*end.special))
        .set("passage", std::string(name(branch.special[*end.special].passage)));
  return json;
}

Json cascades_json(const orbit::Branch& branch) {
  Json list = Json::list();
  for (const orbit::Cascade& cascade : orbit::cascades(branch))
    list.push(Json::object()
                  .set("onset", static_cast<long long>(cascade.onset))
                  .set("first", static_cast<long long>(cascade.first))
                  .set("last", static_cast<long long>(cascade.last))
                  .set("changes", static_cast<long long>(cascade.changes))
                  .set("impacts", static_cast<long long>(cascade.impacts)));
  return list;
}

Json meeting_json(const orbit::Curve& curve, const orbit::Meeting& met, const System& system) {
  Json json = Json::object().set("type", name(met));
  if (met.kind == orbit::Meeting::Kind::turn) json.set("parameter", curve.parameters[met.parameter]);
  if (met.kind == orbit::Meeting::Kind::margin) json.set("margin", margin_json(met.margin, system));
  return json;
}

Json end_json(const orbit::CurveEnd& end) {
  return Json::object().set("kind", std::string(name(end.kind))).set("failed", end.failed);
}

}  // namespace slapstick::app
