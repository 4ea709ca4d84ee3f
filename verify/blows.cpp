/// Impulses at the end of a segment: that each follows the stated law from the state before.
///
/// Moreau's law at the stops S in contact, v their velocities of approach: impulses P >= 0 with v+ + r v <= 0, one of
/// both zero at each stop. Where the stops that are hit depend on each other P is not unique, and v+ is: some solution
/// has impulses at independent stops only. At one stop it is Newton's law, v+ = -r v.
#include <algorithm>
#include <cmath>
#include <optional>

#include "bodies.hpp"
#include "check.hpp"

namespace verify {
namespace {

/// Impacts this much slower than the fastest of their instant, or this many, may be called a pile-up.
constexpr double slow = 0x1p-20;
constexpr long many_blows = 5000;
/// Segments this short, in periods and in radians of their mode, are at one instant.
constexpr double no_time = 0x1p-44;
constexpr std::size_t most_dependent = 16;

}  // namespace

Ball Checker::approach(int stop) const {
  return Ball(m_.stop(static_cast<std::size_t>(stop)).sign) * last_->X[u(stop)];
}

/// r v of an approach at v: r is that of the model below the first corner, then a polyline, then constant. A ball that
/// straddles corners gets what belongs to each piece that it touches.
Ball Checker::rebound(int stop, const Ball& v) const {
  const Stop& of = m_.model().stops[static_cast<std::size_t>(stop)];
  const auto& corners = of.corners;
  std::optional<Ball> hull;
  for (std::size_t k = 0; k <= corners.size(); ++k) {
    if ((k > 0 && v < Ball(corners[k - 1].at)) || (k < corners.size() && v > Ball(corners[k].at))) continue;
    Ball r(k == 0 ? of.restitution : corners[k - 1].force);
    if (k > 0 && k < corners.size()) {
      const Corner &from = corners[k - 1], &to = corners[k];
      r += (Ball(to.force) - Ball(from.force)) / (Ball(to.at) - Ball(from.at)) * (v - Ball(from.at));
    }
    hull = hull ? united(*hull, r) : r;
  }
  return (hull ? *hull : Ball(of.restitution)) * v;
}

/// 1 + |d(r v)/dv| near v, at least 2: how a rounding of v grows.
double Checker::steepness(int stop, double v) const {
  const auto& corners = m_.model().stops[static_cast<std::size_t>(stop)].corners;
  double most = 2.0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Corner &from = corners[k - 1], &to = corners[k];
    const double slope = std::abs((to.force - from.force) / (to.at - from.at)), margin = 1e-6 * to.at;
    if (v > from.at - margin && v < to.at + margin) most = std::max(most, 2.0 + slope * v);
  }
  return most;
}

double Checker::speed_rounding(int stop) const { return allowance(u(stop)); }

void Checker::blows() {
  const Segment& segment = last_->segment;
  if (segment.duration > no_time * period_ || segment.duration * flown(segment.states).flow.nu > no_time ||
      instant_.fastest.empty())
    instant_ = {std::vector<double>(m_.model().stops.size(), 0.0)};
  std::vector<bool> found(segment.impacts.size());
  for (const Blow& each : segment.blows) {
    for (const int k : each.stops)
      if (!last_->touches[static_cast<std::size_t>(k)])
        refuse_(each.line, "stop " + name(k) + " is struck with a gap of " +
                               digits(-m_.stop(static_cast<std::size_t>(k)).sign * last_->X[p(k)].near()));
    blow(each, found);
    if (each.kind == Blow::Kind::chatter && &each != &segment.blows.back())
      refuse_(each.line, "a stop that has come to rest is struck again");
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!found[i])
      refuse_(segment.impacts[i].line, "no blow belongs to this impact at " + name(segment.impacts[i].stop) +
                                           " with w = " + digits(segment.impacts[i].w));
}

void Checker::blow(const Blow& blow, std::vector<bool>& found) {
  if (blow.kind == Blow::Kind::pile_up) return pile_up(blow);
  if (blow.kind == Blow::Kind::chatter) {
    last_->rests_from.clear();
    for (const int k : blow.stops) last_->rests_from.push_back(approach(k));
    return bring_to_rest(blow);
  }
  impact(blow, found);
}

