/// Checks the rules that lead from segment to segment.
#include "check.hpp"

#include <algorithm>
#include <cmath>

namespace verify {
namespace {

/// Of the clock: that of a stored fraction, in periods; of an instant, in radians of the fastest motion of its mode (no
/// more than this many periods); of a flight. A model that nothing drives has no period: its 1 may be long beside its
/// motion.
constexpr double stored_clock = 0x1p-51, clock_rounding = 0x1p-48, flight_rounding = 0x1p-50;
constexpr double start_of_run = 0x1p-48;  ///< of W q - shift, in units of its terms
/// all jumps of the clock together, in such radians, apart from what each stored fraction is
constexpr double most_of_clock = 0x1p-24;
constexpr double most_behind = 0x1p-10;  ///< radians behind an event in which its condition has fallen

}  // namespace

Checker::Checker(const Model& model, const Start& start, const Refuse& refuse)
    : m_(model, start.line),
      refuse_([this, refuse](long line, const std::string& what) {
        refuse(line, "segment " + std::to_string(tally_.segments) + ", " + what);
      }),
      start_(start),
      period_(m_.period().near()),
      jumps_(m_) {}

const FlownMode& Checker::flown(const ContactStates& states) {
  std::unique_ptr<FlownMode>& mode = flown_[states];
  if (!mode) mode = std::make_unique<FlownMode>(m_, m_.mode(states));
  return *mode;
}

void Checker::segment(const Segment& segment) {
  begin(segment);
  const FlownMode& mode = flown(segment.states);
  fastest_ = std::max(fastest_, mode.flow.nu);
  Flight flight(mode, segment, m_.extended(segment.p, segment.u, segment.start), period_, tally_.flight, refuse_);
  flight.fly();
  ends(segment, flight, mode);
  jumps_.raise(flight.coordinates, flight.size);
  auto departure = std::make_unique<Departure>(Departure{segment, std::move(flight.X), std::move(flight.size)});
  blur(*departure, mode.flow);
  if (segment.end == EndKind::chatter) chatter(segment, departure->size);
  last_ = std::move(departure);
  ++tally_.segments;
}

void Checker::begin(const Segment& segment) {
  if (last_ == nullptr) {
    start(segment);
  } else {
    cut_ = last_->segment.end == EndKind::cut;
    if (!last_->segment.blows.empty() && last_->segment.blows.back().kind == Blow::Kind::chatter &&
        segment.chatter != last_->segment.blows.back().stops)
      refuse_(last_->segment.blows.back().line, "a stop is brought to rest by a chatter that nothing proves");
    const bool same_mode = last_->segment.states == segment.states;
    if (cut_ && !same_mode) refuse_(segment.line, "the mode has changed at `end cut`");
    if (!cut_ && same_mode && last_->segment.duration == 0.0 && last_->segment.blows.empty())
      refuse_(segment.line, "an event that lasts no time has changed nothing");
    arrive(segment.line, segment.start, segment.p, segment.u);
    unanswered(segment);
  }
  dependence(segment.line, m_.extended(segment.p, segment.u, {}), last_ ? last_->size : std::vector<double>());
  rest(segment);
  choice_due_ = choice_due_ || !cut_;
  if (segment.duration > 0.0 && choice_due_) choice(segment);
  choice_due_ = choice_due_ && segment.duration == 0.0;
}

void Checker::start(const Segment& segment) {
  const Balls X = m_.contact_numbers(start_.q, start_.v);
  const auto size = [&](std::size_t i) {
    const Number& number = m_.model().numbers[i % m_.d()];
    const std::vector<double>& x = i < m_.d() ? start_.q : start_.v;
    double sum = std::abs(i < m_.d() ? number.shift : number.drift);
    for (const int body : {number.pair.a, number.pair.b})
      if (body != ground) sum += std::abs(x[static_cast<std::size_t>(body)]);
    return sum;
  };
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const double stated = i < m_.d() ? segment.p[i] : segment.u[i - m_.d()];
    double loop = 0.0;
    for (const std::size_t j : m_.loop(i % m_.d(), i >= m_.d())) loop += size(j + (i < m_.d() ? 0 : m_.d()));
    jump(segment.line, i, X[i] - Ball(stated), start_of_run * loop);
  }
  coordinates_jump(segment.p, segment.u, X);
  if (segment.start.period != start_.at.period || segment.start.fraction != start_.at.fraction)
    refuse_(segment.line, "the run does not begin at its start");
}

