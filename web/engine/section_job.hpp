#pragma once
/// Points of a section of a motion, as many as are wished for.
///
/// Rows: phase of the forcing in [0, 1), w, flight in periods (both NaN where the point is no impact), contact, state.
#include <optional>
#include <variant>

#include "choice.hpp"
#include "job.hpp"
#include "slapstick/section/event_section.hpp"
#include "slapstick/section/impact_section.hpp"

namespace slapstick::web {

struct SectionWish {
  std::string at = "impacts";  ///< impacts, periods, or an event as "stick:belt"
  int transient = 500, points = 2000;
  double phase = 0.0;  ///< of the section by periods, in [0, 1)
};

class SectionJob : public Job {
 public:
  SectionJob(const Choice& choice, const SectionWish& wish);

 protected:
  bool work(const Deadline& deadline) override;

 private:
  bool next_period(const Deadline& deadline);
  void add(const SectionPoint& point);
  void open();

  SectionWish wish_;
  System system_;
  std::optional<EventChoice> event_;
  std::optional<Motion> motion_;  ///< of the transient, and of a section by periods
  std::variant<std::monostate, ImpactSection, EventSection> section_;
  SectionPoint impact_;
  EventPoint point_;
  int found_ = 0;
};

}  // namespace slapstick::web
