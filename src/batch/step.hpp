#pragma once
/// One step of all lanes: a flight, then cuts, jumps and the modes that may follow. No lane waits for another.
#include "batch/carry.hpp"

namespace slapstick::batch {
namespace {

/// A window that has been halved so often is in doubt.
constexpr double most_halvings = 6.0;
/// No window is shorter, in units of the mode's.
constexpr double least_scale = 0x1p-40;

template <int width, int n, bool tangents>
class Step : Carry<width, n> {
  using Base = Carry<width, n>;
  using Real = typename Base::Real;
  using Mask = typename Base::Mask;
  using Base::action_, Base::all, Base::at_, Base::block_, Base::doubtful_, Base::fraction_, Base::halve_, Base::follow,
      Base::impact_, Base::lanes_of, Base::next_, Base::occupied_, Base::of, Base::p_, Base::period_, Base::reached_,
      Base::slots_, Base::take_phase, Base::take_words, Base::tried_, Base::u_, Base::window_, Base::winner_,
      Base::word, Base::x_;

 public:
  __attribute__((always_inline)) explicit Step(Block& block) : Base(block) {}

  /// @returns true if a lane needs the caller
  __attribute__((always_inline)) bool run() {
    if (!block_.in_phase) look_up_phase();
    Base::fly();
    take_phase();
    block_.events = block_.cuts = block_.doubtful = block_.wanting = 0;
    const Real tries = choose(halve_, load<Real>(block_.tries) + 1.0, Real{});
    doubtful_ = doubtful_ | (halve_ & less(all(most_halvings - 0.5), tries));
    halve_ = halve_ & ~doubtful_;
    moved_ = occupied_ & ~halve_ & ~doubtful_;
    reached_ = reached_ & moved_;
    look_at_cuts();
    if constexpr (tangents) Base::carry(shown_);
    happen();
    keep(tries);
    return (block_.events | block_.cuts | block_.doubtful | block_.wanting) != 0;
  }

  /// Chooses the modes of lanes that start. @returns true if a lane needs the caller
  __attribute__((always_inline)) bool begin() {
    from_bits(occupied_, block_.occupied);
    for (int i = 0; i < n; ++i) {
      p_[i] = load<Real>(block_.p[i]);
      u_[i] = load<Real>(block_.u[i]);
    }
    fraction_ = load<Real>(block_.fraction);
    for (unsigned left = block_.starting; left != 0; left &= left - 1)
      action_[__builtin_ctz(left)] = &block_.start[__builtin_ctz(left)];
    block_.events = block_.cuts = block_.wanting = 0;
    take_phase();
    block_.doubtful = follow(block_.starting);
    const unsigned begun = block_.starting & ~(block_.doubtful | block_.wanting);
    for (unsigned left = begun; left != 0; left &= left - 1)
      block_.mode[__builtin_ctz(left)] = next_[__builtin_ctz(left)];
    if constexpr (tangents) Base::begin_tangents(begun);
    block_.starting = block_.wanting;
    return (block_.doubtful | block_.wanting) != 0;
  }

 private:
  /// Of lanes that have been set by the caller.
  __attribute__((noinline)) void look_up_phase() {
    fraction_ = load<Real>(block_.fraction);
    take_phase();
    Base::keep_phase(~of(0));
    block_.in_phase = true;
  }

  /// A lane whose cut lies before what it has reached is shown there, and stays at its window's start: a cut changes
  /// nothing.
  __attribute__((always_inline)) void look_at_cuts() {
    const Real period = load<Real>(block_.cut_period), fraction = load<Real>(block_.cut_fraction);
    const Mask cut = moved_ & (less(period, period_) | (equal(period, period_) & less(fraction, fraction_)));
    block_.cuts = bits(cut);
    shown_ = x_;
    if (block_.cuts == 0) return;
    const Real since = (period - load<Real>(block_.period)) + (fraction - load<Real>(block_.fraction));
    const Real x = smaller(larger(since / (word(Layout::window_periods) * window_.scale), Real{}), x_);
    Real p[n], u[n];
    window_.state_at(x, p, u);
    for (int i = 0; i < n; ++i) {
      store<Real>(block_.at_p[i], p[i]);
      store<Real>(block_.at_u[i], u[i]);
    }
    shown_ = choose(cut, x, x_);
    moved_ = moved_ & ~cut;
    reached_ = reached_ & ~cut;
  }

  /// Jumps of all lanes at an event, then their modes.
  __attribute__((always_inline)) void happen() {
    unsigned lanes = bits(reached_);
    tried_ = 0;
    if (lanes == 0) return;
    find_actions(lanes);
    speed_ = Real{};
    if constexpr (tangents) Base::leave_mode();
    unsigned refused = untouched(lanes);
    for (unsigned left = lanes; left != 0;) {
      const Action& action = *action_[__builtin_ctz(left)];
      const unsigned same = left & lanes_of(jumps_, action.key());
      left &= ~same;
      refused |= jump(action, same);
    }
    refused |= follow(lanes & ~refused);
    if constexpr (tangents) Base::enter_mode(lanes & ~(refused | block_.wanting), next_);
    doubtful_ = doubtful_ | of(refused);
  }

  __attribute__((always_inline)) void find_actions(unsigned lanes) {
    alignas(64) double winner[most_lanes];
    store<Real>(winner, winner_);
    Mask upper = occupied_ & ~occupied_;
    for (int s = 0; s < Base::used_; ++s) upper = upper | (equal(winner_, all(s)) & less(Real{}, slots_[s].side));
    const unsigned high = bits(upper), by_gap = bits(impact_);
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int l = __builtin_ctz(left), s = static_cast<int>(winner[l]);
      const int side = (by_gap >> l & 1U) != 0 ? at_gap : (high >> l & 1U) != 0 ? at_upper : at_lower;
      action_[l] = &block_.action[(block_.mode[l] * at_.slots + s) * sides + side];
      jumps_[l] = action_[l]->key();
      block_.event_mode[l] = block_.mode[l];
      block_.event_slot[l] = s;
      block_.event_side[l] = side;
    }
  }

