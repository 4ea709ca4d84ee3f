#pragma once
/// The options of the orbit that `orbit`, `continue` and `curve` begin with.
#include <string>

#include "arguments.hpp"
#include "io/json.hpp"
#include "model_options.hpp"
#include "slapstick/orbit/find.hpp"

namespace slapstick::app {

struct OrbitOptions {
  std::string orbit;  ///< --orbit N-P-I
  bool stable = false, unstable = false, symmetric = false, nearest = false;
  long long transient = 500;  ///< --transient
  long long starts = 0;       ///< --starts; 0: as many as there is time for, up to the default
  long long seed = 1;         ///< --seed
  double seconds = 0.0;       ///< --seconds; 0: ten, or with --starts no limit

  void declare(Arguments& arguments);
  void declare_choice(Arguments& arguments);  ///< the same without --transient
  /// Does an option say which orbit is meant?
  [[nodiscard]] bool any() const { return !orbit.empty() || stable || unstable || symmetric || nearest; }
  /// What the library is asked for. @throws InputError for options that exclude one another
  [[nodiscard]] orbit::OrbitWish wish() const;
};

/// What the options say about the orbit. @throws InputError naming the option
[[nodiscard]] orbit::OrbitChoice choice_of(const OrbitOptions& options, const State& start);

/// The orbit that is meant (Chosen::orbit is there). A choice that ended by time is told on standard error.
/// @throws NumericalError saying what was tried and found instead
[[nodiscard]] orbit::Chosen find_orbit(const orbit::Problem& problem, const System& system, const State& start,
                                       const OrbitOptions& options, const std::atomic<bool>& stop);

/// What a search tried: "64 motions, 812 near returns, 530 runs of Newton's method (..)".
[[nodiscard]] std::string tried(const orbit::SearchReport& report, const OrbitOptions& options);
[[nodiscard]] Json report_json(const orbit::SearchReport& report);

}  // namespace slapstick::app
