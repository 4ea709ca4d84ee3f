#pragma once
/// The tangent vector of each lane: along the leg that has been flown, through the event at its end (the saltation of
/// flow/saltation.hpp), and kept near one by powers of two.
#include "batch/follow.hpp"

namespace slapstick::batch {
namespace {

/// delta(z) = exp(A H z) delta(0), z the fraction of the mode's window: Taylor's series of the motion without forces,
/// for displacements and H times velocities.
template <int n, class Real>
static __attribute__((noinline)) void flow_tangent(const Block& block, const Real& z, Real (&p)[n], Real (&v)[n]) {
  const Layout& at = block.layout;
  Real K[n][n], C[n][n], term_p[n], term_v[n];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      K[i][j] = load<Real>(block.active[at.row(i) + j]);
      C[i][j] = load<Real>(block.active[at.row(i) + n + j]);
    }
    term_p[i] = p[i];
    term_v[i] = v[i];
  }
  for (int m = 1; m < terms; ++m) {
    const Real step = z * tables.inverse[m];
    Real next[n];
    for (int i = 0; i < n; ++i) {
      Real still = K[i][0] * term_p[0], moving = C[i][0] * term_v[0];
      for (int j = 1; j < n; ++j) {
        still = still + K[i][j] * term_p[j];
        moving = moving + C[i][j] * term_v[j];
      }
      next[i] = (still + moving) * step;
    }
    for (int i = 0; i < n; ++i) {
      term_p[i] = term_v[i] * step;
      term_v[i] = next[i];
      p[i] = p[i] + term_p[i];
      v[i] = v[i] + term_v[i];
    }
  }
}

template <int width, int n>
class Carry : public Follow<width, n> {
  using Base = Follow<width, n>;

 public:
  using Real = typename Base::Real;
  using Mask = typename Base::Mask;

  __attribute__((always_inline)) explicit Carry(Block& block) : Base(block) {}

 protected:
  using Base::all, Base::at_, Base::block_, Base::impact_, Base::of, Base::p_, Base::reached_, Base::u_, Base::window_,
      Base::winner_, Base::word;

  /// To x of the window, in the mode of the window; shown to lanes at a cut.
  __attribute__((always_inline)) void carry(const Real& x) {
    const Real H = word(Layout::window), inverse = 1.0 / H;
    for (int i = 0; i < n; ++i) {
      dp_[i] = load<Real>(block_.dp[i]);
      du_[i] = load<Real>(block_.du[i]) * H;
    }
    flow_tangent<n>(block_, x * window_.scale, dp_, du_);
    for (int i = 0; i < n; ++i) {
      du_[i] = du_[i] * inverse;
      store<Real>(block_.at_dp[i], dp_[i]);
      store<Real>(block_.at_du[i], du_[i]);
    }
  }

  /// dt = -(h delta) / h', and delta + f dt with the field f before the event. In the mode that ends, before its jump.
  __attribute__((always_inline)) void leave_mode() {
    const Real H = word(Layout::window);
    Real velocity[n], acceleration[n], delta[n];
    accelerations(H, velocity, acceleration);
    for (int i = 0; i < n; ++i) delta[i] = du_[i] * H;
    Real change = Real{}, rate = all(1.0);
    for (int s = 0; s < Base::used_; ++s) {
      const Mask mine = equal(winner_, all(s)) & reached_, by_gap = mine & impact_;
      if (!any(mine)) continue;
      Real h = Real{}, gap = Real{}, gap_rate = Real{};
      for (int i = 0; i < n; ++i) {
        h = h + word(at_.slot(s) + i) * dp_[i] + word(at_.slot(s) + n + i) * delta[i];
        gap = gap + word(at_.gap(s) + i) * dp_[i];
        gap_rate = gap_rate + word(at_.gap(s) + i) * (velocity[i] + word(at_.drift(i)));
      }
      change = choose(mine, choose(by_gap, gap, h), change);
      rate = choose(mine, choose(by_gap, gap_rate, Base::rate_of(at_.slot(s), velocity, acceleration)), rate);
    }
    const Real windows = choose(equal(rate, Real{}), Real{}, -change / rate);
    for (int i = 0; i < n; ++i) {
      dp_[i] = dp_[i] + (velocity[i] + word(at_.drift(i))) * windows;
      du_[i] = (delta[i] + acceleration[i] * windows) / H;
    }
    time_ = windows * H;
  }

