#pragma once
/// The flat program of a model: all that a kernel needs to know of the model, as plain arrays. No pointers, no
/// virtual calls; what a lane, a processor with wider vectors or another machine runs is this and nothing else.
///
/// A program has two parts. The *shape* is what all parameter values share: the modes, what ends each mode, what may
/// follow. The *words* are numbers: of every mode a row of `Layout::size` doubles, and a few of the model. A kernel
/// keeps the words of a lane's present mode at hand.
///
/// In a mode p' = u + drift and u' = K p + C u + F f + R, f the *streams*: sin(j theta) and cos(j theta), those that
/// some force needs. A *slot* is a row v over (p, u, f, 1) that must stay between two limits, -lower < v < upper: a
/// gap, a relative velocity, the two limits of a holding force. Words are scaled to the mode's window H: K H^2, C H,
/// F H^2, R H^2, rows over u by 1/H.
///
/// Source: docs/developers/proofs.md, section 11, for the window, the norm and the bounds.
#include <cstdint>
#include <vector>

#include "batch/layout.hpp"
#include "mode/outline.hpp"

namespace slapstick::batch {

/// Of one slot of one mode.
struct Slot {
  std::int8_t own = -1;  ///< the number that the row consists of, or -1: a sum
  bool speed = false;    ///< that number is u_own, else p_own
  std::int8_t gap = -1;  ///< the stop whose gap falls with the slot, or -1
};

/// What all parameter values share.
struct Shape {
  Layout layout;
  int modes = 0, stops = 0, frictions = 0, compliant = 0;
  std::vector<int> harmonic;            ///< of each stream ..
  std::vector<std::uint8_t> cosine_of;  ///< .. and whether it is a cosine
  std::vector<Slot> slot;               ///< [mode][slot]
  std::vector<std::uint8_t> slots;      ///< how many each mode has; none of a lane without a mode
  std::vector<Action> action;           ///< [mode][slot][side]
  std::vector<std::uint8_t> open;       ///< [mode]: bit by bit, the displacements of open stops that no slot watches
  std::vector<std::uint8_t> still;      ///< [mode]: bit i, a tangent's u_i is zero; bit most_coordinates + i, its p_i
  std::vector<std::uint8_t> known;      ///< [mode]: whether slots, actions and the two above have been made

  std::vector<int> structure;  ///< what `same_shape` compares

  [[nodiscard]] const Action& action_of(int mode, int s, int side) const {
    return action[static_cast<std::size_t>((mode * layout.slots + s) * sides + side)];
  }
};

/// Numbers of a model that no mode changes.
struct ModelWords {
  double period = 1.0;
  double restitution[most_contacts] = {};                ///< of each stop
  double impulse[most_contacts][most_coordinates] = {};  ///< of each stop: -(1 + r) times u's change per unit of
                                                         ///< velocity
  double zero_force_rate[most_contacts] = {};            ///< of each compliant stop: -stiffness / damping
};

/// True if lanes can run the model: at most four coordinates and contacts, no loads, characteristics, bounded
/// compliant stops, tones or signals, constant restitutions above zero, contacts that do not depend on each other.
[[nodiscard]] bool fits_lanes(const Model& model, const mode::Frame& frame);

/// The shape of a model for which `fits_lanes`. Modes are added by `add_mode` as they are met.
[[nodiscard]] Shape shape_of(const Model& model, const mode::Frame& frame);
/// Whether a model's lanes can stand beside those of this shape.
[[nodiscard]] bool same_shape(const Shape& shape, const Model& model, const mode::Frame& frame);
[[nodiscard]] ModelWords model_words(const Model& model, const mode::Frame& frame);

/// Contact states of a mode, in the numbering of System.
[[nodiscard]] mode::ContactStates states_of(const Shape& shape, int mode);

/// The words of a mode; and, once for a shape, its slots and what ends it.
/// @returns false if this parameter value has another structure than the shape: such a run is a Motion's
bool make_words(const Model& model, const mode::Frame& frame, Shape& shape, int mode, double* words);

}  // namespace slapstick::batch
