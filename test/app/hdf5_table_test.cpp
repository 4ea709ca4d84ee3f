/// Tables as HDF5, read back by the HDF5 library from the bytes of the file.
#include "slapstick/hdf5_table.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <cmath>

namespace slapstick::app {
namespace {

ColumnTable some_table(int rows) {
  ColumnTable table({"time [s]", "kind", "w"}, {{"model", "box"}, {"parameter_omega", 1.5}});
  table.unit("w", "m/s");
  for (int i = 0; i < rows; ++i) {
    table.number(0.1 * i);
    table.word(i % 3 == 0 ? "stick" : "impact");
    table.number(i == 1 ? std::nan("") : -i / 3.0);
    table.end_row();
  }
  return table;
}

/// A file that is open in memory.
class Opened {
 public:
  explicit Opened(std::string bytes) : access_(H5Pcreate(H5P_FILE_ACCESS)) {
    H5Pset_fapl_core(access_, 1024, false);
    H5Pset_file_image(access_, bytes.data(), bytes.size());
    file_ = H5Fopen("image.h5", H5F_ACC_RDONLY, access_);
  }
  ~Opened() {
    H5Fclose(file_);
    H5Pclose(access_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  template <class Number>
  std::vector<Number> numbers(const char* name, hid_t type) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<Number> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!read.empty()) {
      EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0);
    }
    H5Sclose(space);
    H5Dclose(set);
    return read;
  }
  /// Texts of an attribute of a dataset, or of the file, one after another with their padding.
  std::string text(const char* object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT),
                type = H5Aget_type(attribute);
    std::string read(H5Aget_storage_size(attribute), '?');
    EXPECT_GE(H5Aread(attribute, type, read.data()), 0);
    H5Tclose(type);
    H5Aclose(attribute);
    return read;
  }
  double number(const char* name) const {
    const hid_t attribute = H5Aopen(file_, name, H5P_DEFAULT);
    double value = 0.0;
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), 0);
    H5Aclose(attribute);
    return value;
  }

  bool has(const char* name) const { return H5Lexists(file_, name, H5P_DEFAULT) > 0; }
  std::vector<hsize_t> extent(const char* name) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<hsize_t> sides(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, sides.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return sides;
  }
  /// The path of the scale that is attached to a dimension.
  std::string scale_of(const char* name, unsigned dimension) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT);
    std::string path;
    const auto take = [](hid_t, unsigned, hid_t scale, void* to) -> herr_t {
      char text[64] = "";
      H5Iget_name(scale, text, sizeof text);
      *static_cast<std::string*>(to) = text;
      return 1;
    };
    H5DSiterate_scales(set, dimension, nullptr, take, &path);
    H5Dclose(set);
    return path;
  }

 private:
  hid_t access_, file_;
};

TEST(Hdf5Table, numbers_words_units_and_attributes_come_back) {
  constexpr int rows = 100'000;  // more than one chunk
  const std::string bytes = hdf5_file(some_table(rows));
  const Opened file(bytes);
  const auto time = file.numbers<double>("time", H5T_NATIVE_DOUBLE), w = file.numbers<double>("w", H5T_NATIVE_DOUBLE);
  const auto kind = file.numbers<int>("kind", H5T_NATIVE_INT);
  ASSERT_EQ(time.size(), rows);
  for (int i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    ASSERT_EQ(time[at], 0.1 * i);
    ASSERT_EQ(kind[at], i % 3 == 0 ? 0 : 1);
    if (i == 1)
      ASSERT_TRUE(std::isnan(w[at]));
    else
      ASSERT_EQ(w[at], -i / 3.0);
  }
  EXPECT_EQ(file.text("kind", "names"), std::string("stick\0impact", 12));
  EXPECT_EQ(file.text("time", "units"), "s");
  EXPECT_EQ(file.text("w", "units"), "m/s");
  EXPECT_EQ(file.text(".", "model"), "box");
  EXPECT_EQ(file.number("parameter_omega"), 1.5);
  EXPECT_LT(bytes.size(), rows * 17U) << "words take a byte";
  EXPECT_EQ(bytes, hdf5_file(some_table(rows))) << "the bytes depend on the table only";
}

