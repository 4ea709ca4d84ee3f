#pragma once
/// Real numbers as balls with a midpoint of 256 bits (Arb). Every operation gives a ball that contains the exact
/// result; a comparison is true only if it holds for all numbers of both balls, so that what is not certain counts as
/// false.
#include <arb.h>

#include <vector>

namespace verify {

class Ball {
 public:
  static constexpr slong bits = 256;
  Ball() { arb_init(x_); }
  Ball(double exact) : Ball() { arb_set_d(x_, exact); }
  Ball(const Ball& b) : Ball() { arb_set(x_, b.x_); }
  Ball(Ball&& b) noexcept : Ball() { arb_swap(x_, b.x_); }
  Ball& operator=(Ball b) noexcept { return arb_swap(x_, b.x_), *this; }
  ~Ball() { arb_clear(x_); }

  friend Ball operator+(Ball a, const Ball& b) { return arb_add(a.x_, a.x_, b.x_, bits), a; }
  friend Ball operator-(Ball a, const Ball& b) { return arb_sub(a.x_, a.x_, b.x_, bits), a; }
  friend Ball operator*(Ball a, const Ball& b) { return arb_mul(a.x_, a.x_, b.x_, bits), a; }
  friend Ball operator/(Ball a, const Ball& b) { return arb_div(a.x_, a.x_, b.x_, bits), a; }
  friend Ball operator-(Ball a) { return arb_neg(a.x_, a.x_), a; }
  Ball& operator+=(const Ball& b) { return arb_add(x_, x_, b.x_, bits), *this; }
  Ball& operator-=(const Ball& b) { return arb_sub(x_, x_, b.x_, bits), *this; }
  /// this += a b.
  void add_product(const Ball& a, const Ball& b) { arb_addmul(x_, a.x_, b.x_, bits); }
  friend bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.x_, b.x_) != 0; }
  friend bool operator<=(const Ball& a, const Ball& b) { return arb_le(a.x_, b.x_) != 0; }
  friend bool operator>(const Ball& a, const Ball& b) { return b < a; }
  friend bool operator>=(const Ball& a, const Ball& b) { return b <= a; }
  friend Ball abs(Ball a) { return arb_abs(a.x_, a.x_), a; }
  friend Ball sqrt(Ball a) { return arb_sqrt(a.x_, a.x_, bits), a; }
  /// A ball that contains the greater of the two.
  friend Ball greater(Ball a, const Ball& b) { return arb_max(a.x_, a.x_, b.x_, bits), a; }
  friend Ball power(Ball a, ulong n) { return arb_pow_ui(a.x_, a.x_, n, bits), a; }
  /// A ball that contains both.
  friend Ball united(Ball a, const Ball& b) { return arb_union(a.x_, a.x_, b.x_, bits), a; }
  /// The ball a, widened by the numbers up to |e|.
  friend Ball widen(Ball a, const Ball& e) { return arb_add_error(a.x_, e.x_), a; }
  friend Ball times(Ball a, ulong n) { return arb_mul_ui(a.x_, a.x_, n, bits), a; }
  friend Ball over(Ball a, ulong n) { return arb_div_ui(a.x_, a.x_, n, bits), a; }
  /// cos and sin of pi times a.
  friend void cos_sin_pi(Ball& c, Ball& s, const Ball& a) { arb_sin_cos_pi(s.x_, c.x_, a.x_, bits); }
  friend void cos_sin(Ball& c, Ball& s, const Ball& a) { arb_sin_cos(s.x_, c.x_, a.x_, bits); }
  static Ball pi() {
    Ball a;
    return arb_const_pi(a.x_, bits), a;
  }
  [[nodiscard]] bool is_zero() const { return arb_is_zero(x_) != 0; }
  /// Something near the midpoint, for messages and for choices that need no proof.
  [[nodiscard]] double near() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }

  /// Not below the ball's radius.
  [[nodiscard]] double radius() const {
    Ball r;
    arb_get_rad_arb(r.x_, x_);
    return r.highest();
  }
  /// Doubles that no number of the ball is above, or below.
  [[nodiscard]] double highest() const { return bound(arb_get_ubound_arf, ARF_RND_CEIL); }
  [[nodiscard]] double lowest() const { return bound(arb_get_lbound_arf, ARF_RND_FLOOR); }

  /// The midpoint alone; `off` is raised by what the ball was wide.
  [[nodiscard]] Ball middle(double& off) const {
    Ball m;
    arb_get_mid_arb(m.x_, x_);
    off += radius();
    return m;
  }

  /// e with |midpoint| < 2^e, far below zero for 0. A guide, no bound.
  [[nodiscard]] double exponent() const { return static_cast<double>(arf_abs_bound_lt_2exp_si(arb_midref(x_))); }

  friend Ball dot(const std::vector<Ball>& a, const std::vector<Ball>& b) {
    static_assert(sizeof(Ball) == sizeof(arb_struct));
    Ball sum;
    arb_dot(sum.x_, nullptr, 0, a.front().x_, 1, b.front().x_, 1, static_cast<slong>(a.size()), bits);
    return sum;
  }

 private:
  double bound(void (*of)(arf_t, const arb_t, slong), arf_rnd_t rounding) const {
    arf_t edge;
    arf_init(edge);
    of(edge, x_, bits);
    const double x = arf_get_d(edge, rounding);
    return arf_clear(edge), x;
  }

  arb_t x_;
};

using Balls = std::vector<Ball>;

}  // namespace verify
