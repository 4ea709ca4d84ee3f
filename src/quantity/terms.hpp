#pragma once
/// Quantities as polynomials: sums of rows over X and of products of two.
#include <optional>
#include <utility>
#include <vector>

#include "event/polynomial.hpp"
#include "mode/outline.hpp"

namespace slapstick::quantity {

using event::Polynomial;
using mode::Vector;

/// Of the Taylor polynomials of rows: what is left out is below rounding on the steps of a mode.
inline constexpr int taylor_degree = 23;

/// The rows, by their numbers, that a quantity is made of.
struct Term {
  std::vector<std::pair<std::size_t, std::size_t>> products;
  std::optional<std::size_t> linear;
};

/// Rows' coefficients, degree + 1 of each, as polynomials on a part of their step, without the terms that are below
/// rounding.
void scale_rows(const Vector& coefficients, double ratio, std::vector<Polynomial>& out);

/// A quantity of its rows.
void combine(const Term& term, const std::vector<Polynomial>& rows, Polynomial& value);

/// Its derivative: (a b)' = a' b + a b'.
void combine_rates(const Term& term, const std::vector<Polynomial>& rows, const std::vector<Polynomial>& rates,
                   Polynomial& value);

}  // namespace slapstick::quantity
