#pragma once
/// What a picture of a motion shows: numbers of its state, which of them is drawn over which, and whose events are
/// marked.
#include <functional>
#include <string>
#include <vector>

#include "axis_units.hpp"
#include "model_options.hpp"
#include "relative_motion.hpp"

namespace slapstick::app {

struct ShownNumber {
  std::string label{};  ///< of its axis, with its unit
  std::function<double(const State&)> of{};
  std::vector<double> limits{};  ///< where a stop touches
};

struct ShownPanel {
  static constexpr int time = -1;
  int x = time, y = 0;  ///< numbers of ShownMotion::numbers
};

struct ShownMotion {
  std::vector<ShownNumber> numbers{};
  std::vector<ShownPanel> panels{};
  std::vector<int> contacts{};  ///< whose events and phases are marked, as System::contact_name counts
  std::string time{};           ///< label of the time, which is drawn in forcing periods
};

/// The relative motion of a pair: velocity over displacement, and both over time.
[[nodiscard]] ShownMotion shown_pair(const RelativeMotion& pair, const ChosenModel& chosen);

/// --show Q,X:Y,..: panels of Q over time and of Y over X. The names are displacements, velocities, gaps and relative
/// velocities of `slapstick quantities`, and differences of two.
/// @param contacts  whose events and phases are marked
/// @throws InputError naming --show
[[nodiscard]] ShownMotion shown_by_name(const std::string& text, const std::vector<int>& contacts,
                                        const ChosenModel& chosen);

/// The contacts of the pair of coordinates.
[[nodiscard]] std::vector<int> contacts_of(const RelativeMotion& pair, const Model& model);
[[nodiscard]] std::vector<int> all_contacts(const Model& model);

}  // namespace slapstick::app
