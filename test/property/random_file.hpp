#pragma once
/// Random model files: the machines of `random_machine`, with the features that a file has and a `Model` has not.
#include <cstdint>

#include "io/definition.hpp"

namespace slapstick::test {

/// What of the features a file may have. Without `tones` and `signals` its model is periodic.
struct FileShape {
  int most_coordinates = 3;
  bool tones = true, signals = true;
  bool free = true;  ///< some files have no drive
};

/// A file with its start: a function of the seed. The file has what its machine has, and besides: bases, coordinates
/// that are measured from one, signals, tones, two-sided stops, matrices (gears), ratios, zones, falling friction,
/// unloading stiffnesses, forces that press a friction contact, and parameters in place of numbers.
/// Its names are "x1", "stop", "friction2", "p1"; every part that has a row of its own in a table is named.
[[nodiscard]] Definition random_file(std::uint64_t seed, const FileShape& shape = {});

}  // namespace slapstick::test
