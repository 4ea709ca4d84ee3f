#pragma once
/// Numbers for what findings have in common: two have one number if all that a filled pixel takes over is equal.
#include <cstdint>
#include <map>
#include <tuple>

#include "slapstick/sweep/map.hpp"

namespace slapstick::sweep {

class FindingKinds {
 public:
  [[nodiscard]] std::int32_t number(const Finding& of) {
    const Kind kind{of.failed, of.attractor, of.n, of.p, of.chatter, of.sticking};
    return numbers_.try_emplace(kind, static_cast<std::int32_t>(numbers_.size())).first->second;
  }

 private:
  using Kind = std::tuple<bool, Attractor, std::int32_t, std::int32_t, Chatter, bool>;
  std::map<Kind, std::int32_t> numbers_;
};

}  // namespace slapstick::sweep