void Checker::done(const Done& done) {
  if (last_ == nullptr) return refuse_(done.line, "there is no segment");
  arrive(done.line, done.at, done.p, done.u);
  if (!last_->segment.blows.empty() && last_->segment.blows.back().kind == Blow::Kind::chatter)
    refuse_(done.line, "the run ends before the limit of a chatter");
  dependence(done.line, m_.extended(done.p, done.u, {}), last_->size);
  tally_.open.still = jumps_.check(done.line, refuse_);
  tally_.displacement = {jumps_.largest(false), jumps_.sum(false)};
  tally_.velocity = {jumps_.largest(true), jumps_.sum(true)};
  const double most =
      most_of_clock * std::min(1.0, 1.0 / (fastest_ * period_)) + stored_clock * static_cast<double>(tally_.segments);
  if (!(tally_.clock.sum <= most))
    refuse_(done.line, "all jumps of the clock together are " + digits(tally_.clock.sum) +
                           " periods, rounding explains " + digits(most));
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
  const Ball shown =
      Ball(static_cast<double>(at.period - before.start.period)) + Ball(at.fraction) - Ball(before.start.fraction);
  const Ball off = abs(shown - flown);
  tally_.clock.largest = std::max(tally_.clock.largest, off.highest());
  tally_.clock.sum += off.highest();
  if (before.duration == 0.0 && (at.period != before.start.period || at.fraction != before.start.fraction))
    return refuse_(line, "the clock has moved in a segment that lasts no time");
  if (!(off <= Ball(clock_allowance(before) / period_)))
    refuse_(line, "begins " + digits((shown - flown).near()) + " periods from where the one before has ended");
}

/// Stops whose gap is exactly zero in the state that follows touch. One that is no more than rounding, and not called
/// zero, may touch too: a closed stop does.
void Checker::land(const std::vector<double>& next) {
  const Segment& before = last_->segment;
  for (std::size_t k = 0; k < m_.model().stops.size(); ++k) {
    const int stop = static_cast<int>(k);
    const bool near = abs(last_->X[p(stop)]) <= Ball(allowance(p(stop)));
    last_->touches.push_back(near && next[p(stop)] == 0.0);
    last_->struck.push_back(false);
    if (!near || next[p(stop)] == 0.0) continue;
    if (before.states.closed[k])
      refuse_(before.end_line, "stop " + name(stop) + " was closed, and does not touch in the state that follows");
    else if (!before.blows.empty() && !(Ball(-m_.stop(k).sign) * last_->X[p(stop)] > Ball(0.0)))
      ++tally_.open.undecided;
  }
}

/// By how much, in time, the next segment may begin from where this one ends.
double Checker::clock_allowance(const Segment& segment) {
  const double radian = 1.0 / flown(segment.states).flow.nu;
  return stored_clock * period_ + clock_rounding * std::min(period_, radian) + flight_rounding * segment.duration;
}

/// The instant of the end is known to a rounding of the clock, and a number of the state to its rate times that: so
/// much its size is more.
void Checker::blur(Departure& end, const Flow& flow) {
  const double length = clock_allowance(end.segment);
  const Balls rate = flow.rate(end.X);
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) end.size[i] += length / rounding * std::abs(rate[i].near());
}

void Checker::jump(long line, std::size_t i, const Ball& by, double allowed) {
  const double size = abs(by).highest();
  if (size > 0.0) tally_.of_allowed = std::max(tally_.of_allowed, size / allowed);
  if (!(size <= allowed))
    refuse_(line, "number " + std::to_string(i) + " of the state is " + digits(by.near()) +
                      " from where it must be, rounding explains " + digits(allowed));
}

void Checker::continuity(long line, const std::vector<double>& p, const std::vector<double>& u) {
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const double stated = i < m_.d() ? p[i] : u[i - m_.d()];
    jump(line, i, Ball(stated) - last_->X[i], allowance(i));
  }
  coordinates_jump(p, u, last_->X);
}

