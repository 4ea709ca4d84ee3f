/// Reads matrices from Matrix Market and CSV files.
#include "io/matrix_file.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "io/number_rows.hpp"
#include "io/read_file.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

constexpr std::size_t most_rows = 1000;
constexpr double asymmetry_rounding = 1e-9;  ///< of the largest entry: what programs of finite elements leave

/// Entries with the lines that they come from, until the symmetric part is taken.
class Gathered {
 public:
  Gathered(std::string source, std::size_t n) : source_(std::move(source)), n_(n), entries_(n * n), lines_(n * n, 0) {}

  void set(std::size_t i, std::size_t j, double value, int line) {
    int& known = lines_[i * n_ + j];
    if (known != 0)
      throw InputError(line_of(source_, line) + "entry " + label(i, j) + " was given before, in line " +
                       std::to_string(known));
    known = line;
    entries_[i * n_ + j] = value;
  }

  FileMatrix symmetric_part() {
    double largest = 0.0;
    for (const double entry : entries_) largest = std::max(largest, std::abs(entry));
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double &below = entries_[i * n_ + j], &above = entries_[j * n_ + i];
        if (std::abs(below - above) > asymmetry_rounding * largest) refuse(i, j);
        if (below != above) below = above = below + 0.5 * (above - below);
      }
    return {n_, std::move(entries_), {}};
  }

 private:
  [[noreturn]] void refuse(std::size_t i, std::size_t j) const {
    const int line = std::max({lines_[i * n_ + j], lines_[j * n_ + i], 1});
    throw InputError(line_of(source_, line) + "the matrix is not symmetric: " + label(i, j) + " = " +
                     shown(entries_[i * n_ + j]) + " differs from " + label(j, i) + " = " +
                     shown(entries_[j * n_ + i]));
  }
  static std::string label(std::size_t i, std::size_t j) {
    return "(" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ")";
  }

  std::string source_;
  std::size_t n_;
  std::vector<double> entries_;
  std::vector<int> lines_;
};

/// A Matrix Market text line by line.
class MarketReader {
 public:
  MarketReader(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  FileMatrix read() {
    read_banner();
    const auto sizes = numbers(coordinates_ ? 3 : 2, coordinates_ ? "rows, columns, entries" : "rows, columns");
    const std::size_t n = whole(sizes[0], 1, most_rows, "the number of rows");
    if (sizes[1] != sizes[0]) fail("the matrix is not square: " + shown(sizes[0]) + " x " + shown(sizes[1]));
    Gathered all(source_, n);
    if (coordinates_)
      read_coordinates(all, n, whole(sizes[2], 0, most_rows * most_rows, "the number of entries"));
    else
      read_array(all, n);
    if (next()) fail("expected the file's end, found " + in_quotes(line_));
    return all.symmetric_part();
  }

 private:
  /// %%MatrixMarket matrix coordinate|array real|integer general|symmetric
  void read_banner() {
    const bool any = take_line();
    std::string lower(line_);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto words = fields_of(lower);
    if (!any || words.size() != 5 || words[0] != "%%matrixmarket" || words[1] != "matrix")
      fail("expected '%%MatrixMarket matrix coordinate real symmetric' or the like");
    const auto one_of = [&](const std::string& word, std::initializer_list<const char*> known, const char* what) {
      if (std::find(known.begin(), known.end(), word) == known.end())
        fail(in_quotes(word) + " is not available: the matrix must be " + what);
    };
    one_of(words[2], {"coordinate", "array"}, "coordinate or array");
    one_of(words[3], {"real", "integer", "double"}, "real or integer");
    one_of(words[4], {"general", "symmetric"}, "general or symmetric");
    coordinates_ = words[2] == "coordinate";
    symmetric_ = words[4] == "symmetric";
  }

  void read_coordinates(Gathered& all, std::size_t n, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto entry = numbers(3, "row, column, value");
      const std::size_t i = whole(entry[0], 1, n, "the row") - 1, j = whole(entry[1], 1, n, "the column") - 1;
      all.set(i, j, entry[2], number_);
      if (symmetric_ && i != j) all.set(j, i, entry[2], number_);
    }
  }

  /// By columns; of a symmetric matrix the lower half.
  void read_array(Gathered& all, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = symmetric_ ? j : 0; i < n; ++i) {
        const double value = numbers(1, "one value")[0];
        all.set(i, j, value, number_);
        if (symmetric_ && i != j) all.set(j, i, value, number_);
      }
  }

  bool take_line() {
    if (at_ >= text_.size()) return false;
    const auto end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }

  /// The next line that is neither empty nor a comment.
  bool next() {
    while (take_line())
      if (fields_ = fields_of(line_); !fields_.empty() && line_[0] != '%') return true;
    return false;
  }

  std::vector<double> numbers(std::size_t count, const char* what) {
    if (!next()) {
      ++number_;
      fail(std::string("the file ends, and ") + what + " are expected");
    }
    if (fields_.size() != count)
      fail("expected " + std::to_string(count) + (count == 1 ? " field (" : " fields (") + what + "), found " +
           std::to_string(fields_.size()));
    std::vector<double> values;
    for (const auto& field : fields_) values.push_back(finite_number(field, source_, number_));
    return values;
  }

  std::size_t whole(double value, std::size_t least, std::size_t most, const char* what) const {
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) || value != std::floor(value))
      fail(what + (" = " + shown(value)) + " is not a whole number in [" + std::to_string(least) + ", " +
           std::to_string(most) + "]");
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(line_of(source_, std::max(number_, 1)) + what);
  }

  std::string_view text_, line_;
  std::string source_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::vector<std::string> fields_;
  bool coordinates_ = false, symmetric_ = false;
};

}  // namespace

FileMatrix read_matrix_market(std::string_view text, const std::string& source) {
  if (text.size() > numbers_size_limit) throw InputError(source + ": the file is larger than 16 MiB");
  return MarketReader(text, source).read();
}

FileMatrix read_matrix_csv(std::string_view text, const std::string& source) {
  const NumberRows table = read_rows(text, source);
  const std::size_t n = table.rows.size(), width = table.rows.front().numbers.size();
  if (width != n || n > most_rows)
    throw InputError(line_of(source, table.rows.back().line) + "the matrix has " + std::to_string(n) + " rows and " +
                     std::to_string(width) + " columns; a matrix is square, with at most 1000 rows");
  Gathered all(source, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) all.set(i, j, table.rows[i].numbers[j], table.rows[i].line);
  FileMatrix matrix = all.symmetric_part();
  matrix.names = table.heading;
  return matrix;
}

FileMatrix read_matrix_file(const std::string& path) {
  const std::string text = read_file(path, "matrix file ", numbers_size_limit);
  return path.ends_with(".csv") ? read_matrix_csv(text, path) : read_matrix_market(text, path);
}

}  // namespace slapstick
