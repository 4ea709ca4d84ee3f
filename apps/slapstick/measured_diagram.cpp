/// Tables and pictures of statistics over a parameter.
#include "measured_diagram.hpp"

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

std::vector<Wanted> parse_statistics(const std::string& argument, const std::string& text, const ChosenModel& chosen) {
  std::vector<Wanted> wanted = parse_wanted(argument, text, quantities(chosen.definition, chosen.overrides));
  for (const Wanted& one : wanted)
    if (one.statistic.empty())
      throw InputError(argument + ": " + in_quotes(one.quantity.name) +
                       " has no statistic; one number a value is wanted, as " + one.quantity.name + ":rms");
  return wanted;
}

std::string statistic_axis(const Wanted& wanted) {
  const std::string& statistic = wanted.statistic;
  const bool bare = statistic == "crest" || statistic == "number" || statistic == "min_at" || statistic == "max_at" ||
                    statistic == "impulse";
  const std::string unit = statistic.ends_with(":phase") ? "rad" : bare ? "" : wanted.quantity.unit;
  return with_unit(axis_text(wanted.quantity.name + ":" + statistic), unit);
}

MeasuredDiagram::MeasuredDiagram(const ChosenModel& chosen, const std::string& y, const Sweep& sweep)
    : chosen_(chosen), sweep_(sweep), wanted_(parse_statistics("--y", y, chosen)) {
  for (const Wanted& one : wanted_) {
    if (one.quantity.kind == Quantity::Kind::parameter)
      throw InputError("--y: " + in_quotes(one.quantity.name) + " is a parameter, which no motion changes");
    check_of_stretch("--y", one);
  }
}

std::vector<Quantity> MeasuredDiagram::of() const {
  std::vector<Quantity> all;
  for (const Wanted& one : wanted_) all.push_back(one.quantity);
  return all;
}

std::vector<std::string> MeasuredDiagram::shown() const {
  std::vector<std::string> all;
  for (const Wanted& one : wanted_) all.push_back(one.quantity.name + ":" + one.statistic);
  return all;
}

std::vector<std::string> MeasuredDiagram::columns() const {
  std::vector<std::string> all{sweep_.name, "direction"};
  for (const std::string& name : shown()) all.push_back(name);
  return all;
}

void MeasuredDiagram::write(const sweep::Diagram& diagram, TableOutput& table) const {
  for (const sweep::DiagramPoint& point : diagram.points) {
    if (point.of.empty()) continue;
    table.number(point.parameter).word(point.direction == sweep::Direction::up ? "up" : "down");
    for (std::size_t k = 0; k < wanted_.size(); ++k) table.number(statistic(point.of[k], wanted_[k].statistic));
    table.end_row();
  }
  if (ranges::any_of(diagram.points, [](const auto& point) { return point.failure.empty(); })) table.commit();
}

/// A panel for each statistic, and in each a line for each direction.
figure::Figure MeasuredDiagram::figure(const sweep::Diagram& diagram) const {
  figure::Figure figure{.width_cm = 17.5, .share_x = true};
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    figure::Panel panel{.x_label = parameter_axis(chosen_.definition, sweep_.name),
                        .y_label = statistic_axis(wanted_[k]),
                        .x_range = figure::Range{sweep_.from, sweep_.to}};
    figure::Line up{.label = "up", .colour = figure::colours::dark_blue};
    figure::Line down{.label = "down", .colour = figure::colours::vermillion};
    for (const sweep::DiagramPoint& point : diagram.points) {
      if (point.of.empty()) continue;
      figure::Line& line = point.direction == sweep::Direction::up ? up : down;
      line.x.push_back(point.parameter);
      line.y.push_back(statistic(point.of[k], wanted_[k].statistic));
    }
    const bool both = !up.x.empty() && !down.x.empty();
    for (figure::Line* line : {&up, &down}) {
      if (!both) line->label.clear();
      if (!line->x.empty()) panel.lines.push_back(std::move(*line));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace slapstick::app
