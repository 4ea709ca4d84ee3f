/// Builds the operators of a mode and applies them.
#include "mode/mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.hpp"
#include "mode/series.hpp"

namespace slapstick::mode {

Mode::Mode(const Model& model, const Frame& frame, ContactStates states, double longest_window)
    : outline_(model, frame, std::move(states)), d_(frame.d), m_(frame.size()), state_blocks_((m_ + 7) / 8) {
  const Series series(outline_, d_, model.forcing_period(), longest_window);
  window_ = series.window();
  window_in_periods_ = series.window_in_periods();
  noise_factor_ = noise_factor_of(m_);
  lay_out();
  std::copy(frame.drift.begin(), frame.drift.end(), drift_);
  store_step(series, frame, model.omega);
  store_rows(series);
  std::array<event::Lane8, event::most_terms> bounds;
  const event::HullRows rows = event::hull_rows(noise_factor_, bounds.data());
  for (int g = 0; g < guard_count(); ++g) {
    store_start(series, g);
    store_bounds(series, g, rows);
  }
  if (!rows_stored()) terms_ = TermSum(outline_.system, d_);
}

void Mode::lay_out() {
  const auto m = static_cast<std::ptrdiff_t>(m_), guards = static_cast<std::ptrdiff_t>(outline_.guards.size());
  const std::ptrdiff_t stored = rows_stored() ? 1 : 0, d = d_;
  const std::ptrdiff_t lanes = m * (state_blocks_ + guards * (3 + 2 * stored_orders + 1) + stored * (3 * d + guards));
  event::LaneBlockBuilder block(static_cast<std::size_t>(8 * lanes + d + guards * (stored_orders + 1)));
  step_ = block.take<event::Lane8>(m * state_blocks_);
  taylor_ = block.take<event::Lane8>(3 * guards * m);
  coordinates_ = block.take<event::Lane8>(stored * 3 * d * m);
  leading_noise_ = block.take<event::Lane8>(stored * guards * m);
  hulls_ = block.take<event::Lane8>(guards * stored_orders * m);
  hull_bounds_ = block.take<event::Lane8>(guards * stored_orders * m);
  tails_ = block.take<event::Lane8>(guards * m);
  quick_errors_ = block.take<double>(guards * stored_orders);
  coarse_noise_ = block.take<double>(guards);
  drift_ = block.take<double>(d);
  lanes_ = block.release();
}

/// exp(A H): positions from their own series, u = p' - drift from its derivative, the oscillators as rotations.
void Mode::store_step(const Series& series, const Frame& frame, double omega) {
  std::fill_n(step_, static_cast<std::ptrdiff_t>(state_blocks_) * m_, event::Lane8{});
  for (int i = 0; i < m_; ++i) entry(step_, i, i) = 1.0;
  for (int k = 0; k < d_; ++k) {
    const int row = guard_count() + k;
    for (int i = 0; i < m_; ++i) {
      entry(step_, k, i) = series.end_value(row, i);
      if (!outline_.steady[k]) entry(step_, d_ + k, i) = series.end_slope(row, i);
    }
    if (!outline_.steady[k]) entry(step_, d_ + k, m_ - 1) -= drift_[k];
  }
  const auto turn = [&](int c, double angle) {
    const auto [cosine, sine] = fixed::cosine_sine(angle);
    entry(step_, c, c) = entry(step_, c + 1, c + 1) = cosine;
    entry(step_, c, c + 1) = -sine;
    entry(step_, c + 1, c) = sine;
  };
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k)
    turn(2 * d_ + 2 * static_cast<int>(k), frame.harmonics[k] * omega * window_);
  for (std::size_t k = 0; k < frame.tones.size(); ++k) turn(frame.tone(k), frame.tones[k].frequency * window_);
  for (std::size_t k = 0; k < frame.signals.size(); ++k)
    entry(step_, frame.signal(k), frame.signal(k) + 1) = window_ / frame.period;
}

/// The Taylor rows of the guards and, where they are stored, of the displacements.
void Mode::store_rows(const Series& series) {
  const int guards = guard_count();
  for (int r = 0; r < guards + (rows_stored() ? d_ : 0); ++r) {
    event::Lane8* const rows = r < guards ? taylor_ + static_cast<std::ptrdiff_t>(3 * r) * m_
                                          : coordinates_ + static_cast<std::ptrdiff_t>(3 * (r - guards)) * m_;
    for (int n = 0; n < event::terms; ++n)
      for (int i = 0; i < m_; ++i) entry(rows, n, i) = series.taylor(r, n, i);
  }
}

