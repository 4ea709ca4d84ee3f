/// Reads rows of numbers from a CSV file.
#include "io/number_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "io/read_file.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// As C and Fortran write a number: a leading '+', an exponent with D.
std::errc read_number(std::string text, double& value) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.erase(0, 1);
  return read_decimal(text, value);
}

bool is_name(const std::string& field) {
  double value = 0.0;
  return read_number(field, value) == std::errc::invalid_argument;
}

}  // namespace

std::string line_of(const std::string& source, int line) { return source + ":" + std::to_string(line) + ": "; }

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  bool separated = true;  // by a comma or by the line's start: an empty field may follow
  std::size_t i = 0;
  for (;;) {
    while (i < line.size() && is_blank(line[i])) ++i;
    if (i == line.size()) break;
    if (line[i] == ',' || line[i] == ';') {
      if (separated) fields.emplace_back();
      separated = true;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < line.size() && !is_blank(line[end]) && line[end] != ',' && line[end] != ';') ++end;
    std::string_view field = line.substr(i, end - i);
    if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.emplace_back(field);
    separated = false;
    i = end;
  }
  if (separated && !fields.empty()) fields.emplace_back();
  return fields;
}

double finite_number(const std::string& field, const std::string& source, int line) {
  double value = 0.0;
  const std::errc error = read_number(field, value);
  if (field.empty()) throw InputError(line_of(source, line) + "a number is missing");
  if (error == std::errc::result_out_of_range)
    throw InputError(line_of(source, line) + in_quotes(field) + " is beyond the range of a double");
  if (error != std::errc{}) throw InputError(line_of(source, line) + in_quotes(field) + " is not a number");
  if (!std::isfinite(value)) throw InputError(line_of(source, line) + in_quotes(field) + " is not a finite number");
  return value;
}

NumberRows read_rows(std::string_view text, const std::string& source) {
  if (text.size() > numbers_size_limit) throw InputError(source + ": the file is larger than 16 MiB");
  NumberRows table;
  int line = 0;
  std::size_t width = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find('\n', begin), text.size());
    const auto fields = fields_of(text.substr(begin, end - begin));
    begin = end + 1;
    ++line;
    if (fields.empty() || (!fields[0].empty() && (fields[0][0] == '#' || fields[0][0] == '%'))) continue;
    if (width == 0 && std::all_of(fields.begin(), fields.end(), is_name)) {
      table.heading = fields;
      width = fields.size();
      continue;
    }
    if (width == 0) width = fields.size();
    if (fields.size() != width)
      throw InputError(line_of(source, line) + "the row has " + std::to_string(fields.size()) +
                       " fields, and the first one has " + std::to_string(width));
    auto& row = table.rows.emplace_back(NumberRows::Row{{}, line});
    for (const auto& field : fields) row.numbers.push_back(finite_number(field, source, line));
  }
  if (table.rows.empty()) throw InputError(source + ": the file has no row of numbers");
  return table;
}

}  // namespace slapstick
