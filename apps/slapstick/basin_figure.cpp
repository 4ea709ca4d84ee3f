/// Draws basins: a colour for each attractor.
#include "basin_figure.hpp"

#include <algorithm>
#include <map>

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "chart_colours.hpp"
#include "chart_parts.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::app {
namespace {

using sweep::Basins;

/// What belongs to no basin.
struct Outside {
  std::int32_t what;
  const char* name;
  figure::Colour colour;
};
constexpr Outside outsides[] = {{Basins::undecided, "undecided", undecided_colour},
                                {Basins::inadmissible, "not admissible", {225, 225, 225}},
                                {Basins::failed, "failed", {160, 160, 160}}};

/// As of a chart: of the largest ten one each, the others together; of motions without a cycle their own.
std::vector<figure::Colour> colours_of(const Basins& basins) {
  std::vector<figure::Colour> colours;
  std::size_t next = 0;
  for (const sweep::Basin& basin : basins.basins) {
    const Attractor kind = basin.attractor.attractor;
    if (kind == Attractor::chaotic)
      colours.push_back(chaotic_colour);
    else if (kind == Attractor::quasi_periodic)
      colours.push_back(quasi_periodic_colour);
    else
      colours.push_back(next < class_colours.size() ? class_colours[next++] : other_classes_colour);
  }
  return colours;
}

std::string axis_name(const BasinWish& wish, std::size_t place) {
  const Model& model = wish.chosen.model;
  const int coordinate = static_cast<int>(place / 2);
  const AxisUnits units(wish.chosen.definition, model);
  return with_unit("initial " + axis_symbol(state_names(model)[place]),
                   place % 2 == 0 ? units.displacement(coordinate, ground) : units.velocity(coordinate, ground));
}

std::size_t place_of(const BasinWish& wish, const std::string& name) {
  const std::vector<std::string> names = state_names(wish.chosen.model);
  return static_cast<std::size_t>(ranges::find(names, name) - names.begin());
}

/// With its share of the admissible starts.
figure::Key key(const std::string& name, long starts, const Basins& basins, figure::Colour colour) {
  const long admissible = static_cast<long>(basins.of.size()) - basins.count(Basins::inadmissible);
  return swatch(name + "  " + percent(starts, admissible), colour);
}

void fill_cells(const Basins& basins, const std::vector<figure::Colour>& colours, figure::Panel& panel) {
  figure::Cells cells{.x = edges(basins.x), .y = edges(basins.y), .columns = basins.x.count, .rows = basins.y.count};
  const auto code = [&](figure::Colour colour) {
    auto place = ranges::find(cells.colours, colour);
    if (place == cells.colours.end()) place = cells.colours.insert(place, colour);
    return static_cast<std::uint8_t>(place - cells.colours.begin());
  };
  std::map<std::int32_t, std::uint8_t> codes;
  for (std::size_t i = 0; i < colours.size(); ++i) codes[static_cast<std::int32_t>(i)] = code(colours[i]);
  for (const Outside& one : outsides) codes[one.what] = code(one.colour);
  codes[Basins::missing] = figure::Cells::clear;
  cells.codes.reserve(basins.of.size());
  for (const std::int32_t of : basins.of) cells.codes.push_back(codes.at(of));
  panel.cells = std::move(cells);
}

void add_keys(const Basins& basins, const std::vector<figure::Colour>& colours, figure::Panel& panel) {
  const std::vector<std::string> names = basin_names(basins);
  long others = 0, kinds = 0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    if (colours[i] == other_classes_colour) {
      others += basins.basins[i].starts;
      ++kinds;
    } else {
      panel.keys.push_back(key(axis_text(names[i]), basins.basins[i].starts, basins, colours[i]));
    }
  }
  if (kinds > 0) panel.keys.push_back(key(std::to_string(kinds) + " others", others, basins, other_classes_colour));
  for (const Outside& one : outsides)
    if (const long count = basins.count(one.what); count > 0)
      panel.keys.push_back(one.what == Basins::inadmissible ? swatch(one.name, one.colour)
                                                            : key(one.name, count, basins, one.colour));
}

constexpr figure::Marker open_markers[] = {figure::Marker::circle, figure::Marker::box, figure::Marker::delta,
                                           figure::Marker::nabla, figure::Marker::cross};

/// Where an attractor is at phase 0, on the plane of the two numbers; at rest where it rests. Empty where it has no
/// such points.
figure::Points points_of(const BasinWish& wish, const Basins& basins, std::size_t basin) {
  const std::size_t x = place_of(wish, wish.plane.x), y = place_of(wish, wish.plane.y);
  const Classification& found = basins.basins[basin].attractor;
  figure::Points points{.colour = figure::colours::black, .drawing = figure::Drawing::discs, .diameter_mm = 1.8};
  points.marker = open_markers[basin];
  const bool at_rest = found.attractor == Attractor::equilibrium;
  if (!at_rest && !(basins.driven && found.n > 0)) return points;
  points.label = axis_text(basin_names(basins)[basin]) + (at_rest ? "" : " at phase 0");
  Motion motion(System(wish.chosen.model), found.state);
  for (int k = 0; k < (at_rest ? 1 : found.n); ++k) {
    if (k > 0) (void)run_to(motion, Instant{k, 0.0}, nullptr, [] {});
    const State state = motion.state();
    points.x.push_back(state[x]);
    points.y.push_back(state[y]);
  }
  return points;
}

}  // namespace

std::vector<std::string> basin_names(const sweep::Basins& basins) {
  std::map<std::string, int> all, seen;
  for (const sweep::Basin& basin : basins.basins) ++all[basin.attractor.label];
  std::vector<std::string> names;
  for (const sweep::Basin& basin : basins.basins) {
    const std::string& label = basin.attractor.label;
    names.push_back(all[label] > 1 ? label + " (" + std::to_string(++seen[label]) + ")" : label);
  }
  return names;
}

figure::Figure basin_outline(const BasinWish& wish) {
  figure::Figure figure{.width_cm = 12.0, .row_cm = 8.5};
  figure.panels = {{.x_label = axis_name(wish, place_of(wish, wish.plane.x)),
                    .y_label = axis_name(wish, place_of(wish, wish.plane.y)),
                    .x_range = edges(wish.plane.problem.x),
                    .y_range = edges(wish.plane.problem.y),
                    .legend = figure::Legend::below}};
  return figure;
}

figure::Figure basin_figure(const BasinWish& wish, const sweep::Basins& basins) {
  figure::Figure figure = basin_outline(wish);
  figure::Panel& panel = figure.panels.front();
  const std::vector<figure::Colour> colours = colours_of(basins);
  fill_cells(basins, colours, panel);
  add_keys(basins, colours, panel);
  for (std::size_t i = 0; i < std::min(basins.basins.size(), std::size(open_markers)); ++i)
    if (figure::Points points = points_of(wish, basins, i); !points.x.empty())
      panel.points.push_back(std::move(points));
  return figure;
}

}  // namespace slapstick::app
