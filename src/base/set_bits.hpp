#pragma once
/// Sets of contacts, bit by bit.
#include <bit>
#include <cstdint>
#include <vector>

namespace slapstick {

/// The numbers of the bits that are set, in order.
[[nodiscard]] inline std::vector<int> set_bits(std::uint32_t set) {
  std::vector<int> all;
  for (; set != 0; set &= set - 1) all.push_back(std::countr_zero(set));
  return all;
}

}  // namespace slapstick
