#pragma once
/// Newton's equations of a Model in its own coordinates, M v' = F - C v - K q + contact forces, as a text book writes
/// them: what the balances of the engine's motions are checked against. Shares nothing with src/mode.
#include <Eigen/Core>
#include <span>

#include "mode/outline.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick::test {

/// The greatest coordinate and velocity of some states: what their rounding is measured by, since the stored numbers
/// are sums and differences of coordinates.
struct Sizes {
  double x = 0.0, v = 0.0;
  void note(std::span<const double> state);
};

class Newton {
 public:
  explicit Newton(const Model& model);

  /// x_a - x_b of a pair (part 0), or v_a - v_b (part 1), of a user's state.
  [[nodiscard]] static double difference(std::span<const double> state, int a, int b, int part);
  /// 1 at a, -1 at b.
  [[nodiscard]] Eigen::RowVectorXd row(int a, int b) const;
  [[nodiscard]] const Eigen::MatrixXd& mass() const { return M_; }
  /// g M^{-1} g^T of a pair.
  [[nodiscard]] double mobility(int a, int b) const;
  [[nodiscard]] static Eigen::VectorXd displacements(std::span<const double> state);
  [[nodiscard]] static Eigen::VectorXd velocities(std::span<const double> state);

  [[nodiscard]] double kinetic(const Eigen::VectorXd& velocity) const { return 0.5 * velocity.dot(M_ * velocity); }
  /// The same and that of the springs.
  [[nodiscard]] double energy(std::span<const double> state) const;
  /// What is done per unit of time by the forcing less what dampers, friction and compliant stops take, theta = omega
  /// t.
  [[nodiscard]] double power(std::span<const double> state, const mode::ContactStates& contacts, double theta) const;

  [[nodiscard]] const Sizes& least() const { return least_; }  ///< clearances and belt speeds
  /// Sums of the sizes of the terms: of the force on each coordinate, of the energy, of the power, of the greatest
  /// acceleration.
  [[nodiscard]] Eigen::VectorXd force_size(const Sizes& sizes) const;
  [[nodiscard]] double energy_size(const Sizes& sizes) const;
  [[nodiscard]] double power_size(const Sizes& sizes) const { return sizes.v * force_size(sizes).sum(); }
  [[nodiscard]] double acceleration_size(const Sizes& sizes) const;

  /// The normal force of a friction contact, 1 if it has fixed limits; and the sum of the sizes of its terms.
  [[nodiscard]] double load(std::span<const double> state, const mode::ContactStates& contacts, std::size_t i) const;
  [[nodiscard]] double load_size(const Sizes& sizes, std::size_t i) const;
  /// The force of a compliant stop that pushes b.
  [[nodiscard]] double compliant_force(std::span<const double> state, const mode::ContactStates& contacts,
                                       std::size_t i) const;

  /// The force on a of a pair that is held, along x_a - x_b, from G v' = 0; all contacts of the pair together.
  struct Held {
    int a, b;
    double force;
    /// of the terms it is the sum of; infinite if held pairs depend on each other: then it is not determined
    double size;
    double limit;    ///< sum of the static frictions of the pair's sticking contacts
    bool low, high;  ///< has a closed stop that pushes a towards -, towards + (then there is no limit on that side)
    double belt;     ///< v_a - v_b
  };
  [[nodiscard]] std::vector<Held> held(std::span<const double> state, const mode::ContactStates& contacts, double theta,
                                       const Sizes& sizes = {}) const;

 private:
  [[nodiscard]] Eigen::VectorXd force(std::span<const double> state, const mode::ContactStates& contacts,
                                      double theta) const;
  [[nodiscard]] std::vector<Held> held_pairs(std::span<const double> state, const mode::ContactStates& contacts) const;
  [[nodiscard]] double bent_force(std::span<const double> state, const mode::ContactStates& contacts,
                                  std::size_t i) const;

  const Model& model_;
  Eigen::MatrixXd M_, M_inverse_, C_, K_;
  Sizes least_;
};

}  // namespace slapstick::test
