/// Opens the outputs of a verb before it computes, and writes them whole.
#include "output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <set>
#include <system_error>
#include <utility>

#include "arguments.hpp"
#include "base/text.hpp"
#include "hdf5_table.hpp"
#include "interruption.hpp"
#include "io/table.hpp"
#include "slapstick/base/error.hpp"
#include "unit_prefix.hpp"
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
  answer_signal();
  if (file_) return file_->commit();
  errno = 0;
  if (std::fflush(stdout) != 0)
    throw StorageError("cannot write to standard output: " + std::generic_category().message(errno));
}

namespace {

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

bool ends_as_hdf5(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".h5" || ending == ".hdf5";
}

/// A table of another format under such a name would only be found out when it is read.
const std::string& checked_table(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* other :
       {".npy", ".mat", ".nc", ".parquet", ".feather", ".arrow", ".xlsx", ".xls", ".ods", ".gz", ".zip"})
    if (ending == other)
      throw InputError("cannot write " + in_quotes(path) + ": tables are .csv, .npz or .h5, and " + ending +
                       " is not one of them");
  if (ends_as_hdf5(path) && !has_hdf5())
    throw InputError("cannot write " + in_quotes(path) +
                     ": this program was built without HDF5; .npz and .csv are there");
  return path;
}

/// Script and data of a.png are a.gp and a-plot.csv; those of a.svg a-svg.gp and a-svg-plot.csv, so that neither takes
/// the place of the other's.
std::string name_beside(const fs::path& picture) {
  const std::string ending = picture.extension().string();
  return picture.stem().string() + (ending == ".png" || ending.empty() ? "" : "-" + ending.substr(1));
}

/// A length in cm from "85" and the unit of "85x60mm".
double centimetres(const std::string& text, const std::string& unit, const std::string& whole) {
  const double factor = unit == "mm" ? 0.1 : unit == "cm" ? 1.0 : unit == "in" ? 2.54 : 0.0;
  const std::string wanted = "--plot-size: " + in_quotes(whole) + " is no size; write 85mm, 8.5cm or 85x60mm";
  if (factor == 0.0 || text.empty() || text.find_first_not_of("0123456789.") != std::string::npos)
    throw InputError(wanted);
  const double length = factor * parse_number("--plot-size", text);
  constexpr double least = 3.0, most = 100.0;
  if (!(length >= least && length <= most))
    throw InputError("--plot-size: " + in_quotes(whole) + " is outside 30mm to 1000mm");
  return length;
}

}  // namespace

bool is_column_file(const std::string& path) { return ending_of(path) == ".npz" || ends_as_hdf5(path); }

namespace {

/// Of columns with one name, as of a parameter `w` beside the speed w, the later are w_2, w_3: formats that go by names
/// keep each. A unit in brackets stays.
std::vector<std::string> distinct(const std::vector<std::string>& headings) {
  std::set<std::string> taken;
  std::vector<std::string> all;
  for (const std::string& heading : headings) {
    const std::size_t bracket = std::min(heading.rfind(" ["), heading.size());
    const std::string name = heading.substr(0, bracket), unit = heading.substr(bracket);
    std::string free = name;
    for (int k = 2; !taken.insert(free).second; ++k) free = name + "_" + std::to_string(k);
    all.push_back(free + unit);
  }
  return all;
}

}  // namespace

TableOutput::TableOutput(const std::string& path, const std::vector<std::string>& headings, const TableFacts& facts)
    : output_(checked_table(path)), hdf5_(ends_as_hdf5(path)) {
  const std::vector<std::string> columns = distinct(headings);
  if (is_column_file(path)) {
    columns_.emplace(columns, facts.attributes);
    for (const auto& [column, unit] : facts.units) columns_->unit(column, unit);
    columns_->over(facts.axes, facts.layers);
    return;
  }
  for (const std::string& column : columns) word(column);
  header_ = std::exchange(row_, {}) + '\n';
}

void TableOutput::write_header() {
  if (!header_.empty()) output_.write(std::exchange(header_, {}));
}

