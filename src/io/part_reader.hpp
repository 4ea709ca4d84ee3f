#pragma once
/// Reads the [[part]]s of a model file and [matrix] by the table of `part_rules`.
#include "io/tree_reader.hpp"

namespace slapstick {

/// Fills `definition.parts` and `definition.matrices`. `tree` must know the parameters. @throws InputError
/// @returns the names of the displacements and velocities, which [start] may set
std::vector<std::string> read_parts(const TreeReader& tree, const TomlNode& root, Definition& definition);

}  // namespace slapstick
