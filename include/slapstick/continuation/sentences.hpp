#pragma once
/// Results of the continuation in words: the one place where their sentences are made. No program takes a sentence
/// apart: all that it says is in the result's enumerations and numbers.
#include <optional>
#include <string>
#include <utility>

#include "slapstick/continuation/branch.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick::orbit {

/// A margin that is used up: "the gap of stop touches zero in leg 2". @param shape  of the orbit whose leg it is
[[nodiscard]] std::string describe(const UsedMargin& margin, const Itinerary& shape, const System& system);
/// What happens at a special point: "the gap of stop touches zero in leg 2".
[[nodiscard]] std::string what_happens(const SpecialPoint& point, const System& system);
/// What becomes of the branch there: "persistence", "jump to 1-2-I"; empty where the events stay.
[[nodiscard]] std::string what_becomes(const SpecialPoint& point);
/// "supercritical", or why there is no coefficient; empty where no coefficient is asked for.
[[nodiscard]] std::string sentence(const NormalForm& form);
/// Does the branch go on behind a change of events?
[[nodiscard]] bool goes_on(const Branch& branch, const SpecialPoint& special);
/// The classes before and behind a change of events: of the branch, in the order of its points, or of the orbit of
/// another branch in which it ends.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> classes_around(const Branch& branch,
                                                                                const SpecialPoint& special);
/// Why a branch ends at either side.
[[nodiscard]] std::string sentence(const Branch& branch);
[[nodiscard]] std::string sentence(const Branch& branch, const BranchEnd& end);
/// The conditions that come to hold at a point of a curve.
[[nodiscard]] std::string sentence(const Curve& curve, const CurveEvent& event, const System& system);
/// Why a curve ends at either side.
[[nodiscard]] std::string sentence(const Curve& curve, const System& system);

}  // namespace slapstick::orbit
