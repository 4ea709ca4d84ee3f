#pragma once
/// The tangent vector of a run while an engine carries the run on.
#include <span>
#include <vector>

#include "flow/carried_tangents.hpp"

namespace slapstick::batch {

/// ln |delta 2^power|; -infinity for zero.
[[nodiscard]] double growth_of(std::span<const double> delta, double power);

/// Of the numbers that a tangent starts with.
[[nodiscard]] constexpr double first_delta(int i) { return 1.0 / (1.0 + i); }

class EngineTangent {
 public:
  explicit EngineTangent(const flow::CompiledSystem& system);

  /// From `first_delta`, where the engine stands.
  void begin(const flow::Engine& engine);
  /// From a lane's tangent: p and u, 2 n numbers.
  void take(std::span<const double> delta, double power, const flow::Engine& engine);
  /// After each advance of the engine.
  void follow(const flow::Engine& engine, Outcome outcome);

  [[nodiscard]] std::span<const double> delta() const { return delta_; }
  [[nodiscard]] double power() const { return power_; }
  [[nodiscard]] double growth() const { return growth_of(delta_, power_); }

 private:
  void keep();

  flow::CarriedTangents carried_;
  std::vector<double> delta_;
  double power_ = 0.0;
};

}  // namespace slapstick::batch
