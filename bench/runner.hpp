#pragma once
/// What every row of the trajectory table shares: start x1 = -0.5, else 0; this many forcing periods; these frequencies.
#include <array>

namespace slapstick::bench {

inline constexpr int periods = 500;
inline constexpr std::array<double, 4> omegas{2.2, 1.5, 4.9, 0.552};

/// Registers the rows of slapstick itself.
void register_slapstick();
/// .. and of chains with many contacts.
void register_chains();

}  // namespace slapstick::bench
