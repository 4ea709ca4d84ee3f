#pragma once
/// Random machines with several contacts, and a second way to move them: Moreau's time-stepping with a small step.
#include <Eigen/Dense>
#include <random>

#include "slapstick/model/model.hpp"

namespace slapstick::test {

struct NetworkShape {
  int most_coordinates = 8, most_contacts = 6;
  bool compliant = false;     ///< compliant stops too
  bool one_friction = false;  ///< f_s = f_k and no belts, for time-stepping
};

/// A chain-like machine of 2 to `most_coordinates` coordinates: springs, dampers, two harmonics, stops (some two-sided), friction contacts
/// (some on belts), all with one restitution.
inline Model random_network(std::uint64_t seed, const NetworkShape& shape) {
  std::mt19937_64 random(seed);
  const auto real = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const auto integer = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  Model m;
  m.name = "network";
  const int n = integer(2, shape.most_coordinates);
  m.omega = real(0.5, 4);
  for (int i = 0; i < n; ++i) {
    m.coordinates.push_back({"x" + std::to_string(i + 1), real(0.3, 3)});
    m.springs.push_back({i, integer(0, 1) == 1 || i == 0 ? ground : i - 1, real(0.5, 4)});
    m.dampers.push_back({i, ground, real(0.02, 0.3)});
    if (i > 0 && integer(0, 1) == 1) m.springs.push_back({i, i - 1, real(0.2, 2)});
  }
  m.forces.push_back({integer(0, n - 1), 1, real(0.5, 2), real(0, 6)});
  m.forces.push_back({integer(0, n - 1), 2, real(0.2, 1), real(0, 6)});
  if (integer(0, 1) == 1) m.forces.push_back({integer(0, n - 1), 0, real(-1, 1), 0});
  const double r = real(0, 0.9);
  const int contacts = integer(1, shape.most_contacts);
  for (int k = 0; k < contacts; ++k) {
    const int a = integer(0, n - 1), other = integer(-1, n - 1), b = other == a ? ground : other;
    const std::string name = std::to_string(k);
    const int kind = integer(0, shape.compliant ? 2 : 1);
    if (kind == 0) {
      m.stops.push_back({"s" + name, a, b, real(0, 0.5), r});
      if (b != ground && integer(0, 2) == 0) m.stops.push_back({"t" + name, b, a, real(0, 0.5), r});
    } else if (kind == 1) {
      const double f_s = real(0.05, 0.5), belt = integer(0, 3) == 0 ? real(-0.5, 0.5) : 0.0;
      const double f_k = integer(0, 1) == 1 ? f_s : f_s * real(0.3, 1);
      m.frictions.push_back({"f" + name, a, b, shape.one_friction ? 0.0 : belt, f_s, shape.one_friction ? f_s : f_k});
    } else {
      m.compliant_stops.push_back({"c" + name, a, b, real(0, 0.3), real(1, 20), real(0, 0.5), integer(0, 1) == 1});
    }
  }
  m.impact_law = integer(0, 1) == 1 ? ImpactLaw::moreau : ImpactLaw::sequence;
  return m;
}

/// Moreau and Jean's scheme with midpoints: stops that are touched at the middle of a step, and all friction contacts, act on its velocities
/// through impulses found by projected Gauss-Seidel. Of first order; it has no events. For rigid stops, f_s = f_k and no belts.
class TimeStepping {
 public:
  explicit TimeStepping(const Model& model);
  /// Positions after `steps` steps of h from rest at the origin.
  Eigen::VectorXd positions(double h, long steps) const;

 private:
  struct Row {
    Eigen::VectorXd g, M_inverse_g;  ///< displacement row over the coordinates
    double mobility;                 ///< g M^{-1} g^T
    double clearance = 0.0, restitution = 0.0, friction = 0.0;
  };
  Row row(int a, int b) const;
  void contact_impulses(const Eigen::VectorXd& middle, const Eigen::VectorXd& before, double h,
                        Eigen::VectorXd& v) const;

  Model model_;
  Eigen::VectorXd inverse_mass_;
  Eigen::MatrixXd C_, K_;
  std::vector<Row> stops_, frictions_;
};

}  // namespace slapstick::test
