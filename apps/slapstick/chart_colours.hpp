#pragma once
/// The colours of charts.
#include <array>
#include <cmath>

#include "figure/figure.hpp"

namespace slapstick::app {

/// Of classes in the order of their area. With those below any two differ by more than 19 in CIELAB, as people see them
/// and as people with protanopia, deuteranopia and tritanopia do (test/app/chart_colours_test.cpp; the simulation is
/// that of Machado et al. 2009).
inline constexpr std::array<figure::Colour, 10> class_colours{{{34, 136, 238},
                                                               {255, 136, 0},
                                                               {255, 187, 136},
                                                               {0, 68, 85},
                                                               {0, 204, 255},
                                                               {119, 68, 0},
                                                               {170, 102, 170},
                                                               {255, 34, 68},
                                                               {68, 0, 187},
                                                               {85, 0, 119}}};
inline constexpr figure::Colour chaotic_colour{25, 25, 25}, quasi_periodic_colour{120, 120, 120};
inline constexpr figure::Colour other_classes_colour{200, 200, 200}, undecided_colour{255, 255, 255};

/// A scale whose lightness grows evenly, for all colour visions: cividis (Nunez et al. 2018), at equal distances.
inline constexpr std::array<figure::Colour, 10> scale_anchors{{{0, 32, 77},
                                                               {0, 51, 111},
                                                               {57, 72, 107},
                                                               {87, 92, 109},
                                                               {112, 113, 115},
                                                               {138, 135, 121},
                                                               {166, 157, 117},
                                                               {196, 181, 108},
                                                               {228, 207, 91},
                                                               {255, 234, 70}}};
/// @param share  in [0, 1]
[[nodiscard]] inline figure::Colour scale_colour(double share) {
  const double place = share * (scale_anchors.size() - 1);
  const auto below = static_cast<std::size_t>(place < scale_anchors.size() - 1 ? place : scale_anchors.size() - 2);
  const double rest = place - static_cast<double>(below);
  const auto between = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + rest * (static_cast<double>(b) - a)));
  };
  const figure::Colour &a = scale_anchors[below], &b = scale_anchors[below + 1];
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue)};
}

}  // namespace slapstick::app
