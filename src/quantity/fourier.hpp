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
    if (turns <= few_turns) return add(gauss(), at_nodes(f, gauss().x), step.begin, step.length);
    if (turns <= most_turns) return add(long_gauss(), at_nodes(f, long_gauss().x), step.begin, step.length);
    const double parts = std::ceil(turns / most_turns), length = step.length / parts;
    for (double part = 0.0; part < parts; ++part) {
      std::array<double, many_nodes> values{};
      for (std::size_t k = 0; k < many_nodes; ++k) values[k] = f.at((part + long_gauss().x[k]) / parts);
      add(long_gauss(), values, step.begin + part * length, length);
    }
  }

  void jump(const VelocityJump& jump) override {
    if (jump.impulses[0].value == 0.0) return;
    sums_.add(jump.impulses[0].value, jump.time.value);
    ++impulses_;
  }

  /// The integrals since the last call.
  [[nodiscard]] std::vector<std::complex<double>> take() { return sums_.take(); }
  [[nodiscard]] double square() const { return square_; }
  [[nodiscard]] long impulses() const { return impulses_; }

 private:
  /// In a quadrature: 10 of the 14, and 44 of the 50, that are exact to rounding.
  static constexpr double few_turns = 1.5, most_turns = 7.0;

  template <class Rule, class Values>
  void add(const Rule& rule, const Values& values, double begin, double length) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double weight = rule.weight[k] * length;
      sums_.add(weight * values[k], begin + rule.x[k] * length);
      square_ += weight * values[k] * values[k];
    }
  }

  double T_;
  std::size_t count_;
  LineSums sums_;
  double square_ = 0.0;
  long impulses_ = 0;
};

}  // namespace slapstick::quantity
