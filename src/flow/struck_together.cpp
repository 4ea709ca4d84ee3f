/// Finds rows of stops that touch.
#include "slapstick/flow/struck_together.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick {

const char* const how_rows_are_struck =
    "these stops touch in a row: impact_law \"moreau\" shares a blow among all, \"sequence\" hands it on, as in "
    "Newton's cradle";

namespace {

bool touches(const Stop& stop, const State& state) {
  constexpr double gap_rounding = 0x1p-50;
  return std::abs(stop.clearance - relative(stop, state, 0)) <=
         gap_rounding * (std::abs(stop.clearance) + relative_size(stop, state));
}

bool share_a_body(const Stop& one, const Stop& other) {
  const auto on = [&](int body) { return body != ground && (body == other.a || body == other.b); };
  return on(one.a) || on(one.b);
}

}  // namespace

std::vector<int> struck_together(const Model& model, const State& state) {
  std::vector<int> all;
  for (std::size_t i = 0; i < model.stops.size(); ++i) {
    bool beside = false;
    for (std::size_t j = 0; j < model.stops.size() && touches(model.stops[i], state); ++j)
      beside = beside || (i != j && touches(model.stops[j], state) && share_a_body(model.stops[i], model.stops[j]));
    if (beside) all.push_back(static_cast<int>(i));
  }
  return all;
}

}  // namespace slapstick
