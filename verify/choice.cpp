/// The choice among several lawful modes at the start of a segment.
///
/// With f_s = f_k the laws leave no choice of accelerations. Where a contact at rest could bear more than its kinetic
/// friction they may: sticking and slipping are both lawful. The rule is then that as few contacts as possible differ
/// from stuck and closed. A mode that differs in as many contacts, and moves otherwise, makes the choice one of
/// several.
#include <algorithm>
#include <array>

#include "check.hpp"

namespace verify {
namespace {

constexpr long most_tried = 729;

/// Certainly lawful from X on: every condition rises, except those that stay zero.
bool fits(const FlownMode& mode, const Balls& X) {
  const std::vector<double> sizes = mode.flow.sizes_of(X);
  const Expansion about(mode.flow, X, Ball(0.0), terms_at_start(X));
  for (std::size_t i = 0; i < mode.flow.rows.size(); ++i) {
    const Order order = order_at(mode.flow, i, about.of(mode.flow.rows[i]), sizes);
    if (!order.rises || !order.certain) return false;
  }
  return true;
}

/// By any derivative: where slip begins as its force comes to the limit, the first ones are those of rest. Two motions
/// of m numbers whose first 2 m derivatives agree are one.
bool moves_otherwise(const FlownMode& a, const FlownMode& b, const Balls& X) {
  Balls one = X, other = X;
  std::vector<double> size = a.flow.sizes_of(X);
  for (std::size_t n = 0; n < 2 * X.size(); ++n) {
    one = a.flow.rate(one);
    other = b.flow.rate(other);
    size = a.flow.apply_sizes(size);
    for (std::size_t i = 0; i < one.size(); ++i)
      if (abs(one[i] - other[i]) > Ball(rounding * size[i])) return true;
  }
  return false;
}

}  // namespace

/// Contacts at rest, and the states that each may take, the preferred one first.
struct Checker::Candidates {
  std::vector<std::size_t> stops, frictions;
  std::vector<std::size_t> off_stops, off_frictions;  ///< those whose state is not zero, and that the motion leads to
  bool several = false;                               ///< static friction is greater than kinetic somewhere
  std::vector<int> offered;                           ///< states of each friction contact: 3, or 4 with a normal force

  [[nodiscard]] long count() const {
    long product = 1;
    for (std::size_t i = 0; i < stops.size() && product <= most_tried; ++i) product *= 2;
    for (std::size_t i = 0; i < frictions.size() && product <= most_tried; ++i) product *= offered[i];
    return product;
  }
  [[nodiscard]] ContactStates combination(ContactStates states, long k) const {
    for (const std::size_t i : stops) states.closed[i] = k % 2 == 0, k /= 2;
    constexpr std::array order = {0, 1, -1, ContactStates::unloaded};
    for (std::size_t j = 0; j < frictions.size(); ++j) {
      states.slip[frictions[j]] = order[static_cast<std::size_t>(k % offered[j])];
      k /= offered[j];
    }
    return states;
  }
  [[nodiscard]] long changes(const ContactStates& states) const {
    long n = 0;
    for (const std::size_t i : stops) n += states.closed[i] ? 0 : 1;
    for (const std::size_t i : frictions) n += states.slip[i] == 0 ? 0 : 1;
    return n;
  }
  /// One that is not at rest is said to be so, or to move otherwise.
  [[nodiscard]] bool by_rounding(const ContactStates& states, const ContactStates& stated) const {
    const auto stop = [&](std::size_t i) { return states.closed[i] != stated.closed[i]; };
    const auto friction = [&](std::size_t i) { return states.slip[i] != stated.slip[i]; };
    return std::any_of(off_stops.begin(), off_stops.end(), stop) ||
           std::any_of(off_frictions.begin(), off_frictions.end(), friction);
  }
};

/// Number i of the state is zero up to rounding.
bool Checker::near_zero(const Segment& segment, std::size_t i) const {
  const double x = i < m_.d() ? segment.p[i] : segment.u[i - m_.d()];
  return x == 0.0 || (last_ != nullptr && std::abs(x) <= allowance(i));
}

/// Number i of the state is not zero, and has the sign that flight and impacts have led to.
bool Checker::led_to(const Segment& segment, std::size_t i) const {
  const double x = i < m_.d() ? segment.p[i] : segment.u[i - m_.d()];
  return last_ != nullptr && Ball(x) * last_->X[i] > Ball(0.0);
}

Checker::Candidates Checker::those_at_rest(const Segment& segment) const {
  const Model& model = m_.model();
  Candidates candidates;
  for (std::size_t i = 0; i < model.stops.size(); ++i) {
    const std::size_t own = m_.stop(i).own;
    if (!near_zero(segment, own) || !near_zero(segment, m_.d() + own)) continue;
    candidates.stops.push_back(i);
    if (led_to(segment, own) || led_to(segment, m_.d() + own)) candidates.off_stops.push_back(i);
  }
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const std::size_t own = m_.d() + m_.friction(i).own;
    if (!near_zero(segment, own)) continue;
    candidates.frictions.push_back(i);
    if (led_to(segment, own)) candidates.off_frictions.push_back(i);
    candidates.offered.push_back(model.frictions[i].normal ? 4 : 3);
    candidates.several = candidates.several || model.frictions[i].kinetic < model.frictions[i].static_limit;
  }
  return candidates;
}

/// Who writes the last bit of a state does not choose by it: what rounding explains counts as rest, and is zero in the
/// modes that are tried. What rounding explains too, but the motion leads to, as in a chatter that ends, is a choice
/// that is counted.
void Checker::choice(const Segment& segment) {
  const Candidates candidates = those_at_rest(segment);
  if (!candidates.several) return;
  if (candidates.count() > most_tried) return void(++tally_.open.choices);
  std::vector<double> p = segment.p, u = segment.u;
  for (const std::size_t i : candidates.stops) p[m_.stop(i).own] = u[m_.stop(i).own] = 0.0;
  for (const std::size_t i : candidates.frictions) u[m_.friction(i).own] = 0.0;
  const Balls at_rest = m_.extended(p, u, segment.start);
  for (const std::size_t i : candidates.off_frictions) u[m_.friction(i).own] = segment.u[m_.friction(i).own];
  for (const std::size_t i : candidates.off_stops) {
    p[m_.stop(i).own] = segment.p[m_.stop(i).own];
    u[m_.stop(i).own] = segment.u[m_.stop(i).own];
  }
  const Balls moving = m_.extended(p, u, segment.start);
  const FlownMode& chosen = flown(segment.states);
  const long changes = candidates.changes(segment.states);
  bool another = false;
  for (long k = 0; k < candidates.count(); ++k) {
    const ContactStates states = candidates.combination(segment.states, k);
    if (states == segment.states || candidates.changes(states) > changes) continue;
    const FlownMode& mode = flown(states);
    const bool by_rounding = candidates.by_rounding(states, segment.states);
    const Balls& X = by_rounding ? at_rest : moving;
    if (!fits(mode, X) || !moves_otherwise(chosen, mode, X)) continue;
    if (!by_rounding && candidates.changes(states) < changes)
      return refuse_(segment.line, "contacts slip or open that could stick or stay closed");
    another = true;
  }
  if (another) ++tally_.open.choices;
}

}  // namespace verify
