#pragma once
/// Special points in a picture: a marker of a shape for each type, at the point. Filled: LP, PD, NS; open: where the
/// events change; a star: BP.
#include <vector>

#include "figure/figure.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

struct SpecialPlace {
  orbit::SpecialType type = orbit::SpecialType::LP;
  double x = 0.0, y = 0.0;
};

/// Adds them to a panel over its lines, a series for each type. Of several of one type that lie on each other in print
/// one is drawn.
void add_special_points(figure::Panel& panel, const std::vector<SpecialPlace>& places);

/// The entries of the legend for the types that a panel has.
[[nodiscard]] std::vector<figure::Key> special_keys(const figure::Panel& panel);

}  // namespace slapstick::app
