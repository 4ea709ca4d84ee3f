#include "oracle/oracle.hpp"

#include <algorithm>
#include <stdexcept>

namespace slapstick::oracle {
namespace {

// A chatter is summed once u, over the longest step, is this small a part of the motion: what is left of it is
// quadratic in this.
const Real chatter_share{"1e-22"};
// A ratio of successive intervals between impacts that repeats this well belongs to a geometric series.
const Real ratio_repeats{"1e-10"};
constexpr int most_events_at_one_instant = 20;

Vector interleave(const Vector& x, const Vector& v) {
  Vector state;
  for (std::size_t i = 0; i < x.size(); ++i) state.push_back(x[i]), state.push_back(v[i]);
  return state;
}

/// Divides out the zero at the start of the step.
Polynomial without_start_zero(const Polynomial& p, int zeros) { return {p.begin() + zeros, p.end()}; }

}  // namespace

Oracle::Oracle(const Model& model, const std::vector<double>& state, double phase_fraction)
    : Oracle(model, to_real(state), Real(phase_fraction)) {}

Oracle::Oracle(const Model& model, const Vector& state, const Real& phase_fraction)
    : mechanics_(model), t_(phase_fraction * mechanics_.period()) {
  split(state);
  start();
}

Oracle::Oracle(const Model& model, const SegmentStart& segment)
    : mechanics_(model), t_(segment.phase_fraction * mechanics_.period()), mode_(segment.mode) {
  split(segment.state);
  Contact contact{segment.touching || closed(), closed(), segment.no_slip || sticking()};
  if (contact.touching) gap_ = 0;
  const StartTest test = may_start(mechanics_, mode_, contact, x_, v_, gap_, t_);
  mechanics_.project(mode_, v_);
  if (segment.no_slip && mechanics_.has_friction()) mechanics_.project(Mode{0, mode_.closed}, v_);
  begin_segment(test.start);
  if (!test.admissible) pending_.push_back(handle(test.violated, false, Real(0)));
}

void Oracle::split(const Vector& state) {
  const std::size_t n = static_cast<std::size_t>(mechanics_.model().size());
  if (state.size() != 2 * n) throw std::invalid_argument("oracle: a state has 2n numbers");
  for (std::size_t i = 0; i < n; ++i) x_.push_back(state[2 * i]), v_.push_back(state[2 * i + 1]);
  if (mechanics_.has_stop()) gap_ = mechanics_.gap(x_);
}

void Oracle::start() {
  Contact contact;
  if (mechanics_.has_friction()) contact.no_slip = abs(mechanics_.slip_velocity(v_)) <= zero_share;
  if (mechanics_.has_stop()) {
    if (gap_ < -zero_share) throw std::invalid_argument("oracle: the start violates the stop");
    contact.touching = gap_ <= zero_share;
    if (contact.touching) gap_ = 0;
    contact.at_rest = contact.touching && abs(mechanics_.closing_velocity(v_)) <= zero_share;
    if (contact.touching && !contact.at_rest && mechanics_.closing_velocity(v_) > 0) {
      mode_.friction = contact.no_slip || !mechanics_.has_friction() || mechanics_.slip_velocity(v_) > 0 ? 1 : -1;
      pending_.push_back(handle(GuardKind::gap, false, Real(0)));
      return;
    }
  }
  choose_mode(contact);
}

/// Modes that agree with the velocities, in order of preference: closed before open, stick before slip.
std::vector<Mode> Oracle::candidates(const Contact& contact) const {
  const bool merged = mechanics_.merged_sign() != 0;
  std::vector<int> frictions{1};
  if (mechanics_.has_friction()) {
    frictions = {mechanics_.slip_velocity(v_) > 0 ? 1 : -1};
    if (contact.no_slip) frictions = {0, 1, -1};
  }
  std::vector<Mode> modes;
  for (const bool closed : {true, false})
    for (const int friction : frictions) {
      if (closed && !(contact.touching && contact.at_rest)) continue;
      if (merged && closed && friction != 0) continue;                       // closed means w = 0
      if (merged && !closed && friction == 0 && contact.touching) continue;  // w = 0 on the stop is the closed stop
      modes.push_back({friction, closed});
    }
  return modes;
}

void Oracle::choose_mode(const Contact& contact) {
  for (const Mode& mode : candidates(contact)) {
    const StartTest test = may_start(mechanics_, mode, contact, x_, v_, gap_, t_);
    if (!test.admissible) continue;
    mode_ = mode;
    // w = 0 holds to all digits, whether the contact sticks or slips on.
    mechanics_.project(Mode{contact.no_slip && mechanics_.has_friction() ? 0 : mode.friction, mode.closed}, v_);
    begin_segment(test.start);
    return;
  }
  std::string where = "oracle: no mode may start at t = " + t_.str(20);
  for (const Real& value : state()) where += " " + value.str(20);
  throw std::runtime_error(where);
}

void Oracle::begin_segment(const Start& start_zeros) {
  zeros_ = start_zeros;
  step_ = mechanics_.longest_step();
  if (since_event_ > 0) step_ = std::min(step_, Real(2 * since_event_));  // bounces of a chatter need short steps only
  since_event_ = 0;
  if (gap_ == 0) gap_size_ = 0;
  slip_size_ = 0;
}

std::optional<Oracle::Hit> Oracle::first_hit(const Jet& jet) {
  std::optional<Hit> first;
  for (const Guard& guard : guards_of(mechanics_, mode_, jet, gap_)) {
    const int zeros = zeros_[guard.kind];
    if (zeros == Start::never) continue;
    Real size = guard.scale;
    if (guard.kind == GuardKind::gap) size = gap_size_ = std::max(gap_size_, magnitude(guard.p));
    if (guard.kind == GuardKind::slip) size = slip_size_ = std::max(slip_size_, magnitude(guard.p));
    const Polynomial p = without_start_zero(guard.p, zeros);
    if (zeros > 0) size = magnitude(p);
    // A holding force or stop force that only touches its limit ends nothing.
    const bool report_touch = guard.kind == GuardKind::gap || guard.kind == GuardKind::slip;
    const std::optional<Root> root = first_root(p, zero_share * size, report_touch);
    if (root && (!first || root->s < first->root.s)) first = Hit{guard.kind, *root};
  }
  return first;
}

/// g'' at s.
Real Oracle::gap_curvature(const Jet& jet, const Real& s) const {
  if (!mechanics_.has_stop()) return Real(0);
  const Vector c = mechanics_.gap_series(jet).coefficients;
  Polynomial slope;
  for (std::size_t k = 1; k < c.size(); ++k) slope.push_back(c[k] * static_cast<int>(k));
  return derivative(slope, s) / (jet.step * jet.step);
}

void Oracle::advance(const Jet& jet, const Real& s) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    x_[i] = evaluate(jet.x[i], s);
    v_[i] = evaluate(jet.v[i], s);
  }
  const bool gap_moves = mechanics_.has_stop() && !closed() && !(mechanics_.merged_sign() != 0 && sticking());
  if (gap_moves) gap_ += evaluate(mechanics_.gap_series(jet).coefficients, s);
  const Real elapsed = s * jet.step;
  t_ += elapsed;
  since_event_ += elapsed;
  since_impact_ += elapsed;
}

