/// A legend below the frame: as many rows as it needs, each place decided here. (gnuplot's own would choose its columns
/// by the terminal.)
#include <algorithm>

#include "base/ranges.hpp"
#include "layout.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

std::vector<Key> all_keys(const Panel& panel) {
  std::vector<Key> keys = panel.keys;
  int next = 0;
  for (const Key& key : keys) next = std::max(next, key.group + 1);
  for (const Points& points : panel.points)
    if (!points.label.empty())
      keys.push_back({.label = points.label,
                      .colour = points.colour,
                      .marker = points.marker,
                      .size = std::max(points.diameter_mm, 0.6),
                      .group = next});
  for (const Line& line : panel.lines)
    if (!line.label.empty())
      keys.push_back(
          {.label = line.label, .colour = line.colour, .size = line.width_pt, .dash = line.dash, .group = next});
  ranges::stable_sort(keys, {}, &Key::group);
  return keys;
}

/// What the samples of a group take, which its texts stand behind.
template <class Keys>
double sample_em(Keys first, Keys last) {
  const bool lines = std::any_of(first, last, [](const Key& key) { return !key.marker; });
  return lines ? spacing::line_sample : spacing::marker_sample;
}

}  // namespace

std::vector<KeyPlace> place_keys(const Panel& panel, double cell_cm, double em_cm) {
  const double font_cm = spacing::legend_font * em_cm, room = cell_cm - 2 * spacing::edge * em_cm;
  std::vector<KeyPlace> places;
  const std::vector<Key> keys = all_keys(panel);
  int row = -1;
  double used = 0.0;
  for (auto first = keys.begin(); first != keys.end();) {
    const auto last = std::find_if(first, keys.end(), [&](const Key& key) { return key.group != first->group; });
    const double sample = sample_em(first, last) * font_cm;
    const auto width = [&](const Key& key) {
      return sample + (spacing::after_sample + width_em(key.label) + spacing::between_keys) * font_cm;
    };
    double widest = 0.0;
    for (auto key = first; key != last; ++key) widest = std::max(widest, width(*key));
    const auto columns = std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(room / widest));
    for (auto key = first; key != last; ++key) {
      const std::ptrdiff_t column = (key - first) % columns;
      if (column == 0) ++row;
      places.push_back({*key, static_cast<double>(column) * widest, sample + spacing::after_sample * font_cm, row});
      used = std::max(used, places.back().x_cm + width(*key) - spacing::between_keys * font_cm);
    }
    first = last;
  }
  for (KeyPlace& place : places) place.x_cm += spacing::edge * em_cm + std::max(0.0, 0.5 * (room - used));
  return places;
}

}  // namespace slapstick::figure
