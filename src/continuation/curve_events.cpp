/// What else is met along the locus of a special point.
#include "continuation/curve_events.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/ranges.hpp"
#include "change/change_kind.hpp"
#include "continuation/special.hpp"

namespace slapstick::orbit {
namespace {

using Multipliers = std::vector<std::complex<double>>;

constexpr double without_bound = 1e6;  ///< a multiplier

/// prod (mu - target) / (1 + |mu|): the sign changes where a multiplier passes the target.
double product(const Multipliers& multipliers, double target) {
  std::complex<double> all = 1.0;
  for (const std::complex<double>& mu : multipliers) all *= (mu - target) / (1.0 + std::abs(mu));
  return all.real();
}

/// Without the factor nearest to zero, which is zero all along: the sign changes where a second multiplier comes there.
double product_of_others(Multipliers multipliers, double target) {
  const auto off = [target](const std::complex<double>& mu) { return std::abs(mu - target); };
  const auto own = ranges::min_element(multipliers, {}, off);
  if (own != multipliers.end()) multipliers.erase(own);
  return product(multipliers, target);
}

Meeting multiplier(SpecialType type) { return {.kind = Meeting::Kind::multiplier, .type = type}; }
Meeting resonance(int order) { return {.kind = Meeting::Kind::resonance, .order = order}; }

/// Strong resonances on the way of a torus; those at its ends are not among them.
void add_resonances(std::vector<CurveTest>& tests) {
  tests.push_back({resonance(3), [](const CurvePlace& at) { return sum_of_pair(at.watched) + 1.0; }});
  tests.push_back({resonance(4), [](const CurvePlace& at) { return sum_of_pair(at.watched); }});
}

/// A function of the multipliers. Where one is infinite, as at an impact without speed, the others are rounding and it
/// has no value.
std::function<double(const CurvePlace&)> of_multipliers(double (*value)(const Watched&)) {
  return [value](const CurvePlace& at) {
    const Multipliers& all = at.watched.multipliers;
    return !all.empty() && std::abs(all.front()) > without_bound ? std::nan("") : value(at.watched);
  };
}

/// A component of a curve's tangent, by differences over 1e-5 of a function known to rounding: what is less counts as
/// zero, as where a parameter has no part.
constexpr double constant = 1e-6;

constexpr double at_zero =
    0.1;  ///< a function that changes its sign through infinity, as beside an impact without speed, is no such zero

/// Are there this many multipliers at a value?
std::function<bool(const Watched&)> multipliers_at(double target, int count) {
  return [target, count](const Watched& at) {
    const auto near = [target](const std::complex<double>& mu) { return std::abs(mu - target) < at_zero; };
    return ranges::count_if(at.multipliers, near) >= count;
  };
}

/// Two multipliers whose product is 1 are a torus's if they are no real numbers mu, 1 / mu, as at a neutral saddle.
bool on_the_circle(const Watched& at) {
  return ranges::any_of(at.multipliers,
                        [](const std::complex<double>& mu) { return std::abs(std::abs(mu) - 1.0) < at_zero; }) &&
         std::abs(sum_of_pair(at)) < 2.0;
}

/// A multiplier passes 1 where the branch turns back; where branches cross it does not.
bool is_a_fold(const Watched& at) { return multipliers_at(1.0, 1)(at) && std::abs(at.turn) < at_zero; }

void add_multipliers(std::vector<CurveTest>& tests, SpecialType type) {
  const auto add = [&](const Meeting& met, double (*value)(const Watched&), std::function<bool(const Watched&)> holds) {
    tests.push_back({met, of_multipliers(value), false, 0.0, std::move(holds)});
  };
  if (type == SpecialType::PD)
    add(
        resonance(2), [](const Watched& at) { return product_of_others(at.multipliers, -1.0); },
        multipliers_at(-1.0, 2));
  else
    add(
        multiplier(SpecialType::PD), [](const Watched& at) { return at.flip; }, multipliers_at(-1.0, 1));
  if (type == SpecialType::LP)
    add(
        resonance(1), [](const Watched& at) { return product_of_others(at.multipliers, 1.0); }, multipliers_at(1.0, 2));
  else
    add(
        multiplier(SpecialType::LP), [](const Watched& at) { return product(at.multipliers, 1.0); }, is_a_fold);
  if (type == SpecialType::NS) return add_resonances(tests);
  if (type != SpecialType::PD && type != SpecialType::LP)
    add(
        multiplier(SpecialType::NS), [](const Watched& at) { return at.torus; }, on_the_circle);
}

}  // namespace

double sum_of_pair(const Watched& watched) {
  double sum = 0.0, least = INFINITY;
  for (std::size_t i = 0; i < watched.multipliers.size(); ++i)
    for (std::size_t j = i + 1; j < watched.multipliers.size(); ++j) {
      const double off = std::abs(watched.multipliers[i] * watched.multipliers[j] - 1.0);
      if (off >= least) continue;
      least = off;
      sum = (watched.multipliers[i] + watched.multipliers[j]).real();
    }
  return sum;
}

std::vector<bool> own_margins(const SpecialPoint& point, const std::vector<TestValue>& tests,
                              const std::vector<std::vector<TestValue>>& off) {
  constexpr double zero = 1e-3;  // of what a margin comes to off the curve
  std::vector<bool> own(tests.size(), false);
  for (std::size_t i = 0; i < own.size(); ++i) {
    double most = 0.0;
    for (const std::vector<TestValue>& aside : off) most = std::max(most, std::abs(aside[i].value));
    own[i] = std::isfinite(most) && std::abs(tests[i].value) < zero * most;
  }
  if (changes_events(point.type)) own.at(point.test) = true;
  return own;
}

std::vector<CurveTest> curve_tests(const SpecialPoint& point, const Watched& start, const std::vector<bool>& own) {
  std::vector<CurveTest> tests;
  add_multipliers(tests, point.type);
  for (std::size_t j = 0; j < 2; ++j)
    tests.push_back({.met = {.kind = Meeting::Kind::turn, .parameter = j},
                     .value = [j](const CurvePlace& at) { return at.along[j]; },
                     .noise = constant});
  const Itinerary& shape = point.solution.orbit.shape;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i]) continue;
    CurveTest test;
    test.met = {.kind = Meeting::Kind::margin, .type = type_of(start.tests[i], shape), .margin = used(start.tests[i])};
    test.value = [i](const CurvePlace& at) { return at.watched.tests[i].value; };
    test.falls = true;
    tests.push_back(std::move(test));
  }
  return tests;
}

