/// Writes CSV.
#include "io/table.hpp"

#include <cmath>
#include <stdexcept>

#include "base/decimal.hpp"

namespace slapstick {

void append_number(std::string& out, double value) {
  if (std::isnan(value)) {  // the digits might be "-nan"
    out += "nan";
    return;
  }
  append_digits(out, value, 17);
}

std::string number_text(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : file_(path), columns_(columns.size()) {
  for (const auto& column : columns) word(column);
  end_row();
}

void CsvWriter::cell() {
  if (cells_++ > 0) row_ += ',';
}

CsvWriter& CsvWriter::number(double value) {
  cell();
  append_number(row_, value);
  return *this;
}

CsvWriter& CsvWriter::integer(long long value) {
  cell();
  row_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::word(std::string_view text) {
  cell();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    row_ += text;
    return *this;
  }
  row_ += '"';
  for (const char c : text) {
    if (c == '"') row_ += '"';
    row_ += c;
  }
  row_ += '"';
  return *this;
}

CsvWriter& CsvWriter::numbers(const std::vector<double>& values) {
  for (const double value : values) number(value);
  return *this;
}

void CsvWriter::end_row() {
  if (cells_ != columns_)
    throw std::logic_error("a table row has " + std::to_string(cells_) + " cells for " + std::to_string(columns_) +
                           " columns");
  row_ += '\n';
  file_.write(row_);
  row_.clear();
  cells_ = 0;
}

void CsvWriter::commit() {
  if (cells_ != 0) throw std::logic_error("a table ends inside a row");
  file_.commit();
}

}  // namespace slapstick