/// One of its stops approaches; each that does is reported.
void Checker::report(const Blow& blow, std::vector<bool>& found) {
  bool certain = false, possible = false;
  long unsure = 0;
  for (const int k : blow.stops) {
    const Ball w = approach(k), allowed(speed_rounding(k));
    double& fastest = instant_.fastest[static_cast<std::size_t>(k)];
    fastest = std::max(fastest, w.near());
    certain = certain || w > Ball(0.0);
    possible = possible || !(w < -allowed);
    bool reported = false;
    for (std::size_t i = 0; i < found.size() && !reported; ++i) {
      const Impact& impact = last_->segment.impacts[i];
      if (found[i] || impact.stop != k || !(abs(w - Ball(impact.w)) <= allowed)) continue;
      reported = found[i] = true;
      ++tally_.impacts;
      if (!(impact.w > 0.0))
        refuse_(impact.line, "an impact at " + name(k) + " that does not approach");
      else if (!(w > Ball(0.0)))
        ++unsure;
    }
    if (!reported && w > allowed)
      refuse_(blow.line, "the impact at " + name(k) + " with w = " + digits(w.near()) + " is not listed");
  }
  if (!certain && !possible)
    refuse_(blow.line, "no stop of this blow approaches");
  else
    tally_.open.undecided += !certain && unsure == 0 ? 1 : unsure;
}

void Checker::impact(const Blow& blow, std::vector<bool>& found) {
  ++instant_.blows;
  report(blow, found);
  const Balls before = last_->X;
  Bodies bodies(m_.model().n);
  std::vector<int> forest;
  for (const int k : blow.stops)
    if (bodies.join(m_.model().numbers[p(k)].pair)) forest.push_back(k);
  bool lawful = strike(blow, forest);
  // Others of the sets of independent stops, where those that are hit depend on each other.
  const std::size_t n = blow.stops.size();
  for (std::size_t set = 1; !lawful && forest.size() < n && n <= most_dependent && set >> n == 0; ++set) {
    Bodies joined(m_.model().n);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < n; ++i)
      if ((set >> i & 1U) != 0 && joined.join(m_.model().numbers[p(blow.stops[i])].pair))
        chosen.push_back(blow.stops[i]);
    last_->X = before;
    lawful = strike(blow, chosen);
  }
  if (!lawful) refuse_(blow.line, "an impulse of this blow pulls");
  m_.model().in_sequence ? in_sequence(blow, before) : law(blow, before);
}

/// D P = (1 + r) v at these stops. @returns whether no impulse pulls
bool Checker::strike(const Blow& blow, const std::vector<int>& stops) {
  const Balls P = impulses(stops, false);
  if (P.size() != stops.size()) return refuse_(blow.line, "the inertia at the stops is singular"), true;
  bool pushes = true;
  for (std::size_t i = 0; i < stops.size(); ++i)
    pushes = pushes && P[i] >= -(Ball(4.0 * speed_rounding(stops[i])) / m_.inertia()[p(stops[i])][p(stops[i])]);
  apply(stops, P);
  return pushes;
}

/// v+ + r v <= 0 at all stops in contact: those that were not hit need no impulse.
void Checker::law(const Blow& blow, const Balls& before) {
  for (std::size_t k = 0; k < last_->touches.size(); ++k) {
    const int stop = static_cast<int>(k);
    if (!last_->touches[k]) continue;
    const Ball v = Ball(m_.stop(k).sign) * before[u(stop)];
    const double allowed = 2.0 * steepness(stop, v.near()) * speed_rounding(stop);
    if (!(approach(stop) + rebound(stop, v) <= Ball(allowed)))
      refuse_(blow.line, "Moreau's law: stop " + name(stop) + " touches, and gets no impulse that it needs");
  }
}

/// Newton's law at the first of the stops in contact that approaches.
void Checker::in_sequence(const Blow& blow, const Balls& before) {
  if (blow.stops.size() != 1) return refuse_(blow.line, "by the law of the model one stop is struck after the other");
  for (int k = 0; k < blow.stops.front(); ++k) {
    const Ball v = Ball(m_.stop(static_cast<std::size_t>(k)).sign) * before[u(k)];
    if (last_->touches[static_cast<std::size_t>(k)] && v > Ball(speed_rounding(k)))
      refuse_(blow.line, "stop " + name(k) + " approaches too, and comes first");
  }
}

