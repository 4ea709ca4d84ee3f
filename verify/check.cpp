/// Checks the rules that lead from segment to segment.
#include "check.hpp"

#include <algorithm>
#include <cmath>

#include "bodies.hpp"

namespace verify {
namespace {

constexpr double clock_rounding = 0x1p-48, flight_rounding = 0x1p-50;
constexpr double start_of_run = 0x1p-48;  ///< of W q - shift, in units of its terms
constexpr double most_in_sum = 0x1p-24;   ///< all jumps of a run together, in units of the greatest number

}  // namespace

Checker::Checker(const Model& model, const Start& start, const Refuse& refuse)
    : m_(model, start.line),
      refuse_([this, refuse](long line, const std::string& what) {
        refuse(line, "segment " + std::to_string(tally_.segments) + ", " + what);
      }),
      start_(start),
      period_(m_.period().near()) {
  for (std::size_t i = 0; i < m_.d(); ++i) {
    Bodies bodies(model.n);
    for (std::size_t j = 0; j < m_.d(); ++j)
      if (j != i) bodies.join(model.numbers[j].pair);
    follows_.push_back(bodies.joined(model.numbers[i].pair));
  }
}

const FlownMode& Checker::flown(const ContactStates& states) {
  std::unique_ptr<FlownMode>& mode = flown_[states];
  if (!mode) mode = std::make_unique<FlownMode>(m_, m_.mode(states));
  return *mode;
}

void Checker::segment(const Segment& segment) {
  begin(segment);
  const FlownMode& mode = flown(segment.states);
  Flight flight(mode, segment, m_.extended(segment.p, segment.u, segment.start.fraction), period_, tally_.flight,
                refuse_);
  flight.fly();
  ends(segment, flight, mode);
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    Jumps& jumps = i < m_.d() ? tally_.displacement : tally_.velocity;
    jumps.scale = std::max(jumps.scale, flight.greatest[i]);
  }
  auto departure = std::make_unique<Departure>(Departure{segment, std::move(flight.X), std::move(flight.size)});
  blur(*departure, mode.flow);
  if (segment.end == EndKind::chatter) chatter(segment, departure->size);
  last_ = std::move(departure);
  ++tally_.segments;
}

void Checker::begin(const Segment& segment) {
  if (last_ == nullptr) {
    const Balls X = m_.contact_numbers(start_.q, start_.v);
    const double scale = [&] {
      double most = 0.0;
      for (const Number& number : m_.model().numbers) most = std::max({most, std::abs(number.shift), std::abs(number.drift)});
      for (const double x : start_.q) most = std::max(most, std::abs(x));
      for (const double x : start_.v) most = std::max(most, std::abs(x));
      return most;
    }();
    for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
      const double stated = i < m_.d() ? segment.p[i] : segment.u[i - m_.d()];
      jump(segment.line, i, X[i] - Ball(stated), start_of_run * scale);
    }
    if (segment.start.period != start_.at.period || segment.start.fraction != start_.at.fraction)
      refuse_(segment.line, "the run does not begin at its start");
  } else {
    cut_ = last_->segment.end == EndKind::cut;
    if (!last_->segment.blows.empty() && last_->segment.blows.back().kind == Blow::Kind::chatter &&
        segment.chatter != last_->segment.blows.back().stops.front())
      refuse_(last_->segment.blows.back().line, "a stop is brought to rest by a chatter that nothing proves");
    if (cut_ && last_->segment.states != segment.states) refuse_(segment.line, "the mode has changed at `end cut`");
    arrive(segment.line, segment.start, segment.p, segment.u);
  }
  dependence(segment.line, m_.extended(segment.p, segment.u, 0.0), last_ ? last_->size : std::vector<double>());
  rest(segment);
  if (segment.duration > 0.0 && !cut_) choice(segment);
}

