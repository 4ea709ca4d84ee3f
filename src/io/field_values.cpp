/// Reads polylines, intervals, Stribeck curves, bands and signals of a part.
#include "io/field_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/nearest.hpp"
#include "io/number_rows.hpp"
#include "io/read_file.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

std::vector<Point> read_points(const TreeReader& tree, const TomlNode& list, const std::string& where,
                               const std::string& pair) {
  constexpr std::size_t most_points = 100;
  tree.expect(list, TomlNode::Kind::list, where);
  if (list.items.size() < 2 || list.items.size() > most_points)
    tree.fail(list.line, where, "expected 2 to 100 points " + pair + ", found " + std::to_string(list.items.size()));
  std::vector<Point> points;
  for (const auto& item : list.items) {
    const auto each = where + ": point " + std::to_string(points.size() + 1);
    tree.expect(item, TomlNode::Kind::list, each);
    if (item.items.size() != 2)
      tree.fail(item.line, each, "expected " + pair + ", found " + std::to_string(item.items.size()) + " numbers");
    points.push_back({tree.scalar(item.items[0], each + ": x"), tree.scalar(item.items[1], each + ": force")});
  }
  return points;
}

std::vector<Scalar> read_interval(const TreeReader& tree, const TomlNode& list, const std::string& where) {
  tree.expect(list, TomlNode::Kind::list, where);
  if (list.items.size() != 2)
    tree.fail(list.line, where, "expected [from, to], found " + std::to_string(list.items.size()) + " numbers");
  return {tree.scalar(list.items[0], where + ": from"), tree.scalar(list.items[1], where + ": to")};
}

Ratio read_ratio(const TreeReader& tree, const TomlNode& list, const std::string& where, bool still) {
  tree.expect(list, TomlNode::Kind::list, where);
  if (list.items.size() != 2)
    tree.fail(list.line, where, "expected [r_a, r_b], found " + std::to_string(list.items.size()) + " numbers");
  std::array<double, 2> of_end{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Scalar scalar = tree.scalar(list.items[i], where);
    of_end[i] = scalar.number;
    if (scalar.expression)
      tree.fail(list.line, where,
                "a ratio is a plain number: a parameter would decide whether contacts are on one pair");
  }
  if (!still)
    tree.fail(list.line, where,
              "a ratio is between coordinates that stand still with the ground: one of the ends is a base, or measured "
              "from one");
  return {of_end[0], of_end[1]};
}

/// The stops of a file come after its friction contacts: they are looked up when the model is built.
void read_load(const TreeReader& tree, const TomlNode& table, const std::string& where,
               const std::vector<std::string>& states, Part& part) {
  tree.expect(table, TomlNode::Kind::table, where);
  for (const auto& [key, node] : table.entries)
    if (key == "stop")
      tree.fail(node.line, where + ": stop",
                "the force of a rigid stop is a constraint force, not a function of the state: friction along a rigid "
                "stop is not available; write the stop as a [[compliant_stop]] and name it by compliant_stop");
  std::vector<std::string> known = states;
  known.emplace_back("constant");
  known.emplace_back("compliant_stop");
  tree.check_keys(table, where, known);
  for (const auto& [key, node] : table.entries) {
    if (key == "compliant_stop")
      part.load_stop = tree.text(table, "compliant_stop", where);
    else
      part.load.emplace_back(key, tree.scalar(node, where + ": " + key));
  }
  if (table.entries.empty()) tree.fail(table.line, where, "nothing is in it");
}

namespace {

Numbers read_numbers(const TreeReader& tree, const TomlNode& table, const std::string& where,
                     const std::vector<std::string>& keys, std::initializer_list<const char*> required) {
  tree.expect(table, TomlNode::Kind::table, where);
  tree.check_keys(table, where, keys);
  Numbers numbers;
  for (const auto& [key, node] : table.entries) numbers[key] = tree.scalar(node, where + ": " + key);
  for (const char* key : required)
    if (!numbers.contains(key)) tree.fail(table.line, where, in_quotes(key) + " is missing");
  return numbers;
}

}  // namespace

