#include "slapstick/event/first_root.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::event {
namespace {

struct Range {
  double low, high;
};

using Differences = Coefficients;

/// b_{j+1} - b_j; lane 23 repeats lane 22 (there are 23 of them). h' = degree sum_j (b_{j+1} - b_j) B_j.
Differences first_differences(const Coefficients& b) {
  Differences d = {shifted(b, 0) - b[0], shifted(b, 1) - b[1], shifted(b, 2) - b[2]};
  d[2][7] = d[2][6];
  return d;
}

/// A guard with the zero at its start divided out: h = x^p g, g(0) = a_p > 0, so h and g have the same zeros and signs on (0, 1].
///     Taylor: g_n = a_{n+p};   Bernstein, p times: g_j = b_{j+1} d / (j + 1), d the degree before (x B_j^{d-1} = (j+1)/d B_{j+1}^d).
/// Nothing cancels near the start: g is known there as well as a_p is.
struct Deflated {
  Coefficients taylor, bernstein;
  int degree_left = degree;
  double noise_0, noise_1, noise_2;

  explicit Deflated(const GuardWindow& h)
      : taylor(h.taylor), bernstein(h.bernstein), noise_0(h.noise_0), noise_1(h.noise_1), noise_2(h.noise_2) {
    for (int k = 0; k < h.order; ++k) divide_by_x();
    if (h.order == 0) return;
    // noise_2 bounds all coefficients from a_2 on: past the leading one they come with at least one x. The leading one is known to
    // an eighth of itself, or it would not count as one.
    noise_0 = h.order == 1 ? h.noise_1 : std::min(h.noise_2, 0.125 * taylor[0][0]);
    noise_1 = h.noise_2;
    noise_2 = 0.0;
  }

 private:
  void divide_by_x() {
    const double d = degree_left--;
    for (int g = 0; g < 3; ++g) {
      const double j = 8.0 * g;
      taylor[g] = shifted(taylor, g);
      bernstein[g] = shifted(bernstein, g) * (d / Lane8{j + 1, j + 2, j + 3, j + 4, j + 5, j + 6, j + 7, j + 8});
    }
    bernstein[0][0] = taylor[0][0];
    // The coefficient past the end continues the last two in a straight line: differences there repeat, second differences vanish.
    const auto at = [&](int j) -> double { return bernstein[j / 8][j % 8]; };
    for (int j = degree_left + 1; j < terms; ++j) bernstein[j / 8][j % 8] = 2.0 * at(j - 1) - at(j - 2);
  }
};

/// Enclosure of h'' on the whole window from the second differences of the Bernstein coefficients,
///     h'' = n (n - 1) sum_j (b_{j+2} - 2 b_{j+1} + b_j) B_j,
/// widened by the rounding error of the coefficients.
Range curvature(const Differences& d, int n, double noise) {
  const Lane8 a = shifted(d, 0) - d[0], b = shifted(d, 1) - d[1];
  Lane8 c = shifted(d, 2) - d[2];
  c[6] = c[7] = c[5];  // there are only 22 second differences
  const Lane8 low = smaller(smaller(a, b), c), high = larger(larger(a, b), c);
  const double scale = n * (n - 1.0);
  return {scale * (least(low) - 4.0 * noise), scale * (-least(-high) + 4.0 * noise)};
}

/// sum_{n>2} n (n - 1) |a_n|.
double second_derivative_tail(const Coefficients& a) {
  constexpr auto weight = [](int n) { return n < 3 ? 0.0 : n * (n - 1.0); };
  Lane8 bound{};
  for (int g = 0; g < 3; ++g) {
    const int n = 8 * g;
    bound += magnitude(a[g]) * Lane8{weight(n),     weight(n + 1), weight(n + 2), weight(n + 3),
                                     weight(n + 4), weight(n + 5), weight(n + 6), weight(n + 7)};
  }
  return sum(bound);
}

/// sup |h^(3)| on [0, 1] from the Taylor coefficients.
double third_derivative_bound(const Coefficients& a) {
  constexpr auto weight = [](int n) { return n * (n - 1.0) * (n - 2.0); };
  Lane8 bound{};
  for (int g = 0; g < 3; ++g) {
    const int n = 8 * g;
    bound += magnitude(a[g]) * Lane8{weight(n),     weight(n + 1), weight(n + 2), weight(n + 3),
                                     weight(n + 4), weight(n + 5), weight(n + 6), weight(n + 7)};
  }
  return sum(bound);
}

/// First positive zero of h + h1 d + m d^2 / 2 with h > 0; infinity if there is none.
double parabola_root(double h, double h1, double m) {
  const double discriminant = h1 * h1 - 2.0 * m * h;
  if (discriminant < 0.0) return INFINITY;
  const double root = std::sqrt(discriminant);
  if (h1 < 0.0) return 2.0 * h / (root - h1);
  return m < 0.0 ? (h1 + root) / -m : INFINITY;
}

/// One search; holds what all steps share.
class Search {
 public:
  Search(const GuardWindow& guard, double x_end, long& evaluations)
      : guard_(guard),
        first_(derivative(guard_.taylor)),
        differences_(first_differences(guard_.bernstein)),
        x_end_(x_end),
        evaluations_(evaluations) {}

