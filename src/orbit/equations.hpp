#pragma once
/// The equations of a periodic orbit of a given shape, and Newton's method on them.
///
/// Unknowns v: the contact state x_0 just after event 0 (modulo the model's rigid translations), the instants
/// t_0 .. t_k of the events, and the parameters. Equations: each leg ends at the zero of its guard; the state after the
/// last leg is x_0; t_k - t_0 = n (without forcing: t_0 = 0). The states x_1 .. x_{k-1} are unknowns too (multiple
/// shooting) and eliminated by the recursion
///     dx_{i+1} = r_i + (d after_i) (dx_i, dt_i, dt_{i+1}, dp),
/// so that a step costs a matrix of 2n + k + 1 rows. No guard's slope is divided by: at a graze, where one is zero, the
/// equations are regular.
#include <Eigen/Core>
#include <complex>
#include <functional>
#include <memory>
#include <optional>

#include "flow/compiled_system.hpp"
#include "flow/translations.hpp"
#include "orbit/leg_flow.hpp"

namespace slapstick::orbit {

/// A family and what does not change along it.
class Problem {
 public:
  /// @throws InputError as the family and System
  Problem(Family family, const std::vector<double>& values);

  [[nodiscard]] const Family& family() const { return family_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }  ///< of the parameters, at `base`
  [[nodiscard]] const System& base() const { return *base_; }
  [[nodiscard]] const flow::Translations& translations() const { return translations_; }
  [[nodiscard]] Eigen::Index parameters() const { return static_cast<Eigen::Index>(family_.names.size()); }
  /// Are its motions free: none of the forces has a harmonic with an amplitude, and no parameter gives it one? Only
  /// then cycles have a period of their own (Itinerary::n = 0).
  [[nodiscard]] bool free() const { return free_; }
  /// What arclength measures states by where an orbit is smaller than this: one that shrinks to nothing is left behind
  /// in steps of some length.
  [[nodiscard]] const Eigen::VectorXd& least_sizes() const { return least_sizes_; }
  /// .. and the first parameter where its value is smaller: the range that it is followed over. The parameter may pass
  /// zero.
  [[nodiscard]] double least_value() const { return least_value_; }
  void set_least(Eigen::VectorXd sizes, double value) {
    least_sizes_ = std::move(sizes);
    least_value_ = value;
  }
  /// Of a state, without free displacements.
  [[nodiscard]] Eigen::Index numbers() const;
  /// Of an orbit with this many legs: numbers of x_0, instants, parameters.
  [[nodiscard]] Eigen::Index unknowns(std::size_t legs) const;
  [[nodiscard]] Eigen::Index instant_column(std::size_t event) const;
  [[nodiscard]] Eigen::Index parameter_column(std::size_t legs, Eigen::Index j) const;

