/// Names of what happens at special points, and the events and contacts that take part.
#include "slapstick/orbit/special_point.hpp"

#include <array>

#include "base/ranges.hpp"

namespace slapstick::orbit {
namespace {

template <class Enumeration, std::size_t Count>
std::string_view named(Enumeration value, const std::array<std::string_view, Count>& names) {
  return names.at(static_cast<std::size_t>(value));
}

}  // namespace

std::string_view name(SpecialType type) {
  return named<SpecialType, 8>(type, {"LP", "PD", "NS", "BP", "GR", "SL", "CH", "CO"});
}

std::string_view name(Occurrence occurrence) {
  return named<Occurrence, 10>(occurrence, {"fold", "doubling", "end-of-doubled", "torus", "crossing",
                                            "broken-symmetry", "margin", "release", "onset", "death"});
}

std::string_view name(UsedMargin::Kind kind) {
  return named<UsedMargin::Kind, 4>(kind, {"least", "speed", "duration", "no-stick"});
}

std::string_view name(Sliding sliding) {
  return named<Sliding, 5>(sliding, {"unchanged", "crossing", "grazing", "switching", "adding"});
}

std::string_view name(Passage passage) {
  return named<Passage, 12>(passage, {"same-events", "persistence", "fold", "jump", "family", "cascade", "merges",
                                      "equilibrium", "symmetric", "retraced", "not-followed", "unknown"});
}

std::string_view name(Jump::Kind kind) { return named<Jump::Kind, 3>(kind, {"settles", "wanders", "departs"}); }

std::string_view name(NormalForm::Verdict verdict) {
  return named<NormalForm::Verdict, 9>(verdict, {"none", "fold", "supercritical", "subcritical", "not-simple",
                                                 "resonance", "other-critical", "too-inexact", "no-map"});
}

std::vector<std::size_t> events_at(const SpecialPoint& point) {
  const std::size_t legs = point.solution.orbit.legs(), leg = point.margin.leg;
  const bool of_margin = point.occurrence == Occurrence::margin || point.occurrence == Occurrence::death;
  if (!of_margin || legs == 0) return {};
  switch (point.margin.kind) {
    case UsedMargin::Kind::duration:
      return {(leg + legs - 1) % legs, leg};
    case UsedMargin::Kind::least:
      return point.margin.at_start ? std::vector{(leg + legs - 1) % legs} : std::vector<std::size_t>{};
    case UsedMargin::Kind::speed:
    case UsedMargin::Kind::no_stick:
      break;
  }
  return {leg};
}

std::vector<int> contacts_at(const SpecialPoint& point, const Model& model) {
  std::vector<int> contacts;
  const auto add = [&](int contact) {
    if (ranges::find(contacts, contact) == contacts.end()) contacts.push_back(contact);
  };
  if (point.occurrence != Occurrence::margin && point.occurrence != Occurrence::death) return contacts;
  for (const std::size_t leg : events_at(point))
    if (const Leg& ends = point.solution.orbit.shape.legs[leg]; ends.ending != Ending::cut) add(ends.event_contact);
  if (point.margin.kind != UsedMargin::Kind::duration)
    add(mode::contact_index(point.margin.guard, point.margin.contact, model));
  return contacts;
}

}  // namespace slapstick::orbit
