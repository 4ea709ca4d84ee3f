/// Draws special points: a marker of a shape for each type.
#include "special_markers.hpp"

#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "frame_shares.hpp"

namespace slapstick::app {
namespace {

using figure::Marker;
using orbit::SpecialType;

constexpr double diameter_mm = 1.25;

struct Sign {
  SpecialType type;
  Marker marker;
};
constexpr std::array<Sign, 8> signs{{{SpecialType::LP, Marker::square},
                                     {SpecialType::PD, Marker::disc},
                                     {SpecialType::NS, Marker::diamond},
                                     {SpecialType::BP, Marker::star},
                                     {SpecialType::GR, Marker::delta},
                                     {SpecialType::SL, Marker::nabla},
                                     {SpecialType::CH, Marker::box},
                                     {SpecialType::CO, Marker::circle}}};

}  // namespace

void add_special_points(figure::Panel& panel, const std::vector<SpecialPlace>& places) {
  constexpr double one_place_cm = 0.05;
  const FrameShares frame(panel);
  for (const Sign& sign : signs) {
    figure::Points points{.colour = figure::colours::black,
                          .drawing = figure::Drawing::discs,
                          .diameter_mm = diameter_mm,
                          .marker = sign.marker,
                          .over_lines = true};
    std::vector<PlaceOnPaper> drawn;
    for (const SpecialPlace& place : places) {
      const PlaceOnPaper here = frame.cm(place.x, place.y);
      const auto lies_here = [&](const PlaceOnPaper& other) { return distance(here, other) < one_place_cm; };
      if (place.type != sign.type || ranges::any_of(drawn, lies_here)) continue;
      drawn.push_back(here);
      points.x.push_back(place.x);
      points.y.push_back(place.y);
    }
    if (!points.x.empty()) panel.points.push_back(std::move(points));
  }
}

std::vector<figure::Key> special_keys(const figure::Panel& panel) {
  std::vector<figure::Key> keys;
  for (const Sign& sign : signs)
    for (const figure::Points& points : panel.points)
      if (points.over_lines && points.marker == sign.marker)
        keys.push_back({.label = std::string(name(sign.type)), .marker = sign.marker, .size = diameter_mm, .group = 1});
  return keys;
}

}  // namespace slapstick::app
