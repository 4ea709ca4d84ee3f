#pragma once
/// Where results go: files that appear whole or not at all, standard output, and pictures. All are opened before the
/// computation starts, so that an output that cannot be written is known at once.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "figure/figure.hpp"
#include "io/atomic_file.hpp"
#include "table_facts.hpp"

namespace slapstick::app {

/// Exit status of a run whose picture has no points: all other results are there, but not what was asked for.
inline constexpr int nothing_to_draw = 3;

/// A file, or standard output if the path is empty.
class Output {
 public:
  /// @throws StorageError if it cannot be written
  explicit Output(const std::string& path);
  /// @throws StorageError
  void write(std::string_view bytes);
  /// Puts the file in place, or flushes standard output. @throws StorageError
  void commit();

 private:
  std::optional<AtomicFile> file_;
};

/// A table of numbers and names on an Output: as .npz or .h5 where the path ends so, else as CSV. Names are model names
/// or fixed words: in CSV they need no quotes. The header of CSV goes out with the first row or with `commit`: a table
/// that is given up leaves nothing on standard output. The other formats are written by `commit`, and until then take 8
/// bytes a number and 1 a name.
class TableOutput {
 public:
  /// @param headings  "x1" or "x1 [mm]"; of equal names the later become NAME_2
  /// @param facts  what formats say that have a place for it; CSV has none
  /// @throws InputError for the ending of another format, StorageError if it cannot be written
  TableOutput(const std::string& path, const std::vector<std::string>& headings, const TableFacts& facts = {});
  TableOutput& number(double value);
  TableOutput& word(std::string_view text);
  TableOutput& numbers(std::span<const double> values);
  void end_row();
  void commit();

 private:
  void write_header();

  Output output_;
  std::string header_, row_;
  std::optional<ColumnTable> columns_;
  bool hdf5_ = false;
};

/// Whether a path ends as a table's file does that is no CSV.
[[nodiscard]] bool is_column_file(const std::string& path);

/// --plot F.png: the picture, with its script and data beside it.
class Plot {
 public:
  /// @param path empty: no plot
  /// @param size "", "85mm" or "85x60mm" (also cm, in): the picture's width, and its height
  /// @throws InputError unless the path ends in .png, .pdf, .svg, .tex or .py, and for a `size` that is no size;
  /// StorageError if it cannot be written
  explicit Plot(const std::string& path, const std::string& size = {});
  [[nodiscard]] bool wanted() const { return !stem_.empty(); }
  /// Whether a picture has room for its parts, known from its panels and insets alone. @throws InputError
  void demand_room(figure::Figure figure) const;
  /// @throws StorageError
  void write(figure::Figure figure) const;
  /// The same, or a line on standard error if the figure is empty. `status`: the exit status so far.
  /// @returns the exit status: `nothing_to_draw` for a picture that was wanted and is not made, if nothing worse
  /// happened
  [[nodiscard]] int write_or_say(figure::Figure figure, bool empty, int status) const;

 private:
  void fit(figure::Figure& figure) const;

  std::filesystem::path stem_;
  std::string beside_;
  figure::Formats formats_;
  std::optional<double> width_cm_, height_cm_;
};

/// --plot-size
void declare_plot_size(Arguments& arguments, std::string& target);

/// Refuses a command line on which two roles name one file. Empty paths are ignored.
class FileRoles {
 public:
  /// @throws InputError naming both arguments
  void add(const std::string& argument, const std::string& path);
  void add_plot(const std::string& path);  ///< the picture and the files beside it

 private:
  struct Role {
    std::string argument;
    std::filesystem::path path;
  };
  std::vector<Role> roles_;
};

}  // namespace slapstick::app
