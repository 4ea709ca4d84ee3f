#pragma once
/// The modes that may follow an event, for all lanes: each lane tries the candidates of what has ended its mode.
#include "batch/flight.hpp"

namespace slapstick::batch {
namespace {

template <int width, int n>
class Follow : public Flight<width, n> {
  using Base = Flight<width, n>;

 public:
  using Real = typename Base::Real;
  using Mask = typename Base::Mask;

  __attribute__((always_inline)) explicit Follow(Block& block) : Base(block) {}

 protected:
  using Base::all, Base::at_, Base::block_, Base::fraction_, Base::occupied_, Base::p_, Base::u_, Base::word;

  static inline __attribute__((always_inline)) Mask of(unsigned lanes) {
    Mask mask;
    from_bits(mask, lanes);
    return mask;
  }

  /// The first mode of each lane's candidates that nothing refuses, from the streams that `take_phase` has made.
  /// @returns the lanes that have none
  __attribute__((always_inline)) unsigned follow(unsigned lanes) {
    unsigned refused = 0;
    for (int c = 0; lanes != 0; ++c) {
      for (unsigned left = lanes; left != 0; left &= left - 1) {
        const int l = __builtin_ctz(left);
        const unsigned bit = 1U << l;
        if (c >= action_[l]->candidates) {
          refused |= bit;
          lanes &= ~bit;
          continue;
        }
        const int mode = action_[l]->candidate[c];
        if (block_.ready[mode * most_lanes + l] == 0) {
          block_.wanting |= bit;
          block_.wanted[l] = mode;
          lanes &= ~bit;
          continue;
        }
        next_[l] = mode;
      }
      if (lanes == 0) break;
      take_words(lanes, next_);
      tried_ |= lanes;
      const Verdict verdict = judge();
      refused |= lanes & bits(verdict.unsure & ~verdict.falls);
      lanes &= bits(verdict.falls);
    }
    return refused;
  }

  /// Lanes whose number is this.
  static inline __attribute__((always_inline)) unsigned lanes_of(const int (&numbers)[most_lanes], int number) {
    unsigned lanes = 0;
    for (int l = 0; l < width; ++l) lanes |= static_cast<unsigned>(numbers[l] == number) << l;
    return lanes;
  }

  /// Makes each lane's words those of its mode. Two modes are taken together; together, three and more cost what they
  /// cost one after another.
  __attribute__((always_inline)) void take_words(unsigned lanes, const int (&modes)[most_lanes]) {
    const Block::Row* from[most_lanes];
    unsigned takers[most_lanes];
    for (int l = 0; l < width; ++l) block_.active_mode[l] = (lanes >> l & 1U) != 0 ? modes[l] : block_.active_mode[l];
    const long size = at_.size();
    int groups = 0, filled = 0;
    for (int l = 0; l < width; ++l) {
      const int slots = block_.slots[block_.active_mode[l]];
      filled = slots > filled ? slots : filled;
    }
    while (lanes != 0) {
      const int mode = modes[__builtin_ctz(lanes)];
      takers[groups] = lanes & lanes_of(modes, mode);
      lanes &= ~takers[groups];
      from[groups++] = block_.all + mode * size;
    }
    // up to the most slots before: a slot that no mode has any more becomes zeros
    const int last = at_.slot(filled > block_.filled ? filled : block_.filled);
    block_.filled = filled;
    if (groups == 2)
      copy_words<2>(last, from, takers);
    else
      for (int g = 0; g < groups; ++g) copy_words<1>(last, from + g, takers + g);
  }

  template <int groups>
  __attribute__((always_inline)) void copy_words(int last, const Block::Row* const* from, const unsigned* takers) {
    for (int w = 0; w < last; ++w) {
      Real number = load<Real>(block_.active[w]);
      for (int g = 0; g < groups; ++g) number = choose(of(takers[g]), load<Real>(from[g][w]), number);
      store<Real>(block_.active[w], number);
    }
  }

  /// Sines and cosines of the streams at fraction_.
  __attribute__((always_inline)) void take_phase() {
    for (int k = 0; k < at_.k; ++k)
      sine_cosine(fraction_, static_cast<double>(block_.harmonic[k]), sine_[k], cosine_[k]);
  }
  /// Keeps those of lanes that go on for their next window.
  __attribute__((always_inline)) void keep_phase(const Mask& go) {
    for (int k = 0; k < at_.k; ++k) {
      store<Real>(block_.sine[k], choose(go, sine_[k], load<Real>(block_.sine[k])));
      store<Real>(block_.cosine[k], choose(go, cosine_[k], load<Real>(block_.cosine[k])));
    }
  }

  __attribute__((always_inline)) Real stream(int k) const { return block_.cosine_of[k] != 0 ? cosine_[k] : sine_[k]; }
  __attribute__((always_inline)) Real stream_rate(int k) const {
    return block_.cosine_of[k] != 0 ? -sine_[k] : cosine_[k];
  }

  /// row . (p, scaled velocities, f, 1)
  __attribute__((always_inline)) Real product(int row, const Real (&velocity)[n]) const {
    Real sum = word(row + 2 * n + at_.k);
    for (int i = 0; i < n; ++i) sum = sum + word(row + i) * p_[i] + word(row + n + i) * velocity[i];
    for (int k = 0; k < at_.k; ++k) sum = sum + word(row + 2 * n + k) * stream(k);
    return sum;
  }

