/// Records a stretch of a motion as curves.
#include "motion_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ranges.hpp"

namespace slapstick::app {
namespace {

constexpr double lifted = std::numeric_limits<double>::quiet_NaN();
constexpr double per_window = 24.0, per_period = 1000.0;  // dense samples
constexpr double least_samples = 32.0, most_samples = 50'000.0;
constexpr std::size_t pieces = 8;  // that a segment has at least, so that it may be magnified

}  // namespace

void MotionRecord::keep(Instant from, Instant to) {
  from_ = from;
  to_ = to;
  covered_ = time(from);
  t_.clear();
  values_.assign(shown_.numbers.size(), {});
  dense_.assign(shown_.numbers.size(), {});
  least_.assign(shown_.numbers.size(), std::numeric_limits<double>::infinity());
  greatest_.assign(shown_.numbers.size(), -std::numeric_limits<double>::infinity());
  stretches_.clear();
  moments_.clear();
  instant_.reset();
}

std::vector<double> MotionRecord::numbers(Instant now, const State& state,
                                          const std::vector<double>& quantities) const {
  std::vector<double> found = quantities;
  if (shown_.observer) {
    const auto own = static_cast<std::ptrdiff_t>(shown_.observer->quantities().size());
    const std::vector<double>& more =
        shown_.observer->read(now.seconds(system_.period()), state, {quantities.end() - own, quantities.end()});
    found.insert(found.end(), more.begin(), more.end());
  }
  std::vector<double> all(shown_.numbers.size(), 0.0);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const auto& [index, factor] : shown_.numbers[k].terms) all[k] += factor * found[index];
  return all;
}

/// By more than what the curves leave out anyway? A force that is continuous has the rounding of two sums.
bool MotionRecord::apart(const std::vector<double>& a, const std::vector<double>& b) const {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::abs(a[k] - b[k]) > tolerance * std::max(greatest_[k] - least_[k], 0.0)) return true;
  return false;
}

MotionRecord::Phase MotionRecord::phase(ModeId mode) {
  const auto known = phases_.find(mode);
  if (known != phases_.end()) return known->second;
  const mode::ContactStates states = system_.states(mode);
  Phase found = Phase::apart;
  for (const int contact : shown_.contacts) {
    auto index = static_cast<std::size_t>(contact);
    bool touches = false, sticks = false;
    if (index < states.stops.size()) {
      touches = states.stops[index] == mode::StopState::closed;
    } else if (index -= states.stops.size(); index < states.frictions.size()) {
      sticks = states.frictions[index] == mode::FrictionState::stick;
    } else if (index -= states.frictions.size(); index < states.compliant.size()) {
      touches = states.compliant[index] == mode::CompliantState::on ||
                states.compliant[index] == mode::CompliantState::bounded;
    }
    if (touches) found = Phase::touches;
    if (sticks && found == Phase::apart) found = Phase::sticks;
  }
  return phases_[mode] = found;
}

void MotionRecord::push(double t, const std::vector<double>& numbers) {
  t_.push_back(t);
  for (std::size_t k = 0; k < numbers.size(); ++k) values_[k].push_back(numbers[k]);
}

/// Dense samples of the segment that begins at `start`, between two instants in periods.
void MotionRecord::read(const Motion& motion, double from, double to, double start) {
  const double length = to - from;
  const double wished = length * std::max(per_window * system_.windows_per_period(), per_period);
  const auto count = static_cast<std::size_t>(std::clamp(wished, least_samples, most_samples));
  State state(2 * static_cast<std::size_t>(system_.model().size()));
  dense_t_.clear();
  for (std::vector<double>& column : dense_) column.clear();
  for (std::size_t i = 0; i <= count; ++i) {
    const double t = from + length * static_cast<double>(i) / static_cast<double>(count);
    const double within = std::clamp((t - start) * system_.period(), 0.0, motion.segment().duration);
    if (shown_.observer) motion.sample(within, state);
    const std::vector<double> all = numbers(Instant{from_.period, 0.0}.plus(t), state, reader_.within(motion, within));
    dense_t_.push_back(t);
    for (std::size_t k = 0; k < dense_.size(); ++k) {
      const double value = all[k];
      dense_[k].push_back(value);
      least_[k] = std::min(least_[k], value);
      greatest_[k] = std::max(greatest_[k], value);
    }
  }
}

