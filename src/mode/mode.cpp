/// Builds the operators of a mode and applies them.
#include "mode/mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.hpp"
#include "mode/series.hpp"

namespace slapstick::mode {

Mode::Mode(const Model& model, const Frame& frame, ContactStates states, double longest_window)
    : outline_(model, frame, std::move(states)), d_(frame.d), m_(frame.size()) {
  drift_.assign(frame.drift.begin(), frame.drift.end());
  build_operators(frame, model, longest_window);
}

/// exp(A H): positions from their own series, u = p' - drift from its derivative, the oscillators as rotations.
Matrix Mode::flow_over_window(const Series& series, std::size_t first_coordinate, const Frame& frame,
                              double omega) const {
  Matrix flow = Matrix::Identity(m_, m_);
  for (int i = 0; i < d_; ++i) {
    flow.row(i) = series.end_value(first_coordinate + i);
    flow.row(d_ + i) = series.end_slope(first_coordinate + i);
    flow(d_ + i, m_ - 1) -= drift_[i];
    if (outline_.steady[i]) flow.row(d_ + i) = RowVector::Unit(m_, d_ + i);
  }
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * d_ + 2 * k);
    const double angle = frame.harmonics[k] * omega * window_;
    const double cosine = fixed::cos(angle), sine = fixed::sin(angle);
    flow.block<2, 2>(c, c) << cosine, -sine, sine, cosine;
  }
  for (std::size_t k = 0; k < frame.tones.size(); ++k) {
    const double angle = frame.tones[k].frequency * window_;
    const double cosine = fixed::cos(angle), sine = fixed::sin(angle);
    flow.block<2, 2>(frame.tone(k), frame.tone(k)) << cosine, -sine, sine, cosine;
  }
  for (std::size_t k = 0; k < frame.signals.size(); ++k)
    flow(frame.signal(k), frame.signal(k) + 1) = window_ / frame.period;
  return flow;
}

void Mode::build_operators(const Frame& frame, const Model& model, double longest_window) {
  std::vector<RowVector> rows;
  for (const Guard& guard : outline_.guards) rows.push_back(guard.row);
  for (int i = 0; i < d_; ++i) rows.push_back(RowVector::Unit(m_, i));
  const Series series(outline_.system, outline_.system_size, rows, d_, model.forcing_period(), longest_window);
  window_ = series.window();
  window_in_periods_ = series.window_in_periods();
  noise_factor_ = noise_factor_of(m_);

  const auto guards = outline_.guards.size();
  state_blocks_ = (m_ + 7) / 8;
  step_.assign(static_cast<std::size_t>(state_blocks_) * m_, event::Lane8{});
  taylor_.assign(3 * guards * m_, event::Lane8{});
  const bool rows_stored = m_ <= most_stored_rows;
  if (rows_stored)
    coordinates_.assign(3 * static_cast<std::size_t>(d_) * m_, event::Lane8{});
  else
    terms_ = TermSum(outline_.system, d_);

  const Matrix flow = flow_over_window(series, guards, frame, model.omega);
  for (int i = 0; i < m_; ++i) {
    for (int r = 0; r < m_; ++r) step_[(r / 8) * m_ + i][r % 8] = flow(r, i);
    for (int j = 0; j < event::terms; ++j) {
      for (std::size_t g = 0; g < guards; ++g) taylor_[(3 * g + j / 8) * m_ + i][j % 8] = series.taylor(g, j, i);
      for (std::size_t k = 0; rows_stored && k < static_cast<std::size_t>(d_); ++k)
        coordinates_[(3 * k + j / 8) * m_ + i][j % 8] = series.taylor(guards + k, j, i);
    }
  }
  for (int g = 0; g < guard_count(); ++g) {
    store_start(series, g);
    store_bounds(g, series);
  }
}

/// The leading coefficients' rounding bounds; of a large mode, both packed: they reach a few neighbours only.
void Mode::store_start(const Series& series, int g) {
  for (int i = 0; i < m_; ++i) {
    const event::Lane8& leading = taylor_[3 * g * m_ + i];
    event::Lane8 noise = noise_factor_ * event::magnitude(leading);
    for (int j = 0; j < 8; ++j) noise[j] += series.error(static_cast<std::size_t>(g), j, i);
    if (!coordinates_.empty())
      leading_noise_.push_back(noise);
    else if (event::greatest(noise) > 0.0) {
      starts_.add(i, leading);
      start_noise_.add(i, noise);
    }
  }
  starts_.close();
  start_noise_.close();
}

namespace {

/// The lanes that dropped terms add to. Divided by x^order they are no larger, nor are their slopes and curvatures: the
/// first is x^24.
event::Lane8 bounds_of(const Tail<double>& tail) {
  event::Lane8 bounds{};
  bounds[event::hull_error] = bounds[event::noise_2] = tail.value;
  bounds[event::slope_error] = bounds[event::slope_noise] = tail.slope;
  bounds[event::curvature_error] = bounds[event::curvature_noise] = tail.curvature;
  return bounds;
}

}  // namespace

/// What guard g adds to its hull, by column.
void Mode::store_bounds(int g, const Series& series) {
  coarse_noise_.push_back(0.0);
  for (int i = 0; i < m_; ++i) {
    const Tail<double> tail = series.tail(static_cast<std::size_t>(g), i);
    tails_.push_back(bounds_of(tail));
    double size = 0.0;
    for (int b = 0; b < 3; ++b) size += event::sum(event::magnitude(taylor_[(3 * g + b) * m_ + i]));
    coarse_noise_[g] = std::max(coarse_noise_[g], noise_factor_ * size + tail.value);
  }
  for (int order = 0; order < stored_orders; ++order) {
    for (int i = 0; i < m_; ++i) {
      const event::Hull hull = hull_column(g, order, i);
      hulls_.push_back(hull.bernstein);
      hull_bounds_.push_back(hull.bounds);
    }
    store_quick_look(g, order);
  }
}

