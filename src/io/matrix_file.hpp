#pragma once
/// Symmetric matrices from files: Matrix Market (coordinate or array, symmetric or general) and CSV.
///
/// Source of the format: Boisvert, Pozo, Remington, "The Matrix Market exchange formats" (NIST, 1996).
#include <string>
#include <string_view>
#include <vector>

namespace slapstick {

struct FileMatrix {
  std::size_t n = 0;
  std::vector<double> entries;     ///< n x n by rows, exactly symmetric
  std::vector<std::string> names;  ///< of the rows: the heading of a CSV file, or empty
};

/// @param path  ends in .mtx or .csv
/// @throws StorageError for a file that cannot be read; InputError "K.mtx:17: WHAT" for one that is no real square
/// matrix of at most 1000 rows, or whose entries (i, j) and (j, i) differ by more than rounding, 1e-9 of the largest
/// entry. What differs by less is replaced by the mean.
[[nodiscard]] FileMatrix read_matrix_file(const std::string& path);

/// The same of a text.
[[nodiscard]] FileMatrix read_matrix_market(std::string_view text, const std::string& source);
[[nodiscard]] FileMatrix read_matrix_csv(std::string_view text, const std::string& source);

}  // namespace slapstick