/// Splits a piece where it is farthest from its chord, until nowhere is far.
void MotionRecord::keep_bends(std::size_t first, std::size_t last, std::vector<bool>& kept) const {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    kept[a] = kept[b] = true;
    double farthest = tolerance;
    std::size_t at = a;
    for (std::size_t k = 0; k < dense_.size(); ++k) {
      const double extent = greatest_[k] - least_[k];
      if (!(extent > 0.0)) continue;
      const std::vector<double>& y = dense_[k];
      const double slope = (y[b] - y[a]) / static_cast<double>(b - a);
      for (std::size_t i = a + 1; i < b; ++i) {
        const double off = std::abs(y[i] - y[a] - slope * static_cast<double>(i - a)) / extent;
        if (off > farthest) farthest = off, at = i;
      }
    }
    if (at == a) continue;
    open.emplace_back(a, at);
    open.emplace_back(at, b);
  }
}

void MotionRecord::note_phase(ModeId mode, double from, double to) {
  const Phase now = phase(mode);
  if (now == Phase::apart) return;
  constexpr double one_stretch = 1e-9;
  if (!stretches_.empty() && stretches_.back().phase == now && from - stretches_.back().to < one_stretch) {
    stretches_.back().to = to;
  } else {
    stretches_.push_back({now, from, to, {}, {}});
    for (const std::vector<double>& column : dense_) stretches_.back().start.push_back(column.front());
  }
  stretches_.back().finish.clear();
  for (const std::vector<double>& column : dense_) stretches_.back().finish.push_back(column.back());
}

void MotionRecord::add_segment(const Motion& motion) {
  const Motion::Segment segment = motion.segment();
  const double start = time(segment.start), end = start + segment.duration / system_.period();
  const double from = std::max(start, covered_), to = std::min(end, time(to_));
  if (!(to > from)) return;
  covered_ = to;
  read(motion, from, to, start);
  const std::size_t last = dense_t_.size() - 1;
  std::vector<bool> kept(dense_t_.size(), false);
  for (std::size_t piece = 0; piece < pieces; ++piece)
    keep_bends(piece * last / pieces, (piece + 1) * last / pieces, kept);
  for (std::size_t i = 0; i <= last; ++i) {
    if (!kept[i]) continue;
    t_.push_back(dense_t_[i]);
    for (std::size_t k = 0; k < dense_.size(); ++k) values_[k].push_back(dense_[k][i]);
  }
  note_phase(segment.mode, from, to);
}

/// Takes back how the instant's earlier events went on.
void MotionRecord::join_jumps(const std::vector<double>& after) {
  t_.resize(points_);
  for (std::vector<double>& column : values_) column.resize(points_);
  const auto first = moments_.begin() + static_cast<std::ptrdiff_t>(first_moment_);
  moments_.erase(std::remove_if(first, moments_.end(), [](const Moment& one) { return !one.ours; }), moments_.end());
  for (std::size_t k = first_moment_; k < moments_.size(); ++k) moments_[k].after = after;
}

/// Events at one instant are one jump: what is between them is no motion.
void MotionRecord::add_event(const Motion& motion) {
  const Event& event = motion.event();
  if (event.time < from_ || event.time > to_) return;
  const auto state = motion.before();
  const bool known =
      event.kind == EventKind::impact || event.kind == EventKind::graze || event.kind == EventKind::chatter;
  const bool ours = known && ranges::find(shown_.contacts, event.contact) != shown_.contacts.end();
  Moment moment{event.kind, ours, time(event.time),
                numbers(event.time, State(state.begin(), state.end()), reader_.before(motion)),
                numbers(event.time, motion.state(), reader_.now(motion))};
  if (instant_ != event.time) {
    instant_ = event.time;
    before_ = moment.before;
    points_ = t_.size();
    first_moment_ = moments_.size();
  }
  moment.before = before_;
  join_jumps(moment.after);
  const bool jumps = apart(moment.before, moment.after);
  if (jumps && !t_.empty()) push(lifted, std::vector<double>(shown_.numbers.size(), lifted));
  if (jumps) push(moment.t, moment.after);
  if (jumps || ours) moments_.push_back(std::move(moment));
}

}  // namespace slapstick::app
