/// Checks the rules that lead from segment to segment.
#include "check.hpp"

#include <algorithm>
#include <cmath>

#include "tail.hpp"

namespace verify {
namespace {

constexpr double rounding = 0x1p-40;   ///< of a state, in units of the sizes of what it was added up from
constexpr double dependent = 0x1p-40;  ///< what is left of its inertia when others are held, in units of it
constexpr double clock_rounding = 0x1p-48, flight_rounding = 0x1p-50, phase_rounding = 0x1p-46;

/// Not below the exact difference that x is the rounding of; exact where nothing was lost.
double rounded_up(double x) { return x == 0.0 ? 0.0 : std::nextafter(x, INFINITY); }

/// Is displacement k a combination of the others? Then holding all of them holds it: nothing is left of its inertia.
bool is_combination(std::vector<std::vector<double>> V, std::size_t k) {
  const std::vector<std::vector<double>> whole = V;
  std::vector<bool> held(V.size());
  for (;;) {
    std::size_t pivot = k;
    double best = dependent;
    for (std::size_t i = 0; i < V.size(); ++i)
      if (i != k && !held[i] && V[i][i] > best * whole[i][i]) best = V[pivot = i][i] / whole[i][i];
    if (pivot == k) return V[k][k] <= dependent * whole[k][k];
    held[pivot] = true;
    for (std::size_t i = 0; i < V.size(); ++i) {
      if (held[i]) continue;
      const double factor = V[i][pivot] / V[pivot][pivot];
      for (std::size_t j = 0; j < V.size(); ++j) V[i][j] -= factor * V[pivot][j];
    }
  }
}

}  // namespace

Checker::Checker(const Head& head, const std::map<long, Mode>& modes, const Refuse& refuse)
    : head_(head), modes_(modes), refuse_([this, refuse](long line, const std::string& what) {
        refuse(line, "segment " + std::to_string(tally_.segments) + ", " + what);
      }) {
  for (std::size_t k = 0; k < head.inertia.size(); ++k) follows_.push_back(is_combination(head.inertia, k));
}

void Checker::segment(const Segment& segment) {
  start(segment);
  Flight flight(flow(segment.mode), modes_.at(segment.mode), segment, head_.period, tally_, refuse_);
  flight.fly();
  auto departure = std::make_unique<Departure>(Departure{segment, std::move(flight.X), std::move(flight.size)});
  blur(*departure, flow(segment.mode));
  if (segment.end.kind == EndKind::chatter) chatter(segment, departure->size);
  last_ = std::move(departure);
  blows(*last_);
  ++tally_.segments;
}

const Flow& Checker::flow(long mode) {
  std::unique_ptr<Flow>& flow = flows_[mode];
  if (!flow) {
    mode_is_mechanical(modes_.at(mode));
    flow = std::make_unique<Flow>(modes_.at(mode), head_);
  }
  return *flow;
}

/// p' = u (+ the speed of a belt, but not under a stop), phases that turn j times per period, a constant that stays.
void Checker::mode_is_mechanical(const Mode& mode) {
  const auto fault = [&](std::size_t row, const char* what) {
    refuse_(mode.line, "row " + std::to_string(row) + " of its mode: " + what);
  };
  const auto d = static_cast<std::size_t>(head_.d), one = static_cast<std::size_t>(head_.m - 1);
  for (std::size_t i = 0; i < d; ++i) {
    Entries row = mode.rows[i];
    const bool under_stop =
        std::any_of(head_.stops.begin(), head_.stops.end(), [&](const Stop& s) { return p(s) == i; });
    if (!under_stop && row.size() == 2 && row[1].first == head_.m - 1) row.pop_back();
    if (row != Entries{{static_cast<int>(d + i), 1.0}}) fault(i, "a displacement's rate is not its velocity");
  }
  for (std::size_t i = 2 * d; i < one; i += 2) {
    const Entries &c = mode.rows[i], &s = mode.rows[i + 1];
    const bool turns = c.size() == 1 && s.size() == 1 && c[0].first == static_cast<int>(i + 1) &&
                       s[0].first == static_cast<int>(i) && c[0].second == -s[0].second;
    const double j = turns ? harmonic(mode, i).near() : 0.0;
    if (!(j > 0.5 && abs(harmonic(mode, i) - Ball(std::nearbyint(j))) <= Ball(0x1p-45 * j)))
      fault(i, "phases do not turn a whole number of times in a period");
  }
  if (!mode.rows[one].empty()) fault(one, "the constant does not stay");
}

/// How often the phases at i, i + 1 turn in a period.
Ball Checker::harmonic(const Mode& mode, std::size_t i) const {
  return mode.rows[i + 1].empty() ? Ball(0.0)
                                  : Ball(mode.rows[i + 1][0].second) * Ball(head_.period) / times(Ball::pi(), 2);
}

void Checker::start(const Segment& segment) {
  const Mode& mode = modes_.at(segment.mode);
  if (segment.number != tally_.segments) refuse_(segment.line, "it is called number " + std::to_string(segment.number));
  phases(segment, mode);
  stops(segment, mode);
  if (last_ == nullptr) return;
  clock(segment);
  continuity(segment);
  if (last_->segment.end.kind == EndKind::cut && last_->segment.mode != segment.mode)
    refuse_(segment.line, "the mode has changed at `end cut`");
}

void Checker::phases(const Segment& segment, const Mode& mode) {
  for (std::size_t i = 2 * static_cast<std::size_t>(head_.d); i + 1 < segment.state.size(); i += 2) {
    Ball c, s;
    cos_sin_pi(c, s, Ball(2.0 * std::nearbyint(harmonic(mode, i).near())) * Ball(segment.fraction));
    if (!(abs(c - Ball(segment.state[i])) <= Ball(phase_rounding) &&
          abs(s - Ball(segment.state[i + 1])) <= Ball(phase_rounding)))
      refuse_(segment.line, "the phases at " + std::to_string(i) + " are not those of the clock: they are " +
                                digits(c.near()) + ", " + digits(s.near()));
  }
  if (segment.state.back() != 1.0) refuse_(segment.line, "the last number of the state is not 1");
}

void Checker::clock(const Segment& segment) {
  const Segment& before = last_->segment;
  const Ball flown = Ball(before.duration) / Ball(head_.period);
  const Ball shown =
      Ball(static_cast<double>(segment.period - before.period)) + Ball(segment.fraction) - Ball(before.fraction);
  if (!(abs(shown - flown) <= Ball(clock_rounding) + Ball(flight_rounding) * flown))
    refuse_(segment.line, "begins " + digits((shown - flown).near()) + " periods from where the one before has ended");
}

/// The instant of the end is known to a rounding of the clock, and a number of the state to its rate times that: so
/// much its size is more.
void Checker::blur(Departure& end, const Flow& flow) const {
  const double instant = clock_rounding * head_.period + flight_rounding * end.segment.duration;
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(head_.d); ++i)
    end.size[i] += instant / rounding * std::abs(dot(flow.A[i], end.X).near());
}

