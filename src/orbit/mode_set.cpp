/// Compiles the modes of a model at one point of its parameters, with derivatives.
#include "orbit/mode_set.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

/// The largest row sum, each coordinate measured in its own unit.
double row_sum(const mode::Matrix& block, const Eigen::VectorXd& units) {
  return (block.cwiseAbs() * units.asDiagonal()).rowwise().sum().cwiseQuotient(units).maxCoeff();
}

/// Units of the coordinates, in which the largest row sum of a block comes near to its least, the largest eigenvalue of
/// its absolute values (Collatz and Wielandt): metres beside radians, a light mass beside a heavy one.
Eigen::VectorXd natural_units(const mode::Matrix& block) {
  constexpr int iterations = 3;         // of the power method; the bound holds after any number of them
  constexpr double smallest = 0x1p-20;  // of the largest: what nothing accelerates has no unit of its own
  Eigen::VectorXd units = Eigen::VectorXd::Ones(block.rows());
  for (int k = 0; k < iterations; ++k) {
    units = block.cwiseAbs() * units;
    units = (units / units.maxCoeff()).cwiseMax(smallest).eval();
  }
  return units;
}

/// X' = A X is no faster than this: |u'| by displacements (twice its root), by velocities, and the phases.
double fastest_rate(const mode::Frame& frame, const mode::Matrix& A) {
  constexpr double worth = 2.0;  // a gain for which coordinates are measured anew: it decides on time alone
  const int d = frame.d;
  const mode::Matrix by_displacement = A.block(d, 0, d, d), by_velocity = A.block(d, d, d, d);
  const auto rate = [&](const Eigen::VectorXd& units) {
    return std::max(std::sqrt(row_sum(by_displacement, units)), row_sum(by_velocity, units));
  };
  double fastest = rate(Eigen::VectorXd::Ones(d));
  if (by_displacement.cwiseAbs().maxCoeff() > 0.0)
    if (const double natural = rate(natural_units(by_displacement)); worth * natural < fastest) fastest = natural;
  const auto phases = static_cast<Eigen::Index>(2 * frame.harmonics.size());
  if (phases > 0)
    fastest = std::max(fastest, row_sum(A.block(2 * d, 2 * d, phases, phases), Eigen::VectorXd::Ones(phases)));
  return fastest;
}

std::vector<Model> all_rates(const Family& family, const std::vector<double>& values) {
  std::vector<Model> rates;
  for (std::size_t j = 0; j < family.names.size(); ++j) rates.push_back(family.rate(values, j));
  return rates;
}

}  // namespace

double ModeRates::steps(double s) const {
  constexpr double most = 1e5;  // more: less than ten digits are left. Newton's method may try a mass of almost nothing
  const double steps = std::max(1.0, std::ceil(std::abs(s) / longest_step));
  if (!(steps <= most)) throw NumericalError("orbit: a leg is too long for the rates of its mode");
  return steps;
}

std::size_t ModeRates::guard(mode::GuardKind kind, int contact) const {
  for (std::size_t g = 0; g < outline.guards.size(); ++g)
    if (outline.guards[g].kind == kind && outline.guards[g].contact == contact) return g;
  throw NumericalError("orbit: a leg of the cycle has no guard of the kind that ends it");
}

ModeSet::ModeSet(const Family& family, const std::vector<double>& values)
    : model_(family.model(values)), rates_(all_rates(family, values)), frame_(model_) {
  for (const Model& rate : rates_) frame_rates_.emplace_back(model_, rate, frame_);
}

const ModeRates& ModeSet::mode(const mode::ContactStates& states) const {
  const auto known = ranges::find_if(modes_, [&](const auto& mode) { return mode->outline.states == states; });
  if (known != modes_.end()) return **known;
  auto made = std::make_unique<ModeRates>(ModeRates{mode::Outline(model_, frame_, states), {}, 1.0, {}});
  for (std::size_t j = 0; j < rates_.size(); ++j)
    made->rates.emplace_back(model_, rates_[j], frame_, frame_rates_[j], made->outline);
  const double rate = fastest_rate(frame_, made->outline.system);
  made->longest_step = rate > 0.0 ? 2.0 / rate : INFINITY;
  modes_.push_back(std::move(made));
  return *modes_.back();
}

double ModeSet::period_rate(std::size_t j) const {
  return model_.forced() ? -period() * rates_[j].omega / model_.omega : 0.0;
}

}  // namespace slapstick::orbit