void Checker::done(const Done& done) {
  if (last_ == nullptr) return refuse_(done.line, "there is no segment");
  arrive(done.line, done.at, done.p, done.u);
  if (!last_->segment.blows.empty() && last_->segment.blows.back().kind == Blow::Kind::chatter)
    refuse_(done.line, "the run ends before the limit of a chatter");
  for (const Jumps* jumps : {&tally_.displacement, &tally_.velocity})
    if (!(jumps->relative(jumps->sum) <= most_in_sum))
      refuse_(done.line, "all jumps together are " + digits(jumps->relative(jumps->sum)) +
                             " of the greatest number, more than 2^-24");
}

/// What happens at the end of the segment before leads to this state.
void Checker::arrive(long line, const Clock& at, const std::vector<double>& p, const std::vector<double>& u) {
  clock(line, at);
  land(p);
  blows();
  continuity(line, p, u);
}

void Checker::clock(long line, const Clock& at) {
  const Segment& before = last_->segment;
  const Ball flown = Ball(before.duration) / m_.period();
  const Ball shown = Ball(static_cast<double>(at.period - before.start.period)) + Ball(at.fraction) -
                     Ball(before.start.fraction);
  const Ball off = abs(shown - flown);
  tally_.clock = std::max(tally_.clock, off.near());
  if (!(off <= Ball(clock_rounding) + Ball(flight_rounding) * flown))
    refuse_(line, "begins " + digits((shown - flown).near()) + " periods from where the one before has ended");
}

/// Stops whose gap is exactly zero in the state that follows touch.
void Checker::land(const std::vector<double>& next) {
  for (std::size_t k = 0; k < m_.model().stops.size(); ++k) {
    const int stop = static_cast<int>(k);
    const bool near = abs(last_->X[p(stop)]) <= Ball(rounding * (last_->size[p(stop)] + size_of_others(p(stop))));
    last_->touches.push_back(near && next[p(stop)] == 0.0);
    last_->struck.push_back(false);
  }
}

/// The instant of the end is known to a rounding of the clock, and a number of the state to its rate times that: so
/// much its size is more.
void Checker::blur(Departure& end, const Flow& flow) const {
  const double length = clock_rounding * period_ + flight_rounding * end.segment.duration;
  const Balls rate = flow.rate(end.X);
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) end.size[i] += length / rounding * std::abs(rate[i].near());
}

void Checker::jump(long line, std::size_t i, const Ball& by, double allowed) {
  const double size = abs(by).highest();
  Jumps& jumps = i < m_.d() ? tally_.displacement : tally_.velocity;
  jumps.largest = std::max(jumps.largest, size);
  jumps.sum += size;
  if (size > 0.0) tally_.of_allowed = std::max(tally_.of_allowed, size / allowed);
  if (!(size <= allowed))
    refuse_(line, "number " + std::to_string(i) + " of the state is " + digits(by.near()) +
                      " from where it must be, rounding explains " + digits(allowed));
}

void Checker::continuity(long line, const std::vector<double>& p, const std::vector<double>& u) {
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const double stated = i < m_.d() ? p[i] : u[i - m_.d()];
    jump(line, i, Ball(stated) - last_->X[i], rounding * (last_->size[i] + size_of_others(i)));
  }
}

