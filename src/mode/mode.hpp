#pragma once
/// One mode: a combination of contact states, the linear system it selects, and that system's window operators.
#include <cmath>
#include <vector>

#include "event/kernels.hpp"
#include "event/lane_block.hpp"
#include "mode/outline.hpp"
#include "mode/packed_rows.hpp"
#include "mode/term_sum.hpp"

namespace slapstick::mode {

class Series;

/// Dense operators on X = (p, u, cos, sin, .., 1), all for the window length `window`, x = s / window in [0, 1].
///
/// Written once at set-up in double-doubles from A; see docs/developers/proofs.md for the remainder and rounding
/// bounds. Storage is in blocks of eight rows: element (row 8 b + lane, column i) of an operator is
/// data[b * m + i][lane].
class Mode {
 public:
  /// Builds the mode. Cost: O(60 m^2) per coordinate and guard, once.
  /// @param longest_window  in forcing periods; the window is no longer than this
  Mode(const Model& model, const Frame& frame, ContactStates states, double longest_window = INFINITY);
  Mode(Mode&&) = default;  // its arrays stay where they are
  Mode& operator=(Mode&&) = delete;
  ~Mode() = default;

  [[nodiscard]] const ContactStates& states() const { return outline_.states; }
  [[nodiscard]] const std::vector<Guard>& guards() const { return outline_.guards; }
  [[nodiscard]] const Matrix& system() const { return outline_.system; }            ///< X' = system() X
  [[nodiscard]] const Matrix& system_size() const { return outline_.system_size; }  ///< see Outline
  [[nodiscard]] bool steady(int i) const { return outline_.steady[i]; }             ///< u_i is held
  [[nodiscard]] double window() const { return window_; }                           ///< window length in time
  /// The same in forcing periods; at most 24 bits, so that the clock can count windows without loss.
  [[nodiscard]] double window_in_periods() const { return window_in_periods_; }
  [[nodiscard]] int size() const { return m_; }
  [[nodiscard]] int guard_count() const { return static_cast<int>(outline_.guards.size()); }
  [[nodiscard]] int state_blocks() const { return state_blocks_; }

  /// One step over a whole window: exp(A window()) X.
  void step(const double* X, event::Lane8* out) const;
  /// The same, with what its rounding is measured by (event::Kernels::pass).
  void pass(const event::Lane8* X, const event::Lane8* floor, bool fresh, event::Lane8* out, event::Lane8* magnitude,
            event::Lane8* largest, double* sizes) const {
    kernels_->pass(step_, state_blocks_, m_, X, floor, fresh, out, magnitude, largest, sizes);
  }
  /// The rounding of a guard at the start is within this times Guard::size.
  [[nodiscard]] double noise_factor() const { return noise_factor_; }
  /// Of every mode with m numbers.
  [[nodiscard]] static double noise_factor_of(int m) { return (m + 16.0) * event::unit_roundoff; }
  /// A coarse bound of the rounding of guard g, anywhere on the window, for numbers whose sizes sum to 1.
  [[nodiscard]] double coarse_noise(int g) const { return coarse_noise_[g]; }
  /// A quick look at a guard: true only if it is excluded, also where its noise is `more` than X's own. size: sum of
  /// |X|. The bounds are replaced by the largest of all columns, and of a large mode the columns of the hull that are
  /// small by theirs.
  [[nodiscard]] bool excludes(int g, int order, const double* X, double size, double more) const;
  /// Guard g from its zero of order `order` at the window's start on: its hull (magnitude = |X|), and whether it is
  /// above its error and `more` ..
  bool enclose(int g, int order, const double* X, const double* magnitude, event::Hull& out, double more = 0.0) const;
  /// .. the bounds alone, for another magnitude ..
  void bounds(int g, int order, const double* X, const double* magnitude, event::Lane8& out) const;
  /// .. and its Taylor coefficients a_order, a_{order+1}, ...
  void taylor(int g, int order, const double* X, event::Coefficients& out) const;
  /// The first eight Taylor coefficients of guard g and a bound on the rounding error of each.
  void leading(int g, const double* X, const double* magnitude, event::Lane8& coefficients, event::Lane8& noise) const;
  /// p and u at time s = x window() into out, linear in X (same layout as X; the phase part is not written).
  void state_at(double x, const double* X, double* out) const;

 private:
  void lay_out();
  void store_step(const Series& series, const Frame& frame, double omega);
  void store_rows(const Series& series);
  void store_start(const Series& series, int g);
  void store_bounds(const Series& series, int g, const event::HullRows& rows);
  void store_quick_look(int g, int order);
  [[nodiscard]] bool rows_stored() const { return m_ <= most_stored_rows; }
  [[nodiscard]] double& entry(event::Lane8* rows, int row, int column) const {
    return reinterpret_cast<double*>(rows + static_cast<std::ptrdiff_t>(row / 8) * m_ + column)[row % 8];
  }
  void enclose_rare(int g, int order, const double* X, const double* magnitude, event::Hull& out) const;

  /// Orders of a zero at the start whose hulls are stored; the others are rare and made from the Taylor rows.
  static constexpr int stored_orders = 3;
  /// Larger modes do not store the rows of their displacements (400 kB for 32 coordinates) but sum the terms of
  /// exp(A s) X.
  static constexpr int most_stored_rows = 24;

  const event::Kernels* kernels_ = &event::kernels();
  Outline outline_;
  int d_ = 0, m_ = 0, state_blocks_ = 0;
  double window_ = 1.0, window_in_periods_ = 1.0, noise_factor_ = 0.0;
  event::LaneBlock lanes_;  ///< holds the arrays that follow
  event::Lane8 *step_ = nullptr, *taylor_ = nullptr;
  event::Lane8 *coordinates_ = nullptr,
               *leading_noise_ = nullptr;                   ///< of a mode that stores rows: those of the displacements
  event::Lane8 *hulls_ = nullptr, *hull_bounds_ = nullptr;  ///< [guard][order], see event::Hull
  event::Lane8* tails_ = nullptr;                           ///< [guard], what the dropped terms add to the bounds
  double* quick_errors_ = nullptr;                          ///< [guard][order], of `excludes`, per unit of any X_i
  double *drift_ = nullptr, *coarse_noise_ = nullptr;
  TermSum terms_;  ///< of a mode that stores no rows
  // Larger modes only:
  PackedRows near_hulls_;            ///< [guard][order], the columns that are not small
  PackedRows starts_, start_noise_;  ///< the leading coefficients of each guard, and their rounding bounds
};

}  // namespace slapstick::mode
