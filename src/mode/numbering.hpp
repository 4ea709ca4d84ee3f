#pragma once
/// Which numbers stand for the contacts of a model, and which of them carry the motion (the first n rows of W, the
/// basis).
///
/// A number is row . q - shift, with the rate row . q' - drift. A shift in the basis costs the motion the digits of its
/// size, whether the contact is ever reached or not. So of the contacts on one pair the first is in the basis that is
/// not far beside the nearest: of the least drift, and of a shift within ten bits of the least and of the motion's
/// size. Where even that is far (`far`), row . q itself is in the basis, and all the pair's contacts follow from it. A
/// contact is far against another length of the model; one that is alone has none to be far against, and its own is the
/// size that motions are expected to have.
///
/// The rows of the basis are those of the first contact of each pair, whichever is the nearest: they depend on no
/// parameter. Shifts do, where a parameter makes another contact the nearest one. A family of orbits keeps the choice
/// that it began with (`numbered_alike`): it costs digits at most, and contact states of all its values are in the same
/// coordinates.
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/model/family.hpp"

namespace slapstick::mode {

struct Number {
  RowVector row;
  double shift = 0.0, drift = 0.0;
};

struct Numbering {
  explicit Numbering(const Model& model);

  std::vector<Number> numbers;  ///< those of the basis first, n of them
  std::vector<ContactRow> stops, compliant, frictions;
  std::vector<ContactRow> sliders;  ///< the pair of each
  /// As Model::numbered_by: for each pair a contact (stops, compliant stops, frictions, sliders), or -1 for none.
  std::vector<int> chosen;
};

/// The family, its models numbered as the one at these values is.
[[nodiscard]] Family numbered_alike(Family family, const std::vector<double>& values);

/// +1 or -1 if the rows are equal or opposite, else 0.
[[nodiscard]] int same_direction(const RowVector& a, const RowVector& b);

/// A length and a speed that the model has, whatever its motion: 0 where nothing in the model gives one.
struct Extent {
  double length = 0.0, speed = 0.0;
};
/// How far the forces alone move the masses: F / k or F / (m omega^2), and that times the fastest rate. Of F, m and k
/// the greatest, the least and the least: a resonance may go farther, and is then no worse off for a number more.
[[nodiscard]] Extent extent_of_forces(const Model& model);

}  // namespace slapstick::mode
