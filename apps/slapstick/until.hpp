#pragma once
/// simulate --until EVENT[:K]: the event that ends a run.
#include <string>

#include "io/json.hpp"
#include "slapstick/section/event_section.hpp"

namespace slapstick::app {

class Until {
 public:
  /// Reads "impact", "stick:belt", "impact:5", "stick:belt:5". @throws InputError naming --until
  Until(const std::string& text, const System& system);

  /// Counts an event. @returns whether it is the one that ends the run
  [[nodiscard]] bool ends(const Event& event);
  [[nodiscard]] bool met() const { return seen_ == wanted_; }

  /// {"event": .., "number": K, "met": ..}
  [[nodiscard]] Json json() const;
  /// @throws NumericalError if the event did not come
  void demand_met(double periods) const;

 private:
  std::string event_;
  EventChoice choice_;
  long long wanted_ = 1, seen_ = 0;
};

}  // namespace slapstick::app
