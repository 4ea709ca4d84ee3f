/// Tables and pictures of quantities at instants over a parameter.
#include "values_diagram.hpp"

#include <algorithm>

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "event_options.hpp"
#include "slapstick/base/error.hpp"
#include "span_options.hpp"

namespace slapstick::app {

using sweep::Direction;
using sweep::ReadAt;

bool are_statistics(const std::string& y) {
  const std::vector<std::string> words = split(y, ',');
  const auto with =
      ranges::count_if(words, [](const std::string& word) { return word.find(':') != std::string::npos; });
  if (with == 0) return false;
  if (static_cast<std::size_t>(with) != words.size())
    throw InputError("--y: " + in_quotes(y) +
                     " mixes statistics (Q:STAT, a number a value) with values at instants (Q): choose one");
  return true;
}

namespace {

/// What `ask` says of an option's value, behind the option's name.
template <class Ask>
auto with_option(const char* option, const Ask& ask) {
  try {
    return ask();
  } catch (const InputError& error) {
    throw InputError(option + std::string(error.what()));
  }
}

sweep::InstantChoice instants(const Model& model, const std::string& at) {
  const System system(model);
  if (at != "" && at != "impact" && at != "period") return {ReadAt::events, event_choice(at, system, "--at")};
  return with_option("--at ", [&] { return sweep::parse_instants(at, system); });
}

}  // namespace

ValuesDiagram::ValuesDiagram(const ChosenModel& chosen, const std::string& y, const std::string& at, const Sweep& sweep)
    : chosen_(chosen),
      sweep_(sweep),
      instants_(instants(chosen.model, at)),
      noun_(!at.empty()                            ? at
            : instants_.read_at == ReadAt::periods ? "period"
                                                   : "impact") {
  for (const Wanted& one : parse_wanted("--y", y, quantities(chosen.definition, chosen.overrides))) {
    with_option("--y: ", [&] { sweep::check_value_at(one.quantity, instants_.read_at); });
    of_.push_back(one.quantity);
  }
}

void ValuesDiagram::complete(sweep::DiagramProblem& problem) const {
  problem.values_of = of_;
  problem.read_at = instants_.read_at;
  problem.event = instants_.event;
}

std::vector<std::string> ValuesDiagram::shown() const {
  std::vector<std::string> all;
  for (const Quantity& one : of_) all.push_back(one.name);
  return all;
}

std::vector<std::string> ValuesDiagram::columns() const {
  std::vector<std::string> all{sweep_.name, "direction"};
  for (const std::string& name : shown()) all.push_back(name);
  return all;
}

void ValuesDiagram::write(const sweep::Diagram& diagram, TableOutput& table) const {
  for (const sweep::DiagramPoint& point : diagram.points) {
    for (std::size_t row = 0; row < point.values.size(); row += of_.size()) {
      table.number(point.parameter).word(point.direction == Direction::up ? "up" : "down");
      table.numbers(std::span(point.values).subspan(row, of_.size())).end_row();
    }
  }
  if (ranges::any_of(diagram.points, [](const auto& point) { return point.failure.empty(); })) table.commit();
}

figure::Figure ValuesDiagram::figure(const sweep::Diagram& diagram) const {
  figure::Figure figure{.width_cm = 17.5, .share_x = true};
  for (std::size_t k = 0; k < of_.size(); ++k) {
    figure::Panel panel{.x_label = parameter_axis(chosen_.definition, sweep_.name),
                        .y_label = with_unit(axis_text(of_[k].name), of_[k].unit),
                        .x_range = figure::Range{sweep_.from, sweep_.to}};
    figure::Points up{.label = "up", .colour = figure::colours::dark_blue};
    figure::Points down{.label = "down", .colour = figure::colours::vermillion};
    down.diameter_mm = 0.25, up.diameter_mm = 0.5;  // where both directions agree, up shows as a rim around down
    for (const sweep::DiagramPoint& point : diagram.points) {
      figure::Points& cloud = point.direction == Direction::up ? up : down;
      for (std::size_t i = k; i < point.values.size(); i += of_.size()) {
        cloud.x.push_back(point.parameter);
        cloud.y.push_back(point.values[i]);
      }
    }
    const bool both = !up.x.empty() && !down.x.empty();
    for (figure::Points* cloud : {&up, &down}) {
      if (!both) cloud->label.clear();
      if (!cloud->x.empty()) panel.points.push_back(std::move(*cloud));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace slapstick::app
