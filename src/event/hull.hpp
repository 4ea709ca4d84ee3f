#pragma once
/// An enclosure of a power series on [0, 1] by eight numbers: the Bernstein coefficients of a polynomial of degree 7
/// that is close to it.
///
/// x^n, n >= 8, is replaced by its remainder modulo the Chebyshev polynomial T of degree 8 on [0, 1] (Lanczos's
/// economization):
///     x^n = p_n(x) + q_n(x) T(x) / 2^15,     deg p_n = 7,
///     q_8 = 1,     q_{n+1} = x q_n + (leading coefficient of p_n).
/// The coefficients of q_n are complete symmetric functions of the zeros of T, hence positive, so that on [0, 1]
///     |x^n - p_n|     <=  q / 2^15                              q = q_n(1),  |T|   <= 1
///     |(x^n - p_n)'|  <= (q' + 128 q) / 2^15                                 |T'|  <= 128
///     |(x^n - p_n)''| <= (q'' + 256 q' + 5376 q) / 2^15                      |T''| <= 5376.
/// A window of the flow spans about two radians of its fastest sinusoid; its hull then lies within 1e-6 of the guard.

#include "event/window.hpp"

namespace slapstick::event {

/// Lanes of `Hull::bounds`, for g = sum_n a_n x^n; A_n is the rounding bound of a_n.
enum Bound : int {
  hull_error,       ///< of every Bernstein coefficient against g, and eight times the noise of g
  slope_error,      ///< |g' - hull'|, rounding of the coefficients' differences included
  curvature_error,  ///< |g'' - hull''|, the same
  noise_0,          ///< A_0; the computed g(x) is within noise_0 + noise_1 x + noise_2 x^2,
  noise_1,          ///< A_1;
  noise_2,          ///< sum of A_n, n >= 2;
  slope_noise,      ///< sum of n A_n, n >= 2: the computed g'(x) within noise_1 + slope_noise x,
  curvature_noise   ///< sum of n (n - 1) A_n, n >= 2: and g''(x) within this
};

/// Linear in the series: hulls add, bounds add with the magnitudes of what they multiply.
struct Hull {
  Lane8 bernstein;  ///< b_0 .. b_7
  Lane8 bounds;     ///< see Bound
};

inline constexpr int most_terms = 40;  ///< of a series that is given to `enclose`

/// The hull of sum_{n<count} a_n x^n, count <= most_terms, where a_n is known to `noise_factor` size[n],
/// size[n] >= |a_n| and noise_factor >= 16 u. Cost: four vector operations per term.
Hull enclose(const double* a, const double* size, int count, double noise_factor);

/// What a unit of a_n adds to the hull, and to its bounds, n < most_terms.
struct HullRows {
  const Lane8* bernstein;
  const Lane8* bounds;
};

/// The rows for a noise_factor. `bounds`: storage for most_terms rows, to be kept as long as they are used.
HullRows hull_rows(double noise_factor, Lane8* bounds);

/// The bounds for a state that carries another rounding beside its own: `more` times that of the bounds b.
static inline void add_noise(Hull& hull, const Lane8& b, double more) {
  const double n0 = b[noise_0], n1 = b[noise_1], n2 = b[noise_2], slope = b[slope_noise],
               curvature = b[curvature_noise];
  hull.bounds += more * Lane8{8.0 * (n0 + n1 + n2), n1 + slope, curvature, n0, n1, n2, slope, curvature};
}

/// True if g > 0 on [0, 1], by eight times its noise: no Bernstein coefficient is as low as the error bound.
static inline bool excluded(const Hull& hull) { return all_above(hull.bernstein, hull.bounds[hull_error]); }

}  // namespace slapstick::event