std::optional<OracleEvent> Oracle::next(const Real& t_end) {
  for (int at_one_instant = 0;;) {
    if (!pending_.empty()) {
      if (pending_.front().time > t_end) return std::nullopt;
      const OracleEvent event = pending_.front();
      pending_.pop_front();
      return event;
    }
    if (t_ >= t_end) return std::nullopt;
    const bool last = t_end - t_ <= step_;
    const Real step = last ? Real(t_end - t_) : step_;
    const Jet jet = mechanics_.expand(mode_, x_, v_, t_, step, mechanics_.order(step));
    const std::optional<Hit> hit = first_hit(jet);
    advance(jet, hit ? hit->root.s : Real(1));
    if (hit) {
      at_one_instant = since_event_ > 0 ? 0 : at_one_instant + 1;
      if (at_one_instant > most_events_at_one_instant)
        throw std::runtime_error("oracle: too many events at one instant");
      pending_.push_front(handle(hit->kind, hit->root.touch, gap_curvature(jet, hit->root.s)));
      continue;
    }
    if (last) t_ = t_end;
    for (int& zeros : zeros_.zeros)
      if (zeros != Start::never) zeros = 0;
    step_ = std::min(mechanics_.longest_step(), Real(2 * step_));
  }
}

std::vector<OracleEvent> Oracle::run(const Real& t_end) {
  std::vector<OracleEvent> events;
  while (auto event = next(t_end)) events.push_back(*event);
  return events;
}

OracleEvent Oracle::make_event(const char* kind, bool at_stop) const {
  const Real w = at_stop ? mechanics_.closing_velocity(v_) : mechanics_.slip_velocity(v_);
  return {t_, kind, at_stop ? "stop" : "friction", w, state()};
}

