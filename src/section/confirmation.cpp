/// Confirms cycles beside a motion, the shortest first.
#include "section/confirmation.hpp"

#include <algorithm>
#include <cmath>

#include "section/at_limits.hpp"
#include "section/attraction.hpp"
#include "section/isolated.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {

using Eigen::VectorXd;

namespace {

constexpr double known_to = 1e-9;   ///< a multiplier of a return within 1e-10
constexpr double repelling = 1e-6;  ///< a multiplier of one of a family beyond 1 by more than its own error

}  // namespace

Confirmation::Look Confirmation::first_of(const std::vector<Candidate>& candidates) const {
  Look look;
  for (const Candidate& candidate : candidates) {
    const bool multiple = candidate.returns && look.refused_return != 0 && candidate.n % look.refused_return == 0;
    if (multiple) continue;
    look.cycle = confirm(candidate.n);
    if (look.cycle) return look;
    if (!candidate.returns) continue;
    look.cycle = member(candidate.n);
    if (look.cycle) return look;
    if (look.refused_return == 0) look.refused_return = candidate.n;
  }
  return look;
}

/// The cycle beside a motion that returns after n points, the shortest first: a motion that alternates beside it,
/// slowly nearer, returns after twice its length. Its mean over the alternations is where Newton's method begins.
std::optional<Cycle> Confirmation::confirm(int n) const {
  constexpr double beside = 0.1;  // of the motion's size: what alternates more widely is not beside a shorter cycle
  for (int length = 1; length <= n && !stopped(options_.stop); ++length) {
    if (n % length != 0 || (length < n && record_.returned(length) > beside)) continue;
    if (auto cycle = drawn_to(length, record_.mean(length, n / length))) return cycle;
  }
  return std::nullopt;
}

/// A shorter cycle that a stable one of n points goes round several times; n becomes its length. Beside a multiplier
/// -1 the cycle solves the equations of twice its length also at points beside it: 1 - lambda^2 is almost zero.
FixedPoint Confirmation::once_round(FixedPoint found, int& n) const {
  constexpr double same_cycle =
      1e-5;  // of the motion's size: rounding over 1 - |lambda| where the cycle is barely stable
  constexpr double farthest_image = 1e-2;  // no stable cycle moves a point beside it so much: (1 + |J|) same
  const System& system = map_.translations().system();
  if (n == 1) return found;
  Motion motion(system, flow::user_state(system, found.x));
  for (int length = 1; length < n; ++length) {
    if (!map_.run(motion, 1, options_.stop)) break;
    if (n % length != 0) continue;
    VectorXd image = flow::contact_state(motion);
    map_.translations().take_out(image);
    if (distance(map_.translations(), image, found.x, record_.scale()) > farthest_image) continue;
    auto shorter = fixed_point(map_, found.x, length, record_.scale(), options_.stop);
    if (!shorter || !shorter->stable()) continue;
    if (distance(map_.translations(), shorter->x, found.x, record_.scale()) > same_cycle) continue;
    n = length;
    return std::move(*shorter);
  }
  return found;
}

/// On a family a multiplier is within rounding of 1, on either side, and nothing draws motions to one member. Of a free
/// motion this is the one multiplier that is left.
bool Confirmation::on_a_family(const FixedPoint& found, int n) const {
  if (found.multipliers.empty()) return false;
  const std::complex<double> largest = found.multipliers.front();
  if (options_.free) return std::abs(largest) >= 1.0 - known_to;
  return std::abs(largest - 1.0) <= known_to && family(map_, found.x, n, record_.scale(), options_.stop) > 0;
}

