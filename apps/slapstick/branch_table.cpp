#include "branch_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace slapstick::app {
namespace {

std::string row(std::size_t branch, std::size_t point, std::string_view type, double value, const orbit::Solution& solution,
                const std::string& what) {
  const double largest = solution.multipliers.empty() ? 0.0 : std::abs(solution.multipliers.front());
  return fmt::format("{:>3} {:>5}  {:<2}  {:>18.12g}  {:<10} {:>12.6g} {:>12.6g}  {:<8}  {}\n", branch, point, type, value, solution.label,
                     solution.cycle, largest, largest < 1.0 ? "stable" : "unstable", what);
}

}  // namespace

std::string branch_table(const std::vector<orbit::Branch>& branches, const std::string& parameter, const System&) {
  std::string text = fmt::format("{:>3} {:>5}  {:<2}  {:>18}  {:<10} {:>12} {:>12}  {:<8}  {}\n", "BR", "PT", "TY", parameter, "class", "period",
                                 "max |mu|", "", "");
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const orbit::Branch& branch = branches[b];
    auto special = branch.special.begin();
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const orbit::Solution& point = branch.points[i];
      if (i == 0 || i + 1 == branch.points.size())
        text += row(b + 1, i + 1, "EP", point.orbit.values[0], point, point.is_motion ? "" : "not a motion: " + point.why);
      for (; special != branch.special.end() && special->after == i; ++special) {
        std::string what = special->what;
        if (special->type == orbit::SpecialType::NS) what += fmt::format(", rotation {:.6g}", special->rotation);
        if (!special->outcome.empty()) what += "; " + special->outcome;
        text += row(b + 1, i + 1, name(special->type), special->value, special->solution, what);
      }
    }
    text += fmt::format("    {} points; {}\n", branch.points.size(), branch.ended);
  }
  return text;
}

void follow_doublings(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                      const orbit::ContinuationOptions& how) {
  for (std::size_t b = 0; b < branches.size() && branches.size() < most; ++b) {
    const std::vector<orbit::SpecialPoint> specials = branches[b].special;
    for (const orbit::SpecialPoint& special : specials) {
      if (special.type != orbit::SpecialType::PD || branches.size() >= most) continue;
      const std::optional<orbit::Orbit> start = orbit::doubled(problem, special);
      if (!start || start->values[0] < how.from || start->values[0] > how.to) continue;
      branches.push_back(orbit::follow(problem, *start, how));
    }
  }
}

}  // namespace slapstick::app
