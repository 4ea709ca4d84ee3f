#pragma once
/// Where the impact law decides who moves on.
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

/// What `check` says where there are any.
extern const char* const how_rows_are_struck;

/// Stops, as indices of Model::stops, that touch in this state beside another one on the same body. A blow on such a
/// row is another one by each law. Of five equal balls without loss, the first with speed 1, Moreau's law leaves
/// -0.6, 0.4, 0.4, 0.4, 0.4; in sequence the last ball goes off alone. Both keep momentum and energy.
[[nodiscard]] std::vector<int> struck_together(const Model& model, const State& state);

}  // namespace slapstick