  /// Its derivative along the motion, per window.
  __attribute__((always_inline)) Real rate_of(int row, const Real (&velocity)[n], const Real (&acceleration)[n]) const {
    Real sum = Real{};
    for (int i = 0; i < n; ++i)
      sum = sum + word(row + i) * (velocity[i] + word(at_.drift(i))) + word(row + n + i) * acceleration[i];
    for (int k = 0; k < at_.k; ++k) sum = sum + word(row + 2 * n + k) * stream_rate(k) * word(Layout::rates + k);
    return sum;
  }

  /// Of lanes whose mode may not start, and of those that rounding decides.
  struct Verdict {
    Mask falls, unsure;
  };

  /// A slot refuses a mode by its value; by its rate where the value is zero within rounding (exactly, for a single
  /// number); by its bend where that is zero too. A velocity is a single number: where a force comes to its limit the
  /// velocity and its rate are zero, and its bend says whether slip begins that way. Where the bend is no more than
  /// rounding either, or a force starts at one of two limits, an engine decides.
  __attribute__((always_inline)) Verdict judge() const {
    Real velocity[n], acceleration[n];
    const Real H = word(Layout::window), inverse_speed = word(Layout::inverse_speed);
    Real size = word(Layout::least_size);
    for (int i = 0; i < n; ++i) {
      velocity[i] = u_[i] * H;
      size = larger(size, larger(magnitude(p_[i]), magnitude(u_[i]) * inverse_speed));
    }
    for (int i = 0; i < n; ++i) acceleration[i] = product(at_.row(i), velocity);
    Verdict verdict{occupied_ & ~occupied_, occupied_ & ~occupied_};
    for (int s = 0; s < block_.filled; ++s) {
      const Real norm = word(at_.slot_number(s, Layout::norm));
      if (any(less(Real{}, norm) & occupied_)) judge_slot(s, norm, size, velocity, acceleration, verdict);
    }
    return verdict;
  }

  __attribute__((always_inline)) void judge_slot(int s, const Real& norm, const Real& size, const Real (&velocity)[n],
                                                 const Real (&acceleration)[n], Verdict& verdict) const {
    const Real start_norm = word(at_.slot_number(s, Layout::start_norm));
    const Real lower = word(at_.slot_number(s, Layout::lower)), upper = word(at_.slot_number(s, Layout::upper));
    const Real value = product(at_.slot(s), velocity), margin = smaller(upper - value, value + lower);
    const Real noise = start_norm * size * (24.0 * step_rounding);
    const Mask there = less(Real{}, norm), at_start = there & ~less(2.0 * noise, margin);
    Mask unsure = at_start & ~at_start;
    if (any(at_start)) {
      Real rate = rate_of(at_.slot(s), velocity, acceleration);
      rate = choose(less(upper - value, value + lower), -rate, rate);
      const Real rate_noise = norm * size * (24.0 * longest_window * step_rounding);
      const Mask single = equal(start_norm, Real{}), zero = at_start & ~less(noise, margin) & ~less(margin, -noise);
      const Mask rises = less(2.0 * rate_noise, rate);
      // As a first window would doubt (find_orders). Both compute alike, apart from rounding, which the bounds hold
      // eight times: twice or half of a bound leaves room for that.
      unsure = at_start & ~(rises & equal(upper, all(no_limit)));
      verdict.falls = verdict.falls | (there & less(margin, -noise)) | (zero & less(rate, -rate_noise));
      if (any(unsure & single & ~rises))
        judge_bend(s, velocity, acceleration, zero & single, rate, rate_noise, unsure, verdict.falls);
    }
    verdict.unsure = verdict.unsure | unsure;
    verdict.falls = verdict.falls | (there & touches(s) & ~unsure);
  }

  /// Single numbers that are zero, with a rate that is rounding. Where they bend down the mode falls, a displacement
  /// only if its rate is exactly zero. A gap's bend is an acceleration, a velocity's a jerk.
  __attribute__((noinline)) void judge_bend(int s, const Real (&velocity)[n], const Real (&acceleration)[n],
                                            const Mask& zero, const Real& rate, const Real& rate_noise, Mask& unsure,
                                            Mask& falls) const {
    const Real bend_noise = longest_window * rate_noise;
    Real bend = Real{}, turning = Real{};
    for (int i = 0; i < n; ++i) {
      const Real by_velocity = word(at_.slot(s) + n + i);
      bend = bend + word(at_.slot(s) + i) * acceleration[i] + by_velocity * rate_of(at_.row(i), velocity, acceleration);
      turning = turning + magnitude(by_velocity);
    }
    const Mask level = ~less(rate_noise, magnitude(rate)) & (less(Real{}, turning) | equal(rate, Real{}));
    unsure = unsure & ~(zero & less(-0.5 * rate_noise, rate) & less(4.0 * bend_noise, bend));
    falls = falls | (zero & level & less(bend, -bend_noise));
  }

  /// Lanes whose gap, which falls as long as slot s is positive, is zero already: the mode would push it below zero.
  __attribute__((always_inline)) Mask touches(int s) const {
    const Mask linked = less(all(0.5), word(at_.slot_number(s, Layout::linked)));
    if (!any(linked)) return linked;
    Real gap = Real{};
    for (int i = 0; i < n; ++i) gap = gap + word(at_.gap(s) + i) * p_[i];
    return linked & equal(gap, Real{});
  }

  const Action* action_[most_lanes];  ///< what has ended each lane's mode
  int next_[most_lanes] = {};         ///< the mode that follows
  unsigned tried_ = 0;                ///< lanes whose words are those of a candidate

 private:
  Real sine_[most_streams], cosine_[most_streams];
};

}  // namespace
}  // namespace slapstick::batch
