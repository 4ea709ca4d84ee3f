/// Inner coordinates, whose rates follow from the displacements.
#include "mode/frame.hpp"
#include "mode/numbering.hpp"

namespace slapstick::mode {

/// s' = -(K q)_s / c,  q = W^{-1} (p + shift). No contact acts on s: its number has no shift.
void Frame::choose_inner(const Model& model, const Matrix& K, const Matrix& C) {
  for (int i = 0; i < n; ++i) {
    if (!model.is_inner(i)) continue;
    InnerRow row{i, 0, RowVector::Zero(size()), 2.0 * K(i, i) / C(i, i)};
    while (same_direction(W.row(row.own), RowVector::Unit(n, i)) == 0) ++row.own;
    Matrix over_p = -K.row(i) * W_inverse / C(i, i);
    drop_rounding(over_p, K.row(i).cwiseAbs() * W_inverse.cwiseAbs() / C(i, i));
    row.rate.head(n) = over_p;
    row.rate[one()] = row.rate.head(n).dot(shift.head(n));
    inner.push_back(std::move(row));
  }
}

/// (row . X)' - settling (s' - row . X): the row is one of displacements, and p' = u + drift.
void Frame::add_inner_accelerations(Matrix& acceleration, Matrix& size) const {
  for (const InnerRow& row : inner) {
    RowVector change = row.settling * row.rate;
    change.segment(d, n) += row.rate.head(n);
    change[one()] += row.rate.head(n).dot(drift.head(n));
    change[u(row.own)] -= row.settling;
    acceleration.row(row.coordinate) += change;
    size.row(row.coordinate) += change.cwiseAbs();
  }
}

void Frame::set_inner_rates(double* X) const {
  for (const InnerRow& row : inner) {
    double rate = row.rate[one()];
    for (int i = 0; i < n; ++i) rate += row.rate[i] * X[i];
    X[u(row.own)] = rate;
  }
}

}  // namespace slapstick::mode
