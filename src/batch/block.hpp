#pragma once
/// The state of up to eight lanes, as a kernel sees it: plain arrays [number][lane]. Kernels of all widths share the
/// layout; one of width w uses the first w lanes.
#include <cstdint>

#include "batch/layout.hpp"

namespace slapstick::batch {

inline constexpr int most_lanes = 8;

struct alignas(64) Block {
  using Row = double[most_lanes];

  // A trajectory at the start of its window
  alignas(64) Row p[most_coordinates], u[most_coordinates];
  alignas(64) Row fraction, period;  ///< the instant; whole periods as a double
  alignas(64) Row scale;             ///< what the window is shorter than the mode's by
  alignas(64) Row tries;             ///< how often the window has been halved from the same start
  alignas(64) Row sine[most_streams], cosine[most_streams];  ///< of the streams at the instant, if `in_phase`
  bool in_phase;                             ///< false where an instant has been set by another than the kernel
  alignas(64) Row cut_period, cut_fraction;  ///< the next instant to look at
  alignas(64) Row impacts, speeds;           ///< number of impacts, and the sum of their speeds
  alignas(64) Row seen;                      ///< events of a lane's run that the lane has decided
  int mode[most_lanes];
  bool tangents;                                                      ///< whether each lane carries a tangent vector ..
  alignas(64) Row dp[most_coordinates], du[most_coordinates], power;  ///< .. these numbers times 2 to the power

  // Words
  alignas(64) Row restitution[most_contacts], zero_force_rate[most_contacts], impulse[most_contacts][most_coordinates];
  Row* active;                  ///< [word]: of each lane's mode. Those of slots that no lane's mode has are zero
  int active_mode[most_lanes];  ///< whose words those are; the number of modes: none
  int filled;                   ///< the most slots that one of these modes has
  const Row* all;               ///< [mode][word]
  const std::uint8_t* ready;    ///< [mode][lane]: whether those words have been made
  Layout layout;
  const int* harmonic;  ///< Shape::harmonic, cosine_of, action, open, slots, still
  const std::uint8_t* cosine_of;
  const Action* action;
  const std::uint8_t* open;
  const std::uint8_t* slots;
  const std::uint8_t* still;

  // What a call of the kernel leaves
  unsigned occupied;  ///< lanes that have a trajectory
  unsigned starting;  ///< those of them that have no mode yet: `start` says which it may be
  Action start[most_lanes];
  unsigned watched;                          ///< lanes whose events are to be seen one by one
  unsigned events, cuts, doubtful, wanting;  ///< lanes with an event, at a cut, in doubt, and in want of the words
                                             ///< of a mode ..
  int wanted[most_lanes];                    ///< .. and which
  alignas(64) Row at_p[most_coordinates], at_u[most_coordinates];  ///< at the cut
  alignas(64) Row at_dp[most_coordinates], at_du[most_coordinates];
  alignas(64) Row event_speed;
  int event_mode[most_lanes], event_slot[most_lanes], event_side[most_lanes];  ///< what has ended, and how
  // Work done
  long steps, lane_steps, halved;
};

/// A kernel: one text (step.hpp) for each instruction set.
struct Kernel {
  const char* name;
  int width;
  /// Steps all lanes until one needs its caller: an event that is watched, a cut, a doubt, words that are missing.
  void (*run)(Block& block);
};

/// The kernel that runs: of the environment's SLAPSTICK_TARGET, otherwise the widest that the processor has.
/// @param width  1, 4 or 8; 0: any. Where the processor has none of that width, one that it has
[[nodiscard]] const Kernel& kernel(int width = 0);

}  // namespace slapstick::batch
