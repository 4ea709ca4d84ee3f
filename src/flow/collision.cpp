/// Impulses of stops that are struck together.
#include "flow/collision.hpp"

#include "base/dense.hpp"

namespace slapstick::flow {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Collision::Collision(const Model& model, const mode::Frame& frame, const Motion::Strike& strike, const VectorXd& X) {
  for (int stop = 0; stop < static_cast<int>(frame.stops.size()); ++stop) {
    if ((strike.stops >> stop & 1U) == 0) continue;
    stops.push_back(stop);
    rows.push_back(frame.stops[stop].own);
  }
  const auto count = static_cast<Eigen::Index>(stops.size());
  speed.resize(count);
  factor = slope = VectorXd::Ones(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int stop = stops[static_cast<std::size_t>(i)];
    speed[i] = frame.stops[stop].sign * X[frame.u(frame.stops[stop].own)];
    if (strike.to_rest) continue;
    const Rebound law = rebound(model.stops[stop], speed[i]);
    factor[i] += law.restitution;
    slope[i] += law.rate;
  }
}

MatrixXd impulses(const mode::Frame& frame, const std::vector<int>& rows, const MatrixXd& load) {
  const MatrixXd D = frame.mass_inverse(rows, rows);
  if (rows.size() == 1) return load / D(0, 0);
  return dense::LeastNorm(D).solve(load);
}

void push_along(const mode::Frame& frame, const std::vector<int>& rows, const VectorXd& factor,
                Eigen::Ref<MatrixXd> block) {
  if (rows.empty()) return;
  const MatrixXd load = factor.asDiagonal() * MatrixXd(block(rows, Eigen::all));
  block -= frame.mass_inverse(Eigen::all, rows) * impulses(frame, rows, load);
}

}  // namespace slapstick::flow
