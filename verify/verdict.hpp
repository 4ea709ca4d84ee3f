#pragma once
/// A whole certificate checked, and the verdict on it in words.
#include <istream>
#include <string>

#include "check.hpp"

namespace verify {

struct Verdict {
  std::string model;
  Clock from, to;
  Tally tally;
  long refusals = 0;
  [[nodiscard]] bool proved() const { return refusals == 0 && tally.open.none(); }
};

/// @param refuse  takes each refusal with its line. @throws Unreadable
[[nodiscard]] Verdict check(std::istream& in, const Refuse& refuse);

/// "proved", "proved but for 1 pile-up and 2 touches", "not proved: 3 refusals".
[[nodiscard]] std::string sentence(const Verdict& verdict);
/// What was counted and measured, a line each.
[[nodiscard]] std::string report(const Verdict& verdict);

}  // namespace verify
