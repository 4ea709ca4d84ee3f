/// Checks the limit of a complete chatter.
#include "tail.hpp"

#include <algorithm>

namespace verify {
namespace {

constexpr double rounding = 0x1p-40;  ///< of a state, as from segment to segment

/// |a|, or the greater of it and m.
void raise(Ball& m, const Ball& a) { m = greater(m, abs(a)); }

Balls sum(const Balls& a, const Balls& b) {
  Balls c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] + b[i];
  return c;
}

Balls product(const std::vector<Balls>& M, const Balls& x) {
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

bool exactly_zero(const Balls& x) {
  return std::all_of(x.begin(), x.end(), [](const Ball& each) { return each.is_zero(); });
}

}  // namespace

Limit::Limit(const Head& head, const Segment& segment, const Flow& rise, const Flow& back, const Flow& closed, Ball v,
             const Refuse& refuse)
    : head_(head),
      segment_(segment),
      tail_(segment.tail),
      stop_(head.stops[static_cast<std::size_t>(segment.end.index)]),
      rise_(rise),
      back_(back),
      closed_(closed),
      v_(std::move(v)),
      refuse_(refuse),
      p_(static_cast<std::size_t>(stop_.own)),
      u_(p_ + static_cast<std::size_t>(head.d)),
      b_(closed.size()),
      S_(segment.state.begin(), segment.state.end()),
      size_(magnitudes(S_)),
      N_(closed.size(), Balls(closed.size())),
      more_(N_),
      delta_(closed.size()) {
  const Ball own(head.inertia[p_][p_]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(head.d); ++i)
    b_[static_cast<std::size_t>(head.d) + i] = Ball(head.inertia[i][p_]) / own;
  b_[u_] = Ball(1.0);
  for (std::size_t i = 0; i < closed.size(); ++i) {
    for (std::size_t j = 0; j < closed.size(); ++j) {
      raise(N_[i][j], closed.A[i][j]);
      for (const Flow* flow : {&rise, &back}) {
        const Ball quiet = i == u_ ? Ball() : flow->A[i][j] - b_[i] * flow->A[u_][j];
        raise(N_[i][j], quiet);
        raise(more_[i][j], quiet - closed.A[i][j]);
      }
    }
  }
}

void Limit::check(const std::vector<double>& sizes) {
  if (!(v_ > Ball(0.0))) return refuse("the pair does not leave stop " + stop_.name);
  if (!(tail_.rise_least > 0.0 && tail_.fall_least > 0.0)) return refuse("an acceleration is not positive");
  if (!enclose()) return refuse("the state may leave its box within D = " + digits(tail_.duration));
  acceleration(rise_, tail_.rise_least, tail_.rise_most, "away from");
  acceleration(back_, tail_.fall_least, tail_.fall_most, "back to");
  other_stops();
  time();
  state(sizes);
}

/// A box that nothing leaves: |b| |w| + D |N| (|S| + delta) is less than delta.
bool Limit::enclose() {
  const Ball D(tail_.duration);
  fastest_ = v_ * greater(Ball(1.0), Ball(tail_.fall_most) / Ball(tail_.rise_least));
  const Balls jump = scaled(fastest_, magnitudes(b_));
  delta_ = scaled(Ball(2.0), sum(jump, scaled(D, product(N_, size_))));
  delta_ = sum(delta_, scaled(Ball(2.0) * D, product(N_, delta_)));
  const Balls needed = sum(jump, scaled(D, product(N_, sum(size_, delta_))));
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (!(needed[i] < delta_[i] || (needed[i].is_zero() && delta_[i].is_zero()))) return false;
  return true;
}

void Limit::acceleration(const Flow& flow, double least, double most, const char* name) const {
  const Ball middle = Ball(stop_.sign) * dot(flow.A[u_], S_), spread = dot(magnitudes(flow.A[u_]), delta_);
  if (!(middle - spread >= Ball(least) && middle + spread <= Ball(most)))
    refuse("the acceleration on the way " + std::string(name) + " stop " + stop_.name + " is claimed to be in " +
           digits(least) + " .. " + digits(most) + ", it is " + digits(middle.near()) + " to " + digits(spread.near()));
}

/// No other stop is reached or left: its gap is open all the while, or it is held.
void Limit::other_stops() const {
  for (const Stop& other : head_.stops) {
    if (&other == &stop_) continue;
    const auto p = static_cast<std::size_t>(other.own), u = p + static_cast<std::size_t>(head_.d);
    const bool open = Ball(-other.sign) * S_[p] > delta_[p];
    const bool held = S_[u].is_zero() && delta_[u].is_zero() && delta_[p].is_zero();
    if (!open && !held) refuse("stop " + other.name + " may be reached or left before the limit");
  }
}

/// Speeds at which the pair leaves shrink by a ratio below 1, and the sum of all flights is as long as claimed.
void Limit::time() const {
  const Ball r(stop_.restitution), one(1.0);
  const auto series = [&](double rise, double fall, const Ball& ratio) {
    return v_ * (one / Ball(rise) + one / sqrt(Ball(rise) * Ball(fall))) / (one - ratio);
  };
  const Ball greatest = r * sqrt(Ball(tail_.fall_most) / Ball(tail_.rise_least));
  const Ball smallest = r * sqrt(Ball(tail_.fall_least) / Ball(tail_.rise_most));
  if (!(greatest < one))
    return refuse("the impacts may get no slower: their ratio is up to " + digits(greatest.near()));
  const Ball longest = series(tail_.rise_least, tail_.fall_least, greatest);
  const Ball shortest = series(tail_.rise_most, tail_.fall_most, smallest);
  if (!(longest <= Ball(tail_.duration) && segment_.duration <= tail_.duration))
    refuse("all flights together last up to " + digits(longest.near()) + ", more than D = " + digits(tail_.duration));
  const Ball duration(segment_.duration), error(segment_.end.size);
  if (!(longest - duration <= error && duration - shortest <= error))
    refuse_(segment_.end.line, "the limit is between " + digits(shortest.near()) + " and " + digits(longest.near()) +
                                   ", further than ERROR = " + digits(segment_.end.size) + " from DURATION");
}

/// At the limit the state is that of the closed mode. Of the flights only their second integral is seen.
void Limit::state(const std::vector<double>& sizes) const {
  std::vector<Balls> A;
  for (const Balls& row : closed_.A) A.push_back(magnitudes(row));
  const Ball D(tail_.duration);
  const Balls rounded = product(more_, sum(size_, delta_));
  const Balls apart = scaled(D, sum(product(A, scaled(Ball(2.0), delta_)), rounded));
  const Balls off = scaled(D, sum(product(A, apart), rounded));
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(head_.d); ++i) {
    if (i == p_ || i == u_) continue;  // zero in both
    const Ball allowed = Ball(rounding) * (Ball(sizes[i]) + delta_[i]);
    if (!(off[i] <= allowed))
      refuse("number " + std::to_string(i) + " of the state at the limit is known to " + digits(off[i].near()) +
             " only, rounding is " + digits(allowed.near()));
  }
}

