/// Runs `spectrum --sweep`, and draws its waterfall.
#include "order_map_run.hpp"

#include <algorithm>
#include <cmath>

#include "axis_text.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

constexpr std::size_t most_lines = 60;   ///< in a picture: of more values every second, third, .. is drawn
constexpr double shown_decibels = 60.0;  ///< below the largest level
constexpr double lines_high = 4.0;       ///< the largest level stands this many lines high

/// Heights in [0, 1] of all amplitudes: of the largest one, or of a level.
std::vector<double> heights(const OrderMap& map, bool decibels) {
  const double top = map.amplitude.empty() ? 0.0 : *std::max_element(map.amplitude.begin(), map.amplitude.end());
  std::vector<double> all;
  for (const double one : map.amplitude) {
    const double below = 20.0 * std::log10(one / top) / shown_decibels;
    all.push_back(!(top > 0.0) ? 0.0 : decibels ? std::max(0.0, 1.0 + below) : one / top);
  }
  return all;
}

void write(const OrderMap& map, TableOutput& table) {
  const std::size_t lines = map.order.size();
  for (std::size_t i = 0; i < map.value.size(); ++i)
    for (std::size_t k = 0; k < lines; ++k) {
      table.number(map.value[i]).number(map.time[i]).number(map.order[k]);
      table.number(map.order[k] / map.period[i]).number(map.amplitude[i * lines + k]).end_row();
    }
  table.commit();
}

}  // namespace

figure::Figure waterfall_figure(const OrderMap& map, const SpectrumLabels& labels, const std::string& parameter) {
  figure::Panel panel;
  panel.x_label = labels.forced ? "order" : "frequency [per unit of time]";
  panel.y_label = parameter;
  panel.legend = figure::Legend::none;
  const std::string name = axis_text(labels.name);
  panel.title = labels.decibels ? "level of " + name + ": from line to line 15 dB" : "amplitude of " + name;
  const std::vector<double> height = heights(map, labels.decibels);
  const std::size_t every = (map.value.size() + most_lines - 1) / most_lines, lines = map.order.size();
  if (map.value.size() > 1) {
    const double spacing = std::abs(map.value[1] - map.value[0]) * static_cast<double>(every);
    for (std::size_t i = 0; i < map.value.size(); i += every) {
      figure::Line line;
      line.colour = figure::colours::dark_blue;
      line.width_pt = 0.5;
      line.x = map.order;
      for (std::size_t k = 0; k < lines; ++k)
        line.y.push_back(map.value[i] + lines_high * spacing * height[i * lines + k]);
      panel.lines.push_back(std::move(line));
    }
  }
  figure::Figure figure;
  figure.width_cm = 17.5;
  figure.height_cm = 11.0;
  figure.panels.push_back(std::move(panel));
  return figure;
}

int order_map_run(const OrderMapWish& wish, const ChosenModel& chosen, const State& start, const Quantity& of,
                  const SpectrumLabels& labels, const Context& context) {
  const Climb climb = wish.range.climb(chosen);
  if (wish.settle >= wish.range.hold)
    throw InputError("--settle: " + std::to_string(wish.settle) + " periods are all of --hold " +
                     std::to_string(wish.range.hold));
  TableFacts facts = table_facts(chosen, climb.name);
  facts.units["amplitude"] = of.unit;
  TableOutput table(wish.out, {climb.name, "time", "order", "frequency", "amplitude"}, facts);
  const Plot plot(wish.plot, wish.plot_size);
  RunUp run = run_of(climb, chosen, start);
  Progress progress("values", static_cast<double>(climb.options.steps), wish.progress);
  const OrderMap map = order_map(run, of,
                                 {wish.highest_order, static_cast<long>(wish.settle), &context.stop,
                                  [&](long steps) { progress.update(static_cast<double>(steps)); }});
  write(map, table);
  const figure::Figure picture = waterfall_figure(map, labels, parameter_axis(chosen.definition, climb.name));
  return plot.write_or_say(picture, picture.panels[0].lines.empty(), map.complete ? done : interrupted);
}

}  // namespace slapstick::app
