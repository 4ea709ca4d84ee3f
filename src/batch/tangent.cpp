/// Carries the tangent vector of a run along an engine; its length is kept near one by powers of two.
#include "batch/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"
#include "flow/engine.hpp"

namespace slapstick::batch {
namespace {

Eigen::MatrixXd column(std::span<const double> delta) {
  return Eigen::Map<const Eigen::VectorXd>(delta.data(), static_cast<Eigen::Index>(delta.size()));
}

}  // namespace

double growth_of(std::span<const double> delta, double power) {
  constexpr double ln_2 = 0x1.62e42fefa39efp-1;
  double squares = 0.0;
  for (const double x : delta) squares += x * x;
  return squares > 0.0 ? 0.5 * fixed::ln(squares) + power * ln_2 : -INFINITY;
}

EngineTangent::EngineTangent(const flow::CompiledSystem& system)
    : carried_(system), delta_(2 * static_cast<std::size_t>(system.frame().n)) {}

void EngineTangent::begin(const flow::Engine& engine) {
  for (std::size_t i = 0; i < delta_.size(); ++i) delta_[i] = first_delta(static_cast<int>(i));
  take(std::vector<double>(delta_), 0.0, engine);
}

void EngineTangent::take(std::span<const double> delta, double power, const flow::Engine& engine) {
  power_ = power;
  carried_.set(column(delta), engine);
  carried_.begin(engine);
  keep();
}

void EngineTangent::follow(const flow::Engine& engine, Outcome outcome) {
  carried_.follow(engine, outcome);
  keep();
  const double size = std::abs(
      *std::max_element(delta_.begin(), delta_.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (size == 0.0 || (size > 0x1p-64 && size < 0x1p64)) return;
  const int power = std::ilogb(size);
  for (double& x : delta_) x = std::scalbn(x, -power);
  power_ += power;
  carried_.set(column(delta_), engine);
}

void EngineTangent::keep() {
  const Eigen::MatrixXd all = carried_.get();
  std::copy_n(all.data(), delta_.size(), delta_.begin());
}

}  // namespace slapstick::batch
