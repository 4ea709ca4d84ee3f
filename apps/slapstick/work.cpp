/// Estimates what a run will cost, and refuses one that cannot end within hours.
#include "work.hpp"

#include <cstdio>

#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

System affordable(Model model, const Work& work) {
  System system(std::move(model));
  const double windows = system.windows_per_period() * work.periods;
  if (windows <= most_windows) return system;
  throw InputError(brief(work.periods) + " periods of " + brief(system.period()) + " are about " + brief(windows) +
                   " windows of " + brief(system.period() / system.windows_per_period()) +
                   ", the model's shortest time scale: more than the " + brief(most_windows) +
                   " that hours allow; lower " + work.option +
                   ", or bring the forcing period and the time scales of masses, springs and dampers closer together");
}

}  // namespace

System affordable_system(const ChosenModel& chosen, const Work& work, const Overrides& more) {
  const auto make = [&](Overrides values) {
    for (const auto& [name, value] : more) values[name] = value;
    return affordable(chosen.definition.build(values), work);
  };
  return blaming(chosen.overrides, make);
}

}  // namespace slapstick::app
