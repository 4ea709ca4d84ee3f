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
  using Base::at_, Base::block_, Base::fraction_, Base::occupied_, Base::p_, Base::u_, Base::word;

  static inline __attribute__((always_inline)) Mask of(unsigned lanes) {
    Mask mask;
    from_bits(mask, lanes);
    return mask;
  }

  /// The first mode of each lane's candidates that nothing refuses. @returns the lanes that have none
  __attribute__((always_inline)) unsigned follow(unsigned lanes) {
    unsigned refused = 0;
    start_streams();
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

  /// Makes each lane's words those of its mode.
  __attribute__((always_inline)) void take_words(unsigned lanes, const int (&modes)[most_lanes]) {
    const int size = at_.size();
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int slots = block_.slots[modes[__builtin_ctz(left)]];
      block_.filled = slots > block_.filled ? slots : block_.filled;
    }
    const int last = at_.slot(block_.filled);
    while (lanes != 0) {
      const int mode = modes[__builtin_ctz(lanes)];
      unsigned same = 0;
      for (unsigned left = lanes; left != 0; left &= left - 1)
        if (modes[__builtin_ctz(left)] == mode) same |= left & -left;
      lanes &= ~same;
      const Mask mine = of(same);
      const Block::Row* const from = block_.all + static_cast<long>(mode) * size;
      for (int w = 0; w < last; ++w) store<Real>(block_.active[w], choose(mine, load<Real>(from[w]), load<Real>(block_.active[w])));
    }
  }

  __attribute__((always_inline)) void start_streams() {
    for (int k = 0; k < at_.k; ++k) {
      Real sine, cosine;
      sine_cosine(fraction_ * static_cast<double>(block_.harmonic[k]), sine, cosine);
      const bool turned = block_.cosine[k] != 0;
      stream_[k] = turned ? cosine : sine;
      stream_rate_[k] = turned ? -sine : cosine;
    }
  }

  /// row . (p, scaled velocities, f, 1)
  __attribute__((always_inline)) Real product(int row, const Real (&velocity)[n]) const {
    Real sum = word(row + 2 * n + at_.k);
    for (int i = 0; i < n; ++i) sum = sum + word(row + i) * p_[i] + word(row + n + i) * velocity[i];
    for (int k = 0; k < at_.k; ++k) sum = sum + word(row + 2 * n + k) * stream_[k];
    return sum;
  }

  /// Of lanes whose mode may not start, and of those that rounding decides.
  struct Verdict {
    Mask falls, unsure;
  };

  /// A slot refuses a mode by its value; by its rate where the value is zero within rounding (exactly, for a single
  /// number); by its bend where that is zero too. A velocity that is zero, as its rate is within rounding, is left
  /// to the next window: that looks at its bend.
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

  __attribute__((always_inline)) void judge_slot(int s, const Real& norm, const Real& size, const Real (&velocity)[n], const Real (&acceleration)[n],
                                                 Verdict& verdict) const {
    const Real start_norm = word(at_.slot_number(s, Layout::start_norm));
    const Real lower = word(at_.slot_number(s, Layout::lower)), upper = word(at_.slot_number(s, Layout::upper));
    const Real value = product(at_.slot(s), velocity), margin = smaller(upper - value, value + lower);
    const Real noise = start_norm * size * (24.0 * step_rounding), rate_noise = norm * size * (24.0 * longest_window * step_rounding);
    Real rate = Real{}, bend = Real{};
    for (int i = 0; i < n; ++i) {
      const Real over_p = word(at_.slot(s) + i);
      rate = rate + over_p * (velocity[i] + word(at_.drift(i))) + word(at_.slot(s) + n + i) * acceleration[i];
      bend = bend + over_p * acceleration[i];
    }
    for (int k = 0; k < at_.k; ++k) rate = rate + word(at_.slot(s) + 2 * n + k) * stream_rate_[k] * word(Layout::rates + k);
    rate = choose(less(upper - value, value + lower), -rate, rate);
    const Mask there = less(Real{}, norm), single = equal(start_norm, Real{});
    const Mask zero = ~less(noise, margin) & ~less(margin, -noise), drops = less(rate, -rate_noise);
    const Mask flat = zero & single & equal(rate, Real{}), sinks = less(bend, -rate_noise);
    verdict.falls = verdict.falls | (there & (less(margin, -noise) | (zero & drops) | (flat & sinks)));
    verdict.unsure = verdict.unsure | (there & zero & ~single & ~drops & ~less(rate_noise, rate));
  }

  const Action* action_[most_lanes];  ///< what has ended each lane's mode
  int next_[most_lanes];              ///< the mode that follows
  unsigned tried_ = 0;                ///< lanes whose words are those of a candidate

 private:
  Real stream_[most_streams], stream_rate_[most_streams];
};

}  // namespace
}  // namespace slapstick::batch
