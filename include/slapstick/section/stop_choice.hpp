#pragma once
/// Which stops make the points of a section, and when.
///
/// A point is a *contact event*: the two sides of a stop come together with w > 0. Of a rigid stop that is an `impact`;
/// of a compliant one the `engage` at its gap (delta = 0, w = delta' > 0). A compliant stop that let go beyond its gap
/// may push again there, with delta' < 0: it was never left, so that is no point. Neither is a touch at rest (`graze`,
/// or an `engage` with w = 0).
///
/// A StopChoice is 32 bits: it costs nothing to copy, and threads may share it.
#include <cstdint>
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

/// A set of stops of one model, by their numbers (System::contact_name).
class StopChoice {
 public:
  StopChoice() = default;  ///< every stop, rigid and compliant

  /// The stops of these names; of no names: every stop.
  /// @throws InputError for a name that no stop has; it lists those there are
  StopChoice(const Model& model, const std::vector<std::string>& names);

  [[nodiscard]] bool holds(int contact) const { return (contacts_ >> static_cast<unsigned>(contact) & 1U) != 0; }

  /// Whether this event is a contact event of one of the stops.
  [[nodiscard]] bool is_point(const Event& event) const {
    const bool meets = event.kind == EventKind::impact || (event.kind == EventKind::engage && event.w > 0.0);
    return meets && holds(event.contact);
  }

 private:
  static_assert(System::most_contacts <= 32);
  std::uint32_t contacts_ = ~std::uint32_t{0};  // bit by bit
};

/// The numbers of all stops of a model: the rigid ones, then the compliant ones.
[[nodiscard]] std::vector<int> stop_contacts(const Model& model);

/// The name of the stop with this number.
[[nodiscard]] const std::string& stop_name(const Model& model, int contact);

}  // namespace slapstick