 private:
  Family family_;
  std::vector<double> values_;
  std::shared_ptr<const System> base_;
  flow::Translations translations_;
  Eigen::VectorXd least_sizes_;  ///< of the numbers; zero until they are set
  double least_value_ = 0.0;
  bool free_;
};

struct Linearised {
  Eigen::VectorXd residual;  ///< k endings, the closing, the time: k + numbers + 1
  /// Displacements of x_0 that no leg moves, as of a slider that rests all along: such an orbit is one of a family. In
  /// place of their closing, which holds for any value, they stay as they are.
  std::vector<Eigen::Index> kept;
  std::vector<Eigen::Index> forgotten;   ///< numbers of x_0 of which the cycle makes the same whatever they are
  Eigen::MatrixXd by;                    ///< its derivative by the unknowns
  std::vector<Eigen::MatrixXd> states;   ///< of x_i by the unknowns ..
  std::vector<Eigen::VectorXd> defects;  ///< .. and what x_i has to make good
  std::vector<LegValue> legs;
  Eigen::VectorXd advance;
};

/// The derivative of a jet of a leg by the unknowns, when that of the leg's start is `states`.
[[nodiscard]] Eigen::MatrixXd by_unknowns(const Problem& problem, const Jet& jet, const Eigen::MatrixXd& states,
                                          std::size_t leg, std::size_t legs);

/// @throws NumericalError, InputError as the family
[[nodiscard]] Linearised linearise(const Problem& problem, const ModeSet& set, const Orbit& orbit);

/// Moves an orbit by a change of its unknowns; its inner states by `at`'s elimination, and by this fraction of what
/// they have to make good.
void move(const Problem& problem, const Linearised& at, const Eigen::VectorXd& change, double fraction, Orbit& orbit);

/// Do velocities say no more than that all is at rest? Rounding moves a displacement by so much in a cycle.
[[nodiscard]] bool at_rest(double velocity, double displacement, double cycle);

/// Typical sizes of the unknowns: the orbit's largest displacement and velocity, a forcing period or without forcing
/// the cycle, the parameters' own.
[[nodiscard]] Eigen::VectorXd sizes(const Problem& problem, const Orbit& orbit);

/// Divides each row of a matrix by its largest entry. @returns those
Eigen::VectorXd level_rows(Eigen::MatrixXd& matrix);

/// A function of the unknowns, where they are, and its derivative.
struct Residual {
  double value;
  Eigen::RowVectorXd by;
};

/// One more condition on the unknowns, so that the matrix is square: row . (v - v_0) = 0 at the first step's v_0, or if
/// there is one a function's zero.
struct Condition {
  Eigen::RowVectorXd row;
  std::function<Residual(const ModeSet& set, const Linearised& at, const Orbit& orbit)> function = {};
};

/// Steps of Newton's method, relative to the orbit's size: one after which there is nothing to gain, and the longest
/// one. Larger: an orbit has fewer digits, or a far guess leads elsewhere; smaller: the method takes more steps.
constexpr double enough_step = 1e-13, longest_newton_step = 0.5;

struct NewtonResult {
  bool converged = false;
  int steps = 0;
  double last_step = 0.0;  ///< relative to `sizes`
  std::string refusal;     ///< why there is no model where a step led, if that is it
};

/// Newton's method with as many conditions as there are parameters: all of them fixed, or all except one and an
/// arclength. The orbit is where it came to, converged or not. Never throws for numbers: a model that cannot be made,
/// or overflow, is "not converged".
/// @param besides  orbits v_i that are no solutions any more (deflation): the residual is multiplied by
///                 prod_i (1 + 0.1^2 / |v - v_i|^2), which makes a step longer or shorter, or turns it round.
///                 Source: Farrell, Birkisson and Funke (2015)
NewtonResult solve(const Problem& problem, Orbit& orbit, const std::vector<Condition>& conditions, int most_steps = 12,
                   const std::vector<Orbit>& besides = {});

/// All parameters are as they are.
[[nodiscard]] std::vector<Condition> fixed_parameters(const Problem& problem, std::size_t legs);
/// .. but the first, in place of which the length of a leg is as it is.
[[nodiscard]] std::vector<Condition> fixed_length(const Problem& problem, std::size_t legs, std::size_t leg);

/// The derivative of the return map at fixed time, from just after event 0 to a cycle later, by the contact state and
/// by the parameters, modulo translations: (2n - k) x ... As flow/tangent.hpp gives it; there from a motion, here from
/// the orbit's own legs.
struct ReturnRates {
  Eigen::MatrixXd by_state;
  Eigen::MatrixXd by_parameter;
};
[[nodiscard]] ReturnRates return_rates(const Problem& problem, const ModeSet& set, const Orbit& orbit,
                                       const std::vector<LegValue>& legs);

/// Takes out the multiplier nearest to 1: that of a direction which the map keeps.
void drop_kept_direction(std::vector<std::complex<double>>& multipliers);

/// Solution::multipliers. `legs`: of a linearisation of the orbit as it is; begun elsewhere it is linearised anew.
[[nodiscard]] std::vector<std::complex<double>> multipliers(const Problem& problem, const ModeSet& set,
                                                            const Orbit& orbit, const std::vector<LegValue>& legs);

}  // namespace slapstick::orbit
