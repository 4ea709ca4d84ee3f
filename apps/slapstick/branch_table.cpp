#include "branch_table.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "slapstick/base/text.hpp"

namespace slapstick::app {
namespace {

std::string row(std::size_t branch, std::size_t point, std::string_view type, double value,
                const orbit::Solution& solution, const std::string& what) {
  const double largest = solution.multipliers.empty() ? 0.0 : std::abs(solution.multipliers.front());
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%3zu %5zu  %-2s  %18.12g  %-10s %12.6g %12.6g  %-8s  ", branch, point,
                std::string(type).c_str(), value, solution.label.c_str(), solution.cycle, largest,
                std::abs(largest - 1.0) < 1e-6 ? ""
                : largest < 1.0                ? "stable"
                                               : "unstable");
  return text.data() + what + "\n";
}

std::string head(const std::string& parameter) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%3s %5s  %-2s  %18.60s  %-10s %12s %12s\n", "BR", "PT", "TY",
                parameter.c_str(), "class", "period", "max |mu|");
  return text.data();
}

}  // namespace

std::string branch_table(const std::vector<orbit::Branch>& branches, const std::string& parameter) {
  std::string text = head(parameter);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const orbit::Branch& branch = branches[b];
    auto special = branch.special.begin();
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const orbit::Solution& point = branch.points[i];
      if (i == 0 || i + 1 == branch.points.size())
        text +=
            row(b + 1, i + 1, "EP", point.orbit.values[0], point, point.is_motion ? "" : "not a motion: " + point.why);
      for (; special != branch.special.end() && special->after == i; ++special) {
        std::string what = special->what;
        if (special->type == orbit::SpecialType::NS) what += ", rotation " + shown(special->rotation);
        if (!special->outcome.empty()) what += "; " + special->outcome;
        text += row(b + 1, i + 1, name(special->type), special->value, special->solution, what);
      }
    }
    text += "    " + std::to_string(branch.points.size()) + " points; " + branch.ended + "\n";
  }
  return text;
}

void follow_born(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                 const orbit::ContinuationOptions& how) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const std::vector<orbit::SpecialPoint> specials = branches[b].special;
    for (const orbit::SpecialPoint& special : specials) {
      for (const orbit::Orbit& start : special.born) {
        if (branches.size() >= most) return;
        const bool known =
            std::ranges::any_of(branches, [&](const orbit::Branch& branch) { return orbit::lies_on(branch, start); });
        if (known || start.values[0] < how.from || start.values[0] > how.to) continue;
        branches.push_back(orbit::follow(problem, start, how));
      }
    }
  }
}

}  // namespace slapstick::app
