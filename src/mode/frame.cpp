/// Chooses contact coordinates, and moves states into and out of them.
#include "mode/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/dense.hpp"
#include "base/elementary.hpp"
#include "base/phase.hpp"
#include "base/ranges.hpp"
#include "mode/assembly.hpp"
#include "mode/numbering.hpp"
#include "model/fault.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::mode {

Frame::Frame(const Model& model) : n(model.size()) {
  for (const Force& force : model.forces) {
    if (force.harmonic > 0 && ranges::find(harmonics, force.harmonic) == harmonics.end())
      harmonics.push_back(force.harmonic);
  }
  ranges::sort(harmonics);
  period = model.forcing_period();
  for (const Force& force : model.forces) {
    if (force.frequency != 0.0 && ranges::find(tones, force.frequency, &Tone::frequency) == tones.end())
      tones.emplace_back(force.frequency, period);
  }
  for (const Signal& of : model.signals) signals.emplace_back(of, period);
  choose_displacements(model);
  set_dynamics(model);
  set_characteristics(model);
  add_sliders(model);
}

void Frame::choose_displacements(const Model& model) {
  const Numbering numbering(model);
  stops = numbering.stops;
  compliant = numbering.compliant;
  frictions = numbering.frictions;
  for (const ContactRow& pair : numbering.sliders) sliders.push_back({0, 0, pair, {}});
  d = static_cast<int>(numbering.numbers.size());
  W.resize(d, n);
  shift.resize(d);
  drift.resize(d);
  for (int i = 0; i < d; ++i) {
    const Number& number = numbering.numbers[static_cast<std::size_t>(i)];
    W.row(i) = number.row;
    shift[i] = number.shift;
    drift[i] = number.drift;
  }
  // What is next to nothing in its row is the rounding of a zero, which `reconcile` would take for a dependence.
  const auto without_rounding = [](Matrix rows) {
    drop_rounding(rows, rows.cwiseAbs().rowwise().maxCoeff().replicate(1, rows.cols()));
    return rows;
  };
  W_inverse = without_rounding(dense::inverse(W.topRows(n)));
  dependence = without_rounding(W * W_inverse);
  dependence.topRows(n).setIdentity();
  const auto slack = [&](const Vector& offset) {
    Matrix sum = dependence * offset.head(n) - offset;
    drop_rounding(sum, dependence.cwiseAbs() * offset.head(n).cwiseAbs() + offset.cwiseAbs());
    return Vector(sum);
  };
  shift_slack = slack(shift);
  drift_slack = slack(drift);
}

void Frame::set_dynamics(const Model& model) {
  const Matrix K = stiffness_matrix(model), C = damping_matrix(model), M_inverse = inverse_mass(model);
  Matrix load = Matrix::Zero(n, size());
  for (const Force& force : model.forces)
    if (force.presses < 0) load.row(force.coordinate) += drive_row(force);

  // q'' = M^{-1} (load X - C q' - K q),  q = W^{-1} (p + shift),  q' = W^{-1} (u + drift),  u' = W q''
  mass_inverse = W * M_inverse * W.transpose();
  drop_rounding(mass_inverse, W.cwiseAbs() * M_inverse.cwiseAbs() * W.cwiseAbs().transpose());
  const Matrix stiffness = K * W_inverse, damping = C * W_inverse;
  Matrix force = load, force_size = load.cwiseAbs();
  force.leftCols(n) -= stiffness;
  force.middleCols(d, n) -= damping;
  force.col(one()) -= stiffness * shift.head(n) + damping * drift.head(n);
  force_size.leftCols(n) += K.cwiseAbs() * W_inverse.cwiseAbs();
  force_size.middleCols(d, n) += C.cwiseAbs() * W_inverse.cwiseAbs();
  force_size.col(one()) +=
      stiffness.cwiseAbs() * shift.head(n).cwiseAbs() + damping.cwiseAbs() * drift.head(n).cwiseAbs();
  Matrix acceleration = M_inverse * force, size = M_inverse.cwiseAbs() * force_size;
  choose_inner(model, K, C);
  add_inner_accelerations(acceleration, size);
  free = W * acceleration;
  free_size = W.cwiseAbs() * size;
  drop_rounding(free, free_size);
}