  /// An impact is linear in the velocities.
  __attribute__((always_inline)) void strike_tangent(const Action& action, int own, const Mask& mine) {
    const Real w = du_[own] * static_cast<double>(action.sign);
    for (int j = 0; j < n; ++j) {
      const Real struck = j == own ? -(load<Real>(block_.restitution[action.stop]) * du_[own])
                                   : du_[j] + load<Real>(block_.impulse[action.stop][j]) * w;
      du_[j] = choose(mine, struck, du_[j]);
    }
  }

  /// delta - f dt with the field f of the mode that follows; what that mode holds still is exactly zero.
  __attribute__((always_inline)) void enter_mode(unsigned lanes, const int (&modes)[most_lanes]) {
    const Real H = word(Layout::window), windows = time_ / H;
    Real velocity[n], acceleration[n];
    accelerations(H, velocity, acceleration);
    for (int i = 0; i < n; ++i) {
      dp_[i] = choose(reached_, dp_[i] - (velocity[i] + word(at_.drift(i))) * windows, dp_[i]);
      du_[i] = choose(reached_, du_[i] - acceleration[i] * windows / H, du_[i]);
    }
    hold_still(lanes, modes);
  }

  /// Of lanes that start: what the first mode holds still.
  __attribute__((always_inline)) void begin_tangents(unsigned lanes) {
    for (int i = 0; i < n; ++i) {
      dp_[i] = load<Real>(block_.dp[i]);
      du_[i] = load<Real>(block_.du[i]);
    }
    hold_still(lanes, block_.mode);
    for (int i = 0; i < n; ++i) {
      store<Real>(block_.dp[i], dp_[i]);
      store<Real>(block_.du[i], du_[i]);
    }
  }

  /// Stores the tangents of lanes that go on.
  __attribute__((always_inline)) void keep_tangents(const Mask& go) {
    constexpr double bits = 64.0, many = 0x1p64, few = 0x1p-64;
    Real size = Real{};
    for (int i = 0; i < n; ++i) size = larger(size, larger(magnitude(dp_[i]), magnitude(du_[i])));
    const Mask large = less(all(many), size), small = less(size, all(few)) & less(Real{}, size);
    const Real factor = choose(large, all(few), choose(small, all(many), all(1.0)));
    const Real power = load<Real>(block_.power) + choose(large, all(bits), choose(small, all(-bits), Real{}));
    for (int i = 0; i < n; ++i) {
      store<Real>(block_.dp[i], choose(go, dp_[i] * factor, load<Real>(block_.dp[i])));
      store<Real>(block_.du[i], choose(go, du_[i] * factor, load<Real>(block_.du[i])));
    }
    store<Real>(block_.power, choose(go, power, load<Real>(block_.power)));
  }

 private:
  /// H u and H^2 u' in the present mode.
  __attribute__((always_inline)) void accelerations(const Real& H, Real (&velocity)[n], Real (&acceleration)[n]) const {
    for (int i = 0; i < n; ++i) velocity[i] = u_[i] * H;
    for (int i = 0; i < n; ++i) acceleration[i] = Base::product(at_.row(i), velocity);
  }

  __attribute__((always_inline)) void hold_still(unsigned lanes, const int (&modes)[most_lanes]) {
    unsigned p[n] = {}, u[n] = {};
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int l = __builtin_ctz(left), still = block_.still[modes[l]];
      for (int i = 0; i < n; ++i) {
        u[i] |= static_cast<unsigned>(still >> i & 1) << l;
        p[i] |= static_cast<unsigned>(still >> (most_coordinates + i) & 1) << l;
      }
    }
    for (int i = 0; i < n; ++i) {
      dp_[i] = choose(of(p[i]), Real{}, dp_[i]);
      du_[i] = choose(of(u[i]), Real{}, du_[i]);
    }
  }

  Real dp_[n], du_[n], time_;
};

}  // namespace
}  // namespace slapstick::batch
