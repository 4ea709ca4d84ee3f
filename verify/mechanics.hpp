#pragma once
/// The mechanics of a model in balls: from its exact numbers to the equations of motion in contact coordinates.
///
///     M q'' = F(t) - C q' - K q + contact forces,     p = W q - shift,  u = W q' - drift,
///
/// the rows of W the pairs of the certificate's numbers. The extended state is
/// X = (p, u, cos j theta, sin j theta for each harmonic j,
/// cos w t, sin w t for each tone w, 1), so that p' = u + drift, u' = free X + W M^-1 (forces).
/// Which n numbers the others follow from, the *basis*, the verifier chooses: those of the least shift for
/// displacements, of the least drift for velocities. So the order of the file, and a contact that is far away, explain
/// no rounding of what is near. Nothing of the library is used: docs/reference/certificate.md says what the numbers
/// mean.
#include <array>
#include <map>
#include <memory>
#include <string>

#include "certificate.hpp"
#include "linear.hpp"

namespace verify {

/// A contact in contact coordinates: its displacement is sign p_own, its velocity sign u_own.
struct Place {
  std::size_t own = 0;
  double sign = 1.0;
};

/// The row over X that must not be negative while a mode lasts, by the laws.
struct Condition {
  enum class Kind { gap, slip, stick, press, beyond, apart, pushes, pulls, bound, load, unloaded, corner };
  Kind kind;
  std::size_t contact;  ///< among those of its sort; one of those that hold a pair together
  std::string name;     ///< for messages
  Balls row;
};

/// The linear system X' = A X of a combination of contact states.
struct Mode {
  Matrix A;
  std::vector<Condition> conditions;
  std::vector<bool> held;  ///< by number: its velocity does not change
  bool redundant = false;  ///< contacts that hold depend on each other: their forces are one choice of many
};

class Mechanics {
 public:
  /// @throws Unreadable where masses, numbers and contacts do not fit together
  Mechanics(const Model& model, long line);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] std::size_t n() const { return static_cast<std::size_t>(model_.n); }
  [[nodiscard]] std::size_t d() const { return model_.numbers.size(); }
  [[nodiscard]] std::size_t size() const { return 2 * d() + 2 * (harmonics_.size() + tones_.size()) + 1; }
  [[nodiscard]] const Ball& period() const { return period_; }
  [[nodiscard]] const Place& stop(std::size_t k) const { return stops_[k]; }
  [[nodiscard]] const Place& friction(std::size_t k) const { return frictions_[k]; }
  [[nodiscard]] const Place& compliant(std::size_t k) const { return compliant_[k]; }
  /// W M^-1 W^T.
  [[nodiscard]] const Matrix& inertia() const { return inertia_; }
  /// n numbers whose rows of W are independent, and have the least shifts (drifts).
  [[nodiscard]] const std::vector<std::size_t>& basis(bool velocity) const { return bases_[velocity ? 1 : 0]; }
  [[nodiscard]] bool in_basis(std::size_t number, bool velocity) const;
  /// A row of coefficients for each number: its row of W is that times the rows of the basis.
  [[nodiscard]] const Matrix& dependence(bool velocity) const { return dependence_[velocity ? 1 : 0]; }
  /// +1 or -1 if the numbers are of one pair, else 0.
  [[nodiscard]] double parallel(std::size_t i, std::size_t j) const;

  /// q = this (p + shift), q' = this (u + drift), of the numbers of the basis.
  [[nodiscard]] const Matrix& to_coordinates(bool velocity) const { return W_inverse_[velocity ? 1 : 0]; }
  /// (q, q', phases, 1) of X, and the system that it obeys where X' = A X.
  [[nodiscard]] Balls in_coordinates(const Balls& X) const;
  [[nodiscard]] Matrix in_coordinates(const Matrix& A) const;
  /// What a unit impulse that pushes a number up does to a coordinate's velocity.
  [[nodiscard]] Ball impulse_effect(std::size_t coordinate, std::size_t number) const {
    return dot(mass_inverse_[coordinate], W_[number]);
  }
  /// Numbers that a rounding of this one may come from: of a loop of pairs, in which they follow from each other, those
  /// of the basis, and the number itself. Alone if there is no loop.
  [[nodiscard]] const std::vector<std::size_t>& loop(std::size_t number, bool velocity) const {
    return loops_[velocity ? 1 : 0][number];
  }

  /// X at an instant, phases exact.
  [[nodiscard]] Balls extended(const std::vector<double>& p, const std::vector<double>& u, const Clock& at) const;
  /// p and u of a state in the model's coordinates.
  [[nodiscard]] Balls contact_numbers(const std::vector<double>& q, const std::vector<double>& v) const;
  [[nodiscard]] const Mode& mode(const ContactStates& states);

 private:
  friend class ModeBuilder;

  [[nodiscard]] Place find(const Pair& pair, const double* shift, double drift, const std::string& name) const;
  void place_contacts();
  void choose_basis(bool velocity);
  void find_loops(bool velocity);
  void invert();
  void set_free();
  [[nodiscard]] std::size_t cosine_of(const Force& force) const;
  [[nodiscard]] Balls pair_row(const Pair& pair) const;
  [[nodiscard]] Matrix matrix_of(const Table& table, const std::vector<Element>& elements) const;
  [[nodiscard]] Balls over_state(const Pair& pair, bool velocity) const;

  const Model& model_;
  long line_;
  std::vector<int> harmonics_;
  std::vector<double> tones_;  ///< frequencies beside omega
  Ball period_;
  std::array<std::vector<std::size_t>, 2> bases_;  ///< of displacements, of velocities; so are the arrays below
  std::array<std::vector<std::vector<std::size_t>>, 2> loops_;
  std::array<Matrix, 2> W_inverse_, dependence_;
  std::vector<Place> stops_, frictions_, compliant_;
  Matrix mass_inverse_, W_, inertia_, free_;
  std::map<ContactStates, std::unique_ptr<Mode>> modes_;
};

}  // namespace verify
