#pragma once
/// What is wrong with a model, in parts, so that a model file can point at the line.
#include <optional>
#include <string>
#include <string_view>

#include "slapstick/model/model.hpp"

namespace slapstick {

struct Fault {
  std::string
      part;  ///< "coordinate", "spring", "damper", "force", "friction", "stop", "compliant_stop", "characteristic",
             ///< "matrix" or "model"
  int index = -1;     ///< which of them, from 0; -1 for the model itself and its matrices
  std::string field;  ///< the key as in a model file: "mass", "between", "static", ...; "" if it is not one field
  std::string what;   ///< "mass = -1 is not positive"
  bool behind_stop = false;  ///< of a start: it lies behind a stop

  /// "friction 'contact'": the part by its name, or by its number counted from 1.
  [[nodiscard]] std::string place(const Model& model) const;
};

/// The first thing wrong with a model, in the order in which Model lists its members; nothing if it is sound.
[[nodiscard]] std::optional<Fault> first_fault(const Model& model);

/// The first thing wrong with a start (model sound); part is "state", field the name of the number.
[[nodiscard]] std::optional<Fault> first_fault(const Model& model, const State& state);

/// The same for mass, damping and stiffness alone: size, symmetry, numbers, and a total mass matrix that is positive
/// definite.
[[nodiscard]] std::optional<Fault> first_matrix_fault(const Model& model);

/// The same for forces that press a friction contact (Force::presses), or are a part of its force (Force::contact).
[[nodiscard]] std::optional<Fault> first_press_fault(const Model& model);

/// The same for inner coordinates: what else acts on them, and their dampers.
[[nodiscard]] std::optional<Fault> first_inner_fault(const Model& model);

/// The same for ratios: their size, and contacts between the same ends whose y are multiples of each other, which the
/// engine would not take for one pair.
[[nodiscard]] std::optional<Fault> first_ratio_fault(const Model& model);

/// The part of the size of its terms that y may have been moved by rounding, where a state of n coordinates is written
/// out and read back: at most n + 2 roundings out of contact coordinates and n + 2 into them. A difference of two
/// numbers that are rounded once has four.
[[nodiscard]] inline double reading_error(int n, bool with_ratio) {
  return with_ratio ? (2.0 * n + 4.0) * 0x1p-53 : 0x1p-51;
}

/// The same for the stops together (each of them sound): two that face each other, or a loop of them, with no position
/// that obeys all.
[[nodiscard]] std::optional<Fault> first_room_fault(const Model& model);

/// Numbers beyond `largest`, and masses and frequencies below `smallest`, are refused: the engine multiplies a few of
/// them (a square of a force over a mass is the largest), and every such product has to stay far inside the range of a
/// double, which ends at 1e308.
inline constexpr double largest = 1e50;
inline constexpr double smallest = 1e-50;

/// Has a signal two values at one time?
[[nodiscard]] bool steps(const Signal& signal);

/// Has it a pulse?
[[nodiscard]] bool pulses(const Signal& signal);

/// A piece of a signal that is steeper than the clock resolves.
struct SteepPiece {
  std::size_t end = 0;  ///< the later one of its points, from 0
  std::string what;     ///< "time 1 is only 1e-12 after that of the point before, ..."
};
/// The first of them. The clock knows instants to 2^-53 of T, its period: so of a piece that rises by the part h of the
/// signal's range within dt each value is known to 2^-53 h T / dt of the range. A step that is written as a ramp of dt
/// is wrong by dt / T: below dt = 2^-26 h T a steeper ramp is a worse step, and contacts take the rounding of its slope
/// for rest.
[[nodiscard]] std::optional<SteepPiece> first_steep_piece(const Signal& signal, double period);

/// Whether a coordinate may not have this name: tables have a column, or the surroundings are called so.
[[nodiscard]] bool is_reserved(std::string_view name);

/// The column names, without checking the model.
[[nodiscard]] std::string velocity_name(const std::string& coordinate);

}  // namespace slapstick
