/// Draws maps: classes in colours that can be told apart, quantities on a scale.
#include "chart_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "axis_text.hpp"
#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "chart_colours.hpp"
#include "chart_parts.hpp"
#include "measured_diagram.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

using figure::Cells;
using sweep::Finding;

/// What is drawn of a pixel: of several attractors the one with most starts, and how many there are.
struct Shown {
  std::int32_t place = -1;  ///< among the findings; -1: nothing
  std::int32_t attractors = 0;
  bool filled = false;
};

std::vector<Shown> shown_pixels(const sweep::Map& map, sweep::Direction direction) {
  std::vector<Shown> all(static_cast<std::size_t>(map.x.count) * static_cast<std::size_t>(map.y.count));
  for (std::size_t i = 0; i < map.findings.size(); ++i) {
    if (map.findings[i].direction != direction) continue;
    Shown& pixel = all[static_cast<std::size_t>(map.findings[i].pixel)];
    if (pixel.attractors++ == 0) pixel.place = static_cast<std::int32_t>(i);
  }
  for (std::size_t pixel = 0; pixel < map.stands_for.size(); ++pixel)
    if (all[pixel].place < 0) all[pixel] = {map.stands_for[pixel], 1, true};
  return all;
}

Cells empty_cells(const sweep::Map& map) {
  return {.x = edges(map.x), .y = edges(map.y), .columns = map.x.count, .rows = map.y.count};
}

std::vector<sweep::Direction> directions_of(const MapWish& wish) {
  if (wish.problem.direction == sweep::Direction::both) return {sweep::Direction::up, sweep::Direction::down};
  return {wish.problem.direction};
}

/// Colours of the classes of a map, the same in all of its panels. Takes 4 bytes a finding.
class ClassColours {
 public:
  explicit ClassColours(const sweep::Map& map) {
    std::map<std::string, std::int32_t> known;
    for (const Finding& found : map.findings) {
      const auto [place, is_new] =
          known.try_emplace(found.label(map.driven), static_cast<std::int32_t>(classes_.size()));
      if (is_new) classes_.push_back({place->first});
      class_of_.push_back(place->second);
    }
    if (map.stands_for.empty())
      for (const std::int32_t one : class_of_) ++class_at(one).area;
    for (const std::int32_t place : map.stands_for) ++class_at(class_of_[static_cast<std::size_t>(place)]).area;
    std::size_t next = 0;
    for (Class* one : by_area()) one->colour = colour_of(one->label, next);
  }

  [[nodiscard]] figure::Colour of(const Shown& pixel) const {
    return classes_[static_cast<std::size_t>(class_of_[static_cast<std::size_t>(pixel.place)])].colour;
  }

  /// The legend: classes by their area among these pixels, then the others together.
  [[nodiscard]] std::vector<figure::Key> keys(const std::vector<Shown>& pixels) {
    for (Class& one : classes_) one.area = 0;
    for (const Shown& pixel : pixels)
      if (pixel.place >= 0) ++class_at(class_of_[static_cast<std::size_t>(pixel.place)]).area;
    std::vector<figure::Key> keys;
    const long whole = static_cast<long>(pixels.size());
    long others = 0, kinds = 0;
    for (const Class* one : by_area()) {
      if (one->area == 0) continue;
      if (one->colour == other_classes_colour) {
        others += one->area;
        ++kinds;
      } else {
        keys.push_back(swatch(axis_text(one->label) + "  " + percent(one->area, whole), one->colour));
      }
    }
    if (kinds > 0)
      keys.push_back(swatch(std::to_string(kinds) + " others  " + percent(others, whole), other_classes_colour));
    return keys;
  }

 private:
  struct Class {
    std::string label{};
    figure::Colour colour{};
    long area = 0;  ///< in pixels
  };

  Class& class_at(std::int32_t place) { return classes_[static_cast<std::size_t>(place)]; }

  /// The largest first; of equal ones in the order of their labels.
  std::vector<Class*> by_area() {
    std::vector<Class*> sorted;
    for (Class& one : classes_) sorted.push_back(&one);
    ranges::sort(sorted, [](const Class* a, const Class* b) {
      return a->area != b->area ? a->area > b->area : a->label < b->label;
    });
    return sorted;
  }

  /// @param next  of the colours of classes
  static figure::Colour colour_of(const std::string& label, std::size_t& next) {
    if (label == name(Attractor::chaotic)) return chaotic_colour;
    if (label == name(Attractor::quasi_periodic)) return quasi_periodic_colour;
    if (label == name(Attractor::undecided)) return undecided_colour;
    return next < class_colours.size() ? class_colours[next++] : other_classes_colour;
  }

