#pragma once
/// One mode: a combination of contact states, the linear system it selects, and that system's window operators.
#include <cstdint>
#include <vector>

#include "slapstick/event/first_root.hpp"
#include "slapstick/mode/frame.hpp"

namespace slapstick::mode {

enum class StopState : std::int8_t { open = 0, closed = 1 };
enum class FrictionState : std::int8_t { slip_minus = -1, stick = 0, slip_plus = 1 };

class Series;

/// The state of every contact of the model, in the model's order.
struct ContactStates {
  std::vector<StopState> stops;
  std::vector<FrictionState> frictions;
  friend bool operator==(const ContactStates&, const ContactStates&) = default;
};

/// A guard is a linear functional h of X that is positive while the mode lasts; its zero ends the mode.
enum class GuardKind {
  gap,          ///< open stop: clearance - (x_a - x_b)
  slip,         ///< slipping contact: s w
  stick_above,  ///< sticking contact: f_s - f0
  stick_below,  ///< sticking contact: f_s + f0
  press  ///< closed stop: the largest stop force that its contact forces allow. N alone, or f0 + f_s with a sticking pair
};

struct Guard {
  GuardKind kind;
  int contact;    ///< index of the stop (gap, press) or friction contact (others)
  RowVector row;  ///< h = row . X
  /// Index of the gap guard of the same pair whose rate of fall this slip guard is (h = -gap'), or -1. While such a gap is proven to
  /// fall, the slip guard is positive: y and w are one function and its derivative.
  int falls_with = -1;
  /// h = factor * X[single] if the row has one entry only, for p or u (then h has no rounding error but its own), else -1.
  int single = -1;
  double factor = 0.0;
};

/// Dense operators on X = (p, u, cos, sin, .., 1), all for the window length `window`, x = s / window in [0, 1].
///
/// Written once at set-up in extended precision from A; see docs/certainty.md for the remainder and rounding bounds.
/// Storage is in blocks of eight rows: element (row 8 b + lane, column i) of an operator is data[b * m + i][lane].
class Mode {
 public:
  /// Builds the mode. Cost: O(60 m^2) per coordinate and guard, once.
  Mode(const Model& model, const Frame& frame, ContactStates states);

  [[nodiscard]] const ContactStates& states() const { return states_; }
  /// False for a combination that cannot exist: closed stop and stick to a moving belt, or slip at rest, on one pair.
  [[nodiscard]] bool possible() const { return possible_; }
  [[nodiscard]] const std::vector<Guard>& guards() const { return guards_; }
  [[nodiscard]] const Matrix& system() const { return A_; }  ///< X' = system() X
  [[nodiscard]] double window() const { return window_; }    ///< window length in time
  /// The same in forcing periods; at most 24 bits, so that the clock can count windows without loss.
  [[nodiscard]] double window_in_periods() const { return window_in_periods_; }
  [[nodiscard]] int size() const { return m_; }
  [[nodiscard]] int guard_count() const { return static_cast<int>(guards_.size()); }
  [[nodiscard]] int state_blocks() const { return state_blocks_; }

  /// One step over a whole window: exp(A window()) X.
  void step(const double* X, event::Lane8* out) const;
  /// Guard g from its zero of order `order` at the window's start on: its hull (magnitude = |X|) ..
  void enclose(int g, int order, const double* X, const double* magnitude, event::Hull& out) const;
  /// .. and its Taylor coefficients a_order, a_{order+1}, ...
  void taylor(int g, int order, const double* X, event::Coefficients& out) const;
  /// The first eight Taylor coefficients of guard g and a bound on the rounding error of each.
  void leading(int g, const double* X, const double* magnitude, event::Lane8& coefficients, event::Lane8& noise) const;
  /// p and u at time s = x window() into out (same layout as X; the phase part is not written).
  void state_at(double x, const double* X, double* out) const;

 private:
  struct Held;
  void select_linear_system(const Model& model, const Frame& frame, Held& held);
  void arm_guards(const Model& model, const Frame& frame, const Held& held);
  void note_guard_structure(const Matrix& kinematics);
  void arm_gap(const Model& model, const Frame& frame, int stop, const std::vector<RowVector>& constrained);
  void build_operators(const Frame& frame, const Model& model);
  [[nodiscard]] Matrix flow_over_window(const Series& series, std::size_t first_coordinate, const Frame& frame,
                                        double omega) const;
  [[nodiscard]] event::Hull hull_column(int g, int order, int column) const;

  /// Orders of a zero at the start whose hulls are stored; the others are rare and made from the Taylor rows.
  static constexpr int stored_orders = 3;

  ContactStates states_;
  bool possible_ = true;
  Matrix A_;
  std::vector<Guard> guards_;
  std::vector<double> drift_;
  std::vector<bool> steady_;  ///< u_i is constrained: it keeps its value to the last bit
  int n_ = 0, m_ = 0, state_blocks_ = 0;
  double window_ = 1.0, window_in_periods_ = 1.0, noise_factor_ = 0.0;
  event::Lanes step_, taylor_, leading_noise_, coordinates_;
  event::Lanes hulls_, hull_bounds_;  ///< [guard][order], see event::Hull
};

}  // namespace slapstick::mode
