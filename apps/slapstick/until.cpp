/// Counts the events that may end a run.
#include "until.hpp"

#include <algorithm>

#include "arguments.hpp"
#include "base/text.hpp"
#include "event_options.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

Until::Until(const std::string& text, const System& system) : event_(text) {
  const auto colon = text.rfind(':');
  const std::string last = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool digits =
      !last.empty() && std::all_of(last.begin(), last.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits) {
    event_ = text.substr(0, colon);
    wanted_ = parse_integer("--until K", last, 1, 1'000'000'000'000);
  }
  choice_ = event_choice(event_, system, "--until");
}

bool Until::ends(const Event& event) {
  if (choice_.takes(event)) ++seen_;
  return choice_.takes(event) && met();
}

Json Until::json() const { return Json::object().set("event", event_).set("number", wanted_).set("met", met()); }

void Until::demand_met(double periods) const {
  if (met()) return;
  throw NumericalError("--until " + event_ + ": " +
                       (seen_ == 0 ? "no such event" : "only " + std::to_string(seen_) + " such events") + " in " +
                       shown(periods) + " periods; a longer --periods may bring " + (wanted_ == 1 ? "one" : "more"));
}

}  // namespace slapstick::app
