#pragma once
/// The flight part of a step, for all lanes: window, slots, the first of their zeros, the state there. What happens
/// at it is step.hpp's.
#include "batch/slot.hpp"

namespace slapstick::batch {
namespace {

template <int width, int n>
class Flight {
 public:
  using Real = typename Lanes<width>::Real;
  using Mask = typename Lanes<width>::Mask;

  __attribute__((always_inline)) explicit Flight(Block& block) : block_(block), at_(block.layout) {}

  /// Afterwards x_ is where each lane has come to: `reached_` an event, or the end of what its window shows. Lanes
  /// of `halve_` and `doubtful_` stay.
  __attribute__((always_inline)) void fly() {
    from_bits(occupied_, block_.occupied);
    window_.make(block_);
    first_slot();
    first_gap();
    refine();
    arrive();
  }

 protected:
  static inline __attribute__((always_inline)) Real all(double x) { return Real{} + x; }
  __attribute__((always_inline)) Real word(int i) const { return load<Real>(block_.active[i]); }

  /// All slots; the part of the window that all are decided in; which comes first to a limit.
  __attribute__((always_inline)) void first_slot() {
    place_ = end_ = all(1.0);
    winner_ = all(-1.0);
    halve_ = doubtful_ = occupied_ & ~occupied_;
    used_ = block_.filled;
    while (used_ > 0 && !any(less(Real{}, word(at_.slot_number(used_ - 1, Layout::norm))) & occupied_)) --used_;
    for (int s = 0; s < used_; ++s) {
      slots_[s].make(block_, window_, s);
      end_ = choose(slots_[s].there, smaller(end_, slots_[s].end), end_);
      halve_ = halve_ | (slots_[s].undecided & slots_[s].there);
      doubtful_ = doubtful_ | slots_[s].doubtful;
    }
    doubtful_ = doubtful_ & occupied_;
    place_ = end_;
    for (int s = 0; s < used_; ++s) {
      const Mask sooner = slots_[s].hit & less(slots_[s].root, place_);
      place_ = choose(sooner, slots_[s].root, place_);
      winner_ = choose(sooner, all(s), winner_);
    }
    reached_ = less(all(-0.5), winner_) & ~halve_ & ~doubtful_ & occupied_;
  }

  /// A gap that falls as long as its slot is positive closes before `place_` if it is negative there.
  __attribute__((always_inline)) void first_gap() {
    impact_ = occupied_ & ~occupied_;
    gap_noise_ = all(1.0) * (window_.scale * longest_window + 4.0) * (window_.scale * growth + 1.0) * step_rounding *
                 window_.size * 8.0;
    for (int s = 0; s < used_; ++s) {
      const Mask linked = less(all(0.5), word(at_.slot_number(s, Layout::linked))) & occupied_ & ~halve_ & ~doubtful_;
      if (!any(linked)) continue;
      const Real gap = gap_at(s, place_);
      const Mask closed = linked & less(gap, -gap_noise_);
      halve_ = halve_ | (linked & ~closed & ~less(gap_noise_, gap));
      if (any(closed)) close(s, closed, gap);
    }
    reached_ = (reached_ | impact_) & ~halve_;
    impact_ = impact_ & ~halve_;
  }

  __attribute__((always_inline)) Real gap_at(int s, const Real& x) const {
    Real gap = Real{}, p[n];
    values_at<n>(window_.p, x, p);
    for (int i = 0; i < n; ++i) gap = gap + word(at_.gap(s) + i) * p[i];
    return gap;
  }

  /// About where: from the cubic through both ends with the slopes there, two steps of Newton's method on the
  /// integral of the slot's hull. The slot is minus the gap's rate.
  __attribute__((always_inline)) void close(int s, const Mask& closed, const Real& gap) {
    const auto& slot = slots_[s];
    Real before = Real{}, slope = Real{};
    for (int i = 0; i < n; ++i) {
      before = before + word(at_.gap(s) + i) * window_.p[i][0];
      slope = slope + word(at_.gap(s) + i) * window_.p[i][1];
    }
    const Real D = place_, change = gap - before, m0 = slope * D, m1 = -(slot.about(D) * window_.H * D);
    const Real c2 = 3.0 * change - (m0 + m0 + m1), c3 = m0 + m1 - (change + change);
    const Real t = -before / change, f = ((c3 * t + c2) * t + m0) * t + before, f1 = (3.0 * c3 * t + c2 + c2) * t + m0,
               f2 = 3.0 * c3 * t + c2;
    Real x = inside(t - f * f1 / (f1 * f1 - f * f2), all(1.0)) * D;
    for (int k = 0; k < 2; ++k)
      x = inside(x + (before - window_.H * slot.integral(x)) / (window_.H * slot.about(x)), D);
    const Mask sooner = closed & (~impact_ | less(x, guess_));
    guess_ = choose(sooner, x, guess_);
    winner_ = choose(sooner, all(s), winner_);
    impact_ = impact_ | closed;
  }
  static inline __attribute__((always_inline)) Real inside(const Real& x, const Real& most) {
    return smaller(larger(x, Real{}), most);
  }