  Root run();

 private:
  double noise(double x) const { return guard_.noise_0 + x * (guard_.noise_1 + x * guard_.noise_2); }
  void evaluate(double x);
  void look_close_to_start();
  bool falls() const;
  bool settle(double start, double low, double high, Root& root);
  double hermite_start() const;
  bool certain_fall(Root& root);
  Root decide_at_noise();
  bool pass_convex_minimum(Root& decided);
  double minimum_from(double x, double end);
  double polish();

  const Deflated guard_;
  const Coefficients first_;
  const Differences differences_;
  Range curvature_{};  ///< of h'' on the window; only computed where the guard is not known to fall
  double x_end_;
  double near_end_ = 0.0;   ///< on [0, near_end_] ..
  Range near_curvature_{};  ///< .. h'' lies in this range
  long& evaluations_;
  double x_ = 0.0, h_ = 0.0, h1_ = 0.0, epsilon_ = 0.0;
};

void Search::evaluate(double x) {
  const Powers p(x);
  x_ = x;
  h_ = value(guard_.taylor, p);
  h1_ = value(first_, p);
  epsilon_ = noise(x);
  ++evaluations_;
}

/// On [0, X]: |h'' - 2 a_2| <= X sum_{n>2} n (n - 1) |a_n|. Much sharper than the whole window's bound where the first zero is near
/// the start, as in chatter: X is half as far again as the zero of a_0 + a_1 x + a_2 x^2.
void Search::look_close_to_start() {
  const Lane8& a = guard_.taylor[0];
  const double X = 1.5 * parabola_root(a[0] - guard_.noise_0, a[1], 2.0 * a[2]);
  if (!(X < 0.25)) return;
  near_end_ = X;
  const double tail = X * second_derivative_tail(guard_.taylor);
  near_curvature_ = {2.0 * a[2] - tail, 2.0 * a[2] + tail};
}

/// True if h is proven to fall all over the window, from above the noise to below it: exactly one zero, and a crossing.
bool Search::falls() const {
  const double noise = guard_.noise_0 + guard_.noise_1 + guard_.noise_2;
  const double steepest = -least(-larger(larger(differences_[0], differences_[1]), differences_[2]));
  return steepest < -2.0 * noise && guard_.bernstein[0][0] > noise && guard_.bernstein[2][7] < -noise;
}

/// Inverse Hermite interpolation of the zero between the window's ends, for a falling guard.
double Search::hermite_start() const {
  const double left = guard_.bernstein[0][0], right = -guard_.bernstein[2][7], scale = -(left + right);
  const double t = left / (left + right);  // fraction of the fall from h(0) = left to h(1) = -right at which h = 0
  const double a = scale / (guard_.degree_left * differences_[0][0]),
               b = scale / (guard_.degree_left * differences_[2][7]);
  return t * t * (3.0 - 2.0 * t) + t * (1.0 - t) * ((1.0 - t) * a - t * b);
}

/// The only zero in (low, high], where h is proven to fall through zero, by Halley's iteration (cubic) from `start`.
/// False if it does not settle inside within a few steps; the bounded steps then do the work.
bool Search::settle(double start, double low, double high, Root& root) {
  const Coefficients second = derivative(first_);
  double x = start > low && start < high ? start : 0.5 * (low + high);
  for (int i = 0; i < 6; ++i) {
    const Powers p(x);
    const double h = value(guard_.taylor, p), h1 = value(first_, p), h2 = value(second, p);
    ++evaluations_;
    const double step = -2.0 * h * h1 / (2.0 * h1 * h1 - h * h2);
    x += step;
    if (!(x >= low && x <= high)) return false;
    if (std::abs(step) <= 0x1p-17 * (x - low)) {  // the next error is of the order of step^3
      root = x > x_end_ ? Root{RootKind::none, x_end_} : Root{RootKind::crossing, x};
      return true;
    }
  }
  return false;
}

/// With M >= h'' and h' < 0, h falls on [x, x + |h'| / M]; if h(x + d) <= h + h' d + M d^2 / 2 is below the noise for a d in there, the
/// first zero is the only one in (x, x + d].
bool Search::certain_fall(Root& root) {
  if (h1_ >= 0.0) return false;
  const bool near = x_ < near_end_ && near_curvature_.high < curvature_.high;
  const double M = std::max(near ? near_curvature_.high : curvature_.high, 0.0);
  const double room = (near ? near_end_ : 1.0) - x_;
  const double d = M * room > -h1_ ? -h1_ / M : room;
  if (h_ + d * (h1_ + 0.5 * M * d) >= -noise(x_ + d)) return false;
  return settle(x_ - h_ / h1_, x_, x_ + d, root);
}

/// The steps end where h cannot be told from zero. Crossing if h is certain to go below -epsilon beyond x:
///     h(x + d) <= h + h' d + M d^2 / 2  with M >= h'';  graze if its minimum stays within the noise.
Root Search::decide_at_noise() {
  const double rest = 1.0 - x_;
  if (h1_ < 0.0) {
    const double M = std::max(curvature_.high, 0.0);
    const double d = M > 0.0 ? std::min(rest, -h1_ / M) : rest;
    if (h_ + d * (h1_ + 0.5 * M * d) < -noise(x_ + d)) return {RootKind::crossing, polish()};
  }
  const double u = minimum_from(x_, 1.0);
  if (u >= 1.0) return x_ > 0.0 ? Root{RootKind::restart, x_} : Root{RootKind::graze, x_};
  const double at_minimum = value(guard_.taylor, Powers(u));
  if (at_minimum < -noise(u)) return {RootKind::crossing, polish()};
  return {RootKind::graze, u};
}

/// A last Newton step (h is smooth and h' != 0 here): brings x from "within the noise bound" to rounding.
double Search::polish() {
  if (h1_ >= 0.0) return x_;
  const double d = -h_ / h1_;
  return std::clamp(x_ + d, 0.0, 1.0);
}

/// The point where h' first vanishes after x, by safeguarded Newton on h' in [x, end]; `end` if h' stays negative there.
double Search::minimum_from(double x, double end) {
  double low = x, high = end;
  if (value(first_, Powers(end)) < 0.0) return end;
  double u = x;
  const Coefficients second = derivative(first_);
  for (int i = 0; i < 60; ++i) {
    const Powers p(u);
    const double slope = value(first_, p), bend = value(second, p);
    ++evaluations_;
    (slope < 0.0 ? low : high) = u;
    double next = u - slope / bend;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - u) <= 0x1p-51 * u) return next;
    u = next;
  }
  return u;
}

