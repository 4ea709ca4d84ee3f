#pragma once
/// The algorithms of <algorithm> on whole ranges, with projections, as std::ranges has them.
///
/// libc++ 14 (Emscripten's) has no std::ranges algorithm, so the library and its programs use these
/// (tools/check_portable). Each forwards to the algorithm on iterators, and has of std::ranges what is used here.
#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace slapstick::ranges {

/// f of the projections of its arguments; either may be a pointer to a member.
template <class F, class Projection>
constexpr auto through(const Projection& projection, const F& f) {
  return [&](const auto&... x) -> decltype(auto) { return std::invoke(f, std::invoke(projection, x)...); };
}

template <class Range, class F, class Projection = std::identity>
constexpr bool any_of(Range&& range, F f, Projection p = {}) {
  return std::any_of(std::begin(range), std::end(range), through(p, f));
}
template <class Range, class F, class Projection = std::identity>
constexpr bool all_of(Range&& range, F f, Projection p = {}) {
  return std::all_of(std::begin(range), std::end(range), through(p, f));
}
template <class Range, class F, class Projection = std::identity>
constexpr bool none_of(Range&& range, F f, Projection p = {}) {
  return std::none_of(std::begin(range), std::end(range), through(p, f));
}

template <class Range, class F, class Projection = std::identity>
constexpr auto find_if(Range&& range, F f, Projection p = {}) {
  return std::find_if(std::begin(range), std::end(range), through(p, f));
}
template <class Range, class F, class Projection = std::identity>
constexpr auto find_if_not(Range&& range, F f, Projection p = {}) {
  return std::find_if_not(std::begin(range), std::end(range), through(p, f));
}
template <class Range, class T, class Projection = std::identity>
constexpr auto find(Range&& range, const T& value, Projection p = {}) {
  return find_if(
      range, [&](const auto& x) { return x == value; }, p);
}

template <class Range, class F, class Projection = std::identity>
constexpr auto count_if(Range&& range, F f, Projection p = {}) {
  return std::count_if(std::begin(range), std::end(range), through(p, f));
}
template <class Range, class T, class Projection = std::identity>
constexpr auto count(Range&& range, const T& value, Projection p = {}) {
  return count_if(
      range, [&](const auto& x) { return x == value; }, p);
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto min_element(Range&& range, Less less = {}, Projection p = {}) {
  return std::min_element(std::begin(range), std::end(range), through(p, less));
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto max_element(Range&& range, Less less = {}, Projection p = {}) {
  return std::max_element(std::begin(range), std::end(range), through(p, less));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr void sort(Range&& range, Less less = {}, Projection p = {}) {
  std::sort(std::begin(range), std::end(range), through(p, less));
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
void stable_sort(Range&& range, Less less = {}, Projection p = {}) {
  std::stable_sort(std::begin(range), std::end(range), through(p, less));
}

template <class Range, class Other, class F = std::equal_to<>>
constexpr bool equal(Range&& range, Other&& other, F f = {}) {
  return std::equal(std::begin(range), std::end(range), std::begin(other), std::end(other), f);
}

template <class Range, class T>
constexpr void fill(Range&& range, const T& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <class Range>
constexpr void reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <class Range, class Out>
constexpr Out copy(Range&& range, Out out) {
  return std::copy(std::begin(range), std::end(range), out);
}
template <class Range, class Out, class F>
constexpr Out copy_if(Range&& range, Out out, F f) {
  return std::copy_if(std::begin(range), std::end(range), out, f);
}
template <class Range, class Out>
constexpr Out move(Range&& range, Out out) {
  return std::move(std::begin(range), std::end(range), out);
}
template <class Range, class Out, class F>
constexpr Out transform(Range&& range, Out out, F f) {
  return std::transform(std::begin(range), std::end(range), out, f);
}

}  // namespace slapstick::ranges
