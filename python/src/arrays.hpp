#pragma once
/// Vectors of results as numpy arrays that share their memory: nothing is copied.
///
/// A property that returns one of these keeps its object alive for as long as the array lives (nanobind's
/// reference_internal, which properties have by themselves).
#include <nanobind/ndarray.h>

#include <memory>
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

/// A vector that was made for this array alone, which takes it over.
template <class V>
[[nodiscard]] auto owned(std::unique_ptr<V> values) {
  V* const kept = values.release();
  const nb::capsule owner(kept, [](void* of) noexcept { delete static_cast<V*>(of); });
  return Column<typename V::value_type>(kept->data(), {kept->size()}, owner);
}

/// The same, of rows of `width` numbers seen as width x rows.
[[nodiscard]] inline Table<double> owned_transposed(std::unique_ptr<std::vector<double>> rows, std::size_t width) {
  const std::size_t count = width == 0 ? 0 : rows->size() / width;
  std::vector<double>* const kept = rows.release();
  const nb::capsule owner(kept, [](void* of) noexcept { delete static_cast<std::vector<double>*>(of); });
  return {kept->data(), {width, count}, owner, {1, static_cast<std::int64_t>(width)}};
}

}  // namespace slapstick::python
