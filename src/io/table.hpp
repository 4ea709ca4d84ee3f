#pragma once
/// Tables of numbers and words as CSV (RFC 4180), fast enough for millions of rows.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.hpp"

namespace slapstick {

/// Appends a number with 17 significant digits, which read back as the same double: "2.2000000000000002", "inf",
/// "-inf", "nan".
void append_number(std::string& out, double value);

/// The same as a string.
[[nodiscard]] std::string number_text(double value);

/// Writes a CSV file row by row; it appears under its name only after `commit` (see AtomicFile).
///
///     CsvWriter table("events.csv", {"time", "kind", "w"});
///     table.number(0.5).word("impact").number(1.2).end_row();
///     table.commit();
///
/// Columns are separated by ',', rows by '\n'; a word with ',', '"' or a line break is quoted.
class CsvWriter {
 public:
  /// @throws StorageError
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  CsvWriter& number(double value);
  CsvWriter& integer(long long value);
  CsvWriter& word(std::string_view text);
  /// Several numbers in a row, e.g. a State.
  CsvWriter& numbers(const std::vector<double>& values);
  /// @throws std::logic_error if the row has not as many cells as there are columns; StorageError
  void end_row();
  /// @throws StorageError; std::logic_error inside a row
  void commit();

 private:
  void cell();

  AtomicFile file_;
  std::string row_;
  std::size_t columns_, cells_ = 0;
};

}  // namespace slapstick