void Checker::continuity(const Segment& segment) {
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(head_.d); ++i) {
    const Ball jump = abs(Ball(segment.state[i]) - last_->X[i]);
    const double allowed = rounding * (last_->size[i] + size_of_others(i));
    if (jump.near() > 0.0) tally_.jump = std::max(tally_.jump, jump.near() / allowed);
    if (!(jump <= Ball(allowed)))
      refuse_(segment.line, "number " + std::to_string(i) + " of the state is " + digits(segment.state[i]) +
                                ", it must be " + digits(last_->X[i].near()) + " to " + digits(allowed));
  }
}

/// What a number that follows from others is made of: all such numbers of its kind.
double Checker::size_of_others(std::size_t i) const {
  const std::size_t d = follows_.size(), block = i - i % d;
  double sum = 0.0;
  for (std::size_t j = 0; j < d && follows_[i - block]; ++j)
    if (follows_[j]) sum += last_->size[block + j];
  return sum;
}

/// The most that the velocity towards a stop can be, or infinity: it is constant, or a slip guard v u_i > 0 keeps it
/// below a constant, because u_own -+ u_i does not change.
double Checker::fastest_approach(const Stop& stop, const Segment& segment, const Mode& mode) const {
  const double own = stop.sign * segment.state[u(stop)];
  double least = mode.rows[u(stop)].empty() ? own : INFINITY;
  for (const Guard& guard : mode.guards) {
    if (guard.kind != "slip" || guard.row.size() != 1 || guard.row[0].first < head_.d) continue;
    const auto i = static_cast<std::size_t>(guard.row[0].first);
    const double turn =
        guard.row[0].second * stop.sign > 0.0 ? -1.0 : 1.0;  // turn u_i leads away while the guard lasts
    Entries rate = mode.rows[i];
    for (auto& entry : rate) entry.second *= turn;
    if (rate == mode.rows[u(stop)]) least = std::min(least, rounded_up(own - stop.sign * turn * segment.state[i]));
  }
  return least;
}

