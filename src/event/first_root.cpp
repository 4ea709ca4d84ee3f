#include "slapstick/event/first_root.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace slapstick::event {
namespace {

struct Range {
  double low, high;
};

/// Enclosure of h'' on the whole window from the second differences of the Bernstein coefficients,
///     h'' = degree (degree - 1) sum_j (b_{j+2} - 2 b_{j+1} + b_j) B_j,
/// widened by the rounding error of the coefficients.
Range curvature(const Coefficients& bernstein, double noise) {
  double b[terms + 2];
  std::memcpy(b, bernstein.data(), sizeof bernstein);
  b[terms] = b[terms + 1] = 0.0;
  const double last = b[terms - 1] - 2.0 * b[terms - 2] + b[terms - 3];
  Lane8 low = Lane8{} + last, high = low;
  for (int g = 0; g < 3; ++g) {
    Lane8 left, middle, right;
    std::memcpy(&left, b + 8 * g, sizeof left);
    std::memcpy(&middle, b + 8 * g + 1, sizeof middle);
    std::memcpy(&right, b + 8 * g + 2, sizeof right);
    Lane8 second = right - 2.0 * middle + left;
    if (g == 2) second[6] = second[7] = last;  // there are only 22 differences
    low = smaller(low, second);
    high = larger(high, second);
  }
  constexpr double scale = degree * (degree - 1.0);
  return {scale * (least(low) - 4.0 * noise), scale * (-least(-high) + 4.0 * noise)};
}

/// sup |h^(3)| on [0, 1] from the Taylor coefficients.
double third_derivative_bound(const Coefficients& a) {
  constexpr auto weight = [](int n) { return n * (n - 1.0) * (n - 2.0); };
  Lane8 bound{};
  for (int g = 0; g < 3; ++g) {
    const int n = 8 * g;
    bound += magnitude(a[g]) * Lane8{weight(n), weight(n + 1), weight(n + 2), weight(n + 3), weight(n + 4), weight(n + 5), weight(n + 6), weight(n + 7)};
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
        first_(derivative(guard.taylor)),
        second_(derivative(first_)),
        curvature_(curvature(guard.bernstein, guard.noise_0 + guard.noise_1 + guard.noise_2)),
        x_end_(x_end),
        evaluations_(evaluations) {}

  Root run();

 private:
  double noise(double x) const { return guard_.noise_0 + x * (guard_.noise_1 + x * guard_.noise_2); }
  void evaluate(double x);
  double start_exclusion();
  Root decide_at_noise();
  bool pass_convex_minimum(Root& decided);
  double minimum_from(double x, double end);
  double polish();

  const GuardWindow& guard_;
  const Coefficients first_, second_;
  Range curvature_;
  double x_end_;
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

/// With a_0 = ... = a_{p-1} = 0 and a_p > 0:  h(x) >= x^p (a_p - x sum_{n>p} |a_n|),  so no zero in (0, a_p / sum_{n>p} |a_n|).
/// On the interval found, and a little past it, h'' differs from 2 a_2 only by the tail; the sharper curvature is kept for the steps.
double Search::start_exclusion() {
  const int p = guard_.order;
  Lane8 head = magnitude(guard_.taylor[0]);
  for (int n = 0; n <= p; ++n) head[n] = 0.0;
  const double tail = sum(head + magnitude(guard_.taylor[1]) + magnitude(guard_.taylor[2]));
  const double leading = guard_.taylor[p / 8][p % 8];
  return leading >= tail ? 1.0 : (1.0 - 0x1p-40) * leading / tail;
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
  for (int i = 0; i < 60; ++i) {
    const Powers p(u);
    const double slope = value(first_, p), bend = value(second_, p);
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
  const double bend = value(second_, Powers(x_));
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
  evaluate(guard_.order > 0 ? start_exclusion() : 0.0);
  for (int step = 0;; ++step) {
    if (x_ >= x_end_) return {RootKind::none, x_end_};
    if (h_ <= epsilon_) {
      const Root decided = decide_at_noise();
      return decided.x > x_end_ ? Root{RootKind::none, x_end_} : decided;
    }
    if (step >= 4) {
      Root decided;
      const double before = x_;
      if (pass_convex_minimum(decided)) {
        if (decided.kind != RootKind::none) return decided.x > x_end_ ? Root{RootKind::none, x_end_} : decided;
        if (x_ > before) continue;
      }
    }
    const double d = parabola_root(h_ - epsilon_, h1_, curvature_.low);
    const double next = x_ + (1.0 - 0x1p-40) * d;
    if (next >= x_end_) return {RootKind::none, x_end_};
    if (next <= x_) return decide_at_noise();
    evaluate(next);
  }
}

}  // namespace

bool excluded(const Coefficients& bernstein, double noise, int order) {
  Lane8 head = bernstein[0];
  for (int j = 0; j < order; ++j) head[j] = INFINITY;
  return least(smaller(smaller(head, bernstein[1]), bernstein[2])) > noise;
}

Root first_root(const GuardWindow& guard, double x_end, long& evaluations) {
  return Search(guard, x_end, evaluations).run();
}

}  // namespace slapstick::event
