#pragma once
/// How users write ranges of parameters: `diagram --sweep NAME=A:B:COUNT`, and `curve --params A,B` with
/// `--range NAME=A:B` for each.
#include <array>
#include <string>
#include <vector>

#include "orbit_options.hpp"

namespace slapstick::app {

struct Sweep {
  std::string name;
  double from = 0.0, to = 0.0;
  int count = 0;
};
/// The most values of a sweep: all of them are kept until the end.
inline constexpr int most_values = 10'000'000;
/// Reads "NAME=A:B:COUNT", A < B, COUNT from 2 to `most_values`. @throws InputError naming the argument
[[nodiscard]] Sweep parse_sweep(const std::string& text, const std::string& argument = "--sweep");

/// Reads "A,B": two different names. @throws InputError naming --params
[[nodiscard]] std::vector<std::string> two_parameters(const std::string& text);

/// Reads "NAME=A:B" for each of two names, in the names' order. @throws InputError naming --range
[[nodiscard]] std::array<ParameterRange, 2> two_ranges(const std::vector<std::string>& texts,
                                                       const std::vector<std::string>& names);

}  // namespace slapstick::app
