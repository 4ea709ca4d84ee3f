#pragma once
/// Fourier integrals of a quantity along a trace, impulses included.
#include <cmath>
#include <complex>
#include <vector>

#include "quantity/line_sums.hpp"
#include "quantity/quadrature.hpp"
#include "quantity/tracer.hpp"

namespace slapstick::quantity {

/// Integrals of f(t) exp(-2 pi i k t / T), k = 0 .. count - 1, of the first quantity of the trace.
class Fourier : public Listener {
 public:
  Fourier(double T, std::size_t count) : T_(T), count_(count), sums_(T, count) {}

  void step(const Step& step) override {
    const Polynomial& f = step.values[0];
    if (f.size() == 0.0) return;
    const double turns = static_cast<double>(count_) * step.length / T_;
    const double parts = std::max(1.0, std::ceil(turns / most_turns));
    for (double part = 0.0; part < parts; ++part)
      for (std::size_t k = 0; k < nodes; ++k) {
        const double x = (part + gauss().x[k]) / parts, weight = gauss().weight[k] * step.length / parts, value = f.at(x);
        sums_.add(weight * value, step.begin + x * step.length);
        square_ += weight * value * value;
      }
  }

  void blow(const Blow& blow) override {
    if (blow.impulses[0].value == 0.0) return;
    sums_.add(blow.impulses[0].value, blow.time.value);
    ++impulses_;
  }

  /// The integrals since the last call.
  [[nodiscard]] std::vector<std::complex<double>> take() { return sums_.take(); }
  [[nodiscard]] double square() const { return square_; }
  [[nodiscard]] long impulses() const { return impulses_; }

 private:
  static constexpr double most_turns = 1.5;  ///< in a quadrature: 10 of the 14 that are exact to rounding

  double T_;
  std::size_t count_;
  LineSums sums_;
  double square_ = 0.0;
  long impulses_ = 0;
};

}  // namespace slapstick::quantity
