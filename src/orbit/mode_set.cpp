/// Compiles the modes of a model at one point of its parameters, with derivatives.
#include "orbit/mode_set.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

/// X' = A X is no faster than this: |u'| by displacements (twice its root), by velocities, and the phases.
double fastest_rate(const mode::Frame& frame, const mode::Matrix& A) {
  const int d = frame.d;
  const auto row_sum = [](const auto& block) { return block.cwiseAbs().rowwise().sum().maxCoeff(); };
  const double by_displacement = row_sum(A.block(d, 0, d, d)), by_velocity = row_sum(A.block(d, d, d, d));
  const auto phases = static_cast<Eigen::Index>(2 * frame.harmonics.size());
  const double by_phase = phases == 0 ? 0.0 : row_sum(A.block(2 * d, 2 * d, phases, phases));
  return std::max({std::sqrt(by_displacement), by_velocity, by_phase});
}

std::vector<Model> all_rates(const Family& family, const std::vector<double>& values) {
  std::vector<Model> rates;
  for (std::size_t j = 0; j < family.names.size(); ++j) rates.push_back(family.rate(values, j));
  return rates;
}

}  // namespace

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
  auto made = std::make_unique<ModeRates>(ModeRates{mode::Outline(model_, frame_, states), {}, 1.0});
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
