/// Cuts long runs into stages at fixed instants.
#include "slapstick/flow/stage.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick {
namespace {

constexpr double windows_per_stage = 1e6;
constexpr std::int64_t most_periods = 4096;

/// The first multiple of 1/pieces periods after now.
Instant next_piece(Instant now, std::int64_t pieces) {
  const auto count = static_cast<double>(pieces);
  for (auto index = static_cast<std::int64_t>(std::floor(now.fraction * count)) + 1; index < pieces; ++index) {
    const double fraction = static_cast<double>(index) / count;
    if (fraction > now.fraction) return {now.period, fraction};
  }
  return {now.period + 1, 0.0};
}

}  // namespace

Instant next_stage(const System& system, Instant now, Instant end) {
  const double windows = system.windows_per_period();
  if (windows > windows_per_stage)
    return std::min(next_piece(now, static_cast<std::int64_t>(std::ceil(windows / windows_per_stage))), end);
  const double fitting = std::floor(windows_per_stage / windows);
  const std::int64_t periods =
      fitting < static_cast<double>(most_periods) ? static_cast<std::int64_t>(fitting) : most_periods;
  return std::min(Instant{(now.period / periods + 1) * periods, 0.0}, end);
}

}  // namespace slapstick
