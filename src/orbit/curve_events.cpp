#include "orbit/curve_events.hpp"

#include <algorithm>
#include <cmath>

#include "orbit/change_kind.hpp"
#include "orbit/special.hpp"

namespace slapstick::orbit {
namespace {

using Multipliers = std::vector<std::complex<double>>;

constexpr double without_bound = 1e6;  ///< a multiplier

/// prod (mu - target) without the factor nearest to zero, which is zero all along: its sign changes where a second multiplier comes there.
double product_of_others(const Multipliers& multipliers, double target) {
  const auto off = [target](const std::complex<double>& mu) { return std::abs(mu - target); };
  const auto own = std::ranges::min_element(multipliers, {}, off);
  std::complex<double> product = 1.0;
  for (auto mu = multipliers.begin(); mu != multipliers.end(); ++mu)
    if (mu != own) product *= *mu - target;
  return product.real();
}

std::function<std::string(const Watched&)> always(std::string what) {
  return [what = std::move(what)](const Watched&) { return what; };
}

/// Strong resonances on the way of a torus; those at its ends are not among them.
void add_resonances(std::vector<CurveTest>& tests) {
  tests.push_back({"R3", [](const CurvePlace& at) { return sum_of_pair(at.watched) + 1.0; },
                   always("resonance 1:3: the angle is a third of a turn")});
  tests.push_back({"R4", [](const CurvePlace& at) { return sum_of_pair(at.watched); },
                   always("resonance 1:4: the angle is a quarter of a turn")});
}

/// A function of the multipliers. Where one is infinite, as at an impact without speed, the others are rounding and it has no value.
std::function<double(const CurvePlace&)> of_multipliers(double (*value)(const Watched&)) {
  return [value](const CurvePlace& at) {
    const Multipliers& all = at.watched.multipliers;
    return !all.empty() && std::abs(all.front()) > without_bound ? std::nan("") : value(at.watched);
  };
}

constexpr double at_zero =
    0.1;  ///< a function that changes its sign through infinity, as beside an impact without speed, is no such zero

/// Are there so many multipliers at a value?
std::function<bool(const Watched&)> multipliers_at(double target, int count) {
  return [target, count](const Watched& at) {
    const auto near = [target](const std::complex<double>& mu) { return std::abs(mu - target) < at_zero; };
    return std::ranges::count_if(at.multipliers, near) >= count;
  };
}

/// Two multipliers whose product is 1 are a torus's if they are no real numbers mu, 1 / mu, as at a neutral saddle.
bool on_the_circle(const Watched& at) {
  return std::ranges::any_of(at.multipliers,
                             [](const std::complex<double>& mu) { return std::abs(std::abs(mu) - 1.0) < at_zero; }) &&
         std::abs(sum_of_pair(at)) < 2.0;
}

void add_multipliers(std::vector<CurveTest>& tests, SpecialType type) {
  const auto add = [&](const char* name, double (*value)(const Watched&), const char* what,
                       std::function<bool(const Watched&)> holds) {
    tests.push_back({name, of_multipliers(value), always(what), false, std::move(holds)});
  };
  if (type == SpecialType::PD)
    add(
        "R2", [](const Watched& at) { return product_of_others(at.multipliers, -1.0); },
        "resonance 1:2: a second multiplier passes -1", multipliers_at(-1.0, 2));
  else
    add(
        "PD", [](const Watched& at) { return at.flip; }, "a multiplier passes -1", multipliers_at(-1.0, 1));
  if (type == SpecialType::LP)
    add(
        "R1", [](const Watched& at) { return product_of_others(at.multipliers, 1.0); },
        "resonance 1:1: a second multiplier passes +1", multipliers_at(1.0, 2));
  else
    tests.push_back({"LP", [](const CurvePlace& at) { return at.watched.turn; },
                     always("a fold of the branch: a multiplier passes +1")});
  if (type == SpecialType::NS) return add_resonances(tests);
  if (type != SpecialType::PD && type != SpecialType::LP)
    add(
        "NS", [](const Watched& at) { return at.torus; }, "two multipliers on the unit circle", on_the_circle);
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

std::vector<CurveTest> curve_tests(const Problem& problem, const SpecialPoint& point, const Watched& start,
                                   const std::vector<bool>& own) {
  std::vector<CurveTest> tests;
  add_multipliers(tests, point.type);
  for (std::size_t j = 0; j < 2; ++j)
    tests.push_back({"turn", [j](const CurvePlace& at) { return at.along[j]; },
                     always("the curve turns back in " + problem.family().names[j])});
  const Itinerary& shape = point.solution.orbit.shape;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i]) continue;
    CurveTest test;
    test.type = name(type_of(start.tests[i], shape));
    test.value = [i](const CurvePlace& at) { return at.watched.tests[i].value; };
    test.what = [&problem, &shape, i](const Watched& at) {
      return "the events change: " + describe(at.tests[i], shape, problem.base());
    };
    test.falls = true;
    tests.push_back(std::move(test));
  }
  return tests;
}

void add_event(Curve& curve, CurveEvent event, const std::array<double, 2>& ranges) {
  constexpr double one_place = 1e-5;  // of the ranges
  for (CurveEvent& known : curve.met) {
    const double off = std::max(std::abs(known.values[0] - event.values[0]) / ranges[0],
                                std::abs(known.values[1] - event.values[1]) / ranges[1]);
    if (off > one_place) continue;
    if (known.what.find(event.what) == std::string::npos) known.what += "; " + event.what;
    return;
  }
  curve.met.push_back(std::move(event));
}

std::string likely_cause(const Problem& problem, const SpecialPoint& point, const Orbit& orbit, const Watched& before,
                         const Watched& here, const std::vector<bool>& own) {
  constexpr double soon = 1.0;       // in steps as long as the last one
  constexpr double near_sum = 0.02;  // an angle within 0.003 of a strong resonance, or 0.02 of 1:1 and 1:2
  if (point.type == SpecialType::NS)
    for (const auto& [sum, words] : {std::pair{-2.0, "1:2"}, {-1.0, "1:3"}, {0.0, "1:4"}, {2.0, "1:1"}})
      if (std::abs(sum_of_pair(here) - sum) < near_sum) return std::string(", near the resonance ") + words;
  std::string cause;
  double first = soon;
  for (std::size_t i = 0; i < own.size() && before.tests.size() == own.size(); ++i) {
    const double value = here.tests[i].value, fall = before.tests[i].value - value;
    if (own[i] || !(fall > 0.0) || !(std::abs(value) < first * fall)) continue;
    first = std::abs(value) / fall;
    cause = ", near where " + describe(here.tests[i], orbit.shape, problem.base());
  }
  if (cause.empty() && !here.multipliers.empty() && std::abs(here.multipliers.front()) > without_bound)
    cause = ", where a multiplier grows without bound";
  return cause;
}

}  // namespace slapstick::orbit
