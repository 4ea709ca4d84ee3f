#pragma once
/// The enumerations and numbers of special points and ends of branches, as JSON beside their sentences.
#include "io/json.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick::app {

/// "occurrence", "margin", "sliding", "contacts", "events", "passage", "jump".
[[nodiscard]] Json typed_json(const orbit::SpecialPoint& special, const System& system);
/// "kind", "failed", "param", "special".
[[nodiscard]] Json end_json(const orbit::Branch& branch, const orbit::BranchEnd& end);
/// "onset", "first", "last" (indices of special points), "changes", "impacts".
[[nodiscard]] Json cascades_json(const orbit::Branch& branch);
/// "type", "kind" and what belongs to the kind.
[[nodiscard]] Json meeting_json(const orbit::Curve& curve, const orbit::Meeting& met, const System& system);
[[nodiscard]] Json end_json(const orbit::CurveEnd& end);

}  // namespace slapstick::app