/// q = W^{-1} (p + shift), q' = W^{-1} (u + drift); u' = W M^{-1} force.
void Frame::set_characteristics(const Model& model) {
  if (model.characteristics.empty()) return;
  const Matrix to_velocity = W * inverse_mass(model), size = W.cwiseAbs() * inverse_mass(model).cwiseAbs();
  for (const Characteristic& one_of : model.characteristics) {
    const RowVector pair = pair_row(n, one_of);
    Matrix row = pair * W_inverse;
    drop_rounding(row, pair.cwiseAbs() * W_inverse.cwiseAbs());
    PairRows rows{RowVector::Zero(this->size()), RowVector::Zero(this->size()), {}, {}};
    rows.displacement.head(n) = row;
    rows.displacement[one()] = row.row(0).dot(shift.head(n));
    rows.velocity.segment(d, n) = row;
    rows.velocity[one()] = row.row(0).dot(drift.head(n));
    Matrix push = to_velocity * pair.transpose();
    drop_rounding(push, size * pair.cwiseAbs().transpose());
    rows.push = push;
    const bool rated = one_of.over == Characteristic::Over::velocity;
    for (const Characteristic::Corner& corner : one_of.corners)
      rows.corners.push_back(corner_row(pair, rated ? rows.velocity : rows.displacement, rated, corner.at));
    characteristics.push_back(std::move(rows));
  }
}

/// Of y - at, or y' - at: y = sign (p + shift), y' = sign (u + drift) by each number of the pair.
RowVector Frame::corner_row(const RowVector& pair, const RowVector& value, bool rated, double at) const {
  for (int i = 0; i < d; ++i) {
    const int sign = same_direction(W.row(i), pair);
    if (sign != 0 && at == sign * (rated ? drift[i] : shift[i]))
      return sign * RowVector::Unit(size(), rated ? u(i) : i);
  }
  return value - at * RowVector::Unit(size(), one());
}

void Frame::drop_rounding(Matrix& matrix, const Matrix& size) {
  matrix = (matrix.array().abs() > structural_zero * size.array()).select(matrix, 0.0);
}

int Frame::parallel(int i, int j) const { return same_direction(W.row(i), W.row(j)); }

RowVector Frame::velocity_row(const ContactRow& contact) const {
  return contact.sign * RowVector::Unit(size(), u(contact.own));
}

RowVector Frame::gap_row(const ContactRow& contact) const {
  return -contact.sign * RowVector::Unit(size(), contact.own);
}

RowVector Frame::push_row(const Model& model, int i) const {
  const CompliantStop& stop = model.compliant_stops[i];
  return -stop.stiffness * gap_row(compliant[i]) + stop.damping * velocity_row(compliant[i]);
}

Piece piece_of(const Characteristic& characteristic, int piece) {
  const auto& corners = characteristic.corners;
  const auto last = static_cast<int>(corners.size());
  const Characteristic::Corner& from = corners[static_cast<std::size_t>(std::max(piece - 1, 0))];
  if (characteristic.over == Characteristic::Over::zones)
    return {piece == 0 ? characteristic.slope_below : from.force, 0.0};
  double slope = piece == 0 ? characteristic.slope_below : characteristic.slope_above;
  if (piece > 0 && piece < last) {
    const Characteristic::Corner& to = corners[static_cast<std::size_t>(piece)];
    slope = (to.force - from.force) / (to.at - from.at);
  }
  return {slope, from.force - slope * from.at};
}

Piece piece_rate(const Characteristic& characteristic, const Characteristic& rate, int piece) {
  const auto last = static_cast<int>(characteristic.corners.size());
  const auto i = static_cast<std::size_t>(std::max(piece - 1, 0));
  const Characteristic::Corner &from = characteristic.corners[i], &change = rate.corners[i];
  if (characteristic.over == Characteristic::Over::zones) return {piece == 0 ? rate.slope_below : change.force, 0.0};
  const double slope = piece_of(characteristic, piece).slope;
  double slope_rate = piece == 0 ? rate.slope_below : rate.slope_above;
  if (piece > 0 && piece < last) {
    const Characteristic::Corner &to = characteristic.corners[i + 1], &to_change = rate.corners[i + 1];
    slope_rate = (to_change.force - change.force - slope * (to_change.at - change.at)) / (to.at - from.at);
  }
  return {slope_rate, change.force - slope_rate * from.at - slope * change.at};
}

RowVector Frame::force_row(const Model& model, int i, int piece) const {
  const Piece line = piece_of(model.characteristics[i], piece);
  RowVector row = line.slope * slope_row(model, i);
  row[one()] += line.offset;
  return row;
}