/// Of the hull just stored: the largest bound and, of a large mode, the columns without those that are small beside the largest.
void Mode::store_quick_look(int g, int order) {
  constexpr double small = 0x1p-18, up = 1.0 + 0x1p-40;  // more than the rounding of the sums
  const auto at = static_cast<std::size_t>(g * stored_orders + order) * m_;
  double largest = 0.0, error = 0.0;
  for (int i = 0; i < m_; ++i) largest = std::max(largest, event::greatest(event::magnitude(hulls_[at + i])));
  for (int i = 0; i < m_; ++i) {
    const double size = event::greatest(event::magnitude(hulls_[at + i]));
    const bool near = !coordinates_.empty() || size > small * largest;
    if (near && coordinates_.empty()) near_hulls_.add(i, hulls_[at + i]);
    error = std::max(error, hull_bounds_[at + i][event::hull_error] + (near ? 0.0 : size));
  }
  near_hulls_.close();
  quick_errors_.push_back(up * error);
}

/// The hull of column i of guard g, x^order divided out.
event::Hull Mode::hull_column(int g, int order, int i) const {
  std::array<double, event::terms> a{}, size{};
  for (int n = order; n < event::terms; ++n) {
    a[n - order] = taylor_[(3 * g + n / 8) * m_ + i][n % 8];
    size[n - order] = std::abs(a[n - order]);
  }
  event::Hull hull = event::enclose(a.data(), size.data(), event::terms - order, noise_factor_);
  hull.bounds += tails_[g * m_ + i];
  return hull;
}

void Mode::step(const double* X, event::Lane8* out) const {
  kernels_->multiply(step_.data(), state_blocks_, m_, X, out);
}

bool Mode::excludes(int g, int order, const double* X, double size, double more) const {
  if (order >= stored_orders) return false;
  const int k = g * stored_orders + order;
  const double bound = quick_errors_[k] * size + more;
  if (!coordinates_.empty())
    return kernels_->all_above(hulls_.data() + static_cast<std::ptrdiff_t>(k) * m_, m_, X, bound);
  event::Lane8 bernstein;
  near_hulls_.multiply(*kernels_, k, X, bernstein);
  return event::all_above(bernstein, bound);
}

void Mode::enclose(int g, int order, const double* X, const double* magnitude, event::Hull& out) const {
  if (order >= stored_orders) return enclose_rare(g, order, X, magnitude, out);
  const auto at = static_cast<std::ptrdiff_t>(g * stored_orders + order) * m_;
  kernels_->multiply(hulls_.data() + at, 1, m_, X, &out.bernstein);
  kernels_->multiply(hull_bounds_.data() + at, 1, m_, magnitude, &out.bounds);
}

/// The hull from the guard's Taylor coefficients and the sums of the sizes of their parts.
void Mode::enclose_rare(int g, int order, const double* X, const double* magnitude, event::Hull& out) const {
  const auto row = static_cast<std::ptrdiff_t>(3 * g) * m_;
  event::Coefficients a, size{};
  kernels_->multiply(taylor_.data() + row, 3, m_, X, a.data());
  event::Lane8 tail{};
  for (int i = 0; i < m_; ++i) {
    tail += tails_[g * m_ + i] * magnitude[i];
    for (int b = 0; b < 3; ++b) size[b] += event::magnitude(taylor_[row + b * m_ + i]) * magnitude[i];
  }
  std::array<double, event::terms> values{}, sizes{};
  for (int n = order; n < event::terms; ++n) {
    values[n - order] = a[n / 8][n % 8];
    sizes[n - order] = size[n / 8][n % 8];
  }
  out = event::enclose(values.data(), sizes.data(), event::terms - order, noise_factor_);
  out.bounds += tail;
}

void Mode::taylor(int g, int order, const double* X, event::Coefficients& out) const {
  kernels_->multiply(taylor_.data() + static_cast<std::ptrdiff_t>(3 * g) * m_, 3, m_, X, out.data());
  for (int p = 0; p < order; ++p) out = event::divided_by_x(out);
}

void Mode::leading(int g, const double* X, const double* magnitude, event::Lane8& coefficients,
                   event::Lane8& noise) const {
  if (coordinates_.empty()) {
    starts_.multiply(*kernels_, g, X, coefficients);
    start_noise_.multiply(*kernels_, g, magnitude, noise);
    return;
  }
  kernels_->multiply(taylor_.data() + static_cast<std::ptrdiff_t>(3 * g) * m_, 1, m_, X, &coefficients);
  kernels_->multiply(leading_noise_.data() + static_cast<std::ptrdiff_t>(g) * m_, 1, m_, magnitude, &noise);
}

void Mode::state_at(double x, const double* X, double* out) const {
  if (coordinates_.empty()) return terms_.state(x * window_, X, out);
  const double per_time = 1.0 / window_;
  kernels_->evaluate(coordinates_.data(), d_, m_, X, x, out, out + d_);
  for (int k = 0; k < d_; ++k)
    out[d_ + k] = outline_.steady[k] ? X[d_ + k] : out[d_ + k] * per_time - drift_[k] * X[m_ - 1];
}

}  // namespace slapstick::mode
