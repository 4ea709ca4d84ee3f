/// Inner coordinates: those whose rates follow from the displacements, and sliders.
#include <cmath>

#include "base/ranges.hpp"
#include "mode/assembly.hpp"
#include "mode/frame.hpp"
#include "mode/numbering.hpp"
#include "model/fault.hpp"

namespace slapstick::mode {
namespace {

/// The number of an inner coordinate: no contact acts on it, so that it is itself among the first n.
int number_of(const Matrix& W, int n, int coordinate) {
  int own = 0;
  while (same_direction(W.row(own), RowVector::Unit(n, coordinate)) == 0) ++own;
  return own;
}

double value_of(const RowVector& row, const double* X) {
  double sum = row[row.size() - 1];  // X ends with 1, which may not be written yet
  for (Eigen::Index i = 0; i + 1 < row.size(); ++i) sum += row[i] * X[i];
  return sum;
}

}  // namespace

/// s' = -(K q)_s / c,  q = W^{-1} (p + shift). No contact acts on s: its number has no shift.
void Frame::choose_inner(const Model& model, const Matrix& K, const Matrix& C) {
  for (int i = 0; i < n; ++i) {
    if (!model.is_inner(i) || C(i, i) == 0.0) continue;
    InnerRow row{i, number_of(W, n, i), RowVector::Zero(size()), 2.0 * K(i, i) / C(i, i)};
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

void Frame::add_sliders(const Model& model) {
  auto next = sliders.begin();
  for (std::size_t i = 0; i < model.characteristics.size(); ++i) {
    const Characteristic& one_of = model.characteristics[i];
    if (one_of.inner < 0) continue;
    SliderRow& row = *next++;
    const RowVector pair = outer_row(n, one_of);
    Matrix over = pair * W_inverse;
    drop_rounding(over, pair.cwiseAbs() * W_inverse.cwiseAbs());
    row.characteristic = static_cast<int>(i);
    row.own = number_of(W, n, one_of.inner);
    row.displacement = RowVector::Zero(size());
    row.displacement.head(n) = over;
    row.displacement[one()] = over.row(0).dot(shift.head(n));
    row.low = one_of.corners.front().at;
    row.high = one_of.corners.back().at;
    characteristics[i].velocity = velocity_row(row.pair);
  }
}

const SliderRow* Frame::slider(int characteristic) const {
  const auto found = ranges::find(sliders, characteristic, &SliderRow::characteristic);
  return found == sliders.end() ? nullptr : &*found;
}

bool Frame::rate_follows(int i) const {
  const auto own = [&](const auto& row) { return row.own == i; };
  return ranges::any_of(inner, own) || ranges::any_of(sliders, own);
}

void Frame::set_slider_rates(const std::vector<int>& pieces, double* X) const {
  for (const SliderRow& row : sliders) X[u(row.own)] = row.rests(pieces) ? 0.0 : row.pair.sign * X[u(row.pair.own)];
}

void Frame::set_sliders(const std::vector<int>& pieces, double* X) const {
  for (const SliderRow& row : sliders) {
    const bool below = pieces[static_cast<std::size_t>(row.characteristic)] == 0;
    if (!row.rests(pieces)) X[row.own] = value_of(row.displacement, X) - (below ? row.low : row.high);
  }
}

/// Also one that is beside its corner by the rounding of a state that was written out there.
void Frame::draw_sliders(double* X) const {
  for (const SliderRow& row : sliders) {
    const double y = value_of(row.displacement, X), s = X[row.own];
    double size = std::abs(s) + std::abs(row.displacement[one()]);
    for (int i = 0; i < n; ++i) size += std::abs(row.displacement[i] * X[i]);
    const double error = reading_error(n, true) * size;
    if (y - s >= row.high - error) X[row.own] = y - row.high;
    if (y - s <= row.low + error) X[row.own] = y - row.low;
    X[u(row.own)] = 0.0;
  }
}

}  // namespace slapstick::mode
