#pragma once
/// What a table's file says of all its rows, where the format has a place for it: model, version, parameters, units.
#include <map>
#include <string>
#include <vector>

#include "io/column_table.hpp"
#include "model_options.hpp"

namespace slapstick::app {

struct TableFacts {
  std::vector<Attribute> attributes{};
  std::map<std::string, std::string> units{};  ///< of columns by name; headings with a unit need none
  std::vector<TableAxis> axes{};               ///< of a table that is a grid
  TableLayers layers{};                        ///< .. or several
};

/// @param varied  the parameter that is a column, or ""
[[nodiscard]] TableFacts table_facts(const ChosenModel& chosen, const std::string& varied = {});

}  // namespace slapstick::app