  std::vector<Class> classes_;
  std::vector<std::int32_t> class_of_;  // each finding's
};

void draw_classes(ClassColours& colours, const std::vector<Shown>& pixels, Cells& cells, figure::Panel& panel) {
  for (const Shown& pixel : pixels) {
    if (pixel.place < 0) {
      cells.codes.push_back(Cells::clear);
      continue;
    }
    const figure::Colour colour = colours.of(pixel);
    auto place = ranges::find(cells.colours, colour);
    if (place == cells.colours.end()) place = cells.colours.insert(place, colour);
    cells.codes.push_back(static_cast<std::uint8_t>(place - cells.colours.begin()));
  }
  panel.keys = colours.keys(pixels);
}

/// The number that a column gives a pixel, or not a number.
double value_of(const MapWish& wish, const sweep::Map& map, const Shown& pixel, const std::string& column) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (pixel.place < 0) return none;
  const Finding& found = map.findings[static_cast<std::size_t>(pixel.place)];
  if (found.failed) return none;
  if (column == "n") return found.n > 0 ? found.n : none;
  if (column == "p") return found.n > 0 && found.chatter != Chatter::complete ? found.p : none;
  if (pixel.filled) return none;
  if (column == "exponent") return found.exponent;
  if (column == "multiplier") return std::abs(found.multiplier);
  if (column == "attractors") return pixel.attractors;
  for (std::size_t k = 0; k < wish.of.size(); ++k)
    if (column == wish.of[k].quantity.name + ":" + wish.of[k].statistic) return map.values_of(found)[k];
  return none;
}

/// A round step of about a fifth of the range: 1, 2 or 5 times a power of ten.
double round_step(double range) {
  const double raw = range / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10.0 * power;
}

/// The range of a scale: the outermost half percent of the values on either side takes the colour of the end.
figure::Range scale_range(std::vector<double> values) {
  if (values.empty()) return {0.0, 1.0};
  ranges::sort(values);
  const std::size_t cut = values.size() / 200;
  figure::Range range{values[cut], values[values.size() - 1 - cut]};
  if (range.min == range.max) range = {range.min - 0.5, range.max + 0.5};
  return range;
}

/// @param whole  the values are whole numbers, and so are those of the legend
/// @param none  what pixels without a value are called
void draw_scale(const std::vector<double>& values, bool whole, const char* none, Cells& cells, figure::Panel& panel) {
  constexpr int shades = 200;
  std::vector<double> finite;
  ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  const figure::Range range = scale_range(finite);
  const auto share = [&](double value) { return std::clamp((value - range.min) / (range.max - range.min), 0.0, 1.0); };
  for (int i = 0; i < shades; ++i) cells.colours.push_back(scale_colour(static_cast<double>(i) / (shades - 1)));
  for (const double value : values)
    cells.codes.push_back(std::isfinite(value) ? static_cast<std::uint8_t>(std::lround(share(value) * (shades - 1)))
                                               : Cells::clear);
  const auto text = [&](double value, const char* form) {
    char words[48];
    std::snprintf(words, sizeof words, form, std::abs(value) < 1e-9 * (range.max - range.min) ? 0.0 : value);
    panel.keys.push_back(swatch(words, scale_colour(share(value))));
  };
  if (finite.empty()) return panel.keys.push_back(swatch(none, undecided_colour));
  const double step = std::max(round_step(range.max - range.min), whole ? 1.0 : 0.0);
  const auto [least, most] = std::minmax_element(finite.begin(), finite.end());
  text(range.min, *least < range.min ? "\u2264 %.3g" : "%.3g");
  for (double tick = std::floor(range.min / step + 1.2) * step; tick < range.max - 0.2 * step; tick += step)
    text(tick, "%.6g");
  text(range.max, *most > range.max ? "\u2265 %.3g" : "%.3g");
  if (finite.size() < values.size()) panel.keys.push_back(swatch(none, undecided_colour));
}

std::string title_of(const MapWish& wish, const std::string& column) {
  if (column == "multiplier") return "largest multiplier, absolute value";
  if (column == "exponent") return "largest Lyapunov exponent";
  if (column == "attractors") return "number of attractors";
  for (const Wanted& one : wish.of)
    if (column == one.quantity.name + ":" + one.statistic) return statistic_axis(one);
  return column == "class" || column == "computed" ? "" : column;
}

