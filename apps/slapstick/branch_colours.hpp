#pragma once
/// A colour for each branch of a picture.
#include <array>
#include <cstddef>

#include "figure/figure.hpp"

namespace slapstick::app {

/// Of the motions that settle, beneath the branches.
inline constexpr figure::Colour settled_colour{165, 165, 165};

/// A dozen that can be told apart; those of further branches come again, and their numbers tell them apart.
inline constexpr std::array<figure::Colour, 12> branch_colours{{figure::colours::dark_blue,
                                                                figure::colours::vermillion,
                                                                figure::colours::green,
                                                                figure::colours::purple,
                                                                figure::colours::orange,
                                                                figure::colours::sky_blue,
                                                                {120, 70, 20},
                                                                {130, 30, 110},
                                                                {120, 140, 0},
                                                                {0, 90, 90},
                                                                {220, 30, 80},
                                                                {100, 90, 220}}};
[[nodiscard]] inline figure::Colour branch_colour(std::size_t branch) {
  return branch_colours[branch % branch_colours.size()];
}

/// Up to this many branches have an entry in the legend: as many rows as that takes are no more than a part of a
/// picture.
inline constexpr std::size_t most_named_branches = 24;

}  // namespace slapstick::app
