#include <Eigen/LU>
#include <Eigen/QR>

#include "library/published_cases.hpp"
#include "section/return_map.hpp"

namespace slapstick::library {
namespace {

/// P_n(x; p) - x and the condition `zero` of trace and det, with the exact derivative of the first by x.
struct Residual {
  Eigen::VectorXd value;
  Eigen::MatrixXd by_state;
};

Residual residual(const Entry& entry, const Eigen::VectorXd& x, double p) {
  const Entry& critical = entry.at("critical");
  const Setup setup(entry, {{critical.at("parameter").get<std::string>(), p}});
  const auto map = section::Stroboscopic(setup.system).value(x, critical.at("n").get<int>(), nullptr);
  const Eigen::Index size = x.size();
  Values values = setup.values;
  values["trace"] = map.jacobian.trace();
  values["det"] = map.jacobian.determinant();
  Residual result{Eigen::VectorXd(size + 1), map.jacobian - Eigen::MatrixXd::Identity(size, size)};
  result.value << map.image - x, number(critical.at("zero"), values);
  return result;
}

Eigen::VectorXd settled(const Entry& entry, double p) {
  const Setup setup(entry, {{entry.at("critical").at("parameter").get<std::string>(), p}});
  Motion motion(setup.system, setup.start, setup.begin);
  const auto periods = static_cast<std::int64_t>(number(entry.at("settle"), setup.values) / setup.system.period());
  const Instant end{motion.time().period + 1 + periods, 0.0};
  while (motion.advance(end) == Outcome::event) {
  }
  return flow::contact_state(motion);
}

}  // namespace

/// The unknowns are the cycle's state and the parameter; at a fold the Jacobian by both is regular. At a pitchfork it
/// is singular along the broken symmetry, and the least-squares step stays in the symmetric states. Differences are
/// only for the condition and the parameter.
double critical_value(const Entry& entry) {
  double p = number(entry.at("critical").at("near"), {});
  Eigen::VectorXd x = settled(entry, p);
  const Eigen::Index size = x.size();
  const double h = 1e-6;
  for (int step = 0; step < 30; ++step) {
    const Residual here = residual(entry, x, p);
    Eigen::MatrixXd jacobian(size + 1, size + 1);
    jacobian.topLeftCorner(size, size) = here.by_state;
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd shift = h * Eigen::VectorXd::Unit(size, i);
      jacobian(size, i) =
          (residual(entry, x + shift, p).value[size] - residual(entry, x - shift, p).value[size]) / (2 * h);
    }
    jacobian.col(size) = (residual(entry, x, p + h).value - residual(entry, x, p - h).value) / (2 * h);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-5).compute(jacobian);  // the threshold counts when it is computed
    const Eigen::VectorXd move = decomposition.solve(-here.value);
    x += move.head(size);
    p += move[size];
    if (move.norm() < 1e-11 && here.value.norm() < 1e-10) return p;
  }
  throw std::runtime_error("Newton's method does not converge; last value " + std::to_string(p));
}

}  // namespace slapstick::library