/// Which pixels of a refined map were computed.
void draw_computed(const std::vector<Shown>& pixels, Cells& cells, figure::Panel& panel) {
  cells.colours = {class_colours[0], other_classes_colour};
  for (const Shown& pixel : pixels)
    cells.codes.push_back(pixel.place < 0 ? Cells::clear : static_cast<std::uint8_t>(pixel.filled ? 1 : 0));
  panel.keys = {swatch("computed", cells.colours[0]), swatch("filled in", cells.colours[1])};
}

/// "5.3 % of the pixels computed", or nothing for a map that has no others.
std::string share_computed(const sweep::Map& map) {
  if (map.stands_for.empty()) return {};
  return percent(static_cast<long>(map.findings.size()), static_cast<long>(map.rows())) + " of the pixels computed";
}

void add_to_title(const std::string& words, figure::Panel& panel) {
  panel.title += (panel.title.empty() || words.empty() ? "" : ", ") + words;
}

/// A panel without its cells.
figure::Panel empty_panel(const MapWish& wish, const std::string& column) {
  return {.x_label = parameter_axis(wish.chosen.definition, wish.x.name),
          .y_label = parameter_axis(wish.chosen.definition, wish.y.name),
          .title = title_of(wish, column),
          .x_range = edges(wish.problem.x),
          .y_range = edges(wish.problem.y),
          .legend = figure::Legend::below};
}

void fill(const MapWish& wish, const sweep::Map& map, ClassColours& colours, const std::string& column,
          sweep::Direction direction, figure::Panel& panel) {
  const std::vector<Shown> pixels = shown_pixels(map, direction);
  if (column == "class" || column == "computed") add_to_title(share_computed(map), panel);
  if (wish.problem.direction == sweep::Direction::both)
    add_to_title(direction == sweep::Direction::up ? "up" : "down", panel);
  Cells cells = empty_cells(map);
  if (column == "class") {
    draw_classes(colours, pixels, cells, panel);
  } else if (column == "computed") {
    draw_computed(pixels, cells, panel);
  } else {
    std::vector<double> values;
    for (const Shown& pixel : pixels) values.push_back(value_of(wish, map, pixel, column));
    draw_scale(values, column == "n" || column == "p" || column == "attractors",
               map.stands_for.empty() ? "none" : "none, or filled in", cells, panel);
  }
  panel.cells = std::move(cells);
}

}  // namespace

std::vector<std::string> shown_columns(const MapWish& wish, const std::string& show) {
  std::vector<std::string> known{"class", "exponent", "multiplier", "n", "p"};
  if (wish.problem.start == sweep::MapStart::random) known.emplace_back("attractors");
  if (wish.problem.refine > 0) known.emplace_back("computed");
  std::vector<std::string> usual{"class"};
  for (const Wanted& one : wish.of) {
    known.push_back(one.quantity.name + ":" + one.statistic);
    usual.push_back(known.back());
  }
  if (show.empty()) return usual;
  std::vector<std::string> columns = split(show, ',');
  for (const std::string& column : columns)
    if (ranges::find(known, column) == known.end())
      throw InputError("--show: " + in_quotes(column) + " is no column that can be drawn" + suggestion(column, known));
  return columns;
}

std::vector<NamedInset> chart_insets(const MapWish& wish, const InsetOptions& options) {
  return read_insets(options, {wish.x.name, edges(wish.problem.x)}, {{wish.y.name, edges(wish.problem.y)}});
}

figure::Figure chart_outline(const MapWish& wish, const ChartLook& look) {
  figure::Figure figure;
  for (const std::string& column : look.columns)
    for (std::size_t k = 0; k < directions_of(wish).size(); ++k) figure.panels.push_back(empty_panel(wish, column));
  const bool several = figure.panels.size() > 1;
  figure.columns = several ? 2 : 1;
  figure.width_cm = several ? 17.5 : 12.0;
  figure.row_cm = several ? 7.0 : 8.5;
  add_insets(look.insets, {wish.y.name}, figure);
  return figure;
}

figure::Figure chart_figure(const MapWish& wish, const sweep::Map& map, const ChartLook& look) {
  ClassColours colours(map);
  figure::Figure figure = chart_outline(wish, look);
  std::size_t panel = 0;
  for (const std::string& column : look.columns)
    for (const sweep::Direction direction : directions_of(wish))
      fill(wish, map, colours, column, direction, figure.panels[panel++]);
  return figure;
}

}  // namespace slapstick::app
