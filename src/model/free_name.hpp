#pragma once
/// Names of quantities that would be those of others.
#include <algorithm>
#include <string>
#include <vector>

#include "slapstick/model/quantity.hpp"

namespace slapstick {

/// The name, or where another quantity has it already NAME_2: nothing is left out, and the list shows both.
[[nodiscard]] inline std::string free_name(const std::vector<Quantity>& all, const std::string& name) {
  const auto taken = [&](const std::string& wanted) {
    return std::any_of(all.begin(), all.end(), [&](const Quantity& one) { return one.name == wanted; });
  };
  std::string free = name;
  for (int k = 2; taken(free); ++k) free = name + "_" + std::to_string(k);
  return free;
}

}  // namespace slapstick
