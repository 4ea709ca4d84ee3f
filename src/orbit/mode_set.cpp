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

/// Units of the coordinates in which the largest row sum of a block comes nearer to its least: the largest eigenvalue
/// of its absolute values (Collatz and Wielandt). Metres beside radians; one step of the power method.
Eigen::VectorXd nearer_units(const mode::Matrix& block, const Eigen::VectorXd& units) {
  // Of the largest. Smaller: the terms that `extremes` leaves out grow by its inverse, from below 1e-18.
  constexpr double smallest = 0x1p-20;
  const Eigen::VectorXd grown = block.cwiseAbs() * units;
  return grown.maxCoeff() > 0.0 ? (grown / grown.maxCoeff()).cwiseMax(smallest).eval() : units;
}

/// X' = A X is no faster than this: |u'| by displacements (twice its root), by velocities, and the phases.
double fastest_rate(const mode::Frame& frame, const mode::Matrix& A) {
  const int d = frame.d;
  const mode::Matrix by_displacement = A.block(d, 0, d, d), by_velocity = A.block(d, d, d, d);
  const auto rate = [&](const Eigen::VectorXd& units) {
    return std::max(std::sqrt(row_sum(by_displacement, units)), row_sum(by_velocity, units));
  };
  Eigen::VectorXd units = Eigen::VectorXd::Ones(d);
  double fastest = rate(units), nearer = fastest;  // any units give a bound: on as long as others halve it
  do {
    fastest = nearer;
    units = nearer_units(by_displacement, units);
    nearer = rate(units);
  } while (2.0 * nearer < fastest);
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
  constexpr double most_steps =
      1e5;  // more: less than ten digits are left. Newton's method may try a mass of almost nothing
  const double steps = std::max(1.0, std::ceil(std::abs(s) / longest_step));
  if (!(steps <= most_steps)) throw NumericalError("orbit: a leg is too long for the rates of its mode");
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
