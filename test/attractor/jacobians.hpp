#pragma once
/// Jacobians of the flow by two routes: central differences of motions, and tangents carried along one.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <string>

#include "flow/compiled_system.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::test {

inline State end_state(const System& system, const State& start, Instant end) {
  Motion motion(system, start);
  while (motion.advance(end) == Outcome::event) {
  }
  return motion.state();
}

/// Central differences of the flow in the user's coordinates, Richardson-extrapolated: error about h^4.
inline Eigen::MatrixXd differences(const System& system, const State& start, Instant end, double h) {
  const auto size = static_cast<Eigen::Index>(start.size());
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto column = [&](double step) {
      State plus = start, minus = start;
      plus[j] += step;
      minus[j] -= step;
      const State a = end_state(system, plus, end), b = end_state(system, minus, end);
      Eigen::VectorXd slope(size);
      for (Eigen::Index i = 0; i < size; ++i) slope[i] = (a[i] - b[i]) / (2.0 * step);
      return slope;
    };
    result.col(j) = (4.0 * column(0.5 * h) - column(h)) / 3.0;
  }
  return result;
}

/// The tangent flow's Jacobian in the user's coordinates x1, v1, x2, v2, ..
inline Eigen::MatrixXd tangent_jacobian(const System& system, const State& start, Instant end) {
  const int n = system.compiled().frame().n;
  Eigen::MatrixXd to_contact(2 * n, 2 * n);  // rows p1 p2 .. u1 u2 .., columns x1 v1 x2 v2 ..
  to_contact.setZero();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) to_contact(i, 2 * j) = to_contact(n + i, 2 * j + 1) = system.compiled().frame().W(i, j);
  }
  TangentMotion motion(system, start, to_contact);
  while (motion.advance(end) == Outcome::event) {
  }
  return to_contact.inverse() * motion.tangents();
}

inline std::string kinds(const System& system, const State& start, Instant end) {
  Motion motion(system, start);
  std::string all;
  while (motion.advance(end) == Outcome::event) all += std::string(name(motion.event().kind)) + " ";
  return all;
}

/// Do all starts that the differences are made of have the same events? Only there is the flow differentiable.
inline bool same_events(const System& system, const State& start, Instant end, double h) {
  const std::string expected = kinds(system, start, end);
  for (std::size_t j = 0; j < start.size(); ++j) {
    for (const double step : {-h, -0.5 * h, 0.5 * h, h}) {
      State moved = start;
      moved[j] += step;
      if (kinds(system, moved, end) != expected) return false;
    }
  }
  return true;
}

/// Tangents against differences with a step h; to 1e-6, or to what halving h changes.
inline void expect_equal_jacobians(const System& system, const State& start, Instant end, double h,
                                   const std::string& what) {
  const Eigen::MatrixXd exact = tangent_jacobian(system, start, end);
  const Eigen::MatrixXd coarse = differences(system, start, end, h), fine = differences(system, start, end, 0.5 * h);
  const double size = 1.0 + exact.cwiseAbs().maxCoeff(), own = (coarse - fine).cwiseAbs().maxCoeff();
  EXPECT_LT((exact - coarse).cwiseAbs().maxCoeff(), std::max(1e-6 * size, 30.0 * own))
      << what << ": " << kinds(system, start, end) << "\n"
      << exact << "\n\n"
      << coarse;
}

}  // namespace slapstick::test