/// A stop that no guard watches is open or just closed, and cannot close further.
void Checker::stops(const Segment& segment, const Mode& mode) {
  double largest = 0.0;
  for (int i = 0; i < head_.d; ++i) largest = std::max(largest, std::abs(segment.state[static_cast<std::size_t>(i)]));
  for (const Stop& stop : head_.stops) {
    const bool watched = std::any_of(mode.guards.begin(), mode.guards.end(), [&](const Guard& guard) {
      return guard.kind == "gap" && guard.row.size() == 1 && guard.row[0].first == stop.own &&
             guard.row[0].second * stop.sign < 0.0;
    });
    if (watched) continue;
    const double gap = -stop.sign * segment.state[p(stop)], approach = fastest_approach(stop, segment, mode);
    if (!(approach <= 0.0 || Ball(approach) * Ball(segment.duration) <= Ball(gap)))
      refuse_(segment.line, "stop " + stop.name + " may close: no guard watches it");
    if (!(gap >= -rounding * largest))
      refuse_(segment.line, "stop " + stop.name + " is passed, its gap is " + digits(gap));
  }
}

/// A segment on the closed stop that stands for infinitely many impacts.
void Checker::chatter(const Segment& segment, const std::vector<double>& sizes) {
  const End& end = segment.end;
  const Tail& tail = segment.tail;
  const Stop& stop = head_.stops[static_cast<std::size_t>(end.index)];
  ++tally_.chatters;
  if (last_ == nullptr || last_->segment.blows.empty() || !last_->segment.blows.back().rest ||
      last_->segment.blows.back().stops != std::vector<int>{end.index})
    return refuse_(end.line, "the segment before has not brought stop " + stop.name + " to rest");
  if (!modes_.at(segment.mode).rows[u(stop)].empty() || segment.state[u(stop)] != 0.0 || segment.state[p(stop)] != 0.0)
    return refuse_(end.line, "stop " + stop.name + " is not at rest in the segment that stands for its chatter");
  if (!(end.size <= 0x1p-49 * head_.period))
    refuse_(end.line, "ERROR = " + digits(end.size) + " is more than 2^-49 periods");
  Limit limit(head_, segment, flow(tail.rise), flow(tail.back), flow(segment.mode), Ball(0.0) - last_->rests_from,
              refuse_);
  limit.check(sizes);
  const bool up = limit.guards(modes_.at(tail.rise), flow(tail.rise), true);
  const bool down = limit.guards(modes_.at(tail.back), flow(tail.back), false);
  if (tail.rise == tail.back) return;
  if (!up || !down) refuse_(tail.line, "a mode of the tail is for both directions");
  limit.holds_not(modes_.at(tail.hold), flow(tail.hold));
}

}  // namespace verify