bool operator==(const Meeting& a, const Meeting& b) {
  const auto key = [](const Meeting& met) {
    return std::tuple(met.kind, met.type, met.order, met.parameter, met.margin.kind, met.margin.leg, met.margin.guard,
                      met.margin.contact);
  };
  return key(a) == key(b);
}

void add_event(Curve& curve, CurveEvent event, const std::array<double, 2>& ranges) {
  constexpr double one_place = 1e-5;  // of the ranges
  for (CurveEvent& known : curve.met) {
    const double off = std::max(std::abs(known.values[0] - event.values[0]) / ranges[0],
                                std::abs(known.values[1] - event.values[1]) / ranges[1]);
    if (off > one_place) continue;
    for (const Meeting& met : event.met)
      if (ranges::find(known.met, met) == known.met.end()) known.met.push_back(met);
    return;
  }
  curve.met.push_back(std::move(event));
}

void find_cause(const SpecialPoint& point, const Watched& before, const Watched& here, const std::vector<bool>& own,
                CurveEnd& end) {
  constexpr double soon = 1.0;       // in steps as long as the last one
  constexpr double near_sum = 0.02;  // an angle within 0.003 of a strong resonance, or 0.02 of 1:1 and 1:2
  if (point.type == SpecialType::NS)
    for (const auto& [sum, order] : {std::pair{-2.0, 2}, {-1.0, 3}, {0.0, 4}, {2.0, 1}})
      if (std::abs(sum_of_pair(here) - sum) < near_sum) {
        end.near = resonance(order);
        return;
      }
  double first = soon;
  for (std::size_t i = 0; i < own.size() && before.tests.size() == own.size(); ++i) {
    const double value = here.tests[i].value, fall = before.tests[i].value - value;
    if (own[i] || !(fall > 0.0) || !(std::abs(value) < first * fall)) continue;
    first = std::abs(value) / fall;
    end.near = Meeting{.kind = Meeting::Kind::margin, .margin = used(here.tests[i])};
  }
  end.infinite_multiplier =
      !end.near && !here.multipliers.empty() && std::abs(here.multipliers.front()) > without_bound;
}

}  // namespace slapstick::orbit
