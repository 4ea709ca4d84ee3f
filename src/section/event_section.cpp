/// Walks a motion from event to event of one kind.
#include "slapstick/section/event_section.hpp"

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

namespace {

EventKind parse_kind(std::string_view word) {
  std::string known;
  for (std::size_t k = 0; k < event_kinds; ++k) {
    const auto kind = static_cast<EventKind>(k);
    if (name(kind) == word) return kind;
    known += (k == 0 ? "" : ", ") + std::string(name(kind));
  }
  throw InputError(in_quotes(word) + " is no kind of event; there are " + known);
}

}  // namespace

EventChoice parse_event_choice(const std::string& text, const System& system) {
  const auto colon = text.find(':');
  EventChoice choice{parse_kind(text.substr(0, colon)), {}};
  if (colon == std::string::npos) return choice;
  const Model& model = system.model();
  const auto contacts = static_cast<int>(model.stops.size() + model.frictions.size() + model.compliant_stops.size() +
                                         model.characteristics.size());
  std::string known;
  for (int c = 0; c < contacts; ++c) {
    if (system.contact_name(c) == text.substr(colon + 1)) choice.contact = c;
    known += (c == 0 ? "" : ", ") + system.contact_name(c);
  }
  if (!choice.contact)
    throw InputError("model " + in_quotes(model.name) + " has no contact " + in_quotes(text.substr(colon + 1)) +
                     (known.empty() ? "" : "; the model has " + known));
  return choice;
}

bool EventSection::next(Instant end, EventPoint& point, const std::atomic<bool>* stop) {
  const double period = motion_.system().period();
  Instant stage = motion_.time();
  do {
    stage = next_stage(motion_.system(), stage, end);
    while (motion_.advance(stage) == Outcome::event) {
      if (stopped(stop)) return false;
      const Event& event = motion_.event();
      if (!choice_.takes(event)) continue;
      point.time = event.time;
      point.contact = event.contact;
      point.w = event.w;
      point.return_time = last_ ? event.time.since(*last_) * period : std::numeric_limits<double>::quiet_NaN();
      point.state.assign(motion_.before().begin(), motion_.before().end());
      last_ = event.time;
      return true;
    }
    if (stopped(stop)) return false;
  } while (stage < end);
  return false;
}

}  // namespace slapstick
