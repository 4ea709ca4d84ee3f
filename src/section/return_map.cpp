/// Computes the stroboscopic map with its Jacobian, and fixed points of maps.
#include "section/return_map.hpp"

#include <algorithm>

#include "base/dense.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::section {

using flow::contact_state, flow::multipliers_of, flow::Translations, flow::user_state;

double distance(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                const Eigen::VectorXd& scale) {
  return ((a - b).array().abs() / scale.array()).maxCoeff();
}

double distance(const Translations& translations, const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                const Eigen::VectorXd& scale) {
  return distance(translations.numbers(a), translations.numbers(b), translations.numbers(scale));
}

bool ReturnMap::run(Motion& motion, long n, Stop stop) const {
  for (long k = 0; k < n; ++k) {
    const std::optional<Instant> point = next(motion, stop);
    if (!point || !run_to(motion, *point, stop, [] {})) return false;
  }
  return true;
}

std::vector<std::complex<double>> ReturnMap::multipliers(const Eigen::MatrixXd& jacobian) const {
  return multipliers_of(jacobian);
}

std::optional<Instant> Stroboscopic::next(const Motion& motion, Stop) const {
  return Instant{motion.time().period + 1, 0.0};
}

bool Stroboscopic::run(Motion& motion, long n, Stop stop) const {
  return run_to(motion, {motion.time().period + n, 0.0}, stop, [] {});
}

MapValue Stroboscopic::value(const Eigen::VectorXd& x, int n, Stop stop) const {
  const Eigen::Index size = x.size();
  TangentMotion motion(translations().system(), user_state(translations().system(), x),
                       Eigen::MatrixXd::Identity(size, size));
  run_to(motion, {n, 0.0}, stop, [] {});
  MapValue value{
      contact_state(motion.motion()), translations().quotient(motion.tangents()), {}, static_cast<double>(n)};
  value.advance = translations().take_out(value.image);
  return value;
}

namespace {

FixedPoint on_section(const ReturnMap& map, const Eigen::VectorXd& x, const MapValue& value, int n, Stop stop) {
  FixedPoint found{map.on_section(x, n, stop), value, {}};
  if (found.x != x) found.value = map.value(found.x, n, stop);
  found.multipliers = map.multipliers(found.value.jacobian);
  return found;
}

}  // namespace

std::optional<FixedPoint> fixed_point(const ReturnMap& map, Eigen::VectorXd x, int n, const Eigen::VectorXd& scale,
                                      Stop stop) {
  const Translations& translations = map.translations();
  const Eigen::Index numbers = translations.size();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(numbers, numbers);
  constexpr int most_steps = 40, most_idle = 4;
  constexpr double idle = 0.8;  // of the step before
  double last = INFINITY;
  int idling = 0;
  try {
    for (int step = 0; step < most_steps && idling < most_idle; ++step) {
      const MapValue value = map.value(x, n, stop);
      if (stopped(stop)) return {};
      const bool arrived = distance(translations, value.image, x, scale) < 1e-11;
      if (arrived) return on_section(map, x, value, n, stop);
      const Eigen::VectorXd residual = x - value.image;
      const Eigen::VectorXd correction =
          translations.representative(dense::solve(value.jacobian - identity, translations.numbers(residual)));
      const double size = (correction.array().abs() / scale.array()).maxCoeff();
      if (!correction.allFinite() || size > 0.5) return {};
      idling = size > idle * last ? idling + 1 : 0;
      last = size;
      x += correction;
    }
  } catch (const InputError&) {      // the correction led behind a stop
  } catch (const NumericalError&) {  // or where the motion cannot be continued
  }
  return {};
}

}  // namespace slapstick::section
