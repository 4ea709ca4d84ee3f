/// Scales tables to physical units, by the model's [scale].
#include "physical.hpp"

#include "base/text.hpp"

namespace slapstick::app {
namespace {

std::string heading(const std::string& name, const PhysicalUnits::Column& column) {
  return column.unit.empty() ? name : name + " [" + column.unit + "]";
}

}  // namespace

TableUnits::TableUnits(const ChosenModel& chosen, bool physical) : states_(state_names(chosen.model)) {
  for (const Observable& observable : chosen.definition.observables()) observables_.push_back(observable.name);
  units_.state.resize(states_.size());
  units_.observables.resize(observables_.size());
  if (!physical) return;
  const auto units = blaming(chosen.overrides, [&](const Overrides& sets) { return chosen.definition.physical(sets); });
  if (!units)
    throw InputError("--physical: model " + in_quotes(chosen.model.name) +
                     " has no [scale] (see docs/reference/model_file.md)");
  units_ = *units;
}

void TableUnits::add_headings(std::vector<std::string>& to, const std::vector<std::string>& names,
                              const std::vector<PhysicalUnits::Column>& columns) const {
  for (std::size_t i = 0; i < names.size(); ++i) to.push_back(heading(names[i], columns[i]));
}

std::vector<std::string> TableUnits::event_columns() const {
  std::vector<std::string> columns = {heading("time", units_.time), "kind", "contact", heading("w", units_.w)};
  add_headings(columns, states_, units_.state);
  return columns;
}

std::vector<std::string> TableUnits::trajectory_columns() const {
  std::vector<std::string> columns = {heading("time", units_.time)};
  add_headings(columns, states_, units_.state);
  columns.emplace_back("mode");
  add_headings(columns, observables_, units_.observables);
  return columns;
}

}  // namespace slapstick::app