void Checker::coordinates_jump(const std::vector<double>& p, const std::vector<double>& u, const Balls& X) {
  Balls by_p, by_u;
  for (const std::size_t i : m_.basis(false)) by_p.push_back(Ball(p[i]) - X[i]);
  for (const std::size_t i : m_.basis(true)) by_u.push_back(Ball(u[i]) - X[m_.d() + i]);
  jumps_.add(by_p, by_u);
}

/// Numbers that are combinations of others agree with them.
void Checker::dependence(long line, const Balls& X, const std::vector<double>& size) {
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const std::size_t k = i % m_.d(), block = i - k;
    const bool velocity = block > 0;
    if (m_.in_basis(k, velocity)) continue;
    const auto offset = [&](std::size_t j) {
      const Number& number = m_.model().numbers[j];
      return Ball(block == 0 ? number.shift : number.drift);
    };
    Ball sum = -(X[i] + offset(k));
    double allowed = std::abs(X[i].near()) + std::abs(offset(k).near()) + (size.empty() ? 0.0 : size[i]);
    for (std::size_t l = 0; l < m_.n(); ++l) {
      const std::size_t j = m_.basis(velocity)[l];
      const Ball& c = m_.dependence(velocity)[k][l];
      sum.add_product(c, X[block + j] + offset(j));
      const double part =
          std::abs(X[block + j].near()) + std::abs(offset(j).near()) + (size.empty() ? 0.0 : size[block + j]);
      allowed += std::abs(c.near()) * part;
    }
    if (!(abs(sum) <= Ball(rounding * allowed)))
      refuse_(line, "number " + std::to_string(i) + " of the state is " + digits(sum.near()) +
                        " from what it follows from, rounding explains " + digits(rounding * allowed));
  }
}

