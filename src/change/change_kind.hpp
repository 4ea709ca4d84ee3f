#pragma once
/// What a change of events is called: by the margin that is used up, and, where the events on both sides of it are
/// known, by those.
///
/// The sliding of a friction contact is the sequence of its states over a cycle (di Bernardo et al. 2008, section 8.2).
/// Where one side has a run more, the change is named by it:
///     a stick between two slips of opposite senses      crossing-sliding
///     a stick, or a reversal and back, within a slip    grazing-sliding
///     a reversal before a stick, or after it            switching-sliding
///     a slip within a stick                             adding-sliding
#include "orbit/margins.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

/// From one side: the type, the margin, and how sliding changes.
[[nodiscard]] SpecialType type_of(const TestValue& test, const Itinerary& shape);
[[nodiscard]] UsedMargin used(const TestValue& test);
[[nodiscard]] Sliding kind_of_sliding(const TestValue& test, const Itinerary& shape);

/// From both sides, wherever the branch came from: GR where impacts or the states of stops differ, else SL where
/// friction contacts' do, else CO.
struct ChangeOfEvents {
  SpecialType type = SpecialType::CO;
  Sliding sliding = Sliding::unchanged;
};
/// @param here, beyond  orbits beside the change, or at it
[[nodiscard]] ChangeOfEvents compare_events(const Orbit& here, const Orbit& beyond);

}  // namespace slapstick::orbit
