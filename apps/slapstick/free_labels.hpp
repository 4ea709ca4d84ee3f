#pragma once
/// Text at what it names, where nothing else is drawn.
#include <cstddef>
#include <string>
#include <vector>

#include "figure/figure.hpp"

namespace slapstick::app {

/// The number of each branch, written into its line where the other lines are farthest; beside a branch no larger than
/// its number, with a thin line to it.
/// @param first_line  of each branch the first of its lines in the panel; the branches' lines follow one another
void add_branch_numbers(figure::Panel& panel, const std::vector<std::size_t>& first_line);

struct NamedPlace {
  double x = 0.0, y = 0.0;
  std::string name;
};
/// The name of each place beside it, with a thin line to it; once for places of one name that lie on each other in
/// print.
void add_names(figure::Panel& panel, const std::vector<NamedPlace>& places);

}  // namespace slapstick::app
