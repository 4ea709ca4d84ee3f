#pragma once
/// How a curve in two parameters is walked along, whatever its equations are: from place to place by steps that become
/// shorter where none leads on, up to the end of a range, with the points of codimension two on the way.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "continuation/curve_events.hpp"

namespace slapstick::orbit {

/// A step along the tangent. Its length is in units of both ranges and the orbit's size.
struct CurveStep {
  double length = 0.0;
  std::optional<std::size_t> wall = {};  ///< the parameter at whose end of range it ends
  double value = 0.0;                    ///< .. and that end
};

/// @tparam Place  a point of the curve, with its tangent
template <class Place>
class CurveWalk {
 public:
  virtual ~CurveWalk() = default;

  /// @param here   the first place, its tangent in the sense in which the walk goes
  /// @param first  length of the first step
  Curve walk(Itinerary shape, std::vector<std::string> parameters, Place here, double first);

 protected:
  explicit CurveWalk(const CurveOptions& options) : options_(options) {}
  CurveWalk(const CurveWalk&) = default;

  [[nodiscard]] virtual const std::vector<double>& values(const Place& here) const = 0;
  /// The components of the tangent in both parameters, each in units of its range.
  [[nodiscard]] virtual std::array<double, 2> rates(const Place& here) const = 0;
  /// The place to which a step leads, if there is one.
  [[nodiscard]] virtual std::optional<Place> next(const Place& here, const CurveStep& step) const = 0;
  /// Does the curve go on from one place to another, as far as that is seen from both?
  [[nodiscard]] virtual bool goes_on(const Place& here, const Place& ahead) const = 0;
  [[nodiscard]] virtual CurvePoint point(const Place& here) const = 0;
  [[nodiscard]] virtual CurvePlace watched(const Place& here) const = 0;
  /// What lies between two places goes into the curve. `now` may be moved to where the curve ends.
  /// @returns whether that is the end
  virtual bool pass(const Place& before, Place& now, double length, Curve& curve) const {
    note(before, now, length, curve);
    return false;
  }
  /// What may be the cause where no step leads on.
  virtual void explain(const Place& /*here*/, CurveEnd& /*end*/) const {}

  [[nodiscard]] std::array<double, 2> ranges() const {
    return {options_.to - options_.from, options_.second_to - options_.second_from};
  }
  static bool straight(double cosine) {
    // An angle of 26 degrees: the next place of a smooth curve is within it at some length of the step. A smaller
    // cosine might go over to a neighbouring curve, a larger one takes more steps.
    constexpr double least_cosine = 0.9;
    return cosine >= least_cosine;
  }
  /// The zero of a function between two places, at which its signs differ.
  [[nodiscard]] std::optional<Place> located(const Place& before, const Place& now, double length,
                                             const std::function<double(const Place&)>& value) const;
  void note(const Place& before, const Place& now, double length, Curve& curve) const;

  const CurveOptions& options_;
  std::vector<CurveTest> tests_;  ///< of what is watched

