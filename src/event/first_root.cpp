/// Finds the first zero of a guard on a window, by bounds alone. Compiled for each instruction set (event/kernels.hpp).
#include "event/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"

namespace slapstick::event {
namespace {

/// More than all that underflow can take from a value and its rounding bound.
constexpr double underflow = 0x1p-1060;

/// An interval [0, end] on which g'' lies in [low, high].
struct Curvature {
  double low, high, end;
};

/// b_{j+1} - b_j of the hull; lane 7 repeats lane 6. g' is near 7 sum_j (b_{j+1} - b_j) B_j.
Lane8 differences(const Lane8& b) {
  const Lane8 next = __builtin_shufflevector(b, b, 1, 2, 3, 4, 5, 6, 7, 7);
  const Lane8 d = next - b;
  return __builtin_shufflevector(d, d, 0, 1, 2, 3, 4, 5, 6, 6);
}

/// sum_n weight(n) |a_n|.
template <class Weight>
double weighted_size(const Coefficients& a, Weight weight) {
  Lane8 size{};
  for (int g = 0; g < 3; ++g) {
    const int n = 8 * g;
    size += magnitude(a[g]) * Lane8{weight(n),     weight(n + 1), weight(n + 2), weight(n + 3),
                                    weight(n + 4), weight(n + 5), weight(n + 6), weight(n + 7)};
  }
  return sum(size);
}

/// sum_{n>2} n (n - 1) |a_n|, which |g'' - 2 a_2| stays below on [0, 1].
double bend_change(Coefficients a) {
  a[0][2] = 0.0;
  return weighted_size(a, [](int n) { return n * (n - 1.0); });
}

/// On the whole window, from the second differences: g'' = 42 sum_j (b_{j+2} - 2 b_{j+1} + b_j) B_j within
/// curvature_error. Where that error outweighs them, as for the small velocities of a quasi-static motion, from the
/// coefficients themselves.
Curvature whole_curvature(const GuardWindow& guard, const Lane8& d) {
  const Lane8 next = __builtin_shufflevector(d, d, 1, 2, 3, 4, 5, 6, 6, 6);
  const Lane8 second = next - d;
  const Lane8 bend = __builtin_shufflevector(second, second, 0, 1, 2, 3, 4, 5, 5, 5);
  const double error = guard.hull.bounds[curvature_error], low = 42.0 * least(bend), high = 42.0 * greatest(bend);
  if (error <= std::max(-low, high)) return {low - error, high + error, 1.0};
  const double middle = 2.0 * guard.taylor[0][2],
               spread = bend_change(guard.taylor) + guard.hull.bounds[curvature_noise];
  return {std::max(low - error, middle - spread), std::min(high + error, middle + spread), 1.0};
}

/// First positive zero of g + g1 d + m d^2 / 2 with g > 0; infinity if there is no such zero.
double parabola_root(double g, double g1, double m) {
  const double discriminant = g1 * g1 - 2.0 * m * g;
  if (discriminant < 0.0) return INFINITY;
  const double root = std::sqrt(discriminant);
  if (g1 < 0.0) return 2.0 * g / (root - g1);
  return m < 0.0 ? (g1 + root) / -m : INFINITY;
}

/// The only zero in (low, high], where g is proven to fall through zero, by Halley's iteration (cubic) from `start`.
/// False if it does not settle inside within a few steps; the bounded steps then do the work.
bool settle(const Coefficients& a, double start, double low, double high, long& evaluations, double& zero) {
  const Coefficients first = derivative(a), second = derivative(first);
  double x = start > low && start < high ? start : 0.5 * (low + high);
  for (int i = 0; i < 6; ++i) {
    const Powers p(x);
    const double g = value(a, p), g1 = value(first, p), g2 = value(second, p);
    ++evaluations;
    const double step = -2.0 * g * g1 / (2.0 * g1 * g1 - g * g2);
    x += step;
    if (!(x >= low && x <= high)) return false;
    // The next error is of the order of step^3 times (g'' / 2 g')^2, which is large at a slow impact.
    if (std::abs(step) <= 0x1p-17 * (x - low) && std::abs(step * g2) <= 0x1p-17 * std::abs(g1)) {
      zero = x;
      return true;
    }
  }
  return false;
}

/// Inverse Hermite interpolation of the zero between the window's ends, for a falling guard.
double hermite_start(const GuardWindow& guard, const Lane8& d) {
  const double left = guard.taylor[0][0], right = -guard.hull.bernstein[7], scale = -(left + right);
  const double t = left / (left + right);  // fraction of the fall from g(0) = left to g(1) = -right at which g = 0
  const double a = scale / guard.taylor[0][1], b = scale / (7.0 * d[6]);
  return t * t * (3.0 - 2.0 * t) + t * (1.0 - t) * ((1.0 - t) * a - t * b);
}

/// One search by bounded steps; holds what they share.
class Search {
 public:
  Search(const GuardWindow& guard, const Lane8& d, double x_end, long& evaluations)
      : guard_(guard),
        first_(derivative(guard.taylor)),
        second_(derivative(first_)),
        whole_(whole_curvature(guard, d)),
        x_end_(x_end),
        evaluations_(evaluations) {}

