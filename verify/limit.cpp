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

Limit::Limit(const Mechanics& mechanics, const Segment& segment, const Modes& modes, Balls S, Ball v,
             const Refuse& refuse)
    : m_(mechanics),
      segment_(segment),
      modes_(modes),
      stop_(static_cast<std::size_t>(segment.chatter)),
      place_(mechanics.stop(stop_)),
      u_(mechanics.d() + place_.own),
      v_(std::move(v)),
      refuse_(refuse),
      b_(mechanics.size()),
      S_(std::move(S)),
      size_(magnitudes(S_)),
      N_(zero_matrix(mechanics.size(), mechanics.size())),
      more_(N_),
      D_(Ball(1.0625) * Ball(segment.duration)),
      delta_(mechanics.size()) {
  for (std::size_t i = 0; i < m_.d(); ++i)
    b_[m_.d() + i] = m_.inertia()[i][place_.own] / m_.inertia()[place_.own][place_.own];
  b_[u_] = Ball(1.0);
  set_quiet_part();
}

void Limit::set_quiet_part() {
  const Matrix& A = modes_.closed.flow.A;
  for (std::size_t i = 0; i < A.size(); ++i)
    for (std::size_t j = 0; j < A.size(); ++j) {
      raise(N_[i][j], A[i][j]);
      for (const FlownMode* way : {&modes_.rise, &modes_.back}) {
        const Ball quiet = i == u_ ? Ball() : way->flow.A[i][j] - b_[i] * way->flow.A[u_][j];
        raise(N_[i][j], quiet);
        raise(more_[i][j], quiet - A[i][j]);
      }
    }
}

double Limit::check(const std::vector<double>& sizes) {
  if (!(v_ > Ball(0.0))) return refuse("the pair does not leave the stop"), 0.0;
  if (!enclose()) return refuse("no box is found that the state does not leave before the limit"), 0.0;
  const auto& corners = m_.model().stops[stop_].corners;
  if (!corners.empty() && !(v_ * greater(Ball(1.0), back_.most / rise_.least) < Ball(corners.front().at)))
    return refuse("impacts may be faster than where the restitution begins to change"), 0.0;
  other_stops();
  conditions(modes_.rise, "away from");
  conditions(modes_.back, "back to");
  if (&modes_.rise != &modes_.back) holds_not();
  state(sizes);
  return time();
}

/// A box that nothing leaves: |b| |w| + D |N| (|S| + delta) is less than delta, |w| at most v max(1, c2 / a1).
bool Limit::enclose() {
  Ball ratio(1.0);
  for (int round = 0; round < 4; ++round) {
    const Balls jump = scaled(v_ * ratio, magnitudes(b_));
    delta_ = scaled(Ball(2.0), sum(jump, scaled(D_, image(N_, size_))));
    delta_ = sum(delta_, scaled(Ball(2.0) * D_, image(N_, delta_)));
    rise_ = acceleration(modes_.rise);
    back_ = acceleration(modes_.back);
    if (!(rise_.least > Ball(0.0) && back_.least > Ball(0.0))) return false;
    const Balls needed = sum(jump, scaled(D_, image(N_, sum(size_, delta_))));
    bool inside = back_.most / rise_.least <= ratio;
    for (std::size_t i = 0; i < needed.size(); ++i)
      inside = inside && (needed[i] < delta_[i] || (needed[i].is_zero() && delta_[i].is_zero()));
    if (inside) return true;
    ratio = Ball(1.0 + 0x1p-20) * greater(Ball(1.0), back_.most / rise_.least);
  }
  return false;
}

/// Towards the stop, over the box.
Limit::Range Limit::acceleration(const FlownMode& mode) const {
  const Balls& row = mode.flow.A[u_];
  const Ball middle = Ball(place_.sign) * dot(row, S_), spread = dot(magnitudes(row), delta_);
  return {middle - spread, middle + spread};
}

/// No other stop is reached or left: its gap is open all the while, or it is held.
void Limit::other_stops() const {
  for (std::size_t k = 0; k < m_.model().stops.size(); ++k) {
    if (k == stop_) continue;
    const std::size_t p = m_.stop(k).own, u = p + m_.d();
    const bool open = Ball(-m_.stop(k).sign) * S_[p] > delta_[p];
    const bool held = S_[u].is_zero() && delta_[u].is_zero() && delta_[p].is_zero();
    if (!open && !held) refuse("stop " + m_.model().stops[k].name + " may be reached or left before the limit");
  }
}

/// The gap that chatters, and the velocity of its own pair, whose sign is the mode's direction.
bool Limit::of_pair(const Condition& condition) const {
  if (condition.kind == Condition::Kind::gap) return condition.contact == stop_;
  if (condition.kind != Condition::Kind::slip) return false;
  const std::size_t own = m_.friction(condition.contact).own;
  return m_.parallel(own, place_.own) != 0.0 && m_.model().numbers[own].drift == 0.0;
}

void Limit::conditions(const FlownMode& mode, const char* way) const {
  for (std::size_t i = 0; i < mode.mode.conditions.size(); ++i) {
    const Condition& condition = mode.mode.conditions[i];
    if (of_pair(condition)) continue;
    const Ball middle = dot(mode.flow.rows[i], S_), spread = dot(magnitudes(mode.flow.rows[i]), delta_);
    if (!(middle > spread || (spread.is_zero() && middle >= Ball(0.0))))
      refuse(condition.name + " may fail on the way " + way + " the stop: the value is " + digits(middle.near()) +
             " to " + digits(spread.near()));
  }
}

void Limit::holds_not() const {
  bool exceeded = false;
  for (std::size_t i = 0; i < modes_.hold.mode.conditions.size(); ++i) {
    const Balls& row = modes_.hold.flow.rows[i];
    const Condition& condition = modes_.hold.mode.conditions[i];
    const bool of_stick =
        condition.kind == Condition::Kind::stick && m_.parallel(m_.friction(condition.contact).own, place_.own) != 0.0;
    exceeded = exceeded || (of_stick && dot(row, S_) + dot(magnitudes(row), delta_) < Ball(0.0));
  }
  if (!exceeded) refuse("friction may hold the pair off the stop");
}

/// Speeds at which the pair leaves shrink by a ratio below 1, and the sum of all flights is as long as the segment.
double Limit::time() const {
  const Ball r(m_.model().stops[stop_].restitution), one(1.0), duration(segment_.duration);
  const auto series = [&](const Ball& rise, const Ball& fall, const Ball& ratio) {
    return v_ * (one / rise + one / sqrt(rise * fall)) / (one - ratio);
  };
  const Ball greatest = r * sqrt(back_.most / rise_.least), smallest = r * sqrt(back_.least / rise_.most);
  if (!(greatest < one))
    return refuse("the impacts may get no slower: their ratio is up to " + digits(greatest.near())), 0.0;
  const Ball longest = series(rise_.least, back_.least, greatest);
  const Ball shortest = series(rise_.most, back_.most, smallest);
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
    if (i == place_.own || i == u_) continue;  // zero in both
    const Ball allowed = Ball(rounding) * (Ball(sizes[i]) + delta_[i]);
    if (!(off[i] <= allowed))
      refuse("number " + std::to_string(i) + " of the state at the limit is known to " + digits(off[i].near()) +
             " only, rounding is " + digits(allowed.near()));
  }
}

}  // namespace verify