/// D P = (1 + r) v, or D P = v to bring the stops to rest; empty where D is not certainly regular.
Balls Checker::impulses(const std::vector<int>& stops, bool to_rest) const {
  Matrix D, rates;
  for (const int i : stops) {
    const Place& a = m_.stop(static_cast<std::size_t>(i));
    D.emplace_back();
    for (const int j : stops) {
      const Place& b = m_.stop(static_cast<std::size_t>(j));
      D.back().push_back(Ball(a.sign * b.sign) * m_.inertia()[a.own][b.own]);
    }
    rates.push_back({to_rest ? approach(i) : approach(i) + rebound(i, approach(i))});
  }
  const auto solution = solve(std::move(D), std::move(rates));
  Balls P;
  for (std::size_t i = 0; solution && i < stops.size(); ++i) P.push_back((*solution)[i].front());
  return P;
}

/// What an impulse adds up from: its own size and, once for each stop, that of the roundings of the velocities that it
/// is made of; so that what many impulses at one instant are allowed does not grow with each. Balls would grow too:
/// their midpoints are gone on with, by a jump that is counted.
void Checker::apply(const std::vector<int>& stops, const Balls& P) {
  const std::vector<double> before = last_->size;
  std::vector<double> grown;
  for (const int k : stops) grown.push_back(steepness(k, approach(k).near()));
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Place& place = m_.stop(static_cast<std::size_t>(stops[i]));
    double off = 0.0;
    const bool again = last_->struck[static_cast<std::size_t>(stops[i])];
    const double speed =
        again ? 0.0 : grown[i] * before[m_.d() + place.own] / m_.inertia()[place.own][place.own].near();
    last_->struck[static_cast<std::size_t>(stops[i])] = true;
    for (std::size_t j = 0; j < m_.d(); ++j) {
      const Ball& inertia = m_.inertia()[j][place.own];
      last_->X[m_.d() + j] = (last_->X[m_.d() + j] - P[i] * Ball(place.sign) * inertia).middle(off);
      last_->size[m_.d() + j] += std::abs(inertia.near()) * (std::abs(P[i].near()) + speed);
    }
    jumps_.raise_by_impulse(place.own, P[i].near());
    jumps_.widen(place.own, off);
  }
}

void Checker::bring_to_rest(const Blow& blow) {
  Bodies bodies(m_.model().n);
  std::vector<int> forest;
  for (const int k : blow.stops)
    if (bodies.join(m_.model().numbers[p(k)].pair)) forest.push_back(k);
  const Balls P = impulses(forest, true);
  if (P.size() != forest.size()) return refuse_(blow.line, "the inertia at the stops is singular");
  apply(forest, P);
}

/// The fastest impact of this instant at these stops, or at those that impacts of this instant join to them: 0 if there
/// was none.
double Checker::fastest_near(const Blow& blow) const {
  std::vector<std::size_t> joined(blow.stops.begin(), blow.stops.end());
  double fastest = 0.0;
  for (std::size_t k = 0; k < joined.size(); ++k) {
    fastest = std::max(fastest, instant_.fastest[joined[k]]);
    for (std::size_t s = 0; s < instant_.fastest.size(); ++s) {
      const bool acts = instant_.fastest[s] > 0.0 && !m_.inertia()[m_.stop(joined[k]).own][m_.stop(s).own].is_zero();
      if (acts && std::find(joined.begin(), joined.end(), s) == joined.end()) joined.push_back(s);
    }
  }
  return fastest;
}

/// Only of stops that have become slow by impacts of this instant, of their own or of stops that act on them; or of
/// stops that have come to rest at this instant before and were disturbed. One of them would be struck again. That they
/// come to rest is an assumption.
void Checker::pile_up(const Blow& blow) {
  ++tally_.open.pile_ups;
  bool approaches = false;
  auto& rested = instant_.rested;
  const bool again = std::find(rested.begin(), rested.end(), blow.stops) != rested.end();
  if (!again) rested.push_back(blow.stops);
  for (const int k : blow.stops) {
    const Ball v = approach(k);
    const double fastest = fastest_near({blow.line, blow.kind, {k}});
    approaches = approaches || v > Ball(-speed_rounding(k));
    if (fastest == 0.0)
      refuse_(blow.line, "stop " + name(k) + " comes to rest, and no impact of the instant was at it or acts on it");
    else if (!again && instant_.blows < many_blows && !(abs(v) <= Ball(slow * fastest)))
      refuse_(blow.line, "stop " + name(k) + " with w = " + digits(v.near()) +
                             " is not slow beside the fastest impact of the instant, " + digits(fastest));
  }
  if (!approaches) refuse_(blow.line, "no stop of this pile-up approaches");
  bring_to_rest(blow);
}

}  // namespace verify