  /// Lanes in which an open stop that no slot watches is in contact: one that rests there, and that any event may
  /// close.
  __attribute__((always_inline)) unsigned untouched(unsigned lanes) const {
    unsigned refused = 0;
    for (int i = 0; i < n; ++i)
      for (unsigned zero = bits(equal(p_[i], Real{})) & lanes; zero != 0; zero &= zero - 1) {
        const int l = __builtin_ctz(zero);
        if ((block_.open[block_.mode[l]] >> i & 1U) != 0) refused |= 1U << l;
      }
    return refused;
  }

  /// @returns the lanes that Motion is asked for
  __attribute__((always_inline)) unsigned jump(const Action& action, unsigned lanes) {
    const Mask mine = of(lanes);
    for (int i = 0; i < n; ++i) {
      if (i != action.own) continue;
      const Real w = u_[i] * static_cast<double>(action.sign);
      switch (action.jump) {
        case Jump::none:
          break;
        case Jump::leave_it:
          return lanes;
        case Jump::velocity_zero:
          u_[i] = choose(mine, Real{}, u_[i]);
          break;
        case Jump::gap_zero:
          speed_ = choose(mine, w, speed_);
          p_[i] = choose(mine, Real{}, p_[i]);
          break;
        case Jump::force_zero:
          speed_ = choose(mine, w, speed_);
          set_force_zero(i, load<Real>(block_.zero_force_rate[action.stop]) * p_[i], mine);
          break;
        case Jump::impact:
          return strike(action, i, w, mine);
      }
    }
    return action.jump == Jump::leave_it ? lanes : 0;
  }

  /// Makes the force exactly zero, where that is no more than rounding (Engine::set_force_zero).
  __attribute__((always_inline)) void set_force_zero(int own, const Real& exact, const Mask& mine) {
    const Mask far = less(magnitude(u_[own]) * 0x1p-40, magnitude(exact - u_[own]));
    u_[own] = choose(mine & ~far, exact, u_[own]);
  }

  __attribute__((always_inline)) unsigned strike(const Action& action, int own, const Real& w, const Mask& mine) {
    speed_ = choose(mine, w, speed_);
    for (int j = 0; j < n; ++j)
      u_[j] = choose(mine,
                     j == own ? -(load<Real>(block_.restitution[action.stop]) * w) * static_cast<double>(action.sign)
                              : u_[j] + load<Real>(block_.impulse[action.stop][j]) * w,
                     u_[j]);
    p_[own] = choose(mine, Real{}, p_[own]);
    if constexpr (tangents) Base::strike_tangent(action, own, mine);
    struck_ = struck_ | mine;
    return bits(mine & ~less(window_.size * word(Layout::chatter), load<Real>(block_.restitution[action.stop]) * w));
  }

  /// Stores what has moved.
  __attribute__((always_inline)) void keep(const Real& tries) {
    const unsigned stay = bits(doubtful_) | block_.wanting;
    block_.doubtful = bits(doubtful_);
    block_.wanting &= ~block_.doubtful;
    if ((stay & tried_) != 0) take_words(stay & tried_, block_.mode);
    const Mask go = moved_ & ~of(stay), ended = reached_ & go, hit = struck_ & ended;
    for (int i = 0; i < n; ++i) {
      store<Real>(block_.p[i], choose(go, p_[i], load<Real>(block_.p[i])));
      store<Real>(block_.u[i], choose(go, u_[i], load<Real>(block_.u[i])));
    }
    Base::keep_phase(go);
    store<Real>(block_.fraction, choose(go, fraction_, load<Real>(block_.fraction)));
    store<Real>(block_.period, choose(go, period_, load<Real>(block_.period)));
    const Real grown = smaller(all(1.0), larger(window_.scale * choose(ended, x_ * 32.0, all(16.0)), all(least_scale)));
    store<Real>(block_.scale, choose(go, grown, choose(halve_, window_.scale * 0.5, window_.scale)));
    store<Real>(block_.tries, choose(halve_, tries, choose(go, Real{}, load<Real>(block_.tries))));
    store<Real>(block_.impacts, choose(hit, load<Real>(block_.impacts) + 1.0, load<Real>(block_.impacts)));
    store<Real>(block_.speeds, choose(hit, load<Real>(block_.speeds) + speed_, load<Real>(block_.speeds)));
    store<Real>(block_.seen, choose(ended, load<Real>(block_.seen) + 1.0, load<Real>(block_.seen)));
    if constexpr (tangents) Base::keep_tangents(go);
    const unsigned events = bits(ended);
    for (unsigned left = events; left != 0; left &= left - 1)
      block_.mode[__builtin_ctz(left)] = next_[__builtin_ctz(left)];
    block_.events = events & block_.watched;
    if (block_.events != 0) store<Real>(block_.event_speed, speed_);
    ++block_.steps;
    block_.lane_steps += __builtin_popcount(block_.occupied);
    block_.halved += __builtin_popcount(bits(halve_));
  }

  int jumps_[most_lanes] = {};  ///< what happens to each lane
  Mask moved_, struck_ = of(0);
  Real speed_ = Real{};
  Real shown_;  ///< where each lane has come to, or its cut
};

}  // namespace
}  // namespace slapstick::batch
