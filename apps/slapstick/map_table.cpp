/// Writes the findings of a map as rows.
#include "map_table.hpp"

#include <algorithm>
#include <limits>

#include "base/ranges.hpp"

namespace slapstick::app {
namespace {

bool has_directions(const MapWish& wish) { return wish.problem.direction == sweep::Direction::both; }
bool is_refined(const MapWish& wish) { return wish.problem.refine > 0; }
bool has_starts(const MapWish& wish) { return wish.problem.start == sweep::MapStart::random; }

/// Of complete chatter without end; of what is no cycle not a number.
double impacts(const sweep::Finding& found) {
  if (found.n == 0) return std::numeric_limits<double>::quiet_NaN();
  return found.chatter == Chatter::complete ? std::numeric_limits<double>::infinity() : found.p;
}

void write_row(const MapWish& wish, const sweep::Map& map, const sweep::Finding& found, TableOutput& table) {
  table.number(map.x_of(found)).number(map.y_of(found));
  table.word(found.label(map.driven)).word(attractor_word(found));
  table.number(found.n).number(impacts(found)).word(name(found.chatter)).number(found.exponent);
  table.numbers(map.values_of(found));
  table.number(found.multiplier.real()).number(found.multiplier.imag());
  table.number(found.sticking ? 1.0 : 0.0).word(name(found.doubt));
  if (has_directions(wish)) table.word(found.direction == sweep::Direction::up ? "up" : "down");
  if (has_starts(wish)) table.number(found.starts);
  if (is_refined(wish)) table.number(found.filled ? 0.0 : 1.0);
  table.end_row();
}

}  // namespace

std::string_view attractor_word(const sweep::Finding& found) { return found.failed ? "failed" : name(found.attractor); }

std::vector<std::string> map_columns(const MapWish& wish) {
  std::vector<std::string> columns{"x", "y", "class", "attractor", "n", "p", "chatter", "exponent"};
  for (const Wanted& one : wish.of) columns.push_back(one.quantity.name + ":" + one.statistic);
  for (const char* name : {"multiplier_re", "multiplier_im", "sticking", "doubt"}) columns.emplace_back(name);
  if (has_directions(wish)) columns.emplace_back("direction");
  if (has_starts(wish)) columns.emplace_back("starts");
  if (is_refined(wish)) columns.emplace_back("computed");
  return columns;
}

TableFacts map_facts(const MapWish& wish) {
  TableFacts facts = table_facts(wish.chosen, wish.x.name);
  const std::string parameter = "parameter_" + wish.y.name;
  const auto varies = [&](const Attribute& one) { return one.name == parameter; };
  facts.attributes.erase(std::remove_if(facts.attributes.begin(), facts.attributes.end(), varies),
                         facts.attributes.end());
  for (const auto& [column, sweep] : {std::pair{"x", &wish.x}, std::pair{"y", &wish.y}}) {
    facts.attributes.push_back({std::string(column) + "_parameter", sweep->name});
    for (const Parameter& parameter_of : wish.chosen.definition.parameters())
      if (parameter_of.name == sweep->name && parameter_of.unit != "1") facts.units[column] = parameter_of.unit;
  }
  if (is_refined(wish)) facts.attributes.push_back({"refined_from_cells_of", static_cast<double>(wish.problem.refine)});
  if (has_directions(wish)) facts.layers = {"direction", {"up", "down"}};
  if (!has_starts(wish))
    facts.axes = {{"y", wish.y.name, static_cast<std::size_t>(wish.y.count)},
                  {"x", wish.x.name, static_cast<std::size_t>(wish.x.count)}};
  for (const Wanted& one : wish.of) facts.units[one.quantity.name + ":" + one.statistic] = one.quantity.unit;
  return facts;
}

void write_map(const MapWish& wish, const sweep::Map& map, TableOutput& table) {
  for (std::size_t i = 0; i < map.rows(); ++i) write_row(wish, map, map.row(i), table);
  if (ranges::any_of(map.findings, [](const sweep::Finding& found) { return !found.failed; })) table.commit();
}

}  // namespace slapstick::app
