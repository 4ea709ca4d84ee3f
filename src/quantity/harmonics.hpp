#pragma once
/// Harmonics of a quantity over a cycle, impulses included, with their derivatives:
///
///     c_k = 2 / T integral of f exp(-i k w t) dt,   f = mean + sum of Re(c_k exp(i k w t))
///
/// At a fixed time of a piece, whose begin b moves, t' = b': the integrand moves as (f' - i k (w' t + w b') f) exp(-i k
/// w t), and the ends of a step bring f exp(-i k w t) times their own rates.
#include <array>
#include <complex>
#include <vector>

#include "quantity/tracer.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::quantity {

class Harmonics {
 public:
  /// @param frequency  w / 2 pi; 0: nothing is summed
  explicit Harmonics(Number frequency) : frequency_(frequency) {}

  /// @param rate  of f at a fixed time of the piece, or null
  void add(const Polynomial& f, const Polynomial* rate, const Step& step);
  void add(Number impulse, Number time);

  struct Found {
    std::vector<std::complex<double>> value, rate;
  };
  [[nodiscard]] Found over(Number duration) const;

 private:
  using Lines = std::array<std::complex<double>, most_harmonics>;

  /// Adds (f, f' - i k w t' f) exp(-i k w t), of which t' is what the time at hand moves by.
  void add_at(Number f, Number t);
  void add_end(double f, double t, double by);

  Number frequency_;
  Lines value_{}, rate_{};
};

}  // namespace slapstick::quantity
