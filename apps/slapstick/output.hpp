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

/// A CSV table of numbers and names on an Output. Names are model names or fixed words: they need no quotes. The header
/// goes out with the first row or with `commit`: a table that is given up leaves nothing on standard output.
class TableOutput {
 public:
  TableOutput(const std::string& path, const std::vector<std::string>& columns);
  TableOutput& number(double value);
  TableOutput& word(std::string_view text);
  TableOutput& numbers(std::span<const double> values);
  void end_row();
  void commit();

 private:
  void write_header();

  Output output_;
  std::string header_, row_;
};

/// --plot F.png: the picture, with its script and data beside it.
class Plot {
 public:
  /// @param path empty: no plot. @throws InputError unless it ends in .png, .pdf or .svg; StorageError if it cannot be
  /// written
  explicit Plot(const std::string& path);
  [[nodiscard]] bool wanted() const { return !stem_.empty(); }
  /// @throws StorageError
  void write(const figure::Figure& figure) const;
  /// The same, or a line on standard error if the figure is empty. `status`: the exit status so far.
  /// @returns the exit status: `nothing_to_draw` for a picture that was wanted and is not made, if nothing worse
  /// happened
  [[nodiscard]] int write_or_say(const figure::Figure& figure, bool empty, int status) const;

 private:
  std::filesystem::path stem_;
  figure::Formats formats_;
};

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
