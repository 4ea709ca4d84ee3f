#include "oracle/polynomial.hpp"

#include <cmath>

namespace slapstick::oracle {
namespace {

// Halvings; a guard against an endless search only, 2^-200 lies far below the digits of Real.
constexpr int deepest = 200;

/// What the absolute coefficients prove about p on [0, 1].
struct Shape {
  bool no_zero, monotone, curved;  ///< |p| > 0; |p'| > 0; |p''| > 0 on the whole interval
  double largest;                  ///< |p| <= largest
};

Shape shape_of(const Polynomial& p) {
  double tail0 = 0, tail1 = 0, tail2 = 0;
  for (std::size_t k = 1; k < p.size(); ++k) {
    const double a = std::abs(p[k].convert_to<double>()), order = static_cast<double>(k);
    tail0 += a;
    if (k > 1) tail1 += order * a;
    if (k > 2) tail2 += order * (order - 1) * a;
  }
  // The sums are doubles: 1e-9 covers their rounding.
  const auto beats = [](const Real& lead, double tail) {
    return std::abs(lead.convert_to<double>()) > tail * (1 + 1e-9);
  };
  const auto at = [&](std::size_t k) { return k < p.size() ? p[k] : Real(0); };
  return {beats(at(0), tail0), beats(at(1), tail1), beats(2 * at(2), tail2),
          (tail0 + std::abs(p[0].convert_to<double>())) * (1 + 1e-9)};
}

Polynomial differentiate(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * static_cast<int>(k));
  return d;
}

/// p(s/2): the left half stretched to [0, 1].
Polynomial left_half(Polynomial p) {
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = ldexp(p[k], -static_cast<int>(k));
  return p;
}

/// p(s + 1) by Horner's scheme, additions only.
Polynomial shift_by_one(Polynomial p) {
  for (std::size_t first = 0; first + 1 < p.size(); ++first)
    for (std::size_t k = p.size() - 1; k-- > first;) p[k] += p[k + 1];
  return p;
}

/// Where the parabola p[0] + p[1] s + p[2] s^2 first falls to zero; a start for Newton only.
Real parabola_root(const Polynomial& p) {
  if (p.size() < 3) return -p[0] / p[1];
  const Real disc = p[1] * p[1] - 4 * p[0] * p[2];
  if (disc < 0) return Real(-1);
  const Real denominator = -p[1] + sqrt(disc);
  return denominator > 0 ? 2 * p[0] / denominator : Real(-1);
}

/// The only zero in (0, end) of a p that is positive at 0 and negative at `end`. Newton, halving when it leaves the
/// bracket.
Real bracketed_root(const Polynomial& p, const Real& end) {
  static const Real sharp("1e-48");
  Real low = 0, high = end, s = parabola_root(p);
  for (int i = 0; i < 400; ++i) {
    if (!(s > low && s < high)) s = (low + high) / 2;
    const Real value = evaluate(p, s);
    if (value == 0) return s;
    (value > 0 ? low : high) = s;
    const Real slope = derivative(p, s);
    const Real next = slope == 0 ? Real(-1) : s - value / slope;
    if (abs(next - s) <= sharp * s || high - low <= sharp * s) return s;
    s = next;
  }
  return s;
}

/// p decreases from p[0] >= -tolerance to a proven negative value at `end`.
Root crossing(const Polynomial& p, const Real& end) {
  if (p[0] <= 0) return {p[1] < 0 ? -p[0] / p[1] : Real(0), false};
  return {bracketed_root(p, end), false};
}

/// The minimum of a convex p with p'(0) < 0 < p'(1).
Real convex_minimum(const Polynomial& p) {
  Polynomial slope = differentiate(p);
  for (Real& c : slope) c = -c;
  return bracketed_root(slope, Real(1));
}

std::optional<Root> root_of_convex(const Polynomial& p, const Real& tolerance, bool report_touch) {
  if (p[1] >= 0) {  // rising: at most the touch that lies a rounding before 0
    if (report_touch && p[0] <= tolerance) return Root{Real(0), true};
    return std::nullopt;
  }
  if (derivative(p, Real(1)) <= 0)
    return evaluate(p, Real(1)) < -tolerance ? std::optional(crossing(p, Real(1))) : std::nullopt;
  const Real bottom = convex_minimum(p), lowest = evaluate(p, bottom);
  if (lowest < -tolerance) return crossing(p, bottom);
  if (report_touch && lowest <= tolerance) return Root{bottom, true};
  return std::nullopt;
}

std::optional<Root> search(const Polynomial& p, const Real& tolerance, bool report_touch, int depth) {
  const Shape shape = shape_of(p);
  if (shape.no_zero && p[0] > tolerance) return std::nullopt;
  if (shape.monotone || (shape.curved && p[2] < 0)) {
    // Monotone, or concave and positive at 0: one zero if the end is negative, else none.
    return evaluate(p, Real(1)) < -tolerance ? std::optional(crossing(p, Real(1))) : std::nullopt;
  }
  if (shape.curved) return root_of_convex(p, tolerance, report_touch);
  if (depth == deepest || shape.largest <= tolerance) {  // zero to all digits, e.g. next to a touch of higher order
    if (report_touch && p[0] <= tolerance) return Root{Real(0), true};
    return std::nullopt;
  }
  const Polynomial left = left_half(p);
  if (auto root = search(left, tolerance, report_touch, depth + 1)) return Root{root->s / 2, root->touch};
  if (auto root = search(shift_by_one(left), tolerance, report_touch, depth + 1))
    return Root{(root->s + 1) / 2, root->touch};
  return std::nullopt;
}

}  // namespace

Real evaluate(const Polynomial& p, const Real& s) {
  Real value = 0;
  for (std::size_t k = p.size(); k-- > 0;) value = value * s + p[k];
  return value;
}

Real derivative(const Polynomial& p, const Real& s) {
  Real value = 0;
  for (std::size_t k = p.size(); k-- > 1;) value = value * s + p[k] * static_cast<int>(k);
  return value;
}

Real magnitude(const Polynomial& p) {
  Real sum = 0;
  for (const Real& c : p) sum += abs(c);
  return sum;
}

std::optional<Root> first_root(const Polynomial& p, const Real& tolerance, bool report_touch) {
  if (p.empty()) return std::nullopt;
  return search(p, tolerance, report_touch, 0);
}

}  // namespace slapstick::oracle
