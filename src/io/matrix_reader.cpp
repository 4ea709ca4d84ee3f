/// Reads [matrix] of a model file.
#include "io/matrix_reader.hpp"

#include <algorithm>

#include "base/nearest.hpp"
#include "io/matrix_file.hpp"
#include "io/number_rows.hpp"
#include "io/read_file.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

using Kind = TomlNode::Kind;

/// What a file says that the model file names; its messages come behind the model file's place.
template <class Read>
auto from_file(const std::string& place, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(place + error.what());
  } catch (const StorageError& error) {
    throw StorageError(place + error.what());
  }
}

/// The names of a text: one a line, or the heading of a CSV file.
std::vector<std::string> names_of(const std::string& text) {
  std::vector<std::string> names;
  for (const auto& line : split(text, '\n')) {
    const auto fields = fields_of(line);
    if (fields.empty() || (!fields[0].empty() && fields[0][0] == '#')) continue;
    const bool heading = fields.size() > 1;
    if (heading && !names.empty()) break;
    names.insert(names.end(), fields.begin(), fields.end());
    if (heading) break;
  }
  return names;
}

class MatrixReader {
 public:
  MatrixReader(const TreeReader& tree, const std::vector<std::string>& coordinates,
               const std::vector<std::string>& rows, Definition& definition)
      : tree_(tree), coordinates_(coordinates), rows_(rows.empty() ? coordinates : rows), definition_(definition) {
    for (const auto& row : rows_)
      place_.push_back(
          static_cast<std::size_t>(std::find(coordinates.begin(), coordinates.end(), row) - coordinates.begin()));
  }

  MatrixEntry read(const TomlNode& node, const std::string& where) const {
    const bool table = node.kind == Kind::table;
    if (!table && node.kind != Kind::text) return spread(written_out(node, where), node.line);
    std::string factor;
    const TomlNode* file = &node;
    if (table) {
      tree_.check_keys(node, where, {"file", "factor"});
      file = node.find("file");
      if (file == nullptr) tree_.fail(node.line, where, "'file' is missing");
      tree_.expect(*file, Kind::text, where + ": file");
      if (const auto* number = node.find("factor")) factor = checked_factor(*number, where + ": factor");
    }
    return spread(from_file(*file, factor, where), node.line);
  }

 private:
  /// As an expression that every entry is multiplied by.
  std::string checked_factor(const TomlNode& node, const std::string& where) const {
    const Scalar factor = tree_.scalar(node, where);
    const std::string text = factor.expression ? "(" + factor.expression->text() + ")" : shown(factor.number);
    if (text.size() > 350) tree_.fail(node.line, where, "longer than 350 characters");
    return text;
  }

  std::vector<Scalar> from_file(const TomlNode& node, const std::string& factor, const std::string& where) const {
    if (!node.text.ends_with(".mtx") && !node.text.ends_with(".csv"))
      tree_.fail(node.line, where,
                 "expected rows of numbers, or a file whose name ends in .mtx or .csv, found " + in_quotes(node.text));
    const std::string place = definition_.place(node.line) + where + ": ";
    const FileMatrix matrix =
        slapstick::from_file(place, [&] { return read_matrix_file(beside(definition_.source, node.text)); });
    check(matrix, node, where);
    std::vector<Scalar> entries;
    for (const double entry : matrix.entries) {
      Scalar& scalar = entries.emplace_back(Scalar{entry, {}, node.line});
      if (factor.empty() || entry == 0.0) continue;
      TomlNode product;
      product.kind = Kind::text;
      product.line = node.line;
      product.text = factor + " * " + (entry < 0.0 ? "(" + shown(entry) + ")" : shown(entry));
      scalar = tree_.scalar(product, where);
    }
    return entries;
  }