OracleEvent Oracle::handle(GuardKind kind, bool touch, const Real& gap_curvature) {
  const bool merged = mechanics_.merged_sign() != 0;
  bool reached = kind == GuardKind::gap, rest = false;
  bool reversed = mechanics_.has_friction() && !sticking() &&
                  (kind == GuardKind::slip || abs(mechanics_.slip_velocity(v_)) <= zero_share * slip_size_);
  if (mechanics_.has_stop() && !closed() && !(merged && sticking())) {
    const Real u = mechanics_.closing_velocity(v_), tiny = zero_share * gap_size_;
    const bool slow = (reached && touch) || u * u <= 2 * abs(gap_curvature) * tiny || (merged && reversed);
    reached = reached || (abs(gap_) <= tiny && (slow || u > 0));
    rest = reached && slow;
  }
  OracleEvent event = make_event("release", reached || kind == GuardKind::press);
  if (reached) event.kind = rest ? "graze" : "impact", gap_ = 0;
  reversed = reversed || (merged && rest);
  const bool no_slip = reversed || sticking();
  const Contact contact = reached && !rest ? collide(no_slip) : Contact{reached || closed(), rest || closed(), no_slip};
  choose_mode(contact);
  if (!reached && reversed) event.kind = sticking() ? "stick" : mode_.friction > 0 ? "slip+" : "slip-";
  if (event.kind == "impact" && !contact.at_rest) sum_chatter();
  return event;
}

Contact Oracle::collide(bool w_was_zero) {
  const Real u = mechanics_.closing_velocity(v_),
             w = mechanics_.has_friction() ? mechanics_.slip_velocity(v_) : Real(0);
  mechanics_.impact(v_);
  intervals_.push_back(since_impact_);
  if (intervals_.size() > 4) intervals_.pop_front();
  since_impact_ = 0;
  Contact contact{true, mechanics_.stop().restitution == 0, false};
  if (!mechanics_.has_friction()) return contact;
  if (mechanics_.merged_sign() != 0)
    contact.no_slip = contact.at_rest;  // w+ = -r w-
  else if (mechanics_.uncoupled())
    contact.no_slip = w_was_zero;
  else
    contact.no_slip = abs(mechanics_.slip_velocity(v_)) <= zero_share * (abs(u) + abs(w));
  return contact;
}

Real Oracle::velocity_scale() const {
  const Real& h = mechanics_.longest_step();
  return mechanics_.gap_series(mechanics_.expand(mode_, x_, v_, t_, h, 6)).scale / h;
}

/// Replaces the rest of a chatter by its limit. Once the forces are constant over the rest, the intervals d_n between
/// impacts form a geometric series of ratio q, and the impacts end after d q / (1 - q). All contact forces act along
/// the contacts' rows, so the motion projected on the closed mode moves as if it had been closed all the time; what
/// this neglects is of second order in u.
void Oracle::sum_chatter() {
  if (intervals_.size() < 4) return;
  const Real u = -mechanics_.closing_velocity(v_);
  if (u > chatter_share * velocity_scale()) return;
  const Real q = intervals_[3] / intervals_[2], q1 = intervals_[2] / intervals_[1], q2 = intervals_[1] / intervals_[0];
  if (!(q < 1) || abs(q - q1) > ratio_repeats || abs(q - q2) > ratio_repeats) return;
  const Real rest = intervals_[3] * q / (1 - q);
  const bool follows =
      mechanics_.has_friction() && !mechanics_.uncoupled() && abs(mechanics_.slip_velocity(v_)) <= 1000 * u;
  mode_.closed = true;
  gap_ = 0;
  if (follows) mode_.friction = 0;
  mechanics_.project(mode_, v_);
  advance(mechanics_.expand(mode_, x_, v_, t_, rest, mechanics_.order(rest)), Real(1));
  OracleEvent event = make_event("chatter", true);
  event.w = 0;
  intervals_.clear();
  choose_mode({true, true, sticking()});
  pending_.push_back(event);
}

Vector Oracle::state() const { return interleave(x_, v_); }

Real Oracle::holding_force() const {
  return sticking() ? mechanics_.expand(mode_, x_, v_, t_, Real(1), 0).holding.front() : Real(0);
}

Real Oracle::stop_force() const {
  if (!closed()) return Real(0);
  const Real press = mechanics_.expand(mode_, x_, v_, t_, Real(1), 0).press.front();
  if (mechanics_.merged_sign() == 0) return press;
  return std::max<Real>(Real(0), press - Real(mechanics_.friction().static_friction));
}

std::optional<OracleEvent> first_event(const Model& model, const SegmentStart& start, const Real& duration) {
  Oracle oracle(model, start);
  const Real begin = oracle.time();
  std::optional<OracleEvent> event = oracle.next(begin + duration);
  if (event) event->time -= begin;
  return event;
}

}  // namespace slapstick::oracle
