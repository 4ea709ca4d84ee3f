/// What the paper does not claim: its printed restitution, friction that weakens in slip, attractors that share a
/// frequency.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "reproduce/claims.hpp"

namespace slapstick::paper {
namespace {

struct Printed {
  double omega;
  const char* label;
};
constexpr Printed printed_classes[] = {
    {0.552, "1-inf-II"}, {1.5, "1-1-II"}, {2.2, "1-1-I"}, {4.801, "4-2-I"}, {4.805, "quasi-periodic"}};

/// The paper's own examples with other parameters; the number that comes out as printed.
int compare(const Evidence& evidence, const std::string& name, const Case& with, Claim& claim) {
  const Study& study = evidence.study;
  int same = 0;
  for (const Printed& printed : printed_classes) {
    const Found found = study.find(with.with, printed.omega, study.rest());
    same += found.what.label == printed.label;
    claim.quantities.push_back(
        class_quantity("class at " + fixed(printed.omega, 3) + ", " + name, printed.label, found));
  }
  const Window& window = with.windows[1];
  if (window.found) {
    claim.quantities.push_back(edge_quantity("lower edge of the 1-1 window, " + name, "1.12", window.lower));
    claim.quantities.push_back(edge_quantity("upper edge of the 1-1 window, " + name, "2.84", window.upper));
    same += std::abs(std::ceil(100.0 * window.lower.omega()) - 112.0) < 0.5;  // as in C1
    same += std::abs(std::floor(100.0 * window.upper.omega()) - 284.0) < 0.5;
  }
  return same;
}

/// Largest difference of the impact speeds of two cycles.
bool same_cycle(const Classification& a, const Classification& b) {
  if (a.label != b.label || a.impacts.size() != b.impacts.size()) return false;
  const auto speeds = [](const Classification& what) {
    std::vector<double> out;
    for (const CycleImpact& impact : what.impacts) out.push_back(impact.w);
    std::sort(out.begin(), out.end());
    return out;
  };
  const std::vector<double> left = speeds(a), right = speeds(b);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (std::abs(left[i] - right[i]) > 1e-6) return false;
  return true;
}

/// The attractors found at one frequency from three sides: distinct labels, if they are surely different attractors.
std::set<std::string> together(const Classification& a, const Classification& b, const Classification& c) {
  std::set<std::string> labels;
  for (const Classification* what : {&a, &b, &c}) {
    if (what->attractor == Attractor::periodic && what->n > 16)
      return {};  // too close to a band's own locked motions to be told apart
    labels.insert(what->label);
  }
  const auto periodic = [](const Classification& what) { return what.attractor == Attractor::periodic; };
  if (!periodic(a) && !periodic(b) && !periodic(c)) return {};
  if (labels.contains("undecided")) return {};
  if (labels.size() == 1 && same_cycle(a, b) && same_cycle(b, c)) return {};
  return labels;
}

}  // namespace

Claim claim_print(const Evidence& evidence) {
  Claim claim{"print", "Eq. (9): R = 0.08; μ_c and f_k are not printed.", "", Agreement::no, "", {}};
  const int used = compare(evidence, "r = 0.8, f_k = f_s", evidence.surveys.paper(), claim);
  const int printed = compare(evidence, "r = 0.08", evidence.surveys.printed, claim);
  const int weak = compare(evidence, "f_k = 0.1", evidence.surveys.weak_kinetic, claim);
  const auto of_seven = [](int n) { return std::to_string(n) + " of 7"; };
  claim.computed = "Of the five printed examples and two printed edges come out: " + of_seven(used) +
                   " with r = 0.8 and f_k = f_s = 0.15; " + of_seven(printed) + " with r = 0.08; " + of_seven(weak) +
                   " with r = 0.8 and f_k = 0.1.";
  claim.agreement = printed == 7 ? Agreement::yes : Agreement::no;
  claim.explanation =
      "R = 0.08 is a misprint of 0.8: the paper's own windows and figures come out with 0.8 and not with 0.08. The "
      "print lacks μ_c (used: "
      "5 = μ_k, proportional damping) and f_k (used: f_s); a kinetic friction below the static one moves the windows "
      "away from the print.";
  return claim;
}

Claim coexisting(const Evidence& evidence) {
  const Surveys& all = evidence.surveys;
  const std::vector<Found>& up = all.paper().survey;
  Claim claim{"coexisting", "The paper mentions no coexisting attractors.", "", Agreement::not_claimed, "", {}};
  std::set<std::string> current;
  double begin = 0.0, end = 0.0;
  int count = 0;
  const auto close = [&] {
    if (current.empty()) return;
    std::string names;
    for (const std::string& label : current) names += (names.empty() ? "" : ", ") + label;
    claim.quantities.push_back({"ω in [" + fixed(begin, 2) + ", " + fixed(end, 2) + "]", "", names, std::nullopt,
                                "in steps of " + shown(evidence.study.sizes().survey_step)});
  };
  for (std::size_t i = 0; i < up.size(); ++i) {
    const auto labels = together(up[i].what, all.down[i].what, all.rest[i].what);
    if (labels != current) {
      close();
      current = labels;
      begin = up[i].omega;
    }
    end = up[i].omega;
    count += !labels.empty();
  }
  close();
  claim.computed =
      "More than one attractor at " + std::to_string(count) + " of " + std::to_string(up.size()) + " frequencies.";
  claim.explanation =
      "Found by carrying the state up, down, and by starting from rest at each frequency; what none of the three "
      "reaches is not seen. "
      "In Figs. 2, 6 and 8 they show as blue (up) beside orange (down).";
  return claim;
}

}  // namespace slapstick::paper