  void run(Root& root);

 private:
  [[nodiscard]] double bound(Bound which) const { return guard_.hull.bounds[which]; }
  void evaluate(double x);
  [[nodiscard]] Curvature near_start() const;
  double third();
  [[nodiscard]] const Curvature& best(double Curvature::*side) const;
  [[nodiscard]] bool certain_fall(double& zero) const;
  [[nodiscard]] double next_landing();
  void at_the_end(Root& root);
  void walk_through_noise(Root& root);
  void restart_or_linger(Root& root) const;
  [[nodiscard]] double zero_between(double low, double high) const;
  [[nodiscard]] double minimum_between(double low, double high) const;

  const GuardWindow& guard_;
  const Coefficients first_, second_;
  const Curvature whole_;
  Curvature near_{-INFINITY, INFINITY, 0.0};
  double third_ = -1.0;  ///< sup |g^(3)| on the window, once it is needed
  double x_end_;
  long& evaluations_;
  double clear_ = 0.0;  ///< the last landing where g was above eight times its noise
  double last_ = 0.0;   ///< the landing before x_
  double x_ = 0.0, g_ = 0.0, g1_ = 0.0, g2_ = 0.0, noise_ = 0.0;
};

void Search::evaluate(double x) {
  if (g_ > 8.0 * noise_) clear_ = x_;
  const Powers p(x);
  last_ = x_;
  x_ = x;
  g_ = value(guard_.taylor, p);
  g1_ = value(first_, p);
  g2_ = value(second_, p);
  noise_ = underflow + bound(Bound::noise_0) + x * (bound(Bound::noise_1) + x * bound(Bound::noise_2));
  ++evaluations_;
}

/// On [0, X]: |g'' - 2 a_2| <= X sum_{n>2} n (n - 1) |a_n|. Much sharper than the whole window's bound where the first
/// zero is near the start, as in chatter: X is half as far again as the zero of a_0 + a_1 x + a_2 x^2.
Curvature Search::near_start() const {
  const Lane8& a = guard_.taylor[0];
  const double X = 1.5 * parabola_root(a[0], a[1], 2.0 * a[2]);
  if (!(X < 0.25)) return {-INFINITY, INFINITY, 0.0};
  const double spread = X * bend_change(guard_.taylor) + bound(Bound::curvature_noise);
  return {2.0 * a[2] - spread, 2.0 * a[2] + spread, X};
}

/// Of the terms as they are computed, and of what they lack: rounding up to n = 23, and dropped terms, whose sums of n
/// (n - 1) (n - 2) |T_n| are at most 40 times those of n (n - 1) |T_n| (docs/developers/proofs.md, section 3).
double Search::third() {
  if (third_ < 0.0)
    third_ = weighted_size(guard_.taylor, [](int n) { return n * (n - 1.0) * (n - 2.0); }) +
             40.0 * bound(Bound::curvature_noise);
  return third_;
}

/// The bound to use at x_: the one near the start where it holds and is sharper.
const Curvature& Search::best(double Curvature::*side) const {
  if (x_ >= near_.end) return whole_;
  const bool sharper = side == &Curvature::low ? near_.low > whole_.low : near_.high < whole_.high;
  return sharper ? near_ : whole_;
}

/// With M >= g'' and g' < 0, g falls on [x, x + |g'| / M]; if g(x + d) <= g + g' d + M d^2 / 2 is below the noise for a
/// d in there, the first zero is the only one in (x, x + d].
bool Search::certain_fall(double& zero) const {
  const double slope = g1_ + bound(Bound::noise_1) + bound(Bound::slope_noise) * x_;
  if (slope >= 0.0) return false;
  const Curvature& curvature = best(&Curvature::high);
  const double M = std::max(curvature.high, 0.0), room = curvature.end - x_;
  const double d = M * room > -slope ? -slope / M : room;
  const double y = x_ + d;
  const double noise = bound(Bound::noise_0) + y * (bound(Bound::noise_1) + y * bound(Bound::noise_2));
  if (g_ + noise_ + d * (slope + 0.5 * M * d) >= -noise) return false;
  return settle(guard_.taylor, x_ - g_ / g1_, x_, y, evaluations_, zero);
}

/// The end of the longest step that certainly passes no zero: the first zero of a parabola below g. Two are tried: with
/// the least curvature of the interval ahead, and with half the curvature here: for d <= (3/2) g'' / sup |g^(3)|,
///     g'' d^2 / 2 - sup |g^(3)| d^3 / 6  >=  g'' d^2 / 4.
double Search::next_landing() {
  constexpr double short_of = 1.0 - 0x1p-40;  // more than the rounding of the step itself
  const double g = g_ - noise_, g1 = g1_ - bound(Bound::noise_1) - bound(Bound::slope_noise) * x_;
  const Curvature& ahead = best(&Curvature::low);
  double next = std::min(x_ + short_of * parabola_root(g, g1, ahead.low), ahead.end < 1.0 ? ahead.end : INFINITY);
  const double g2 = g2_ - bound(Bound::curvature_noise);
  if (next < x_end_ && x_ > 0.0 && g2 > 0.0)
    next = std::max(next, x_ + short_of * std::min(parabola_root(g, g1, 0.5 * g2), 1.5 * g2 / third()));
  return next;
}

/// No zero up to the window's end. Is g clear of the noise there, so that the next window starts clear of it?
void Search::at_the_end(Root& root) {
  root.x = 1.0;
  if (guard_.hull.bernstein[7] > bound(hull_error)) return;
  evaluate(1.0);
  if (g_ <= 8.0 * noise_) restart_or_linger(root);
}

void Search::restart_or_linger(Root& root) const {
  constexpr double gain = 0.25;  // of a window: a guard that creeps along its noise shall not restart for ever
  root.kind = clear_ >= gain ? RootKind::restart : RootKind::none;
  root.x = clear_ >= gain ? clear_ : 1.0;
  root.lingers = clear_ < gain;
}

/// g is within the noise at x_, or so near it that no step is possible. Steps d with (g'' + sup |g^(3)| d)
/// d^2 / 8 <= noise: between two points of the band g is above -2 noise. The first point below the band proves a
/// crossing, the first above it a graze.
void Search::walk_through_noise(Root& root) {
  constexpr long patience = 65'536;  // steps; a window that begins here is judged by its derivatives
  const double start = x_, before = last_;
  const long begun = evaluations_;
  for (;;) {
    if (evaluations_ - begun > patience) {
      root.kind = RootKind::restart;
      root.x = x_;
      return;
    }
    const double bend = std::max(g2_, 0.0) + bound(Bound::curvature_noise);
    const double d =
        0x1.fffffffffep-1 * std::min(std::sqrt(4.0 * noise_ / bend), fixed::cube_root(4.0 * noise_ / third()));
    if (!(x_ < 1.0)) return restart_or_linger(root);
    evaluate(std::min(x_ + d, 1.0));
    if (!(std::abs(g_) > noise_)) continue;
    root.doubtful = true;
    root.kind = g_ < 0.0 ? RootKind::crossing : RootKind::graze;
    root.x = g_ < 0.0 ? zero_between(before, x_) : minimum_between(start, x_);
    return;
  }
}

/// A zero of the computed g, which is positive at `low` and negative at `high`: Newton's steps kept inside by
/// bisection.
double Search::zero_between(double low, double high) const {
  double x = high;
  for (int i = 0; i < 100; ++i) {
    const Powers p(x);
    const double g = value(guard_.taylor, p), g1 = value(first_, p);
    ++evaluations_;
    (g > 0.0 ? low : high) = x;
    double next = x - g / g1;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (g == 0.0 || std::abs(next - x) <= 0x1p-52 * x) return x;
    x = next;
  }
  return x;
}

/// Where the computed g' changes from negative to positive in [low, high].
double Search::minimum_between(double low, double high) const {
  double x = low;
  if (value(first_, Powers(low)) >= 0.0) return low;
  for (int i = 0; i < 60; ++i) {
    const Powers p(x);
    const double slope = value(first_, p), bend = value(second_, p);
    ++evaluations_;
    (slope < 0.0 ? low : high) = x;
    double next = x - slope / bend;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 0x1p-51 * x) return next;
    x = next;
  }
  return x;
}

void Search::run(Root& root) {
  g_ = guard_.taylor[0][0];
  g1_ = guard_.taylor[0][1];
  g2_ = 2.0 * guard_.taylor[0][2];
  noise_ = underflow + bound(Bound::noise_0);
  near_ = near_start();
  for (;;) {
    if (g_ <= noise_) return walk_through_noise(root);
    if (certain_fall(root.x)) {
      root.kind = RootKind::crossing;
      return;
    }
    const double next = next_landing();
    if (next >= x_end_) {
      root.x = x_end_;
      if (x_end_ == 1.0) at_the_end(root);
      return;
    }
    if (next <= x_) return walk_through_noise(root);
    evaluate(next);
  }
}

}  // namespace

Root SLAPSTICK_KERNEL::first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  const Lane8 d = differences(guard.hull.bernstein);
  const bool falls =
      7.0 * greatest(d) < -guard.hull.bounds[slope_error] && guard.hull.bernstein[7] < -guard.hull.bounds[hull_error];
  Root root;
  root.falls = falls && settle(guard.taylor, hermite_start(guard, d), 0.0, 1.0, evaluations, root.x);
  if (root.falls)
    root.kind = RootKind::crossing;
  else
    Search(guard, d, x_end, evaluations).run(root);
  if (root.x > x_end) {
    root = {};
    root.x = x_end;
  }
  return root;
}

}  // namespace slapstick::event
