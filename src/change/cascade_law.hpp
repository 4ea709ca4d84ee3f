#pragma once
/// The law by which the changes of a cascade gather at the onset of a complete chatter, and the limit of their places
/// by that law.
///
/// A chatter whose onset is near ends just as the contact lets go: the pair is pressed by a(s) = a - j s. With v the
/// speed after an impact, and
///     w = j v / a^2,     flight = sigma a / j:
///     w = sigma/2 - sigma^2/6,     w' = r (sigma/2 - sigma^2/3) / (1 - sigma)^2,     a' = (1 - sigma) a
/// leads from impact to impact. w = 0 is the complete chatter; a second fixed point, (0, w*) in (a, w), is its onset:
///     (3 - s) (1 - s)^2 = r (3 - 2 s),  s = sigma*;     multipliers  mu = 1 - s  of a and  lambda = dw'/dw > 1.
/// Beyond w* the contact lets go after a finite number of impacts. The onset's stable manifold is left by lambda per
/// impact, and the n-th graze is where the orbit has come from it to the graze, w = 3/8 + O(a), with a ~ mu^n. In the
/// cycle the motion leaves with a speed ~ a^2, which the next start remembers. The n-th graze is therefore at the
/// distance
///     D_n = sum c_ik (lambda^-i mu^k)^n,     (i, k) other than (0, 0) and (0, 1),
/// from the onset, the first two terms of which are C lambda^-n + B mu^(2n).
///
/// Friction f_k = f_s on the same pair, phi = f_k / m, makes it rise with a + phi and return with alpha = a - phi;
/// where alpha passes zero it stays where it is. Scaled by alpha the height h of a flight is
/// eta = h j^2 / alpha^3 = sigma^2/2 - sigma^3/6, alpha' = (1 - sigma) alpha and
///     eta' = r^2 alpha (sigma - sigma^2/2)^2 / (4 phi (1 - sigma)^3):
/// with alpha -> 0 there is no second fixed point: along the onset eta -> 1/3, sigma -> 1, alpha' ~ c alpha^(4/3), and
/// d alpha' / d alpha = 2. So
///     D_{n+1} = K 2^(n/3) D_n^(4/3):
/// a cascade that gathers faster than any geometric series. With f_s > f_k it stays with a finite alpha, and each
/// change is a jump.
#include <optional>
#include <vector>

namespace slapstick::orbit {

/// The onset's fixed point and its multipliers.
struct BounceRates {
  double sigma;   ///< sigma*: the flight in units of the time in which the pressing acceleration falls to zero
  double mu;      ///< 1 - sigma*
  double lambda;  ///< dw'/dw
  double w;       ///< w* = sigma*/2 - sigma*^2/6 ..
  double w_rate;  ///< .. and its derivative by r
};
/// @param restitution  in (0, 1)
[[nodiscard]] BounceRates bounce_rates(double restitution);

/// The rates lambda^-i mu^k of D_n, largest first.
[[nodiscard]] std::vector<double> cascade_rates(double restitution, std::size_t count);

struct PlaceLimit {
  double value = 0.0;
  double error = 0.0;
};

/// The limit of places g_0, g_1, .., the nearest first, whose distances from the limit are sums of powers of known
/// rates. One rate after the other is taken out:
///     T_0 = g,     T_M(i) = (T_{M-1}(i) - q_M T_{M-1}(i + 1)) / (1 - q_M).
/// What T_M leaves is a sum of powers of q_{M+1}, ..: its error is at most q / (1 - q), q = q_{M+1}, times its last
/// change. Where two terms cancel that change is small by chance; then what the last rate taken out has made of the
/// limit is not, now or one place earlier. The error is the sum of these three and of the places' own errors; the M
/// with the least is taken.
/// @param errors  of the places
/// @returns empty with fewer than four places
[[nodiscard]] std::optional<PlaceLimit> limit_by_rates(const std::vector<double>& places,
                                                       const std::vector<double>& errors,
                                                       const std::vector<double>& rates);

/// The limit of places whose distances follow D_{n+1} = K 2^(n/3) D_n^(4/3), from three of them; its error is what the
/// three before say otherwise.
/// @returns empty with fewer than four places, or if they follow no such law
[[nodiscard]] std::optional<PlaceLimit> limit_with_friction(const std::vector<double>& places);

}  // namespace slapstick::orbit
