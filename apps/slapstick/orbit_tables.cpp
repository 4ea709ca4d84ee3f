/// Writes branches and curves as tables of numbers.
#include "orbit_tables.hpp"

#include <cmath>

#include "branch_table.hpp"
#include "output.hpp"

namespace slapstick::app {
namespace {

/// What every orbit of a branch or curve has.
void add_orbit_columns(TableOutput& table, const orbit::Problem& problem, const orbit::Solution& solution) {
  table.word(solution.label).number(solution.cycle);
  table.number(solution.largest_across());
  table.number(solution.stable() ? 1.0 : 0.0).number(solution.is_motion ? 1.0 : 0.0);
  table.numbers(orbit::at_phase_zero(problem, solution.orbit));
}

std::vector<std::string> with_orbit_columns(std::vector<std::string> columns, const Model& model) {
  for (const char* name : {"class", "period", "largest_multiplier", "stable", "is_motion"}) columns.emplace_back(name);
  for (const std::string& name : state_names(model)) columns.push_back(name);
  return columns;
}

}  // namespace

bool is_table_file(const std::string& path) { return path.ends_with(".csv") || is_column_file(path); }

void write_branches(const std::string& path, const std::vector<orbit::Branch>& branches, const std::string& parameter,
                    const orbit::Problem& problem, const ChosenModel& chosen, const MoreColumns& more) {
  std::vector<std::string> columns = with_orbit_columns({"branch", "point", "type", parameter}, chosen.model);
  columns.insert(columns.end(), more.names.begin(), more.names.end());
  TableOutput table(path, columns, table_facts(chosen, parameter));
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const orbit::Branch& branch = branches[b];
    const auto row = [&](std::size_t point, std::string_view type, double value, const orbit::Solution& solution) {
      table.number(static_cast<double>(b + 1)).number(static_cast<double>(point)).word(type).number(value);
      add_orbit_columns(table, problem, solution);
      if (more.values) table.numbers(more.values(solution));
      table.end_row();
    };
    auto special = branch.special.begin();
    for (; special != branch.special.end() && begins_at(branch, *special); ++special)
      row(0, name(special->type), special->value, special->solution);
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      row(i + 1, "point", branch.points[i].orbit.parameter(), branch.points[i]);
      for (; special != branch.special.end() && special->after == i; ++special)
        row(0, name(special->type), special->value, special->solution);
    }
  }
  table.commit();
}

void write_curves(const std::string& path, const std::vector<CurveRows>& curves, const std::vector<std::string>& names,
                  const ChosenModel& chosen) {
  TableOutput table(path, with_orbit_columns({"curve", "met", names[0], names[1]}, chosen.model), table_facts(chosen));
  for (const CurveRows& one : curves) {
    const auto row = [&](std::string_view met, const std::vector<double>& values, const orbit::Solution& solution) {
      table.word(one.type).word(met).number(values[0]).number(values[1]);
      add_orbit_columns(table, one.problem, solution);
      table.end_row();
    };
    for (std::size_t i = 0; i < one.curve.points.size(); ++i) {
      const orbit::CurvePoint& point = one.curve.points[i];
      row("none", point.values, point.solution);
      for (const orbit::CurveEvent& event : one.curve.met)
        if (event.after == i) row(name(event.met.front()), event.values, point.solution);
    }
  }
  table.commit();
}

}  // namespace slapstick::app
