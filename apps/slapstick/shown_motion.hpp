#pragma once
/// What a picture of a motion shows: quantities and observables, which of them is drawn over which, and whose events
/// are marked.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "axis_units.hpp"
#include "model_options.hpp"
#include "relative_motion.hpp"
#include "slapstick/io/observer.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::app {

/// A sum with factors.
struct ShownNumber {
  struct Term {
    std::size_t index = 0;  ///< of ShownMotion::of, and behind them of the observables
    double factor = 1.0;
  };
  std::string label{};  ///< of its axis, with its unit
  std::vector<Term> terms{};
  std::vector<double> limits{};  ///< where a stop touches
};

struct ShownPanel {
  static constexpr int time = -1;
  int x = time, y = 0;  ///< numbers of ShownMotion::numbers
};

struct ShownMotion {
  std::vector<Quantity> of{};
  std::shared_ptr<Observer> observer{};  ///< null if no observable is shown; the last of `of` are its quantities
  std::vector<ShownNumber> numbers{};
  std::vector<ShownPanel> panels{};
  std::vector<int> contacts{};  ///< whose events and phases are marked, as System::contact_name counts
  std::string time{};           ///< label of the time, which is drawn in forcing periods
};

/// The relative motion of a pair: velocity over displacement, and both over time.
[[nodiscard]] ShownMotion shown_pair(const RelativeMotion& pair, const ChosenModel& chosen);

/// --show Q,X:Y,..: panels of Q over time and of Y over X. The names are those of observables, of quantities that have
/// a value at any time, and differences of two of these.
/// @param contacts  whose events and phases are marked
/// @throws InputError naming --show
[[nodiscard]] ShownMotion shown_by_name(const std::string& text, const std::vector<int>& contacts,
                                        const ChosenModel& chosen);

/// The contacts of the pair of coordinates.
[[nodiscard]] std::vector<int> contacts_of(const RelativeMotion& pair, const Model& model);
[[nodiscard]] std::vector<int> all_contacts(const Model& model);

}  // namespace slapstick::app