ColumnTable grid_table(int missing) {
  ColumnTable table({"x", "y", "class", "w [m/s]"}, {});
  table.over({{"y", "friction", 3}, {"x", "omega", 4}});
  for (int i = 0; i < 12 - missing; ++i) {
    table.number(1.0 + i % 4);
    table.number(0.1 * (i / 4));
    table.word(i % 4 < 2 ? "1-1-I" : "chaotic");
    table.number(i);
    table.end_row();
  }
  return table;
}

TEST(Hdf5Table, a_grid_has_its_axes_as_dimension_scales) {
  const std::string bytes = hdf5_file(grid_table(0));
  EXPECT_EQ(bytes, hdf5_file(grid_table(0)));
  const Opened file(bytes);
  EXPECT_EQ(file.numbers<double>("grid/omega", H5T_NATIVE_DOUBLE), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(file.numbers<double>("grid/friction", H5T_NATIVE_DOUBLE), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(file.text("grid/omega", "NAME"), std::string("omega", 6));
  EXPECT_EQ(file.text("grid/w", "units"), "m/s");
  EXPECT_EQ(file.scale_of("grid/w", 0), "/grid/friction");
  EXPECT_EQ(file.scale_of("grid/class", 1), "/grid/omega");
  EXPECT_EQ(file.extent("grid/w"), (std::vector<hsize_t>{3, 4}));
  EXPECT_EQ(file.numbers<double>("grid/w", H5T_NATIVE_DOUBLE), file.numbers<double>("w", H5T_NATIVE_DOUBLE));
}

/// Both directions, one after the other: a grid of each, with scales of its own.
TEST(Hdf5Table, layers_are_grids_of_their_own) {
  const auto table = [](int rows) {
    ColumnTable made({"x", "y", "class", "direction", "w [m/s]"}, {});
    made.over({{"y", "friction", 2}, {"x", "omega", 3}}, {"direction", {"up", "down"}});
    for (int i = 0; i < rows; ++i) {
      made.number(1.0 + i % 3);
      made.number(0.1 * (i / 3 % 2));
      made.word(i < 6 ? "1-1-I" : "chaotic");
      made.word(i < 6 ? "up" : "down");
      made.number(i);
      made.end_row();
    }
    return made;
  };
  {
    const Opened stopped(hdf5_file(table(11)));  // files of one name are not open together
    EXPECT_FALSE(stopped.has("grid"));
  }
  const Opened file(hdf5_file(table(12)));
  EXPECT_EQ(file.numbers<double>("grid/up/w", H5T_NATIVE_DOUBLE), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(file.numbers<double>("grid/down/w", H5T_NATIVE_DOUBLE), (std::vector<double>{6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(file.numbers<int>("grid/up/class", H5T_NATIVE_INT), std::vector<int>(6, 0));
  EXPECT_EQ(file.numbers<int>("grid/down/class", H5T_NATIVE_INT), std::vector<int>(6, 1));
  EXPECT_EQ(file.numbers<double>("grid/down/omega", H5T_NATIVE_DOUBLE), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(file.extent("grid/down/w"), (std::vector<hsize_t>{2, 3}));
  EXPECT_EQ(file.scale_of("grid/down/w", 0), "/grid/down/friction");
  EXPECT_EQ(file.scale_of("grid/up/class", 1), "/grid/up/omega");
  EXPECT_EQ(file.text("grid/down/w", "units"), "m/s");
  EXPECT_FALSE(file.has("grid/up/direction"));
}

/// A run that was stopped: rows are not at their place.
TEST(Hdf5Table, a_grid_with_a_missing_row_is_a_table_only) {
  const Opened file(hdf5_file(grid_table(1)));
  EXPECT_FALSE(file.has("grid"));
  EXPECT_EQ(file.numbers<double>("w", H5T_NATIVE_DOUBLE).size(), 11U);
}

TEST(Hdf5Table, a_table_without_rows_is_a_file) {
  const Opened file(hdf5_file(some_table(0)));
  EXPECT_TRUE(file.numbers<double>("time", H5T_NATIVE_DOUBLE).empty());
}

}  // namespace
}  // namespace slapstick::app
