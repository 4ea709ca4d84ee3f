#pragma once
/// Numbers and rows over X together with their derivatives by one parameter of the model.
///
/// Sums and products obey the product rule. Where no parameter is asked for, the derivatives are zero.
#include "mode/derivative.hpp"

namespace slapstick::quantity {

using mode::Matrix;
using mode::RowVector;
using mode::Vector;

struct Number {
  double value = 0.0, rate = 0.0;

  Number& operator+=(Number b) { return value += b.value, rate += b.rate, *this; }
  Number& operator-=(Number b) { return value -= b.value, rate -= b.rate, *this; }
};
[[nodiscard]] inline Number operator+(Number a, Number b) { return a += b; }
[[nodiscard]] inline Number operator-(Number a, Number b) { return a -= b; }
[[nodiscard]] inline Number operator-(Number a) { return {-a.value, -a.rate}; }
[[nodiscard]] inline Number operator*(Number a, Number b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate};
}
[[nodiscard]] inline Number operator*(double a, Number b) { return {a * b.value, a * b.rate}; }
[[nodiscard]] inline Number operator/(Number a, Number b) {
  const double q = a.value / b.value;
  return {q, (a.rate - q * b.rate) / b.value};
}

struct Row {
  RowVector value, rate;

  Row& operator+=(const Row& b) { return value += b.value, rate += b.rate, *this; }
  Row& operator-=(const Row& b) { return value -= b.value, rate -= b.rate, *this; }
  /// At X, which moves by `by`: empty where no derivative is asked for.
  [[nodiscard]] Number at(const Vector& X, const Vector& by) const {
    return {value.dot(X), by.size() == 0 ? 0.0 : rate.dot(X) + value.dot(by)};
  }
};
[[nodiscard]] inline Row operator+(Row a, const Row& b) { return a += b; }
[[nodiscard]] inline Row operator-(Row a, const Row& b) { return a -= b; }
[[nodiscard]] inline Row operator*(Number a, const Row& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate};
}
[[nodiscard]] inline Row operator*(double a, const Row& b) { return {a * b.value, a * b.rate}; }

/// The derivatives of a model and of what a mode is made of.
struct Rates {
  const Model& model;
  const mode::FrameDerivative& frame;
  const mode::OutlineDerivative* outline = nullptr;  ///< of the mode in question
};

}  // namespace slapstick::quantity