/// What a number is made of: numbers that follow from each other have to agree, and those of the basis do not give way
/// to others.
double Checker::size_of_loop(std::size_t i) const {
  const std::size_t block = i < m_.d() ? 0 : m_.d();
  double sum = 0.0;
  for (const std::size_t j : m_.loop(i - block, block > 0)) sum += last_->size[block + j];
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

/// An event is the zero of a condition. Whether it is one, or a touch, is asked behind the end: of every condition that
/// is zero there, however the segment ends. What lasts no time is no event by itself, and its mode none that was there.
void Checker::ends(const Segment& segment, const Flight& flight, const FlownMode& mode) {
  fallen_.clear();
  const bool event = segment.end == EndKind::event;
  if (segment.end == EndKind::cut && !segment.blows.empty())
    refuse_(segment.end_line, "something happens at `end cut`");
  if (event && (segment.duration > 0.0 || !segment.blows.empty())) ++tally_.events;
  if (event && flight.zeros.empty() && !flight.failed())
    refuse_(segment.end_line, "nothing ends the segment: no condition of its mode is zero");
  if (!event && segment.duration == 0.0) return;
  std::vector<std::size_t> open = flight.zeros;
  const double farthest = std::min(instant * period_, most_behind / mode.flow.nu);
  for (double ahead = 0x1p-20 * farthest; event && ahead <= farthest && !open.empty(); ahead *= 2.0) {
    const Ball t(ahead);
    const Expansion behind(mode.flow, flight.X, t);
    const auto falls = [&](std::size_t i) { return behind.of(mode.flow.rows[i]).value(0, t) < Ball(0.0); };
    std::copy_if(open.begin(), open.end(), std::back_inserter(fallen_), falls);
    open.erase(std::remove_if(open.begin(), open.end(), falls), open.end());
  }
  const Balls rate = mode.flow.rate(flight.X);
  const auto leaves = [&](std::size_t i) {  // the condition has come from zero, and is on its way
    const Balls& row = mode.flow.rows[i];
    const bool positive = segment.duration == 0.0 || dot(row, flight.X) > Ball(0.0);
    return positive && !flight.in_band(i) && dot(row, rate) > Ball(0.0);
  };
  const auto touches = open.size() - static_cast<std::size_t>(std::count_if(open.begin(), open.end(), leaves));
  const bool none_falls = event && fallen_.empty() && !flight.zeros.empty();
  tally_.flight.touches += touches > 0 ? static_cast<long>(touches) : none_falls ? 1 : 0;
}

/// A condition that has fallen at the event, and is one of the next mode too, came back by a jump: nothing was done
/// about it. Impacts do something about gaps and velocities.
void Checker::unanswered(const Segment& next) {
  if (fallen_.empty() || !last_->segment.blows.empty()) return;
  const Mode &before = flown(last_->segment.states).mode, &after = flown(next.states).mode;
  for (const std::size_t i : fallen_) {
    const Condition& one = before.conditions[i];
    const auto same = [&](const Condition& other) {
      bool equal = one.kind == other.kind && one.contact == other.contact;
      for (std::size_t k = 0; equal && k < one.row.size(); ++k) equal = one.row[k].near() == other.row[k].near();
      return equal;
    };
    tally_.open.undecided += std::any_of(after.conditions.begin(), after.conditions.end(), same) ? 1 : 0;
  }
}

/// With a stop open and friction on its own pair slipping: 1 away from the stop, -1 back, 0 held.
ContactStates Checker::with_pair(ContactStates states, int stop, int direction) const {
  const Place& place = m_.stop(static_cast<std::size_t>(stop));
  states.closed[static_cast<std::size_t>(stop)] = false;
  for (std::size_t i = 0; i < states.slip.size(); ++i) {
    const Place& friction = m_.friction(i);
    const double same = m_.parallel(friction.own, place.own) * place.sign * friction.sign;
    const bool loaded = states.slip[i] != ContactStates::unloaded;
    if (loaded && same != 0.0 && m_.model().numbers[friction.own].drift == 0.0)
      states.slip[i] = same > 0.0 ? -direction : direction;
  }
  return states;
}

/// Every course of every stop beside every one of the others, from the states of the closed segment.
Limit::Modes Checker::ways(const Segment& segment) {
  using Course = Limit::Course;
  struct States {
    ContactStates states;
    std::vector<Course> courses = {};
  };
  std::vector<States> all{{segment.states}}, next;
  for (const int stop : segment.chatter) {
    next.clear();
    for (const States& one : all)
      for (const Course course : {Course::leaves, Course::returns, Course::rests}) {
        const int direction = course == Course::leaves ? 1 : -1;
        next.push_back({course == Course::rests ? one.states : with_pair(one.states, stop, direction), one.courses});
        next.back().courses.push_back(course);
      }
    all.swap(next);
  }
  Limit::Modes modes{{}, {}, flown(segment.states)};
  for (const States& one : all) {
    const bool at_limit = std::count(one.courses.begin(), one.courses.end(), Course::rests) ==
                          static_cast<std::ptrdiff_t>(one.courses.size());
    if (!at_limit) modes.ways.push_back({&flown(one.states), one.courses});
    for (std::size_t k = 0; k < one.courses.size(); ++k) {
      const ContactStates held = with_pair(one.states, segment.chatter[k], 0);
      if (one.courses[k] == Course::leaves && held != one.states) modes.holds.push_back({&flown(held), k});
    }
  }
  return modes;
}

std::string Checker::names(const std::vector<int>& stops) const {
  std::string text;
  for (const int stop : stops) text += (text.empty() ? "" : ", ") + name(stop);
  return (stops.size() == 1 ? "stop " : "stops ") + text;
}

/// A segment on the closed stops that stands for infinitely many impacts.
void Checker::chatter(const Segment& segment, const std::vector<double>& sizes) {
  constexpr std::size_t most = 5;  // each has three courses, and each of their combinations is a mode
  ++tally_.chatters;
  if (last_ == nullptr || last_->segment.blows.empty() || last_->segment.blows.back().kind != Blow::Kind::chatter ||
      last_->segment.blows.back().stops != segment.chatter)
    return refuse_(segment.end_line, "the segment before has not brought " + names(segment.chatter) + " to rest");
  if (segment.chatter.size() > most)
    return refuse_(segment.end_line, "more than " + std::to_string(most) + " stops chatter together");
  for (const int stop : segment.chatter) {
    const std::size_t own = p(stop);
    if (!flown(segment.states).mode.held[own] || segment.u[own] != 0.0 || segment.p[own] != 0.0)
      return refuse_(segment.end_line, "stop " + name(stop) + " is not at rest at the limit of its chatter");
  }
  Balls speeds;
  for (const Ball& w : last_->rests_from) speeds.push_back(-w);
  Limit limit(m_, segment, ways(segment), m_.extended(segment.p, segment.u, segment.start), speeds, refuse_);
  tally_.limit_error = std::max(tally_.limit_error, limit.check(sizes) / period_);
}

}  // namespace verify