 private:
  [[nodiscard]] std::array<double, 2> least() const { return {options_.from, options_.second_from}; }
  [[nodiscard]] std::array<double, 2> most() const { return {options_.to, options_.second_to}; }
  [[nodiscard]] bool inside(const std::vector<double>& at) const {
    return at[0] >= least()[0] && at[0] <= most()[0] && at[1] >= least()[1] && at[1] <= most()[1];
  }
  [[nodiscard]] CurveStep step_from(const Place& here, double length) const;
  [[nodiscard]] bool at_rim(const Place& here) const;
};

/// To the end of a range that the step would pass.
template <class Place>
CurveStep CurveWalk<Place>::step_from(const Place& here, double length) const {
  CurveStep step{.length = length};
  for (std::size_t j = 0; j < 2; ++j) {
    const double rate = rates(here)[j], end = rate > 0.0 ? most()[j] : least()[j];
    const double to_end = rate != 0.0 ? (end - values(here)[j]) / (rate * ranges()[j]) : INFINITY;
    if (to_end <= step.length) step = {std::max(to_end, 0.0), j, end};
  }
  return step;
}

/// Is it so near to the end of a range that a curve has come to it?
template <class Place>
bool CurveWalk<Place>::at_rim(const Place& here) const {
  constexpr double rim = 1e-4;  // of a range: the model may not exist beyond, and the last step fail
  for (std::size_t j = 0; j < 2; ++j) {
    const double rate = rates(here)[j], end = rate > 0.0 ? most()[j] : least()[j];
    if (rate != 0.0 && std::abs(end - values(here)[j]) < rim * ranges()[j]) return true;
  }
  return false;
}

template <class Place>
Curve CurveWalk<Place>::walk(Itinerary shape, std::vector<std::string> parameters, Place here, double first) {
  constexpr double least_step = 1e-7, growth = 1.4;
  Curve curve;
  curve.parameters = std::move(parameters);
  curve.shape = std::move(shape);
  curve.up.kind = CurveEnd::Kind::most_points;
  double length = first;
  const auto add = [&] {
    curve.points.push_back(point(here));
    if (options_.progress) options_.progress(static_cast<long>(curve.points.size()));
  };
  add();
  while (static_cast<int>(curve.points.size()) < options_.most_points && !stopped(options_.stop)) {
    const CurveStep step = step_from(here, length);
    std::optional<Place> ahead = step.length >= least_step ? next(here, step) : std::nullopt;
    if (!ahead || !inside(values(*ahead)) || !goes_on(here, *ahead)) {
      length = 0.5 * step.length;
      if (length > least_step && !(step.wall && at_rim(here))) continue;
      curve.up = {.kind = CurveEnd::Kind::range};
      if (at_rim(here)) return curve;
      curve.up = {.kind = CurveEnd::Kind::no_step, .failed = true, .values = values(here)};
      explain(here, curve.up);
      return curve;
    }
    const bool ends = pass(here, *ahead, step.length, curve);
    here = std::move(*ahead);
    add();
    if (!ends && step.wall) curve.up.kind = CurveEnd::Kind::range;
    if (ends || step.wall) return curve;
    length = std::min(options_.longest_step, growth * length);
  }
  if (stopped(options_.stop)) curve.up.kind = CurveEnd::Kind::stopped;
  return curve;
}

template <class Place>
std::optional<Place> CurveWalk<Place>::located(const Place& before, const Place& now, double length,
                                               const std::function<double(const Place&)>& value) const {
  constexpr double tolerance = 1e-7;  // of the step: tangents by differences are known no better
  constexpr int most_tries = 30;
  double a = 0.0, b = length, f_a = value(before), f_b = value(now);
  std::optional<Place> best;
  for (int k = 0; k < most_tries && b - a > tolerance * length; ++k) {
    double s = (a * f_b - b * f_a) / (f_b - f_a);
    if (!(s > a && s < b) || k % 3 == 2) s = 0.5 * (a + b);
    std::optional<Place> there = next(before, {.length = s});
    if (!there) break;
    const double f_s = value(*there), moved = std::min(s - a, b - s);
    const bool left = (f_s < 0.0) == (f_a < 0.0);
    (left ? a : b) = s;
    (left ? f_a : f_b) = f_s;
    best = std::move(there);
    if (f_s == 0.0 || moved <= tolerance * length) break;
  }
  return best;
}

/// Points of codimension two between two places.
template <class Place>
void CurveWalk<Place>::note(const Place& before, const Place& now, double length, Curve& curve) const {
  for (const CurveTest& test : tests_) {
    const auto value = [&](const Place& here) { return test.value(watched(here)); };
    const double from = value(before), to = value(now);
    if (!(std::abs(from) >= test.noise && std::abs(to) >= test.noise)) continue;  // no sign, or no value
    if ((from < 0.0) == (to < 0.0) || (test.falls && !(from > 0.0 && to < 0.0))) continue;
    const std::optional<Place> there = located(before, now, length, value);
    const Place& at = there ? *there : now;
    if (test.holds && !test.holds(watched(at).watched)) continue;
    add_event(curve, {{test.met}, values(at), curve.points.size() - 1}, ranges());
  }
}

}  // namespace slapstick::orbit