RowVector Frame::drive_row(const Force& force) const {
  RowVector row = RowVector::Zero(size());
  if (force.signal >= 0) {
    const int value = signal(static_cast<std::size_t>(force.signal));
    row[force.rate ? value + 1 : value] = force.rate ? force.amplitude / period : force.amplitude;
  } else if (force.frequency == 0.0 && force.harmonic == 0) {
    row[one()] = force.amplitude;
  } else {
    const auto k = ranges::find(harmonics, force.harmonic) - harmonics.begin();
    const auto t = ranges::find(tones, force.frequency, &Tone::frequency) - tones.begin();
    const auto c = force.frequency == 0.0 ? 2 * d + 2 * k : tone(static_cast<std::size_t>(t));
    // sin(j theta + phase) = sin(phase) cos(j theta) + cos(phase) sin(j theta)
    const auto [cosine, sine] = fixed::cosine_sine(force.phase);
    row[c] = force.amplitude * sine;
    row[c + 1] = force.amplitude * cosine;
  }
  return row;
}

Matrix Frame::kinematics(double omega) const {
  Matrix A = Matrix::Zero(size(), size());
  for (int i = 0; i < d; ++i) {
    A(i, u(i)) = 1.0;
    A(i, one()) = drift[i];
  }
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * d + 2 * k);
    A(c, c + 1) = -harmonics[k] * omega;
    A(c + 1, c) = harmonics[k] * omega;
  }
  for (std::size_t k = 0; k < tones.size(); ++k) {
    A(tone(k), tone(k) + 1) = -tones[k].frequency;
    A(tone(k) + 1, tone(k)) = tones[k].frequency;
  }
  for (std::size_t k = 0; k < signals.size(); ++k) A(signal(k), signal(k) + 1) = 1.0 / period;
  return A;
}

void Frame::enter(const double* state, double* X) const {
  for (int i = 0; i < d; ++i) {
    double p = 0.0, rate = 0.0, size = std::abs(shift[i]), speed = std::abs(drift[i]);
    bool ratio = false;
    for (int j = 0; j < n; ++j) {
      ratio = ratio || (W(i, j) != 0.0 && std::abs(W(i, j)) != 1.0);
      p += W(i, j) * state[2 * j];
      rate += W(i, j) * state[2 * j + 1];
      size += std::abs(W(i, j) * state[2 * j]);
      speed += std::abs(W(i, j) * state[2 * j + 1]);
    }
    X[i] = p - shift[i];
    // A gap below the rounding of the coordinates it comes from is contact: a state written out on a closed stop reads
    // back as one.
    const double error = reading_error(n, ratio);
    if ((ratio || shift[i] != 0.0) && std::abs(X[i]) <= error * size) X[i] = 0.0;
    X[u(i)] = rate - drift[i];
    if ((ratio || drift[i] != 0.0) && std::abs(X[u(i)]) <= error * speed) X[u(i)] = 0.0;  // so is rest on a belt
  }
  set_inner_rates(X);
  draw_sliders(X);
}

PeriodicDrive::PeriodicDrive(const Model& model, const Frame& frame) : model_(model), frame_(frame) {
  if (!frame.tones.empty() || !ranges::all_of(frame.signals, &SignalTable::in_periods))
    throw InputError("a model with a force of its own frequency, or a signal that is not in periods, has no phase");
}

void PeriodicDrive::set(double turns, const std::vector<int>& lines, double* X) const {
  frame_.set_phase(turns, X);
  for (std::size_t k = 0; k < frame_.signals.size(); ++k) {
    if (static_cast<std::size_t>(lines[k]) + 1 >= model_.signals[k].knots.size())
      throw NumericalError("orbit: signal '" + model_.signals[k].name +
                           "' has fewer points than where the orbit began");
    const auto [value, slope] = on_line(model_.signals[k], lines[k], turns);
    X[frame_.signal(k)] = value;
    X[frame_.signal(k) + 1] = slope;
  }
}

Vector PeriodicDrive::by_turns(const Vector& X) const {
  Vector rate = Vector::Zero(X.size());
  for (std::size_t k = 0; k < frame_.harmonics.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * frame_.d + 2 * k);
    const double turn = 2.0 * std::numbers::pi * frame_.harmonics[k];
    rate[c] = -turn * X[c + 1];
    rate[c + 1] = turn * X[c];
  }
  for (std::size_t k = 0; k < frame_.signals.size(); ++k) rate[frame_.signal(k)] = X[frame_.signal(k) + 1];
  return rate;
}

Vector PeriodicDrive::by_parameter(const Model& rate, double turns, const std::vector<int>& lines) const {
  Vector change = Vector::Zero(frame_.size());
  for (std::size_t k = 0; k < frame_.signals.size(); ++k) {
    const auto [value, slope] = line_rate(model_.signals[k], rate.signals[k], lines[k], turns);
    change[frame_.signal(k)] = value;
    change[frame_.signal(k) + 1] = slope;
  }
  return change;
}

