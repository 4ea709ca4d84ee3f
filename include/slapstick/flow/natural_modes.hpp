#pragma once
/// The natural motions phi exp(lambda t) of a machine whose stops are open and whose friction contacts slip: the
/// eigenvalues lambda of its mode X' = A X without contact.
///
/// A friction force that is constant in slip changes no eigenvalue; one that follows a normal force or the speed does.
/// Characteristics count with the piece that holds the given state. Units: those of the model, rates and frequencies
/// per unit of time.
/// Cost: one dense eigenvalue problem of 2n rows. Threads: safe to call at once.
/// Source: Meirovitch, Fundamentals of Vibrations (2001), chapter 7.
#include <vector>

#include "slapstick/flow/system.hpp"

namespace slapstick {

/// One eigenvalue lambda, of a pair of conjugates that with the positive imaginary part.
struct NaturalMode {
  double decay = 0.0;      ///< -Re lambda; negative where the motion grows
  double frequency = 0.0;  ///< |lambda| of a pair: the circular frequency without damping; 0 of a real lambda
  [[nodiscard]] bool oscillates() const { return frequency > 0.0; }
  [[nodiscard]] double damping_ratio() const { return decay / frequency; }  ///< of a mode that oscillates
};

/// By rising frequency; those that do not oscillate first, by rising decay. A free translation gives the decay 0 twice
/// without damping.
/// @param state  says which pieces hold, and in which direction contacts slip: with w > 0 where w is zero
/// @throws InputError for a state that the stops forbid
[[nodiscard]] std::vector<NaturalMode> natural_modes(const System& system, const State& state);

}  // namespace slapstick
