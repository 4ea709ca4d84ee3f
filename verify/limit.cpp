/// Checks the limit of a complete chatter.
#include "limit.hpp"

#include <algorithm>

namespace verify {
namespace {

/// |a|, or the greater of it and m.
void raise(Ball& m, const Ball& a) { m = greater(m, abs(a)); }

Balls sum(const Balls& a, const Balls& b) {
  Balls c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] + b[i];
  return c;
}

Balls image(const Matrix& M, const Balls& x) {
  Balls y;
  for (const Balls& row : M) y.push_back(dot(row, x));
  return y;
}

Balls scaled(const Ball& a, Balls x) {
  for (Ball& each : x) each = a * each;
  return x;
}

Balls magnitudes(Balls x) {
  for (Ball& each : x) each = abs(each);
  return x;
}

}  // namespace

Limit::Limit(const Mechanics& mechanics, const Segment& segment, Modes modes, Balls S, const Balls& v,
             const Refuse& refuse)
    : m_(mechanics),
      segment_(segment),
      modes_(std::move(modes)),
      refuse_(refuse),
      S_(std::move(S)),
      size_(magnitudes(S_)),
      N_(zero_matrix(mechanics.size(), mechanics.size())),
      more_(N_),
      D_(Ball(1.0625) * Ball(segment.duration)),
      delta_(mechanics.size()) {
  for (std::size_t k = 0; k < segment.chatter.size(); ++k) {
    const auto stop = static_cast<std::size_t>(segment.chatter[k]);
    const Place place = mechanics.stop(stop);
    stops_.push_back({stop, place, mechanics.d() + place.own, v[k], Balls(mechanics.size())});
    const Ball own = m_.inertia()[place.own][place.own];
    for (std::size_t i = 0; i < m_.d(); ++i) stops_[k].b[m_.d() + i] = m_.inertia()[i][place.own] / own;
    stops_[k].b[stops_[k].u] = Ball(1.0);
  }
  set_quiet_part();
}

/// Does no stop feel the impacts of another?
bool Limit::uncoupled() const {
  for (const Stop& one : stops_)
    for (const Stop& other : stops_)
      if (one.stop != other.stop && !one.b[other.u].is_zero()) return false;
  return true;
}

void Limit::set_quiet_part() {
  const Matrix& A = modes_.closed.flow.A;
  const auto add = [&](const Matrix& way, std::size_t i, std::size_t j) {
    Ball quiet = way[i][j];
    for (const Stop& one : stops_) quiet = i == one.u ? Ball() : quiet - one.b[i] * way[one.u][j];
    raise(N_[i][j], quiet);
    raise(more_[i][j], quiet - A[i][j]);
  };
  for (std::size_t i = 0; i < A.size(); ++i)
    for (std::size_t j = 0; j < A.size(); ++j) {
      raise(N_[i][j], A[i][j]);
      for (const Way& way : modes_.ways) add(way.mode->flow.A, i, j);
    }
}

double Limit::check(const std::vector<double>& sizes) {
  if (!uncoupled()) return refuse("stops chatter together that act on each other"), 0.0;
  for (const Stop& one : stops_)
    if (!(one.v > Ball(0.0))) return refuse("the pair does not leave the stop"), 0.0;
  if (!enclose()) return refuse("no box is found that the state does not leave before the limit"), 0.0;
  for (const Stop& one : stops_) {
    const auto& corners = m_.model().stops[one.stop].corners;
    if (!corners.empty() && !(one.v * greater(Ball(1.0), one.faster()) < Ball(corners.front().at)))
      return refuse("impacts may be faster than where the restitution begins to change"), 0.0;
  }
  other_stops();
  conditions();
  holds_not();
  state(sizes);
  double off = 0.0;
  for (const Stop& one : stops_) off = std::max(off, time(one));
  return off;
}

/// |b| |w| of all stops, each |w| at most v times its ratio.
Balls Limit::jump(const std::vector<Ball>& ratios) const {
  Balls all(m_.size());
  for (std::size_t k = 0; k < stops_.size(); ++k)
    all = sum(all, scaled(stops_[k].v * ratios[k], magnitudes(stops_[k].b)));
  return all;
}

/// A box that nothing leaves: |b| |w| + D |N| (|S| + delta) is less than delta, |w| at most v max(1, c2 / a1).
bool Limit::enclose() {
  std::vector<Ball> ratios(stops_.size(), Ball(1.0));
  for (int round = 0; round < 4; ++round) {
    const Balls jumps = jump(ratios);
    delta_ = scaled(Ball(2.0), sum(jumps, scaled(D_, image(N_, size_))));
    delta_ = sum(delta_, scaled(Ball(2.0) * D_, image(N_, delta_)));
    accelerations();
    const Balls needed = sum(jumps, scaled(D_, image(N_, sum(size_, delta_))));
    bool inside = true;
    for (std::size_t k = 0; k < stops_.size(); ++k) {
      const Stop& one = stops_[k];
      if (!(one.rise.least > Ball(0.0) && one.back.least > Ball(0.0))) return false;
      inside = inside && one.faster() <= ratios[k];
      ratios[k] = Ball(1.0 + 0x1p-20) * greater(Ball(1.0), one.faster());
    }
    for (std::size_t i = 0; i < needed.size(); ++i)
      inside = inside && (needed[i] < delta_[i] || (needed[i].is_zero() && delta_[i].is_zero()));
    if (inside) return true;
  }
  return false;
}

