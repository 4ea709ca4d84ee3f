#pragma once
/// Rows of numbers of a CSV file, with their lines in the file for messages.
///
/// Numbers are separated by commas, semicolons, blanks or tabs; a line that begins with # or % is a comment. A first
/// row that holds names is the heading.
#include <string>
#include <string_view>
#include <vector>

namespace slapstick {

struct NumberRows {
  struct Row {
    std::vector<double> numbers;
    int line = 0;
  };
  std::vector<std::string> heading;  ///< empty: the file has no heading
  std::vector<Row> rows;             ///< of finite numbers; all of one length
};

/// "K.csv:12: "
[[nodiscard]] std::string line_of(const std::string& source, int line);

/// The fields of a line; between two commas there may be an empty one.
[[nodiscard]] std::vector<std::string> fields_of(std::string_view line);

/// A finite number; Fortran's exponents (1.5D-3) too. @throws InputError "K.csv:12: 'abc' is not a number"
[[nodiscard]] double finite_number(const std::string& field, const std::string& source, int line);

/// @throws InputError with file and line: a field that is no finite number, a row that is shorter or longer than the
/// first one, no rows at all, a file beyond `numbers_size_limit`
[[nodiscard]] NumberRows read_rows(std::string_view text, const std::string& source);

}  // namespace slapstick