TableOutput& TableOutput::number(double value) {
  if (columns_) {
    columns_->number(value);
    return *this;
  }
  if (!row_.empty()) row_ += ',';
  append_number(row_, value);
  return *this;
}

TableOutput& TableOutput::word(std::string_view text) {
  if (columns_) {
    columns_->word(text);
    return *this;
  }
  if (!row_.empty()) row_ += ',';
  row_ += text;
  return *this;
}

TableOutput& TableOutput::numbers(std::span<const double> values) {
  for (const double value : values) number(value);
  return *this;
}

void TableOutput::end_row() {
  if (columns_) return columns_->end_row();
  row_ += '\n';
  write_header();
  output_.write(row_);
  row_.clear();
}

void TableOutput::commit() {
  answer_signal();
  if (columns_ && hdf5_) output_.write(hdf5_file(*columns_));
  if (columns_ && !hdf5_) write_npz(*columns_, [this](std::string_view bytes) { output_.write(bytes); });
  write_header();
  output_.commit();
}

Plot::Plot(const std::string& path, const std::string& size) {
  if (path.empty()) return;
  const fs::path file(path);
  const std::string ending = file.extension().string();
  formats_ = {.png = ending == ".png",
              .pdf = ending == ".pdf",
              .svg = ending == ".svg",
              .tex = ending == ".tex",
              .py = ending == ".py"};
  if (!formats_.of_gnuplot() && !formats_.py)
    throw InputError("--plot: " + in_quotes(path) + " must end in .png, .pdf, .svg, .tex or .py");
  if (!size.empty()) {
    const std::size_t unit = std::min(size.find_first_not_of("0123456789.x"), size.size()),
                      by = size.substr(0, unit).find('x');
    width_cm_ = centimetres(size.substr(0, std::min(by, unit)), size.substr(unit), size);
    if (by != std::string::npos) height_cm_ = centimetres(size.substr(by + 1, unit - by - 1), size.substr(unit), size);
  }
  stem_ = file;
  stem_.replace_extension();
  beside_ = name_beside(file);
  const AtomicFile writable(file);  // goes away without a trace
  if (formats_.of_gnuplot()) figure::demand_gnuplot();
}

/// The size that was asked for, and units of a handy size.
void Plot::fit(figure::Figure& figure) const {
  if (width_cm_ && figure.height_cm && !height_cm_) figure.height_cm = *figure.height_cm * *width_cm_ / figure.width_cm;
  if (width_cm_) figure.width_cm = *width_cm_;
  if (height_cm_) figure.height_cm = height_cm_;
  use_prefixes(figure);
}

void Plot::demand_room(figure::Figure figure) const {
  if (!wanted()) return;
  fit(figure);
  try {
    figure::demand_room(figure);
  } catch (const InputError& error) {
    throw InputError("--plot: " + error.message());
  }
}

void Plot::write(figure::Figure figure) const {
  if (!wanted()) return;
  answer_signal();
  fit(figure);
  figure::write(figure, stem_, formats_, beside_);
}

int Plot::write_or_say(figure::Figure figure, bool empty, int status) const {
  if (!wanted() || !empty) {
    write(std::move(figure));
    return status;
  }
  std::fprintf(stderr, "slapstick: --plot: there are no points to draw, so the picture is not made\n");
  return status == done ? nothing_to_draw : status;
}

void declare_plot_size(Arguments& arguments, std::string& target) {
  arguments
      .text("--plot-size", target, "85mm", "width of the picture on paper, or width and height: 85x60mm (also cm, in)")
      .with({"--plot"});
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
  if (path.ends_with(".tex"))
    add("--plot " + path + " (its lines)", fs::path(path).replace_filename(name_beside(path) + ".pdf").string());
  for (const char* ending : {"-plot.csv", ".gp"})
    add("--plot " + path + " (its data and script lie beside it)",
        fs::path(path).replace_filename(name_beside(path) + ending).string());
}

}  // namespace slapstick::app
