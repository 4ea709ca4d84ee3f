/// The choice among several lawful modes at the start of a segment.
///
/// With f_s = f_k the laws leave no choice of accelerations. Where a contact at rest could bear more than its kinetic
/// friction they may: sticking and slipping are both lawful. The rule is then that as few contacts as possible differ
/// from stuck and closed. A mode that differs in as many contacts, and moves otherwise, makes the choice one of
/// several.
#include <algorithm>

#include "check.hpp"

namespace verify {
namespace {

constexpr long most_tried = 729;

/// Contacts at rest, and the states that each may take, the preferred one first.
struct Candidates {
  std::vector<std::size_t> stops, frictions;

  [[nodiscard]] long count() const {
    long product = 1;
    for (std::size_t i = 0; i < stops.size() && product <= most_tried; ++i) product *= 2;
    for (std::size_t i = 0; i < frictions.size() && product <= most_tried; ++i) product *= 3;
    return product;
  }
  [[nodiscard]] ContactStates combination(ContactStates states, long k) const {
    for (const std::size_t i : stops) states.closed[i] = k % 2 == 0, k /= 2;
    for (const std::size_t i : frictions) states.slip[i] = static_cast<int>(k % 3 == 2 ? -1 : k % 3), k /= 3;
    return states;
  }
  [[nodiscard]] long changes(const ContactStates& states) const {
    long n = 0;
    for (const std::size_t i : stops) n += states.closed[i] ? 0 : 1;
    for (const std::size_t i : frictions) n += states.slip[i] == 0 ? 0 : 1;
    return n;
  }
};

/// Certainly lawful from X on: every condition rises, but for those that stay zero.
bool fits(const FlownMode& mode, const Balls& X) {
  const std::vector<double> sizes = mode.flow.sizes_of(X);
  const Expansion about(mode.flow, X, Ball(0.0), Order::rest + 8);
  for (std::size_t i = 0; i < mode.flow.rows.size(); ++i) {
    const Order order = order_at(mode.flow, i, about.of(mode.flow.rows[i]), sizes);
    if (!order.rises || !order.certain) return false;
  }
  return true;
}

bool moves_otherwise(const FlownMode& a, const FlownMode& b, const Balls& X) {
  const Balls one = a.flow.rate(X), other = b.flow.rate(X);
  const std::vector<double> size = a.flow.apply_sizes(a.flow.sizes_of(X));
  for (std::size_t i = 0; i < one.size(); ++i)
    if (abs(one[i] - other[i]) > Ball(rounding * size[i])) return true;
  return false;
}

}  // namespace

/// Number i of the state is zero, but for rounding.
bool Checker::near_zero(const Segment& segment, std::size_t i) const {
  const double x = i < m_.d() ? segment.p[i] : segment.u[i - m_.d()];
  return x == 0.0 || (last_ != nullptr && std::abs(x) <= allowance(i));
}

/// Who writes the last bit of a state does not choose by it: what rounding explains counts as rest, and is zero in the
/// modes that are tried.
void Checker::choice(const Segment& segment) {
  const Model& model = m_.model();
  Candidates candidates;
  bool several = false;
  std::vector<double> p = segment.p, u = segment.u;
  for (std::size_t i = 0; i < model.stops.size(); ++i) {
    const std::size_t own = m_.stop(i).own;
    if (!near_zero(segment, own) || !near_zero(segment, m_.d() + own)) continue;
    candidates.stops.push_back(i);
    p[own] = u[own] = 0.0;
  }
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const std::size_t own = m_.friction(i).own;
    if (!near_zero(segment, m_.d() + own)) continue;
    candidates.frictions.push_back(i);
    u[own] = 0.0;
    several = several || model.frictions[i].kinetic < model.frictions[i].static_limit;
  }
  if (!several) return;
  if (candidates.count() > most_tried) return void(++tally_.open.choices);
  const Balls X = m_.extended(p, u, segment.start.fraction);
  const FlownMode& chosen = flown(segment.states);
  const long changes = candidates.changes(segment.states);
  bool another = false;
  for (long k = 0; k < candidates.count(); ++k) {
    const ContactStates states = candidates.combination(segment.states, k);
    if (states == segment.states || candidates.changes(states) > changes) continue;
    const FlownMode& mode = flown(states);
    if (!fits(mode, X) || !moves_otherwise(chosen, mode, X)) continue;
    if (candidates.changes(states) < changes)
      return refuse_(segment.line, "contacts slip or open that could stick or stay closed");
    another = true;
  }
  if (another) ++tally_.open.choices;
}

}  // namespace verify
