#pragma once
/// The natural motions phi exp(lambda t) of a machine in one combination of contact states: the eigenvalues lambda and
/// shapes phi of its mode X' = A X, among the motions that held contacts allow.
///
/// A friction force that is constant in slip changes no eigenvalue; one that follows a normal force or the speed does.
/// A compliant stop that acts adds its spring and damper. Contacts that are held (stuck, closed) let their two sides
/// move as one. Units: those of the model, rates and frequencies per unit of time.
/// Each eigenvalue has the digits that its own rounding leaves, in any units, however fast other parts of the machine
/// are. Where two meet, half of the digits hold, and their shapes are two of many.
/// Cost: one dense eigenvalue problem of 2n rows, and some 8 linear systems of n rows for each mode. Threads: safe to
/// call at once.
/// Source: Meirovitch, Fundamentals of Vibrations (2001), chapter 7; of sliding friction Hoffmann et al. (2002).
#include <complex>
#include <string>
#include <vector>

#include "slapstick/flow/system.hpp"

namespace slapstick {

/// One eigenvalue lambda, of a pair of conjugates that with the positive imaginary part.
struct NaturalMode {
  double decay = 0.0;      ///< -Re lambda; negative where the motion grows
  double frequency = 0.0;  ///< |lambda| of a pair: the circular frequency without damping; 0 of a real lambda
  /// phi: the displacement of each coordinate, the largest of which is 1. The velocities are lambda phi.
  std::vector<std::complex<double>> shape = {};
  [[nodiscard]] bool oscillates() const { return frequency > 0.0; }
  [[nodiscard]] double damping_ratio() const { return decay / frequency; }  ///< of a mode that oscillates
  [[nodiscard]] double cycles() const;  ///< Im lambda / (2 pi): oscillations per unit of time, as they decay
};

/// The contact states at a state, but that stops are open and friction contacts slip, except for some.
/// A contact slips in the sense in which it slips or begins to slip at the state, with w > 0 where it would stick. One
/// with a normal force has that of the state with these stops open; a closed compliant stop presses it in any case.
/// @param stuck   names of friction contacts, which are held with or without a normal force
/// @param closed  names of stops: rigid ones are at rest, compliant ones act
/// @throws InputError for a state that the stops forbid, and for a name that is no such contact
[[nodiscard]] mode::ContactStates sliding_states(const System& system, const State& state,
                                                 const std::vector<std::string>& stuck = {},
                                                 const std::vector<std::string>& closed = {});

/// By rising frequency; those that do not oscillate first, by rising decay. A free translation gives the decay 0 twice
/// without damping. Held contacts leave fewer modes: two rows of A less for each that is independent of the others.
[[nodiscard]] std::vector<NaturalMode> natural_modes(const System& system, const mode::ContactStates& states);

}  // namespace slapstick
