#pragma once
/// What the engine says of a motion, held against the truth segment by segment.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "first_zero.hpp"
#include "near_graze.hpp"
#include "slapstick/flow/motion.hpp"

namespace campaign {

struct Verdicts {
  long scenes = 0;
  long segments = 0;     ///< judged,
  long adversarial = 0;  ///< of them near-grazes by construction: a minimum within half the guard's scale was met
  long hits = 0, misses = 0, grazes = 0;
  long rests_in_noise =
      0;            ///< a relative velocity whose least value is within the noise: stick or reversal, whichever is said
  long missed = 0;  ///< there is a zero, and the motion passed it
  long wrong = 0;   ///< an event where there is no zero
  long doubled = 0;    ///< the same, of the guard whose zero began the segment
  long failed = 0;     ///< the engine gave up
  long undecided = 0;  ///< touches that 113 bits cannot decide either
  long unjudged = 0;   ///< segments whose start is zero only within rounding (after a release), or that chatter ended
  std::array<long, 64>
      depths{};  ///< adversarial ones by k, least value of the guard in (2^-k-1, 2^-k] of its scale, either sign
  double deepest_graze = 0.0;  ///< largest |least value| / scale that was called a graze
  double worst_time = 0.0;     ///< largest |t - exact| in units of what noise explains
  std::vector<std::string> faults;

  void add(const Verdicts& other);
  [[nodiscard]] bool sound() const { return missed + wrong + doubled + failed == 0; }
};

/// What a value of a guard can be wrong by in a motion, in units of its scale (see graze_depth).
inline constexpr double noise = 0x1p-46;
/// What times can be wrong by where the guard has this slope and curvature, and its values may be wrong by so much of
/// its scale.
double blur(const Truth& truth, double duration, double wrong_by);
/// Of the guard's minimum, as a share of its scale; behind a zero that is no minimum, by its slope and curvature.
double depth(const Truth& truth);
/// How deep a graze may be, in units of a guard's scale: section 3 of docs/developers/proofs.md, for Taylor terms that
/// add up to e^2 times the guard.
inline constexpr double graze_depth = 0x1p-42;
/// The order of the guard's zero at the start; nothing if it is zero within rounding only, or falls.
std::optional<int> start_order(const ExactFlow& flow, int guard, const double* X);

/// Follows the motion from a start for up to `most_segments` segments and judges each.
void judge_motion(Scene& scene, const Start& start, Method method, int most_segments, Verdicts& verdicts);

}  // namespace campaign
