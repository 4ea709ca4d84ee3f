#pragma once
/// [matrix] of a model file: matrices written out, or taken from Matrix Market and CSV files beside the model file.
#include <string>
#include <vector>

#include "io/tree_reader.hpp"

namespace slapstick {

/// The coordinates that `[matrix] coordinates` names, a list or a file with a name a line, in the order of the
/// matrices' rows. These coordinates have no mass of their own. Empty where the key is absent.
/// @throws InputError, StorageError
[[nodiscard]] std::vector<Part> matrix_rows(const TreeReader& tree, const TomlNode& root, const std::string& source);

/// Fills `Definition::matrices`: n x n entries for the n coordinates, whatever coordinates the rows stand for.
/// @throws InputError, StorageError
void read_matrices(const TreeReader& tree, const TomlNode& root, const std::vector<std::string>& coordinates,
                   Definition& definition);

}  // namespace slapstick