/// Towards each stop, over the box, in all ways in which its pair leaves or returns.
void Limit::accelerations() {
  for (std::size_t k = 0; k < stops_.size(); ++k) {
    Stop& one = stops_[k];
    bool first[2] = {true, true};
    for (const Way& way : modes_.ways) {
      if (way.courses[k] == Course::rests) continue;
      const bool leaves = way.courses[k] == Course::leaves;
      const Balls& row = way.mode->flow.A[one.u];
      const Ball middle = Ball(one.place.sign) * dot(row, S_), spread = dot(magnitudes(row), delta_);
      const Range here{middle - spread, middle + spread};
      Range& range = leaves ? one.rise : one.back;
      range = first[leaves] ? here : Range{-greater(-range.least, -here.least), greater(range.most, here.most)};
      first[leaves] = false;
    }
  }
}

bool Limit::chatters(std::size_t stop) const {
  return std::any_of(stops_.begin(), stops_.end(), [&](const Stop& one) { return one.stop == stop; });
}

/// No other stop is reached or left: its gap is open all the while, or it is held.
void Limit::other_stops() const {
  for (std::size_t k = 0; k < m_.model().stops.size(); ++k) {
    if (chatters(k)) continue;
    const std::size_t p = m_.stop(k).own, u = p + m_.d();
    const bool open = Ball(-m_.stop(k).sign) * S_[p] > delta_[p];
    const bool held = S_[u].is_zero() && delta_[u].is_zero() && delta_[p].is_zero();
    if (!open && !held) refuse("stop " + m_.model().stops[k].name + " may be reached or left before the limit");
  }
}

/// A gap that chatters, and the velocity of its own pair, whose sign is the pair's course.
bool Limit::in_a_way(const Condition& condition) const {
  if (condition.kind == Condition::Kind::gap) return chatters(condition.contact);
  if (condition.kind != Condition::Kind::slip) return false;
  const std::size_t own = m_.friction(condition.contact).own;
  return m_.model().numbers[own].drift == 0.0 && std::any_of(stops_.begin(), stops_.end(), [&](const Stop& one) {
           return m_.parallel(own, one.place.own) != 0.0;
         });
}

void Limit::conditions() const {
  std::vector<const FlownMode*> seen;
  for (const Way& way : modes_.ways) {
    if (std::find(seen.begin(), seen.end(), way.mode) != seen.end()) continue;
    seen.push_back(way.mode);
    for (std::size_t i = 0; i < way.mode->mode.conditions.size(); ++i) {
      const Condition& condition = way.mode->mode.conditions[i];
      if (in_a_way(condition)) continue;
      const Balls& row = way.mode->flow.rows[i];
      const Ball middle = dot(row, S_), spread = dot(magnitudes(row), delta_);
      if (!(middle > spread || (spread.is_zero() && middle >= Ball(0.0))))
        refuse(condition.name + " may fail on the way to the limit: the value is " + digits(middle.near()) + " to " +
               digits(spread.near()));
    }
  }
}

/// Friction that would hold a pair off its stop is beyond its limit.
void Limit::holds_not() const {
  for (const Hold& hold : modes_.holds) {
    bool exceeded = false;
    for (std::size_t i = 0; i < hold.mode->mode.conditions.size(); ++i) {
      const Balls& row = hold.mode->flow.rows[i];
      const Condition& condition = hold.mode->mode.conditions[i];
      const bool of_stick = condition.kind == Condition::Kind::stick &&
                            m_.parallel(m_.friction(condition.contact).own, stops_[hold.k].place.own) != 0.0;
      exceeded = exceeded || (of_stick && dot(row, S_) + dot(magnitudes(row), delta_) < Ball(0.0));
    }
    if (!exceeded) return refuse("friction may hold the pair off the stop");
  }
}

/// Speeds at which the pair leaves shrink by a ratio below 1, and the sum of all flights is as long as the segment.
double Limit::time(const Stop& stop) const {
  const Range &rise = stop.rise, &back = stop.back;
  const Ball r(m_.model().stops[stop.stop].restitution), one(1.0), duration(segment_.duration);
  const auto series = [&](const Ball& up, const Ball& fall, const Ball& ratio) {
    return stop.v * (one / up + one / sqrt(up * fall)) / (one - ratio);
  };
  const Ball greatest = r * sqrt(back.most / rise.least), smallest = r * sqrt(back.least / rise.most);
  if (!(greatest < one))
    return refuse("the impacts may get no slower: their ratio is up to " + digits(greatest.near())), 0.0;
  const Ball longest = series(rise.least, back.least, greatest);
  const Ball shortest = series(rise.most, back.most, smallest);
  const Ball error = Ball(0x1p-49) * m_.period();
  if (!(longest <= D_ && longest - duration <= error && duration - shortest <= error))
    refuse("the limit is between " + digits(shortest.near()) + " and " + digits(longest.near()) +
           ", further than 2^-49 periods from DURATION = " + digits(segment_.duration));
  return greater(longest - duration, duration - shortest).highest();
}

/// At the limit the state is that of the closed mode. Of the flights only their second integral is seen.
void Limit::state(const std::vector<double>& sizes) const {
  Matrix A;
  for (const Balls& row : modes_.closed.flow.A) A.push_back(magnitudes(row));
  const Balls rounded = image(more_, sum(size_, delta_));
  const Balls apart = scaled(D_, sum(image(A, scaled(Ball(2.0), delta_)), rounded));
  const Balls off = scaled(D_, sum(image(A, apart), rounded));
  for (std::size_t i = 0; i < 2 * m_.d(); ++i) {
    const auto own = [&](const Stop& one) { return i == one.place.own || i == one.u; };
    if (std::any_of(stops_.begin(), stops_.end(), own)) continue;  // zero in both
    const Ball allowed = Ball(rounding) * (Ball(sizes[i]) + delta_[i]);
    if (!(off[i] <= allowed))
      refuse("number " + std::to_string(i) + " of the state at the limit is known to " + digits(off[i].near()) +
             " only, rounding is " + digits(allowed.near()));
  }
}

}  // namespace verify
