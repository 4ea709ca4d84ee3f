/// Impulses at the end of a segment, and the impacts that are reported of them.
#include <algorithm>
#include <cmath>

#include "check.hpp"

namespace verify {
namespace {

constexpr double rounding = 0x1p-40;
constexpr double singular = 0x1p-40;  ///< pivots this small, in units of the diagonal, are rounding

/// A solution of D x = b, D symmetric and positive semidefinite. Where D is singular, some x are 0: M^-1 G^T x does not
/// depend on the choice.
Balls solve(std::vector<Balls> D, Balls b) {
  const std::size_t n = b.size();
  std::vector<double> diagonal(n);
  std::vector<bool> done(n);
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = D[i][i].near();
  Balls x(n);
  for (;;) {
    std::size_t k = n;
    double best = singular;
    for (std::size_t i = 0; i < n; ++i)
      if (!done[i] && D[i][i].near() / diagonal[i] > best) best = D[k = i][i].near() / diagonal[i];
    if (k == n) break;
    done[k] = true;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Ball factor = D[i][k] / D[k][k];
      for (std::size_t j = 0; j < n; ++j) D[i][j] = D[i][j] - factor * D[k][j];
      b[i] = b[i] - factor * b[k];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (done[i]) x[i] = b[i] / D[i][i];
  return x;
}

}  // namespace

void Checker::blows(Departure& departure) {
  const Segment& segment = departure.segment;
  tally_.events += static_cast<long>(segment.events.size());
  if (segment.end.kind == EndKind::cut && !(segment.blows.empty() && segment.events.empty()))
    refuse_(segment.end.line, "something happens at `end cut`");
  std::vector<bool> found(segment.events.size());
  for (const Blow& b : segment.blows) {
    report_of(departure, b, found);
    blow(departure, b);
  }
  for (std::size_t e = 0; e < found.size(); ++e) {
    const Event& event = segment.events[e];
    if (event.kind == "impact" && !found[e])
      refuse_(event.line, "no blow belongs to this impact at " + event.contact + " with w = " + digits(event.w));
  }
}

/// A stop that is approached when it is struck has an event that says so. What brings stops to rest stands for impacts
/// that nobody counts.
void Checker::report_of(const Departure& departure, const Blow& blow, std::vector<bool>& found) {
  if (blow.rest) return;
  for (const int k : blow.stops) {
    const Stop& stop = head_.stops[static_cast<std::size_t>(k)];
    const Ball w = Ball(stop.sign) * departure.X[u(stop)], allowed(rounding * departure.size[u(stop)]);
    bool reported = false;
    for (std::size_t e = 0; e < found.size() && !reported; ++e) {
      const Event& event = departure.segment.events[e];
      if (found[e] || event.kind != "impact" || event.contact != stop.name || !(abs(w - Ball(event.w)) <= allowed))
        continue;
      reported = found[e] = true;
      ++tally_.impacts;
    }
    if (!reported && w > allowed)
      refuse_(blow.line, "the impact at " + stop.name + " with w = " + digits(w.near()) + " has no event");
  }
}

void Checker::blow(Departure& departure, const Blow& blow) {
  const std::size_t n = blow.stops.size();
  std::vector<const Stop*> stops;
  for (const int k : blow.stops) stops.push_back(&head_.stops[static_cast<std::size_t>(k)]);
  std::vector<Balls> D(n, Balls(n));
  Balls b(n);
  std::vector<double> speed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Stop& stop = *stops[i];
    const double gap = rounding * departure.size[p(stop)];
    if (!(abs(departure.X[p(stop)]) <= Ball(gap)))
      refuse_(blow.line,
              "stop " + stop.name + " is struck with a gap of " + digits(-stop.sign * departure.X[p(stop)].near()));
    b[i] = (blow.rest ? Ball(1.0) : Ball(1.0) + Ball(stop.restitution)) * Ball(stop.sign) * departure.X[u(stop)];
    for (std::size_t j = 0; j < n; ++j)
      D[i][j] = Ball(stop.sign * stops[j]->sign * head_.inertia[p(stop)][p(*stops[j])]);
    if (!(D[i][i] > Ball(0.0))) return refuse_(blow.line, "stop " + stop.name + " has no inertia");
    speed[i] = 2.0 * departure.size[u(stop)] / D[i][i].near();
  }
  departure.rests_from = Ball(stops.front()->sign) * departure.X[u(*stops.front())];
  const Balls impulse = solve(D, b);
  for (std::size_t i = 0; i < static_cast<std::size_t>(head_.d); ++i) {
    const std::size_t row = static_cast<std::size_t>(head_.d) + i;
    for (std::size_t j = 0; j < n; ++j) {
      const double inertia = head_.inertia[i][p(*stops[j])];
      departure.X[row] = departure.X[row] - impulse[j] * Ball(stops[j]->sign * inertia);
      departure.size[row] += std::abs(inertia) * (std::abs(impulse[j].near()) + speed[j]);
    }
  }
}

}  // namespace verify