/// A stable fixed point of the n-point map that the motion is drawn to; at the end of a continuum one of a family.
std::optional<Cycle> Confirmation::drawn_to(int n, const VectorXd& start) const {
  auto found = fixed_point(map_, start, n, record_.scale(), options_.stop);
  if (!found || !found->stable()) return std::nullopt;
  if (on_a_family(*found, n) || clear_of_limits(map_, found->x, n, record_.scale(), options_.stop))
    return std::nullopt;  // see `member`
  const Attraction seen = attraction(map_, {options_.by_record ? &record_ : nullptr, motion_, options_.there}, *found,
                                     n, record_.scale(), options_.stop);
  if (!seen.drawn) return std::nullopt;
  found = once_round(std::move(*found), n);
  const bool alone = isolated(map_, *found, n, record_.scale(), options_.stop);
  const int dimensions = alone ? 0 : family(map_, found->x, n, record_.scale(), options_.stop);
  if (!alone && dimensions == 0) return std::nullopt;  // a fold, as far as rounding lets see
  const MapValue& map = found->value;
  const double missed = distance(map_.translations(), map.image, found->x, record_.scale());
  return Cycle{found->x, n, map.duration, found->multipliers, map.advance, missed, seen.distance, dimensions, !alone};
}

/// The point of the cycle that a motion comes to, which returns almost; empty where maps beside it are of no motion.
VectorXd Confirmation::beside(const VectorXd& x, int n) const {
  try {
    return nearest_fixed_point(map_, x, n, record_.scale(), options_.stop);
  } catch (const InputError&) {      // behind a stop
  } catch (const NumericalError&) {  // or a motion that does not return
  }
  return {};
}

bool Confirmation::closes(const VectorXd& x, int length) const {
  try {
    const VectorXd image = map_.value(x, length, options_.stop).image;
    return distance(map_.translations(), image, x, record_.scale()) <= options_.tolerance;
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return false;
}

/// The cycle that the motion is on, in two cases: the cycle is one of a family, where Newton's method has no single
/// point to go to; or nothing draws motions beside it nor repels them. A motion that still turns round the cycle as it
/// comes nearer may return after n points closely and after fewer not yet: there the point of the cycle itself is
/// asked.
std::optional<Cycle> Confirmation::member(int n) const {
  const VectorXd last = record_.back(0);
  std::optional<VectorXd> nearest;
  for (int length = 1; length <= n; ++length) {
    if (n % length != 0) continue;
    const bool returns = record_.returned(length) <= options_.tolerance;
    if (!returns && !nearest) nearest = beside(last, n);
    if (!returns && !(nearest->size() > 0 && closes(*nearest, length))) continue;
    const VectorXd& seen = returns ? last : *nearest;
    const VectorXd here = clear_of_limits(map_, seen, length, record_.scale(), options_.stop).value_or(seen);
    const int dimensions = family(map_, here, length, record_.scale(), options_.stop);
    const MapValue map = map_.value(here, length, options_.stop);
    auto multipliers = map_.multipliers(map.jacobian);
    const double largest = multipliers.empty() ? 0.0 : std::abs(multipliers.front());
    const bool neutral = largest >= 1.0 - known_to;
    // A real multiplier 1 without cycles beside is a fold's, which draws motions from one side.
    const bool fold = !options_.free && neutral && std::abs(multipliers.front() - 1.0) <= repelling;
    if ((dimensions == 0 && (!neutral || fold)) || largest > 1.0 + repelling) continue;
    const double missed = distance(map_.translations(), map.image, here, record_.scale());
    return Cycle{
        here,       length, map.duration, std::move(multipliers), map.advance, missed, record_.returned(length),
        dimensions, true};
  }
  return std::nullopt;
}

std::optional<Cycle> Confirmation::look_around() const {
  constexpr int longest = 8;
  for (int n = 1; n <= std::min(longest, options_.most_n) && !stopped(options_.stop); ++n) {
    const long count = std::min(returns_compared, record_.size() / n);
    if (count < 2) break;
    const VectorXd mean = record_.mean(n, count);
    if (record_.spread(n, count, mean) > options_.widest_round) continue;
    if (auto cycle = drawn_to(n, mean)) return cycle;
  }
  return std::nullopt;
}

}  // namespace slapstick::section
