/// Gathers a table column by column.
#include "io/column_table.hpp"

#include <limits>
#include <stdexcept>

namespace slapstick {

void Words::add(std::string_view word) {
  const auto [at, is_new] = known_.try_emplace(std::string(word), static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.emplace_back(word);
  if (large_.empty() && at->second <= std::numeric_limits<std::uint8_t>::max()) {
    small_.push_back(static_cast<std::uint8_t>(at->second));
    return;
  }
  if (large_.empty()) {
    large_.assign(small_.begin(), small_.end());
    small_ = {};
  }
  large_.push_back(at->second);
}

ColumnTable::ColumnTable(const std::vector<std::string>& headings, std::vector<Attribute> attributes)
    : attributes_(std::move(attributes)) {
  for (const std::string& heading : headings) {
    const std::size_t bracket = heading.rfind(" [");
    const bool has_unit = bracket != std::string::npos && heading.back() == ']';
    columns_.push_back({.name = heading.substr(0, has_unit ? bracket : std::string::npos),
                        .unit = has_unit ? heading.substr(bracket + 2, heading.size() - bracket - 3) : ""});
  }
}

Column& ColumnTable::next() {
  if (cell_ >= columns_.size()) throw std::logic_error("a table row has more cells than there are columns");
  return columns_[cell_++];
}

void ColumnTable::number(double value) {
  Column& column = next();
  if (column.cells.index() == 0) column.cells = std::vector<double>();
  auto* numbers = std::get_if<std::vector<double>>(&column.cells);
  if (numbers == nullptr) throw std::logic_error("a number in the column of words " + column.name);
  numbers->push_back(value);
}

void ColumnTable::word(std::string_view text) {
  Column& column = next();
  if (column.cells.index() == 0) column.cells = Words();
  auto* words = std::get_if<Words>(&column.cells);
  if (words == nullptr) throw std::logic_error("a word in the column of numbers " + column.name);
  words->add(text);
}

void ColumnTable::end_row() {
  if (cell_ != columns_.size())
    throw std::logic_error("a table row has " + std::to_string(cell_) + " cells for " +
                           std::to_string(columns_.size()) + " columns");
  cell_ = 0;
}

void ColumnTable::unit(const std::string& column, const std::string& unit) {
  for (Column& one : columns_)
    if (one.name == column && one.unit.empty()) one.unit = unit;
}

}  // namespace slapstick
