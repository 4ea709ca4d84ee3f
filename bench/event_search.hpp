#pragma once
/// What ends a phase inside one solver step, and where: the event search that both peers share.
///
/// A `Step` offers length(), begin(), end(), at(tau) for 0 < tau < length(): the state tau after the step's begin, and
/// slope(state, tau), the right-hand side. A `Guard` offers value(state, tau) and rate(state, slope, tau), its
/// derivative. The search is one of signs at step ends, as a good user of a general-purpose solver would write it. The
/// search therefore cannot see two crossings inside one step; y is safe from that, because it is monotone while w > 0
/// and is tested at w's root too.

#include "paper_oscillator.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace slapstick::bench {

/// A state `tau` after the step's begin.
struct Instant {
  double tau;
  State state;
};

/// Positive while the slip goes on in the direction of `sign`: sign w.
struct SpeedGuard {
  double sign;
  double value(const State& x, double) const { return sign * x[relative_velocity]; }
  double rate(const State&, const State& slope, double) const { return sign * slope[relative_velocity]; }
};

/// Positive while the stop is open: b - y.
struct GapGuard {
  double value(const State& x, double) const { return PaperOscillator::clearance - x[relative_displacement]; }
  double rate(const State& x, const State&, double) const { return -x[relative_velocity]; }
};

/// Positive while the contact sticks: f_s - |f0|, on the closed stop f_s + f0.
struct HoldGuard {
  const PaperOscillator& oscillator;
  bool closed;
  double begin_time;
  double value(const State& x, double tau) const {
    const double force = oscillator.holding_force(x, begin_time + tau);
    return PaperOscillator::static_friction + (closed ? force : -std::abs(force));
  }
  double rate(const State& x, const State& slope, double tau) const {
    const double rate = oscillator.holding_force_rate(slope, begin_time + tau);
    return closed || oscillator.holding_force(x, begin_time + tau) < 0.0 ? rate : -rate;
  }
};

constexpr std::uintmax_t most_iterations = 80;

/// A guard with its derivative at one instant of a step.
struct Sample {
  double tau, value, rate;
};

template <class Step, class Guard>
Sample sample(Step& step, const Guard& guard, const Instant& instant) {
  const State slope = step.slope(instant.state, instant.tau);
  return {instant.tau, guard.value(instant.state, instant.tau), guard.rate(instant.state, slope, instant.tau)};
}

/// Root of the cubic Hermite interpolant between two samples of opposite sign, to about 1e-8 of their distance.
inline double hermite_root(const Sample& low, const Sample& high) {
  const double length = high.tau - low.tau;
  const double difference = high.value - low.value;
  const double c1 = low.rate * length;
  const double c2 = 3.0 * difference - (2.0 * low.rate + high.rate) * length;
  const double c3 = (low.rate + high.rate) * length - 2.0 * difference;
  const auto cubic = [&](double z) { return low.value + z * (c1 + z * (c2 + z * c3)); };
  const auto narrow = [](double a, double b) { return b - a <= 1e-8 * b; };
  std::uintmax_t iterations = most_iterations;
  const auto [a, b] = boost::math::tools::toms748_solve(cubic, 0.0, 1.0, low.value, high.value, narrow, iterations);
  return low.tau + 0.5 * (a + b) * length;
}

/// Newton's method from the Hermite root, one or two re-taken steps as a rule. The last correction is so small that the
/// state follows it along its slope. Shrinks the bracket; gives up (nothing) when it leaves it or is slow, as near a
/// graze.
template <class Step, class Guard>
std::optional<Instant> newton_root(Step& step, const Guard& guard, Instant& low, Instant& high) {
  constexpr double follow = 1e-8;  // error of following the slope: follow^2 / 2 times an acceleration of order 1
  double tau = hermite_root(sample(step, guard, low), sample(step, guard, high));
  for (int iteration = 0; iteration < 4 && low.tau < tau && tau < high.tau; ++iteration) {
    Instant instant{tau, step.at(tau)};
    const State slope = step.slope(instant.state, tau);
    const double value = guard.value(instant.state, tau);
    (value > 0.0 ? low : high) = instant;
    const double correction = -value / guard.rate(instant.state, slope, tau);
    if (std::abs(correction) <= follow) {
      for (unsigned i = 0; i < slope.size(); ++i) {
        instant.state[i] += correction * slope[i];
      }
      instant.tau += correction;
      return instant;
    }
    tau += correction;
  }
  return std::nullopt;
}

/// TOMS 748 until the bracket is `width` wide; returns the best state seen, so no further evaluation is needed.
template <class Step, class Guard>
Instant bracketed_root(Step& step, const Guard& guard, const Instant& low, const Instant& high, double width) {
  const double value_low = guard.value(low.state, low.tau);
  const double value_high = guard.value(high.state, high.tau);
  Instant best = -value_high < value_low ? high : low;
  double smallest = std::min(value_low, -value_high);
  const auto sampled_guard = [&](double tau) {
    const State state = step.at(tau);
    const double value = guard.value(state, tau);
    if (std::abs(value) < smallest) {
      smallest = std::abs(value);
      best = {tau, state};
    }
    return value;
  };
  const auto narrow = [width](double a, double b) { return b - a <= width; };
  std::uintmax_t iterations = most_iterations;
  boost::math::tools::toms748_solve(sampled_guard, low.tau, high.tau, value_low, value_high, narrow, iterations);
  return best;
}

/// The root of the guard between `low` and `high`, where it is positive and not positive.
template <class Step, class Guard>
Instant locate(Step& step, const Guard& guard, Instant low, Instant high, double width) {
  if (guard.value(high.state, high.tau) == 0.0) {
    return high;
  }
  if (const std::optional<Instant> root = newton_root(step, guard, low, high)) {
    return *root;
  }
  return guard.value(high.state, high.tau) == 0.0 ? high : bracketed_root(step, guard, low, high, width);
}

/// A first instant with guard > 0 when the step begins on the guard's zero and ends beyond it: h/2, h/4, ...
template <class Step, class Guard>
std::optional<Instant> find_inside(Step& step, const Guard& guard) {
  double tau = step.length();
  for (int halving = 0; halving < 40; ++halving) {
    tau *= 0.5;
    const Instant probe{tau, step.at(tau)};
    if (guard.value(probe.state, tau) > 0.0) {
      return probe;
    }
  }
  return std::nullopt;
}

/// Where the guard turns from positive to not positive in this step, if it is not positive at the step's end. A step
/// that begins on the zero (a slip from rest) and never leaves it is passed over: the phase has not started moving yet.
template <class Step, class Guard>
std::optional<Instant> find_crossing(Step& step, const Guard& guard, double width) {
  const Instant end{step.length(), step.end()};
  if (guard.value(end.state, end.tau) > 0.0) {
    return std::nullopt;
  }
  Instant low{0.0, step.begin()};
  if (guard.value(low.state, low.tau) <= 0.0) {
    const std::optional<Instant> inside = find_inside(step, guard);
    if (!inside) {
      return std::nullopt;
    }
    low = *inside;
  }
  return locate(step, guard, low, end, width);
}

/// Contact, y = b, not after `last`; y is monotone until then, so its sign there decides.
template <class Step>
std::optional<Instant> find_contact(Step& step, const Instant& last, double width) {
  constexpr GapGuard gap;
  if (gap.value(last.state, last.tau) > 0.0) {
    return std::nullopt;
  }
  return locate(step, gap, Instant{0.0, step.begin()}, last, width);
}

}  // namespace slapstick::bench
