#pragma once
/// Vectors of results as numpy arrays that share their memory: nothing is copied.
///
/// A property that returns one of these keeps its object alive for as long as the array lives (nanobind's
/// reference_internal, which properties have by themselves).
#include <nanobind/ndarray.h>

#include <vector>

namespace slapstick::python {

namespace nb = nanobind;

template <class T>
using Column = nb::ndarray<nb::numpy, T, nb::ndim<1>>;
template <class T>
using Table = nb::ndarray<nb::numpy, T, nb::ndim<2>>;

template <class T>
[[nodiscard]] Column<T> column(std::vector<T>& values) {
  return {values.data(), {values.size()}};
}

/// Rows of `width` numbers, one after another, seen as width x rows: what scipy calls `y`.
template <class T>
[[nodiscard]] Table<T> transposed(std::vector<T>& rows, std::size_t width) {
  const std::size_t count = width == 0 ? 0 : rows.size() / width;
  return {rows.data(), {width, count}, nb::handle(), {1, static_cast<std::int64_t>(width)}};
}

}  // namespace slapstick::python
