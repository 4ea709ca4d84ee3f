/// Helps to write a claim: finds and formats its quantities.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.hpp"
#include "reproduce/claims.hpp"

namespace slapstick::paper {

std::string_view name(Agreement agreement) {
  constexpr std::string_view names[] = {"yes", "partly", "no", "not claimed"};
  return names[static_cast<std::size_t>(agreement)];
}

const Quantity* Claim::find(std::string_view quantity) const {
  for (const Quantity& one : quantities)
    if (one.name == quantity) return &one;
  return nullptr;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// Rounding to a unit adds half of it to the error, which may be the other half.
std::string place(double value, double within) {
  if (within <= 0.0) return shown(value);
  int decimals = 0;
  for (double unit = 0.1; unit >= 2.0 * within && decimals < 9; unit /= 10.0) ++decimals;
  return fixed(value, decimals);
}

std::string place(const Edge& edge) { return place(edge.omega(), edge.within()); }

std::string grid_value(double value, double step) {
  int decimals = 0;
  for (double unit = 1.0; std::abs(std::remainder(step, unit)) > 1e-9 * step; unit /= 10.0) ++decimals;
  return fixed(value, decimals);
}

std::optional<Found> middle_of_longest(const std::vector<Found>& survey, const Wanted& wanted) {
  std::size_t best = 0, best_length = 0, length = 0;
  for (std::size_t i = 0; i < survey.size(); ++i) {
    length = wanted(survey[i].what) ? length + 1 : 0;
    if (length > best_length) {
      best_length = length;
      best = i;
    }
  }
  if (best_length == 0) return std::nullopt;
  return survey[best - best_length / 2];
}

const Found& nearest(const std::vector<Found>& survey, double omega) {
  return *std::min_element(survey.begin(), survey.end(), [omega](const Found& a, const Found& b) {
    return std::abs(a.omega - omega) < std::abs(b.omega - omega);
  });
}

Window staircase_window(const Study& study, const Overrides& with, const std::vector<Found>& survey, int n) {
  const std::optional<Found> seed = middle_of_longest(survey, cycle(n, 1));
  if (!seed) return {};
  return around(study, with, *seed, 0.3, 10.0, cycle(n, 1));
}

std::optional<Found> scan(const Study& study, const Overrides& with, double omega, const State& state, double step,
                          double limit, const Wanted& wanted) {
  State carried = state;
  for (int k = 1; omega + k * step <= limit; ++k) {
    study.course().check();
    Found found = study.find(with, omega + k * step, carried);
    if (wanted(found.what)) return found;
    carried = found.what.state;
  }
  return std::nullopt;
}

double share(const std::vector<Found>& survey, double from, double to, const Wanted& of) {
  int all = 0, good = 0;
  for (const Found& found : survey) {
    if (found.omega < from || found.omega > to) continue;
    ++all;
    good += of(found.what);
  }
  return all == 0 ? 0.0 : static_cast<double>(good) / all;
}

std::string describe(const Edge& edge) {
  if (!edge.found) return edge.inside.what.label + " up to the end of the search";
  std::string text = edge.inside.what.label + " → " + edge.beyond.what.label;
  if (edge.inside.what.n == edge.beyond.what.n && edge.inside.what.p == edge.beyond.what.p)
    return text + "; the orbit goes on, a stick phase comes or goes";
  if (edge.inside.what.multipliers.empty()) return text;
  const std::complex<double> leading = edge.inside.what.multipliers.front();
  if (std::abs(leading) < weakly_attracting)
    return text + "; no multiplier near the unit circle: a jump, as at a grazing";
  if (std::abs(leading.imag()) > 1e-3) return text + "; a pair of multipliers leaves the unit circle: Neimark-Sacker";
  return text +
         (leading.real() < 0.0 ? "; a multiplier passes -1: period doubling" : "; a multiplier reaches +1: fold");
}

Quantity edge_quantity(const std::string& name, const std::string& printed, const Edge& edge) {
  Quantity out{name, printed, "", edge.omega(), describe(edge)};
  out.computed = (edge.found ? "" : "none up to ") + place(edge);
  if (edge.found) out.within = edge.within();
  return out;
}

Quantity class_quantity(const std::string& name, const std::string& printed, const Found& found) {
  Quantity out{name, printed, found.what.label, std::nullopt, ""};
  if (found.what.attractor == Attractor::periodic) {
    out.note = "largest multiplier " + fixed(std::abs(found.what.multipliers.front()), 4);
  } else {
    out.note = "exponent " + fixed(found.what.exponent, 4) + " ± " + fixed(found.what.exponent_error, 4) +
               " per period, " + fixed(found.what.digits, 1) + " digits";
  }
  return out;
}

Quantity number_quantity(const std::string& name, const std::string& printed, double value, int digits,
                         const std::string& note) {
  return {name, printed, fixed(value, digits), value, note};
}

}  // namespace slapstick::paper
