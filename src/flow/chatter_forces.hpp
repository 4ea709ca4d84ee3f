#pragma once
/// The forces on pairs that chatter, as accelerations, and how much they can change meanwhile.
///
/// delta bounds |X(t) - X(0)|, component by component. Every force is a row over X, so that it changes by no more than
/// the entries of its row times delta.
#include <span>

#include "flow/compiled_system.hpp"

namespace slapstick::flow {

/// Friction on a pair that chatters.
struct ChatterFriction {
  double phi = 0.0;         ///< known: f_k N on the same pair, against the motion
  double phi_static = 0.0;  ///< f_s N on the same pair
  double steady = 0.0;      ///< known: contacts that slip all the while (on a belt, on other pairs)
  double unknown = 0.0;  ///< any value up to this: friction at rest on other pairs, whose state the impulses may change
};

/// Of the flight that begins at X. Refers to its arguments.
class ChatterForces {
 public:
  /// @param here  the mode of the flight
  ChatterForces(const CompiledSystem& system, const mode::Mode& here, const double* X)
      : system_(system), frame_(system.frame()), here_(here), X_(X) {}

  /// Acceleration of the stop's pair towards the stop without friction, in the states of the compliant stops and the
  /// pieces of the characteristics that are in force ..
  [[nodiscard]] double press(int stop) const;
  /// .. and the most that it can change. @param any_piece  of continuous characteristics
  [[nodiscard]] double press_change(int stop, bool any_piece, const double* delta) const;
  /// @param delta  null if no bound is known yet
  [[nodiscard]] ChatterFriction friction(int stop, const double* delta) const;
  /// The most by which friction can be another one than that because loads change: by f_s |N - N_0|, whatever the
  /// state.
  [[nodiscard]] double friction_change(int stop, const double* delta) const;

  /// out = |A| v, of the greater of |A| without contact forces, and with those of the mode that the flight is in.
  void magnitude_product(bool any_piece, const double* v, double* out) const;
  /// |u'| that friction of fixed limits can cause on coordinate i, at most.
  [[nodiscard]] double friction_rate(int i) const;

  /// Does any contact that was counted as steady come to rest?
  [[nodiscard]] bool all_slip_on(int stop, const double* delta) const;
  /// May the impacts move a friction contact of another pair through its rest, a load through zero, or a characteristic
  /// past a corner? With room for bounds that are less sharp than delta.
  [[nodiscard]] bool shakes(int stop, const double* delta) const;
  /// Can any other stop, rigid or compliant, begin or cease to act?
  [[nodiscard]] bool others_change(int stop, const double* delta) const;
  /// May a characteristic whose force is continuous pass a corner?
  [[nodiscard]] bool bends(const double* delta) const;
  /// Is there another closed stop that the impacts strike too?
  [[nodiscard]] bool strikes_others(int stop) const;

 private:
  /// The normal force N of a friction contact, or 1 if it has fixed limits, and the most that it can change. Friction
  /// is in proportion to max(N, 0), which changes by no more than N does.
  struct Load {
    double N = 1.0, change = 0.0;
    [[nodiscard]] bool never() const { return N + change <= 0.0; }
    [[nodiscard]] bool may_end() const { return N - change <= 0.0; }
  };
  [[nodiscard]] Load load(int friction, const double* delta) const;
  [[nodiscard]] bool slips_on(int friction, const double* delta) const;
  [[nodiscard]] double loaded_friction_rate(int i, const double* v) const;
  [[nodiscard]] bool is_continuous(std::size_t characteristic) const;
  [[nodiscard]] bool passes_corner(std::size_t characteristic, const double* delta) const;
  [[nodiscard]] double slope_bound(std::size_t characteristic, bool any_piece) const;
  [[nodiscard]] double bend_rate(int i, const double* v) const;
  [[nodiscard]] bool acts_on(int stop, const mode::ContactRow& contact) const;
  template <class Add>
  void for_compliant_forces(int stop, const Add& add) const;
  [[nodiscard]] const Model& model() const { return system_.model(); }
  [[nodiscard]] int frictions() const { return static_cast<int>(model().frictions.size()); }

  const CompiledSystem& system_;
  const mode::Frame& frame_;
  const mode::Mode& here_;
  const double* X_;
};

}  // namespace slapstick::flow
