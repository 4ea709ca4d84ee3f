/// Makes polynomials of rows, and quantities of these.
#include "quantity/terms.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::quantity {
namespace {

/// Zero from the degree on.
void widen(int to, Polynomial& f) {
  while (f.degree < to) f.a[static_cast<std::size_t>(++f.degree)] = 0.0;
}

void add_product(const Polynomial& f, const Polynomial& g, Polynomial& sum) {
  widen(f.degree + g.degree, sum);
  for (int i = 0; i <= f.degree; ++i)
    for (int j = 0; j <= g.degree; ++j)
      sum.a[static_cast<std::size_t>(i + j)] += f.a[static_cast<std::size_t>(i)] * g.a[static_cast<std::size_t>(j)];
}

}  // namespace

void scale_rows(const Vector& coefficients, double ratio, std::vector<Polynomial>& out) {
  constexpr double negligible = 0x1p-60;
  out.resize(static_cast<std::size_t>(coefficients.size()) / (taylor_degree + 1));
  for (std::size_t r = 0; r < out.size(); ++r) {
    Polynomial& f = out[r];
    double power = 1.0, size = 0.0;
    for (int j = 0; j <= taylor_degree; ++j, power *= ratio) {
      const double a = power * coefficients[static_cast<Eigen::Index>(r) * (taylor_degree + 1) + j];
      f.a[static_cast<std::size_t>(j)] = a;
      size += std::abs(a);
    }
    f.degree = taylor_degree;
    while (f.degree > 0 && std::abs(f.a[static_cast<std::size_t>(f.degree)]) <= negligible * size) --f.degree;
  }
}

void combine(const Term& term, const std::vector<Polynomial>& rows, Polynomial& value) {
  value.degree = 0;
  value.a[0] = 0.0;
  if (term.linear) {
    const Polynomial& row = rows[*term.linear];
    value.degree = row.degree;
    std::copy_n(row.a.begin(), row.degree + 1, value.a.begin());
  }
  for (const auto& [a, b] : term.products) add_product(rows[a], rows[b], value);
}

void combine_rates(const Term& term, const std::vector<Polynomial>& rows, const std::vector<Polynomial>& rates,
                   Polynomial& value) {
  combine({{}, term.linear}, rates, value);
  for (const auto& [a, b] : term.products) {
    add_product(rates[a], rows[b], value);
    add_product(rows[a], rates[b], value);
  }
}

}  // namespace slapstick::quantity
