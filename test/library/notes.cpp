#include "library/notes.hpp"

#include <cmath>
#include <numbers>

namespace slapstick::library {

bool is(const Event& event, const std::string& kind, const System& system) {
  const auto at = kind.find('@');
  if (at != std::string::npos && system.contact_name(event.contact) != kind.substr(at + 1)) return false;
  const auto word = kind.substr(0, at);
  const bool friction = event.contact >= static_cast<int>(system.model().stops.size());
  const bool reverses = event.kind == EventKind::slip_plus || event.kind == EventKind::slip_minus;
  if (word == "turn") return friction && (reverses || event.kind == EventKind::stick);
  return word == "event" || word == name(event.kind);
}

void note_state(Values& values, const System& system, std::span<const double> state, const std::string& suffix) {
  const auto names = state_names(system.model());
  for (std::size_t i = 0; i < names.size(); ++i) values[names[i] + suffix] = state[i];
}

void note_event(Values& values, const Motion& motion, const std::string& suffix) {
  const Event& event = motion.event();
  values["t" + suffix] = event.time.seconds(motion.system().period());
  values["phase" + suffix] = 2 * std::numbers::pi * event.time.fraction;
  values["w" + suffix] = event.w;
  note_state(values, motion.system(), motion.before(), suffix);
}

void start_counts(Values& values) {
  for (const char* name : {"impacts", "chatters", "sticks", "turns", "engagements", "largest_stick"})
    values[name] = 0.0;
}

void count(const Motion& motion, Values& values) {
  const System& system = motion.system();
  const Event& event = motion.event();
  values["impacts"] += event.kind == EventKind::impact;
  values["chatters"] += event.kind == EventKind::chatter;
  values["sticks"] += is(event, "stick", system);
  values["turns"] += is(event, "turn", system);
  values["engagements"] += event.kind == EventKind::engage;
  if (is(event, "stick", system))
    values["largest_stick"] = std::max(values["largest_stick"], std::abs(motion.before()[0]));
}

}  // namespace slapstick::library