  void check(const FileMatrix& matrix, const TomlNode& node, const std::string& where) const {
    if (matrix.n != rows_.size())
      tree_.fail(node.line, where,
                 "file " + in_quotes(node.text) + " has " + std::to_string(matrix.n) + " rows, expected " +
                     std::to_string(rows_.size()) + " (one per coordinate)");
    for (std::size_t i = 0; i < matrix.names.size(); ++i)
      if (matrix.names[i] != rows_[i])
        tree_.fail(node.line, where,
                   "file " + in_quotes(node.text) + ": column " + std::to_string(i + 1) + " is " +
                       in_quotes(matrix.names[i]) + ", and the coordinate there is " + in_quotes(rows_[i]));
  }

  std::vector<Scalar> written_out(const TomlNode& node, const std::string& where) const {
    const auto n = rows_.size();
    const auto demand = [&](const TomlNode& list, const char* what, const std::string& whose) {
      tree_.expect(list, Kind::list, whose);
      if (list.items.size() != n)
        tree_.fail(list.line, whose,
                   "expected " + std::to_string(n) + " " + what + " (one per coordinate), found " +
                       std::to_string(list.items.size()));
    };
    demand(node, "rows", where);
    std::vector<Scalar> entries;
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = where + "[" + rows_[i] + "]";
      demand(node.items[i], "entries", row);
      for (std::size_t j = 0; j < n; ++j)
        entries.push_back(tree_.scalar(node.items[i].items[j], where + "[" + rows_[i] + ", " + rows_[j] + "]"));
    }
    return entries;
  }

  /// To the places of the coordinates that the rows stand for.
  MatrixEntry spread(std::vector<Scalar> entries, int line) const {
    const auto n = coordinates_.size();
    if (rows_ == coordinates_) return {std::move(entries), line};
    MatrixEntry matrix{std::vector<Scalar>(n * n), line};
    for (auto& zero : matrix.entries) zero.line = line;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t j = 0; j < rows_.size(); ++j)
        matrix.entries[place_[i] * n + place_[j]] = std::move(entries[i * rows_.size() + j]);
    return matrix;
  }

  const TreeReader& tree_;
  const std::vector<std::string>& coordinates_;
  std::vector<std::string> rows_;
  std::vector<std::size_t> place_;
  Definition& definition_;
};

}  // namespace

std::vector<Part> matrix_rows(const TreeReader& tree, const TomlNode& root, const std::string& source) {
  const auto* table = root.find("matrix");
  const auto* node = table == nullptr ? nullptr : table->find("coordinates");
  if (node == nullptr) return {};
  const std::string where = "matrix: coordinates";
  std::vector<std::string> names;
  if (node->kind == Kind::text) {
    const std::string place = source + ":" + std::to_string(node->line) + ": " + where + ": ";
    names = names_of(
        from_file(place, [&] { return read_file(beside(source, node->text), "file of names ", numbers_size_limit); }));
  } else {
    tree.expect(*node, Kind::list, where);
    for (const auto& item : node->items) {
      tree.expect(item, Kind::text, where);
      names.push_back(item.text);
    }
  }
  if (names.empty()) tree.fail(node->line, where, "nothing is in it");
  tree.check_count(*node, names.size(), where);
  std::vector<Part> rows;
  for (const auto& name : names) {
    tree.check_new_name(name, node->line, "matrix: coordinate");
    if (std::any_of(rows.begin(), rows.end(), [&](const Part& row) { return row.name == name; }))
      tree.fail(node->line, where, "name " + in_quotes(name) + " is used twice");
    Part& part = rows.emplace_back();
    part.name = name;
    part.line = node->line;
    part.fields["mass"] = Scalar{0.0, {}, node->line};
  }
  return rows;
}

void read_matrices(const TreeReader& tree, const TomlNode& root, const std::vector<std::string>& coordinates,
                   Definition& definition) {
  const auto* table = root.find("matrix");
  if (table == nullptr) return;
  tree.expect(*table, Kind::table, "matrix");
  tree.check_keys(*table, "matrix", matrix_keys());
  std::vector<std::string> rows;
  for (const auto& row : matrix_rows(tree, root, definition.source)) rows.push_back(row.name);
  const MatrixReader reader(tree, coordinates, rows, definition);
  for (const auto& [key, node] : table->entries)
    if (key != "coordinates") definition.matrices[key] = reader.read(node, "matrix: " + key);
}

}  // namespace slapstick
