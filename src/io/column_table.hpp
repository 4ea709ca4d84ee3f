#pragma once
/// A table in memory, column by column: numbers as doubles, words as small integers of a list of names. For files that
/// store columns.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace slapstick {

/// A column of words. Of up to 255 names a row takes one byte, and four beyond.
class Words {
 public:
  void add(std::string_view word);
  [[nodiscard]] std::size_t size() const { return small_.empty() ? large_.size() : small_.size(); }
  [[nodiscard]] bool small() const { return large_.empty(); }
  [[nodiscard]] const std::vector<std::uint8_t>& small_codes() const { return small_; }
  [[nodiscard]] const std::vector<std::uint32_t>& large_codes() const { return large_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }  ///< in order of their first use

 private:
  std::vector<std::uint8_t> small_;
  std::vector<std::uint32_t> large_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> known_;
};

struct Column {
  std::string name{}, unit{};
  std::variant<std::monostate, std::vector<double>, Words> cells{};  ///< what the first cell was; none without rows
};

/// What a table says of all its rows: "model", "version", ..; numbers are parameters.
struct Attribute {
  std::string name{};
  std::variant<std::string, double> value{};
};

/// An axis of a table whose rows are the points of a grid.
struct TableAxis {
  std::string column{}, name{};  ///< the column that has its values, and what they are called
  std::size_t count = 0;
};

/// Of a table that is several grids, one after another: their names, and the column that tells them apart.
struct TableLayers {
  std::string column{};
  std::vector<std::string> names{};
};

/// Rows are given cell by cell, in the order of the columns.
class ColumnTable {
 public:
  /// @param headings  "x1" or "x1 [mm]"
  ColumnTable(const std::vector<std::string>& headings, std::vector<Attribute> attributes);

  /// @throws std::logic_error for a word in a column of numbers or the reverse, or a cell too many
  void number(double value);
  void word(std::string_view text);
  /// @throws std::logic_error if cells are missing
  void end_row();

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<Attribute>& attributes() const { return attributes_; }
  /// Rows are the points of a grid, the last axis fastest; formats that have grids show it if no row is missing.
  void over(std::vector<TableAxis> axes, TableLayers layers = {}) {
    axes_ = std::move(axes);
    layers_ = std::move(layers);
  }
  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }
  [[nodiscard]] const TableLayers& layers() const { return layers_; }
  void unit(const std::string& column, const std::string& unit);  ///< of the column of that name, if it has none

 private:
  [[nodiscard]] Column& next();

  std::vector<Column> columns_;
  std::vector<Attribute> attributes_;
  std::vector<TableAxis> axes_;
  TableLayers layers_;
  std::size_t cell_ = 0;
};

/// The bytes of an .npz file (numpy.load): a .npy array for each column, for words the codes as `NAME` and the list of
/// names as `NAME.names`; units as `NAME.unit`, attributes as arrays without dimension. Stored, not packed.
/// Source: NEP 1 for .npy; PKWARE's APPNOTE 6.3 with ZIP64 records for the archive.
/// @param write  takes the bytes piece by piece, in order
void write_npz(const ColumnTable& table, const std::function<void(std::string_view)>& write);

}  // namespace slapstick
