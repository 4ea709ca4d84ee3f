/// Opens the outputs of a verb before it computes, and writes them whole.
#include "output.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "slapstick/base/error.hpp"
#include "base/text.hpp"
#include "io/table.hpp"
#include "verb.hpp"

namespace slapstick::app {

namespace fs = std::filesystem;

Output::Output(const std::string& path) {
  if (!path.empty()) file_.emplace(path);
}

void Output::write(std::string_view bytes) {
  if (file_) return file_->write(bytes);
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size())
    throw StorageError("cannot write to standard output: " + std::generic_category().message(errno));
}

void Output::commit() {
  if (file_) return file_->commit();
  errno = 0;
  if (std::fflush(stdout) != 0)
    throw StorageError("cannot write to standard output: " + std::generic_category().message(errno));
}

TableOutput::TableOutput(const std::string& path, const std::vector<std::string>& columns) : output_(path) {
  for (const std::string& column : columns) word(column);
  header_ = std::exchange(row_, {}) + '\n';
}

void TableOutput::write_header() {
  if (!header_.empty()) output_.write(std::exchange(header_, {}));
}

TableOutput& TableOutput::number(double value) {
  if (!row_.empty()) row_ += ',';
  append_number(row_, value);
  return *this;
}

TableOutput& TableOutput::word(std::string_view text) {
  if (!row_.empty()) row_ += ',';
  row_ += text;
  return *this;
}

TableOutput& TableOutput::numbers(std::span<const double> values) {
  for (const double value : values) number(value);
  return *this;
}

void TableOutput::end_row() {
  row_ += '\n';
  write_header();
  output_.write(row_);
  row_.clear();
}

void TableOutput::commit() {
  write_header();
  output_.commit();
}

Plot::Plot(const std::string& path) {
  if (path.empty()) return;
  const fs::path file(path);
  const std::string ending = file.extension().string();
  formats_ = {.png = ending == ".png", .pdf = ending == ".pdf", .svg = ending == ".svg"};
  if (!formats_.png && !formats_.pdf && !formats_.svg)
    throw InputError("--plot: " + in_quotes(path) + " must end in .png, .pdf or .svg");
  stem_ = file;
  stem_.replace_extension();
  const AtomicFile writable(file);  // goes away without a trace
  figure::demand_gnuplot();
}

void Plot::write(const figure::Figure& figure) const {
  if (wanted()) figure::write(figure, stem_, formats_);
}

int Plot::write_or_say(const figure::Figure& figure, bool empty, int status) const {
  if (!wanted() || !empty) {
    write(figure);
    return status;
  }
  std::fprintf(stderr, "slapstick: --plot: there are no points to draw, so the picture is not made\n");
  return status == done ? nothing_to_draw : status;
}

void FileRoles::add(const std::string& argument, const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;  // /dev/null may serve twice
  fs::path resolved = fs::weakly_canonical(fs::absolute(path), error);
  if (error) resolved = fs::absolute(path).lexically_normal();
  for (const Role& role : roles_) {
    if (role.path == resolved)
      throw InputError(argument + " would write to " + in_quotes(path) + ", which is also " + role.argument);
  }
  roles_.push_back({argument, resolved});
}

void FileRoles::add_plot(const std::string& path) {
  if (path.empty()) return;
  add("--plot", path);
  for (const char* ending : {"-plot.csv", ".gp"}) {
    const std::string beside = fs::path(path).replace_extension().string() + ending;
    add("--plot " + path + " (its data and script lie beside it)", beside);
  }
}

}  // namespace slapstick::app
