#pragma once
/// The bits of twelve motions as text: the same on every machine and in every build, the browser's included.
#include <string>
#include <vector>

namespace slapstick {

/// A line for each motion, and one with the hash of all. Cost: about a second.
/// @throws NumericalError if the motions are not what they are meant to be
[[nodiscard]] std::vector<std::string> report_of_bits();

}  // namespace slapstick
