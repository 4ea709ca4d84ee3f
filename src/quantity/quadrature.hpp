#pragma once
/// Gauss's quadratures on [0, 1] with n = 16 and n = 32 nodes: exact to degree 2 n - 1. Of a function that is a sum of
/// exp(mu x) they are exact to rounding for |mu| <= 14 and 50: the error is below |mu|^(2 n + 1) (n!)^4 / ((2 n + 1)
/// ((2 n)!)^3).
#include <array>
#include <cmath>
#include <numbers>

#include "event/polynomial.hpp"

namespace slapstick::quantity {

inline constexpr int nodes = 16;

struct Quadrature {
  std::array<double, nodes> x{}, weight{};
};

/// Nodes and weights of Gauss and Legendre, from [-1, 1].
inline const Quadrature& gauss() {
  static constexpr std::array<double, nodes / 2> node = {
      0.0950125098376374401853193354249581, 0.2816035507792589132304605014604961, 0.4580167776572273863424194429835776,
      0.6178762444026437484466717640487910, 0.7554044083550030338951011948474422, 0.8656312023878317438804678977123931,
      0.9445750230732325760779884155346083, 0.9894009349916499325961541734503326};
  static constexpr std::array<double, nodes / 2> weight = {
      0.1894506104550684962853967232082831, 0.1826034150449235888667636679692199, 0.1691565193950025381893120790303599,
      0.1495959888165767320815017305474786, 0.1246289712555338720524762821920164, 0.0951585116824927848099251076022462,
      0.0622535239386478928628438369943777, 0.0271524594117540948517805724560181};
  static const Quadrature rule = [] {
    Quadrature made;
    for (int k = 0; k < nodes / 2; ++k) {
      const auto left = static_cast<std::size_t>(nodes / 2 - 1 - k), right = static_cast<std::size_t>(nodes / 2 + k),
                 of = static_cast<std::size_t>(k);
      made.x[left] = 0.5 * (1.0 - node[of]);
      made.x[right] = 0.5 * (1.0 + node[of]);
      made.weight[left] = made.weight[right] = 0.5 * weight[of];
    }
    return made;
  }();
  return rule;
}

inline constexpr int many_nodes = 32;

struct LongQuadrature {
  std::array<double, many_nodes> x{}, weight{};
};

/// By Newton's method on Legendre's polynomial of degree 32, from cos(pi (i + 3/4) / (n + 1/2)).
inline const LongQuadrature& long_gauss() {
  static const LongQuadrature rule = [] {
    LongQuadrature made;
    for (int i = 0; i < many_nodes; ++i) {
      double z = std::cos(std::numbers::pi * (i + 0.75) / (many_nodes + 0.5)), slope = 0.0;
      for (int step = 0; step < 8; ++step) {
        double p = 1.0, before = 0.0;
        for (int n = 1; n <= many_nodes; ++n) {
          const double next = ((2 * n - 1) * z * p - (n - 1) * before) / n;
          before = p;
          p = next;
        }
        slope = many_nodes * (z * p - before) / (z * z - 1.0);
        z -= p / slope;
      }
      const auto at = static_cast<std::size_t>(i);
      made.x[at] = 0.5 * (1.0 - z);
      made.weight[at] = 1.0 / ((1.0 - z * z) * slope * slope);
    }
    return made;
  }();
  return rule;
}

/// f at these nodes.
template <std::size_t N>
std::array<double, N> at_nodes(const event::Polynomial& f, const std::array<double, N>& x) {
  using Powers = std::array<std::array<double, N>, event::Polynomial::most + 1>;
  static const Powers powers = [&] {  // of the one rule with N nodes
    Powers made{};
    for (std::size_t k = 0; k < N; ++k) {
      made[0][k] = 1.0;
      for (std::size_t j = 1; j < made.size(); ++j) made[j][k] = made[j - 1][k] * x[k];
    }
    return made;
  }();
  std::array<double, N> values{};
  for (int j = f.degree; j >= 0; --j)  // the small terms first
    for (std::size_t k = 0; k < N; ++k)
      values[k] += f.a[static_cast<std::size_t>(j)] * powers[static_cast<std::size_t>(j)][k];
  return values;
}

inline std::array<double, nodes> at_nodes(const event::Polynomial& f) { return at_nodes(f, gauss().x); }

}  // namespace slapstick::quantity