/// The convexity certificate (reliability page, section 4): with M3 >= |h^(3)|, h' < 0, h'' > 0 and h''^2 + 2 M3 h' > 0 the interval
/// [x, x + D], D = 2 |h'| / (h'' + sqrt(.)), has h'' >= kappa = sqrt(.) > 0 and holds exactly one minimum u, with
/// min h in [h(u) - h'(u)^2 / (2 kappa), h(u)]. True if the search may go on from x + D or is decided.
bool Search::pass_convex_minimum(Root& decided) {
  if (h1_ >= 0.0) return false;
  const double bend = value(derivative(first_), Powers(x_));
  const double discriminant = bend * bend + 2.0 * third_derivative_bound(guard_.taylor) * h1_;
  if (bend <= 0.0 || discriminant <= 0.0) return false;
  const double kappa = std::sqrt(discriminant);
  const double end = x_ - 2.0 * h1_ / (bend + kappa);
  if (end >= 1.0) return false;
  const double u = minimum_from(x_, end);
  const Powers p(u);
  const double h = value(guard_.taylor, p), slope = value(first_, p);
  ++evaluations_;
  if (h - 0.5 * slope * slope / kappa > noise(u)) {
    evaluate(end);
    return true;
  }
  if (h < -noise(u)) return false;  // exactly one zero in (x, u]: the steps go on towards it
  decided = {RootKind::graze, u};
  return true;
}

Root Search::run() {
  Root root;
  if (falls() && settle(hermite_start(), 0.0, 1.0, root)) {
    root.falls = root.kind == RootKind::crossing && guard_.degree_left == degree;
    return root;
  }
  curvature_ = curvature(differences_, guard_.degree_left, guard_.noise_0 + guard_.noise_1 + guard_.noise_2);
  h_ = guard_.taylor[0][0];
  h1_ = guard_.taylor[0][1];
  epsilon_ = guard_.noise_0;
  if (h_ > epsilon_) look_close_to_start();
  for (int step = 0;; ++step) {
    if (x_ >= x_end_) return {RootKind::none, x_end_};
    if (h_ <= epsilon_) {
      const Root decided = decide_at_noise();
      return decided.x > x_end_ ? Root{RootKind::none, x_end_} : decided;
    }
    if (certain_fall(root)) return root;
    if (step >= 4) {
      Root decided;
      const double before = x_;
      if (pass_convex_minimum(decided)) {
        if (decided.kind != RootKind::none) return decided.x > x_end_ ? Root{RootKind::none, x_end_} : decided;
        if (x_ > before) continue;
      }
    }
    const bool near = x_ < near_end_ && near_curvature_.low > curvature_.low;
    const double d = parabola_root(h_ - epsilon_, h1_, near ? near_curvature_.low : curvature_.low);
    const double next = near ? std::min(x_ + (1.0 - 0x1p-40) * d, near_end_) : x_ + (1.0 - 0x1p-40) * d;
    if (next >= x_end_) return {RootKind::none, x_end_};
    if (next <= x_) return decide_at_noise();
    evaluate(next);
  }
}

}  // namespace

bool excluded(const Coefficients& bernstein, double noise, int order) {
  const Lane8 head = order == 0 ? bernstein[0] : with_first(bernstein[0], order, INFINITY);
  return least(smaller(smaller(head, bernstein[1]), bernstein[2])) > noise;
}

Root first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  return Search(guard, x_end, evaluations).run();
}

}  // namespace slapstick::event