/// Numbers that are combinations of others agree with them.
void Checker::dependence(long line, const Balls& X, const std::vector<double>& size) {
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const std::size_t k = i % m_.d(), block = i - k;
    if (k < m_.n()) continue;
    const auto offset = [&](std::size_t j) {
      const Number& number = m_.model().numbers[j];
      return Ball(block == 0 ? number.shift : number.drift);
    };
    Ball sum = -(X[i] + offset(k));
    double allowed = std::abs(X[i].near()) + std::abs(offset(k).near()) + (size.empty() ? 0.0 : size[i]);
    for (std::size_t j = 0; j < m_.n(); ++j) {
      const Ball& c = m_.dependence()[k][j];
      sum.add_product(c, X[block + j] + offset(j));
      const double part = std::abs(X[block + j].near()) + std::abs(offset(j).near()) + (size.empty() ? 0.0 : size[block + j]);
      allowed += std::abs(c.near()) * part;
    }
    if (!(abs(sum) <= Ball(rounding * allowed)))
      refuse_(line, "number " + std::to_string(i) + " of the state is " + digits(sum.near()) +
                        " from what it follows from, rounding explains " + digits(rounding * allowed));
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

/// A closed stop and a sticking contact are at rest, exactly.
void Checker::rest(const Segment& segment) {
  for (std::size_t k = 0; k < segment.states.closed.size(); ++k) {
    const std::size_t own = m_.stop(k).own;
    if (segment.states.closed[k] && (segment.p[own] != 0.0 || segment.u[own] != 0.0))
      refuse_(segment.line, "stop " + m_.model().stops[k].name + " is not at rest where it is called closed");
  }
  for (std::size_t k = 0; k < segment.states.slip.size(); ++k)
    if (segment.states.slip[k] == 0 && segment.u[m_.friction(k).own] != 0.0)
      refuse_(segment.line,
              "friction contact " + m_.model().frictions[k].name + " is not at rest where it is said to stick");
}

/// An event is the zero of a condition. Whether it is one, or a touch, is asked behind the end.
void Checker::ends(const Segment& segment, const Flight& flight, const FlownMode& mode) {
  if (segment.end == EndKind::cut) {
    if (!segment.blows.empty()) refuse_(segment.end_line, "something happens at `end cut`");
    return;
  }
  if (segment.end != EndKind::event) return;
  ++tally_.events;
  if (flight.zeros.empty()) {
    if (!flight.failed()) refuse_(segment.end_line, "nothing ends the segment: no condition of its mode is zero");
    return;
  }
  if (segment.duration == 0.0) return;
  for (double ahead = 0x1p-50; ahead <= instant; ahead *= 2.0) {
    const Ball t(ahead * period_);
    const Expansion behind(mode.flow, flight.X, t);
    for (const std::size_t i : flight.zeros)
      if (behind.of(mode.flow.rows[i]).value(0, t) < Ball(0.0)) return;
  }
  ++tally_.flight.touches;
}

/// The states of the closed segment, but the stop open and friction on its own pair slipping: 1 away from the stop, -1
/// back, 0 held.
ContactStates Checker::with_pair(const Segment& segment, int direction) const {
  ContactStates states = segment.states;
  const auto stop = static_cast<std::size_t>(segment.chatter);
  const Place& place = m_.stop(stop);
  states.closed[stop] = false;
  for (std::size_t i = 0; i < states.slip.size(); ++i) {
    const Place& friction = m_.friction(i);
    const double same = m_.parallel(friction.own, place.own) * place.sign * friction.sign;
    if (same != 0.0 && m_.model().numbers[friction.own].drift == 0.0)
      states.slip[i] = same > 0.0 ? -direction : direction;
  }
  return states;
}

/// A segment on the closed stop that stands for infinitely many impacts.
void Checker::chatter(const Segment& segment, const std::vector<double>& sizes) {
  ++tally_.chatters;
  const auto stop = static_cast<std::size_t>(segment.chatter);
  const std::vector<int> itself{segment.chatter};
  if (last_ == nullptr || last_->segment.blows.empty() || last_->segment.blows.back().kind != Blow::Kind::chatter ||
      last_->segment.blows.back().stops != itself)
    return refuse_(segment.end_line, "the segment before has not brought stop " + name(segment.chatter) + " to rest");
  if (!flown(segment.states).mode.held[m_.stop(stop).own] || segment.u[m_.stop(stop).own] != 0.0 ||
      segment.p[m_.stop(stop).own] != 0.0)
    return refuse_(segment.end_line, "stop " + name(segment.chatter) + " is not at rest at the limit of its chatter");
  const Limit::Modes modes{flown(with_pair(segment, 1)), flown(with_pair(segment, -1)), flown(with_pair(segment, 0)),
                           flown(segment.states)};
  Limit limit(m_, segment, modes, m_.extended(segment.p, segment.u, segment.start.fraction), -last_->rests_from,
              refuse_);
  tally_.limit_error = std::max(tally_.limit_error, limit.check(sizes) / period_);
}

}  // namespace verify
