#pragma once
/// Tables as HDF5 files. The library of that name is behind this header, in hdf5_table.cpp and nowhere else.
#include <string>

#include "io/column_table.hpp"

namespace slapstick::app {

/// False where the program was built without HDF5.
[[nodiscard]] bool has_hdf5();

/// The bytes of an .h5 file: a dataset for each column, packed; its unit in the attribute "units", and of a column of
/// words the names that its numbers stand for in "names". The table's attributes are those of the file.
/// Of a table whose rows are a whole grid the group "grid" has the same columns as arrays over the axes, which are
/// dimension scales (HDF5 Dimension Scale Specification 1.0): xarray and MATLAB open them with coordinates.
/// @throws StorageError if HDF5 does not succeed, or is not there
[[nodiscard]] std::string hdf5_file(const ColumnTable& table);

}  // namespace slapstick::app
