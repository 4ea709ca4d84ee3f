#pragma once
/// A map as a table: a row for each motion that was found.
#include "map_options.hpp"
#include "output.hpp"

namespace slapstick::app {

/// x, y, class, attractor, n, p, chatter, exponent, a column for each statistic, then multiplier_re, multiplier_im,
/// sticking and doubt; with two directions `direction`, with random starts `starts`, of a refined map `computed`: 0
/// where the class was filled in and the numbers are NaN.
[[nodiscard]] std::vector<std::string> map_columns(const MapWish& wish);
/// What table formats say of all rows: also what x and y are.
[[nodiscard]] TableFacts map_facts(const MapWish& wish);
/// All rows, and the table is put in place; if every pixel has failed, no table is made.
void write_map(const MapWish& wish, const sweep::Map& map, TableOutput& table);

/// A pixel's class as charts name it: "1-1-II", "chaotic", "failed".
[[nodiscard]] std::string_view attractor_word(const sweep::Finding& found);

}  // namespace slapstick::app
