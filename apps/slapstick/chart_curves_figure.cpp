/// Draws the bifurcation curves of a map, and says how far they explain its boundaries.
#include <algorithm>
#include <cstdio>
#include <set>

#include "chart_curves.hpp"

namespace slapstick::app {
namespace {

struct Style {
  figure::Dash dash;
  figure::Colour colour = figure::colours::black;
};

/// No two types look alike.
Style style_of(orbit::SpecialType type) {
  constexpr figure::Colour red{170, 0, 0}, blue{0, 0, 170};
  switch (type) {
    case orbit::SpecialType::LP:
      return {figure::Dash::dotted};
    case orbit::SpecialType::GR:
      return {figure::Dash::dashed};
    case orbit::SpecialType::CH:
      return {figure::Dash::dashed, red};
    case orbit::SpecialType::SL:
      return {figure::Dash::dash_dotted};
    case orbit::SpecialType::CO:
      return {figure::Dash::dash_dotted, red};
    case orbit::SpecialType::PD:
      return {figure::Dash::solid};
    case orbit::SpecialType::NS:
      return {figure::Dash::solid, red};
    case orbit::SpecialType::BP:
      break;
  }
  return {figure::Dash::solid, blue};
}

}  // namespace

/// Dark on a white rim: seen on light and dark classes alike.
void draw_curves(const chart::Curves& found, figure::Figure& figure) {
  constexpr double rim_pt = 1.9, line_pt = 0.8;
  for (figure::Panel& panel : figure.panels) {
    int group = 0;
    for (const figure::Key& key : panel.keys) group = std::max(group, key.group + 1);
    std::set<orbit::SpecialType> named;
    for (const chart::FoundCurve& curve : found.curves) {
      panel.lines.push_back({.x = curve.x, .y = curve.y, .colour = {255, 255, 255}, .width_pt = rim_pt});
      const auto [dash, colour] = style_of(curve.type);
      panel.lines.push_back({.x = curve.x, .y = curve.y, .colour = colour, .dash = dash, .width_pt = line_pt});
      if (named.insert(curve.type).second)
        panel.keys.push_back(
            {.label = std::string(name(curve.type)), .colour = colour, .size = line_pt, .dash = dash, .group = group});
    }
  }
}

void report_curves(const chart::Curves& found) {
  for (const chart::FoundCurve& curve : found.curves)
    std::fprintf(stderr,
                 "slapstick: %s between %s and %s: %ld boundary edges; along it the pixels on both sides differ at %ld "
                 "places and are alike at %ld\n",
                 std::string(name(curve.type)).c_str(), curve.from.c_str(), curve.to.c_str(), curve.edges, curve.differ,
                 curve.alike);
  std::fprintf(stderr,
               "slapstick: %zu curves explain %ld of %ld boundary edges; at %ld edges tried no curve was found%s\n",
               found.curves.size(), found.explained, found.edges, found.without,
               found.stopped ? "; stopped before the end" : "");
}

}  // namespace slapstick::app