Numbers read_stribeck(const TreeReader& tree, const TomlNode& table, const std::string& where) {
  return read_numbers(tree, table, where, stribeck_keys(), {"static", "kinetic", "speed"});
}

Numbers read_band(const TreeReader& tree, const TomlNode& table, const std::string& where) {
  Numbers band = read_numbers(tree, table, where, band_keys(), {"from", "to", "rms"});
  const auto whole = [&](const char* key, double least, double most, double fallback) {
    const auto found = band.find(key);
    if (found == band.end()) return fallback;
    const Scalar& scalar = found->second;
    const double value = scalar.number;
    if (scalar.expression || !(value >= least && value <= most) || value != std::floor(value))
      tree.fail(scalar.line, where + ": " + key, "not a whole number in [" + shown(least) + ", " + shown(most) + "]");
    return value;
  };
  const double from = whole("from", 1, 1e6, 0), to = whole("to", 1, 1e6, 0);
  if (to < from) tree.fail(band.at("to").line, where + ": to", shown(to) + " is below from = " + shown(from));
  const double most = to - from + 1;
  const double lines = whole("lines", 1, std::min(most, 100.0), most);
  if (lines > 100.0)
    tree.fail(table.line, where, "the band has " + shown(most) + " harmonics; name fewer by lines (at most 100)");
  (void)whole("seed", 0, 9007199254740992.0, 0);
  return band;
}

void read_signal(const TreeReader& tree, const TomlNode& node, const std::string& where, const std::string& source,
                 Part& part) {
  const auto* file = node.find("file");
  if (file == nullptr) return;
  constexpr std::size_t most_points = 100;  // that `show` writes out, as read_points reads them
  const std::string path = beside(source, file->text);
  const std::string place = source + ":" + std::to_string(file->line) + ": " + where + ": file: ";
  NumberRows table;
  try {
    table = read_rows(read_file(path, "signal ", numbers_size_limit), path);
  } catch (const InputError& error) {
    throw InputError(place + error.what());
  } catch (const StorageError& error) {
    throw StorageError(place + error.what());
  }
  part.record = path;
  std::size_t column = 1;
  if (const auto* wanted = node.find("column")) {
    const auto at = std::find(table.heading.begin(), table.heading.end(), wanted->text);
    if (at == table.heading.end())
      tree.fail(wanted->line, where + ": column",
                "file " + in_quotes(file->text) + " has no column " + in_quotes(wanted->text) +
                    (table.heading.empty() ? " (the file has no heading)" : suggestion(wanted->text, table.heading)));
    column = static_cast<std::size_t>(at - table.heading.begin());
  }
  if (table.rows.front().numbers.size() <= column || column == 0)
    tree.fail(file->line, where + ": file", in_quotes(file->text) + " has no column of values beside the time");
  for (const auto& row : table.rows) {
    const double time = row.numbers[0];
    const std::size_t before = part.samples.size();
    if (before > 0 && time < part.samples.back().first)
      throw InputError(place + line_of(path, row.line) + "time " + shown(time) + " is below the " +
                       shown(part.samples.back().first) + " of the row before");
    if (before > 1 && time == part.samples[before - 2].first)
      throw InputError(place + line_of(path, row.line) + "there are three rows at time " + shown(time) +
                       "; a step has two");
    part.samples.emplace_back(time, row.numbers[column]);
    part.rows.push_back(row.line);
  }
  if (part.samples.size() < 2) tree.fail(file->line, where + ": file", in_quotes(file->text) + " has only one row");
  if (part.samples.size() > most_points) {
    part.texts["file"] = std::filesystem::absolute(path).lexically_normal().string();
    return;
  }
  for (const auto& [time, value] : part.samples)
    part.points.push_back({{time, {}, file->line}, {value, {}, file->line}});
  part.samples.clear();
  part.texts.erase("file");
  part.texts.erase("column");
}

}  // namespace slapstick