/// One number that is zero in S and a multiple of w from then on.
bool Limit::follows_pair(const Entries& row) const {
  if (row.size() != 1) return false;
  const auto j = static_cast<std::size_t>(row[0].first);
  return S_[j].is_zero() && exactly_zero(N_[j]) && !b_[j].is_zero();
}

bool Limit::guards(const Mode& mode, const Flow& flow, bool rising) const {
  bool directed = false;
  for (std::size_t g = 0; g < mode.guards.size(); ++g) {
    const Entries& row = mode.guards[g].row;
    if (row == Entries{{stop_.own, -stop_.sign}}) continue;  // the gap that chatters
    const std::string name = "guard " + std::to_string(g) + " (" + mode.guards[g].kind + ") of the way " +
                             (rising ? "away from" : "back to") + " stop " + stop_.name;
    if (follows_pair(row)) {
      const Ball towards = Ball(stop_.sign * row[0].second) * b_[static_cast<std::size_t>(row[0].first)];
      if (!(rising ? towards < Ball(0.0) : towards > Ball(0.0))) refuse(name + ": it is for the other direction");
      directed = true;
      continue;
    }
    const Ball middle = dot(flow.guards[g], S_), spread = dot(magnitudes(flow.guards[g]), delta_);
    if (!(middle > spread || (spread.is_zero() && middle >= Ball(0.0))))
      refuse(name + ": it may come to zero, it is " + digits(middle.near()) + " to " + digits(spread.near()));
  }
  return directed;
}

void Limit::holds_not(const Mode& mode, const Flow& flow) const {
  if (!mode.rows[u_].empty()) refuse("in the mode that would hold the pair off the stop it is not held");
  bool exceeded = false;
  for (std::size_t g = 0; g < mode.guards.size(); ++g) {
    const Ball middle = dot(flow.guards[g], S_), spread = dot(magnitudes(flow.guards[g]), delta_);
    exceeded = exceeded || (mode.guards[g].kind == "stick" && middle + spread < Ball(0.0));
  }
  if (!exceeded) refuse("friction may hold the pair off stop " + stop_.name);
}

}  // namespace verify