void Frame::set_phase(double turns, double* X) const {
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    const auto [cosine, sine] = of_turns(harmonics[k] * turns);
    X[2 * d + 2 * k] = cosine;
    X[2 * d + 2 * k + 1] = sine;
  }
  X[one()] = 1.0;
}

void Frame::set_clock(Instant t, double* X, bool behind) const {
  set_phase(t.fraction, X);
  for (std::size_t k = 0; k < tones.size(); ++k) {
    const auto [cosine, sine] = of_turns(tones[k].at(t));
    X[tone(k)] = cosine;
    X[tone(k) + 1] = sine;
  }
  for (std::size_t k = 0; k < signals.size(); ++k) {
    if (!behind) {
      X[signal(k)] = signals[k].before(t);
      continue;
    }
    const auto [value, slope] = signals[k].at(t);
    X[signal(k)] = value;
    X[signal(k) + 1] = slope;
  }
}

void Frame::kick(std::size_t of_signal, double area, double* X) const {
  for (int i = 0; i < d; ++i) X[u(i)] += free(i, signal(of_signal)) * area;
}

std::vector<int> Frame::lines_at(Instant t) const {
  std::vector<int> lines;
  for (const SignalTable& of : signals) lines.push_back(of.line_at(t));
  return lines;
}

void Frame::set_clock_sizes(const double* X, double* sizes) const {
  for (int c = 2 * d; c < signal(0); ++c) sizes[c] = 1.0;
  for (std::size_t k = 0; k < signals.size(); ++k) sizes[signal(k)] = std::abs(X[signal(k) + 1]);
}

Instant Frame::next_knot(Instant t) const {
  Instant next = SignalTable::never;
  for (const SignalTable& of : signals) next = std::min(next, of.next(t));
  return next;
}

void Frame::match_velocities(int i, double* X) const {
  for (int j = 0; d > n && j < d; ++j) {
    if (const int same = j == i ? 0 : parallel(i, j); same != 0) X[u(j)] = same * (X[u(i)] + drift[i]) - drift[j];
  }
}

void Frame::match_displacements(int i, double* X) const {
  for (int j = 0; d > n && j < d; ++j) {
    if (const int same = j == i ? 0 : parallel(i, j); same != 0) X[j] = same * (X[i] + shift[i]) - shift[j];
  }
}

namespace {

/// Dependent numbers and the basis numbers they follow from: stored = sum_j coefficient_j basis_j + slack. The offsets
/// themselves do not enter: their rounding is more than the gaps of stops that are about to close together, and would
/// never let them come to rest. Zeros come first, because a basis number may give way to a zero: what follows from the
/// same basis number must see its last value.
void reconcile(const Matrix& dependence, const Vector& slack, double* numbers) {
  constexpr double no_cancellation = 0.25;
  for (const bool zeros : {true, false})
    for (Eigen::Index i = dependence.cols(); i < dependence.rows(); ++i) {
      if ((numbers[i] == 0.0) != zeros) continue;
      double sum = slack[i], size = std::abs(slack[i]);
      Eigen::Index largest = -1;  // of the basis numbers
      for (Eigen::Index j = 0; j < dependence.cols(); ++j) {
        const double term = dependence(i, j) * numbers[j];
        sum += term;
        size += std::abs(term);
        if (term != 0.0 && (largest < 0 || std::abs(numbers[j]) > std::abs(numbers[largest]))) largest = j;
      }
      if (zeros && largest >= 0) numbers[largest] -= sum / dependence(i, largest);
      if (!zeros && std::abs(sum) >= no_cancellation * size) numbers[i] = sum;
    }
}

}  // namespace

void Frame::refresh(double* X) const {
  reconcile(dependence, shift_slack, X);
  reconcile(dependence, drift_slack, X + d);
}

void Frame::leave(const double* p, const double* velocity, double* state) const {
  for (int i = 0; i < n; ++i) {
    double q = 0.0, rate = 0.0, speed = 0.0;
    for (int j = 0; j < n; ++j) {
      const double term = W_inverse(i, j) * (velocity[j] + drift[j]);
      q += W_inverse(i, j) * (p[j] + shift[j]);
      rate += term;
      speed += std::abs(term);
    }
    state[2 * i] = q;
    state[2 * i + 1] = std::abs(rate) <= structural_zero * speed ? 0.0 : rate;
  }
}

}  // namespace slapstick::mode
