#pragma once
/// What a change of events is called: by the margin that is used up, and, where the events on both sides of it are known, by those.
///
/// The sliding of a friction contact is the sequence of its states over a cycle (di Bernardo et al. 2008, section 8.2). Where one side has a run more,
/// that is    a stick between two slips of opposite senses            crossing-sliding
///            a stick, or a reversal and back, within a slip          grazing-sliding
///            a reversal before a stick, or behind it                 switching-sliding
///            a slip within a stick                                   adding-sliding
#include "orbit/margins.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {

/// Is it a change of events, other than LP, PD, NS and BP?
[[nodiscard]] bool changes_events(SpecialType type);

/// From one side: the type, the margin in words, and how sliding changes (" (crossing-sliding)"; empty where that is not to be told).
[[nodiscard]] SpecialType type_of(const TestValue& test, const Itinerary& shape);
[[nodiscard]] std::string describe(const TestValue& test, const Itinerary& shape, const System& system);
[[nodiscard]] std::string_view kind_of_sliding(const TestValue& test, const Itinerary& shape);

/// From both sides, wherever the branch came from: GR where impacts or the states of stops differ, else SL where friction contacts' do, else CO.
struct ChangeOfEvents {
  SpecialType type = SpecialType::CO;
  std::string_view sliding;  ///< as kind_of_sliding
};
/// @param here, beyond  orbits beside the change, or at it
[[nodiscard]] ChangeOfEvents change_between(const Orbit& here, const Orbit& beyond);

}  // namespace slapstick::orbit
