#pragma once
/// What a batch of random segments shares: a model, compiled, and the exact flow of the modes that its motions meet.
#include <map>
#include <memory>
#include <string>

#include "exact_flow.hpp"
#include "random.hpp"
#include "slapstick/flow/system.hpp"

namespace campaign {

class Scene {
 public:
  /// A random oscillator of one to three masses, or a built-in model at a random frequency.
  enum class Phase { any, zero };  ///< at which motions start
  explicit Scene(Random& random, Phase phase = Phase::any);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] const slapstick::System& system() const { return *system_; }
  /// Length of a segment in intervals of the grid, and in time.
  [[nodiscard]] int intervals() const { return intervals_; }
  [[nodiscard]] double duration() const { return intervals_ * spacing_; }
  /// Of one mode; made when it is first asked for.
  const ExactFlow& flow(slapstick::ModeId mode);
  /// A random state that no stop forbids.
  slapstick::State state(Random& random) const;
  /// Extended state of a user's state at a phase.
  void enter(const slapstick::State& state, double phase, double* X) const;

  /// A random phase to start at, in periods.
  double phase(Random& random) const;
  /// All gaps are open.
  [[nodiscard]] bool lawful(const slapstick::State& state) const;

 private:
  std::unique_ptr<slapstick::System> system_;
  slapstick::State middle_, reach_;  ///< of each number of a random state
  Phase phase_;
  int intervals_ = 0;
  double spacing_ = 0.0;
  std::map<slapstick::ModeId, std::unique_ptr<ExactFlow>> flows_;
};

/// The models that scenes are made of.
slapstick::Model random_model(Random& random);

}  // namespace campaign
