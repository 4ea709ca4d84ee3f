/// Writes tables as HDF5 files, in memory: the file itself appears whole or not at all.
#include "hdf5_table.hpp"

#include <algorithm>
#include <deque>

#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"

#ifdef SLAPSTICK_HDF5
#include <hdf5.h>
#include <hdf5_hl.h>
#endif

namespace slapstick::app {

#ifndef SLAPSTICK_HDF5

bool has_hdf5() { return false; }
std::string hdf5_file(const ColumnTable&) { throw StorageError("this program was built without HDF5"); }

#else

namespace {

/// What the library gives a number for, until it is closed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw StorageError("HDF5 does not succeed");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as the library's functions take it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void demand(herr_t status) {
  if (status < 0) throw StorageError("HDF5 does not succeed");
}

/// Texts of one length in bytes, as UTF-8.
void add_texts(hid_t to, const char* name, const std::vector<std::string>& texts, bool several) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string data;
  for (std::string text : texts) {
    text.resize(longest, '\0');
    data += text;
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  demand(H5Tset_size(type, longest));
  demand(H5Tset_cset(type, H5T_CSET_UTF8));
  demand(H5Tset_strpad(type, H5T_STR_NULLPAD));
  const hsize_t count = texts.size();
  const Handle space(several ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!texts.empty()) demand(H5Awrite(attribute, type, data.data()));
}

void add_number(hid_t to, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(to, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  demand(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
}

using Extent = std::vector<hsize_t>;

/// What a column is as a dataset: how its numbers are stored and given, and where they lie.
struct Data {
  hid_t stored, given;
  const void* at = nullptr;
  const std::vector<std::string>* names = nullptr;
};

Data data_of(const Column& column) {
  if (const auto* words = std::get_if<Words>(&column.cells)) {
    if (words->small()) return {H5T_STD_U8LE, H5T_NATIVE_UINT8, words->small_codes().data(), &words->names()};
    return {H5T_STD_U32LE, H5T_NATIVE_UINT32, words->large_codes().data(), &words->names()};
  }
  const auto* numbers = std::get_if<std::vector<double>>(&column.cells);
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, numbers != nullptr ? numbers->data() : nullptr};
}

std::size_t rows_of(const Column& column) {
  if (const auto* words = std::get_if<Words>(&column.cells)) return words->size();
  const auto* numbers = std::get_if<std::vector<double>>(&column.cells);
  return numbers != nullptr ? numbers->size() : 0;
}

/// A packed dataset that no time is noted of, so that the bytes depend on the table only.
/// @returns the dataset, for the caller to close
hid_t add_array(hid_t to, const std::string& name, const std::string& unit, const Data& data, const Extent& extent) {
  constexpr hsize_t chunk = 1U << 16U;
  constexpr unsigned effort = 4;
  const auto rank = static_cast<int>(extent.size());
  const bool some = std::find(extent.begin(), extent.end(), 0U) == extent.end();
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  demand(H5Pset_obj_track_times(how, false));
  if (some) {
    Extent piece = extent;
    hsize_t left = chunk;
    for (auto side = piece.rbegin(); side != piece.rend(); ++side) {
      *side = std::min(*side, left);
      left = std::max<hsize_t>(left / *side, 1);
    }
    demand(H5Pset_chunk(how, rank, piece.data()));
    demand(H5Pset_shuffle(how));
    if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) demand(H5Pset_deflate(how, effort));
  }
  const Handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose);
  const hid_t set = H5Dcreate2(to, name.c_str(), data.stored, space, H5P_DEFAULT, how, H5P_DEFAULT);
  if (set < 0) throw StorageError("HDF5 does not succeed");
  if (some) demand(H5Dwrite(set, data.given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.at));
  if (!unit.empty()) add_texts(set, "units", {unit}, false);
  if (data.names != nullptr) add_texts(set, "names", *data.names, true);
  return set;
}

void add_column(hid_t file, const Column& column) {
  const Handle set(add_array(file, column.name, column.unit, data_of(column), {rows_of(column)}), H5Dclose);
}

/// The values of an axis: those of every `stride`-th row.
std::vector<double> values_along(const Column& column, std::size_t count, std::size_t stride) {
  const auto* numbers = std::get_if<std::vector<double>>(&column.cells);
  std::vector<double> values;
  for (std::size_t i = 0; i < count && numbers != nullptr; ++i) values.push_back((*numbers)[i * stride]);
  return values;
}

/// The same column from a row on.
Data from_row(Data data, std::size_t row) {
  data.at = static_cast<const char*>(data.at) + row * H5Tget_size(data.given);
  return data;
}

/// Arrays over the axes, of the rows from `first` on.
void fill_grid(hid_t group, const ColumnTable& table, const Extent& extent, std::size_t points, std::size_t first) {
  std::deque<Handle> scales;
  std::size_t stride = points;
  for (const TableAxis& axis : table.axes()) {
    stride /= axis.count;
    const auto column = ranges::find_if(table.columns(), [&](const Column& one) { return one.name == axis.column; });
    const std::vector<double> values = values_along(*column, axis.count, stride);
    scales.emplace_back(
        add_array(group, axis.name, column->unit, {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data()}, {axis.count}),
        H5Dclose);
    demand(H5DSset_scale(scales.back(), axis.name.c_str()));
  }
  for (const Column& column : table.columns()) {
    const bool is_axis =
        ranges::any_of(table.axes(), [&](const TableAxis& axis) { return axis.column == column.name; });
    if (is_axis || column.name == table.layers().column) continue;
    const Handle set(add_array(group, column.name, column.unit, from_row(data_of(column), first), extent), H5Dclose);
    for (unsigned k = 0; k < scales.size(); ++k) demand(H5DSattach_scale(set, scales[k], k));
  }
}

/// The group of arrays over the axes, with a group for each layer of a table that has layers; none if a row is missing.
void add_grid(hid_t file, const ColumnTable& table) {
  Extent extent;
  std::size_t points = 1;
  for (const TableAxis& axis : table.axes()) {
    extent.push_back(axis.count);
    points *= axis.count;
  }
  const std::vector<std::string>& layers = table.layers().names;
  if (extent.empty() || points * std::max<std::size_t>(layers.size(), 1) != rows_of(table.columns().front())) return;
  const auto grouped = [](hid_t in, const std::string& name) {
    return H5Gcreate2(in, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  };
  const Handle grid(grouped(file, "grid"), H5Gclose);
  if (layers.empty()) return fill_grid(grid, table, extent, points, 0);
  for (std::size_t k = 0; k < layers.size(); ++k)
    fill_grid(Handle(grouped(grid, layers[k]), H5Gclose), table, extent, points, k * points);
}

}  // namespace

bool has_hdf5() { return true; }

std::string hdf5_file(const ColumnTable& table) {
  demand(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
  constexpr std::size_t growth = 1U << 20U;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  demand(H5Pset_fapl_core(access, growth, false));
  const Handle file(H5Fcreate("table.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  for (const Column& column : table.columns()) add_column(file, column);
  add_grid(file, table);
  for (const Attribute& attribute : table.attributes()) {
    if (const auto* text = std::get_if<std::string>(&attribute.value))
      add_texts(file, attribute.name.c_str(), {*text}, false);
    else
      add_number(file, attribute.name, std::get<double>(attribute.value));
  }
  demand(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw StorageError("HDF5 does not succeed");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size) throw StorageError("HDF5 does not succeed");
  return bytes;
}

#endif

}  // namespace slapstick::app
