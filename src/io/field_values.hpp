#pragma once
/// Values of a part's keys that are lists or tables of numbers: polylines, intervals, ratios, loads, Stribeck curves,
/// bands.
#include <map>
#include <string>
#include <vector>

#include "io/definition.hpp"
#include "io/tree_reader.hpp"

namespace slapstick {

using Numbers = std::map<std::string, Scalar, std::less<>>;

/// 2 to 100 points. @param pair  what messages call one: "[x, force]"
/// @throws InputError, as all of these, with the file's line
[[nodiscard]] std::vector<Point> read_points(const TreeReader& tree, const TomlNode& list, const std::string& where,
                                             const std::string& pair);

/// [from, to]
[[nodiscard]] std::vector<Scalar> read_interval(const TreeReader& tree, const TomlNode& list, const std::string& where);

/// [r_a, r_b]. @param still  do both ends stand still with the ground, and not with a base?
[[nodiscard]] Ratio read_ratio(const TreeReader& tree, const TomlNode& list, const std::string& where, bool still);

/// The normal force of a friction contact. @param states  names of displacements and velocities
void read_load(const TreeReader& tree, const TomlNode& table, const std::string& where,
               const std::vector<std::string>& states, Part& part);

/// By stribeck_keys().
[[nodiscard]] Numbers read_stribeck(const TreeReader& tree, const TomlNode& table, const std::string& where);

/// By band_keys(); `from`, `to`, `lines` and `seed` are whole numbers.
[[nodiscard]] Numbers read_band(const TreeReader& tree, const TomlNode& table, const std::string& where);

/// Fills `samples` of a [[signal]] that names a file: the columns `time` and value, or the one that `column` names. A
/// short one is kept as points, a long one as its file.
/// @throws InputError with the lines of both files, StorageError
void read_signal(const TreeReader& tree, const TomlNode& node, const std::string& where, const std::string& source,
                 Part& part);

}  // namespace slapstick