/// The leading coefficients' rounding bounds; of a large mode, both packed: they reach a few neighbours only.
void Mode::store_start(const Series& series, int g) {
  for (int i = 0; i < m_; ++i) {
    const event::Lane8& leading = taylor_[3 * g * m_ + i];
    event::Lane8 noise = noise_factor_ * event::magnitude(leading);
    for (int j = 0; j < 8; ++j) noise[j] += series.error(g, j, i);
    if (rows_stored())
      leading_noise_[g * m_ + i] = noise;
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
event::Lane8 bounds_of(const Tail& tail) {
  event::Lane8 bounds{};
  bounds[event::hull_error] = bounds[event::noise_2] = tail.value;
  bounds[event::slope_error] = bounds[event::slope_noise] = tail.slope;
  bounds[event::curvature_error] = bounds[event::curvature_noise] = tail.curvature;
  return bounds;
}

}  // namespace

/// What guard g adds to its hull, by column.
void Mode::store_bounds(const Series& series, int g, const event::HullRows& rows) {
  coarse_noise_[g] = 0.0;
  for (int i = 0; i < m_; ++i) {
    const Tail tail = series.tail(g, i);
    tails_[g * m_ + i] = bounds_of(tail);
    event::Lane8 size{};
    for (int b = 0; b < 3; ++b) size += event::magnitude(taylor_[(3 * g + b) * m_ + i]);
    coarse_noise_[g] = std::max(coarse_noise_[g], noise_factor_ * event::sum(size) + tail.value);
  }
  for (int order = 0; order < stored_orders; ++order) {
    const auto at = static_cast<std::ptrdiff_t>(g * stored_orders + order) * m_;
    kernels_->enclose(rows, taylor_ + static_cast<std::ptrdiff_t>(3 * g) * m_, order, m_, hulls_ + at,
                      hull_bounds_ + at);
    for (int i = 0; i < m_; ++i) hull_bounds_[at + i] += tails_[g * m_ + i];
    store_quick_look(g, order);
  }
}

/// Of the hull just stored: the largest bound and, of a large mode, the columns without those that are small beside the
/// largest.
void Mode::store_quick_look(int g, int order) {
  constexpr double small = 0x1p-18, up = 1.0 + 0x1p-40;  // more than the rounding of the sums
  const int k = g * stored_orders + order;
  const event::Lane8* const hulls = hulls_ + static_cast<std::ptrdiff_t>(k) * m_;
  const event::Lane8* const bounds = hull_bounds_ + static_cast<std::ptrdiff_t>(k) * m_;
  double largest = 0.0, error = 0.0;
  for (int i = 0; i < m_ && !rows_stored(); ++i)
    largest = std::max(largest, event::greatest(event::magnitude(hulls[i])));
  for (int i = 0; i < m_; ++i) {
    const double size = rows_stored() ? 0.0 : event::greatest(event::magnitude(hulls[i]));
    const bool near = rows_stored() || size > small * largest;
    if (near && !rows_stored()) near_hulls_.add(i, hulls[i]);
    error = std::max(error, bounds[i][event::hull_error] + (near ? 0.0 : size));
  }
  near_hulls_.close();
  quick_errors_[k] = up * error;
}

void Mode::step(const double* X, event::Lane8* out) const { kernels_->multiply(step_, state_blocks_, m_, X, out); }

bool Mode::excludes(int g, int order, const double* X, double size, double more) const {
  if (order >= stored_orders) return false;
  const int k = g * stored_orders + order;
  const double bound = quick_errors_[k] * size + more;
  if (rows_stored()) return kernels_->all_above(hulls_ + static_cast<std::ptrdiff_t>(k) * m_, m_, X, bound);
  event::Lane8 bernstein;
  near_hulls_.multiply(*kernels_, k, X, bernstein);
  return event::all_above(bernstein, bound);
}

bool Mode::enclose(int g, int order, const double* X, const double* magnitude, event::Hull& out, double more) const {
  if (order >= stored_orders) {
    enclose_rare(g, order, X, magnitude, out);
    return event::all_above(out.bernstein, out.bounds[event::hull_error] + more);
  }
  const auto at = static_cast<std::ptrdiff_t>(g * stored_orders + order) * m_;
  return kernels_->hull(hulls_ + at, hull_bounds_ + at, m_, X, magnitude, more, &out);
}

void Mode::bounds(int g, int order, const double* X, const double* magnitude, event::Lane8& out) const {
  if (order < stored_orders)
    return kernels_->multiply(hull_bounds_ + static_cast<std::ptrdiff_t>(g * stored_orders + order) * m_, 1, m_,
                              magnitude, &out);
  event::Hull hull;
  enclose_rare(g, order, X, magnitude, hull);
  out = hull.bounds;
}

/// The hull from the guard's Taylor coefficients and the sums of the sizes of their parts.
void Mode::enclose_rare(int g, int order, const double* X, const double* magnitude, event::Hull& out) const {
  const auto row = static_cast<std::ptrdiff_t>(3 * g) * m_;
  event::Coefficients a, size{};
  kernels_->multiply(taylor_ + row, 3, m_, X, a.data());
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
  kernels_->multiply(taylor_ + static_cast<std::ptrdiff_t>(3 * g) * m_, 3, m_, X, out.data());
  for (int p = 0; p < order; ++p) out = event::divided_by_x(out);
}

void Mode::leading(int g, const double* X, const double* magnitude, event::Lane8& coefficients,
                   event::Lane8& noise) const {
  if (!rows_stored()) {
    starts_.multiply(*kernels_, g, X, coefficients);
    start_noise_.multiply(*kernels_, g, magnitude, noise);
    return;
  }
  kernels_->multiply(taylor_ + static_cast<std::ptrdiff_t>(3 * g) * m_, 1, m_, X, &coefficients);
  kernels_->multiply(leading_noise_ + static_cast<std::ptrdiff_t>(g) * m_, 1, m_, magnitude, &noise);
}

void Mode::state_at(double x, const double* X, double* out) const {
  if (!rows_stored()) return terms_.state(x * window_, X, out);
  const double per_time = 1.0 / window_;
  kernels_->evaluate(coordinates_, d_, m_, X, x, out, out + d_);
  for (int k = 0; k < d_; ++k)
    out[d_ + k] = outline_.steady[k] ? X[d_ + k] : out[d_ + k] * per_time - drift_[k] * X[m_ - 1];
}

}  // namespace slapstick::mode