  /// Halley's iteration on the whole series of what comes first, and the proof that nothing comes before.
  __attribute__((always_inline)) void refine() {
    x_ = end_;
    if (!any(reached_)) return;
    Falling f;
    gather(f);
    Real x = choose(impact_, guess_, place_);
    Mask open = reached_;
    Jet<Real> jet{all(1.0), all(1.0), Real{}};
    for (int k = 0; k < 8 && any(open); ++k) {
      Jet<Real> now;
      jet_at(f.h, x, now);
      now = {-(f.side * now.value), -(f.side * now.slope), -(f.side * now.half_bend)};
      jet = {choose(open, now.value, jet.value), choose(open, now.slope, jet.slope),
             choose(open, now.half_bend, jet.half_bend)};
      const Real move = now.value * now.slope / (now.slope * now.slope - now.value * now.half_bend);
      x = choose(open, x - move, x);
      open = open & ~less(magnitude(move), x * 0x1p-17);  // cubic: the next error is below rounding
    }
    const Real z = window_.scale * longest_window, third = f.size * z * z * z * (window_.scale * growth + 1.0);
    const Real reach = 2.0 * f.error / magnitude(jet.slope);
    const Real flat = reach * magnitude(jet.half_bend) * 2.0 + reach * reach * third * 0.5 + f.noise * 64.0;
    Mask proven = reached_ & ~open & less(Real{}, x) & ~less(end_, x) & less(2.0 * flat, -jet.slope);
    const Mask by_hull = ~less(Real{}, x - reach) | less(Real{}, above_winner(x - reach));
    proven = proven & (impact_ | by_hull);
    halve_ = halve_ | (reached_ & ~proven);
    reached_ = reached_ & proven;
    impact_ = impact_ & proven;
    x_ = choose(reached_, x, end_);
  }

  /// Each lane's event is the zero of -side h, positive at the start: of a slot's series less its limit, or of a gap's
  /// series with side -1. With the errors of its hull and its rounding.
  struct Falling {
    Real h[terms], side, error, noise, size;
  };
  __attribute__((always_inline)) void gather(Falling& to) const {
    to.side = all(-1.0);
    Real limit = Real{};
    to.error = all(1.0);
    to.noise = gap_noise_;
    to.size = all(1.0);
    bool begun = false;
    for (int s = 0; s < used_; ++s) {
      const auto& slot = slots_[s];
      const Mask mine = equal(winner_, all(s)) & reached_, by_gap = mine & impact_, by_slot = mine & ~impact_;
      if (!any(mine)) continue;
      to.side = choose(by_slot, slot.side, to.side);
      limit = choose(by_slot, slot.side * slot.limit, limit);
      to.error = choose(by_slot, slot.error, choose(by_gap, gap_noise_, to.error));
      to.noise = choose(by_slot, slot.noise, to.noise);
      to.size = choose(by_slot, slot.size, choose(by_gap, window_.size, to.size));
      take_series(to.h, s, by_gap, mine, begun);
      begun = true;
    }
    to.h[0] = to.h[0] - limit;
  }

  __attribute__((always_inline)) void take_series(Real (&h)[terms], int s, const Mask& by_gap, const Mask& mine,
                                                  bool begun) const {
    const bool gaps = any(by_gap);
    Real row[n];
    for (int i = 0; i < n; ++i) row[i] = word(at_.gap(s) + i);
    for (int m = 0; m < terms; ++m) {
      Real a = slots_[s].series[m];
      if (gaps) {
        Real gap = row[0] * window_.p[0][m];
        for (int i = 1; i < n; ++i) gap = gap + row[i] * window_.p[i][m];
        a = choose(by_gap, gap, a);
      }
      h[m] = begun ? choose(mine, a, h[m]) : a;
    }
  }

  __attribute__((always_inline)) Real above_winner(const Real& x) const {
    Real above = all(1.0);
    for (int s = 0; s < used_; ++s) {
      const Mask mine = equal(winner_, all(s)) & reached_ & ~impact_;
      if (any(mine)) above = choose(mine, slots_[s].above(x), above);
    }
    return above;
  }

  /// The state at x_, and what else must not have happened up to there: other slots at their limits, gaps that fall
  /// with slots.
  __attribute__((always_inline)) void arrive() {
    window_.state_at(x_, p_, u_);
    for (int s = 0; s < used_; ++s) {
      const Mask winner = equal(winner_, all(s)) & reached_;
      const Mask other = slots_[s].hit & ~(winner & ~impact_);
      if (any(other)) halve_ = halve_ | (other & ~less(Real{}, slots_[s].above(x_)));
      const Mask linked = less(all(0.5), word(at_.slot_number(s, Layout::linked))) & ~(winner & impact_);
      if (!any(linked)) continue;
      Real gap = Real{};
      for (int i = 0; i < n; ++i) gap = gap + word(at_.gap(s) + i) * p_[i];
      halve_ = halve_ | (linked & ~less(gap_noise_, gap));
    }
    halve_ = halve_ & occupied_ & ~doubtful_;
    reached_ = reached_ & ~halve_;
    impact_ = impact_ & ~halve_;
    const Real later = load<Real>(block_.fraction) + x_ * word(Layout::window_periods) * window_.scale,
               whole = floor_of(later);
    fraction_ = later - whole;
    period_ = load<Real>(block_.period) + whole;
  }

  Block& block_;
  const Layout& at_;
  Window<width, n> window_;
  SlotWindow<width> slots_[most_slots];
  int used_ = 0;  ///< slots that some lane has
  Mask occupied_, halve_, doubtful_, reached_, impact_;
  Real place_, end_, winner_, guess_ = Real{}, gap_noise_, x_;
  Real p_[n], u_[n], fraction_, period_;
};

}  // namespace
}  // namespace slapstick::batch
