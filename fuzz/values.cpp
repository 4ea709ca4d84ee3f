/// Bytes as the values of --set, or of an option for ranges and lists. The first byte says which; a line break begins
/// the option anew.
#include <cmath>

#include "event_options.hpp"
#include "lines.hpp"
#include "orbit_choice.hpp"
#include "parameter_ranges.hpp"
#include "small_model.hpp"
#include "stop_options.hpp"
#include "target.hpp"

namespace slapstick::fuzz {
namespace {

using Lines = std::vector<std::string>;

const app::ChosenModel& as_it_is() {
  static const app::ChosenModel chosen = app::ModelOptions{}.with_sets(small_model());
  return chosen;
}

void demand_range(const app::ParameterRange& range) {
  demand(std::isfinite(range.from) && std::isfinite(range.to) && range.from < range.to, "a range has an inside");
}

void check_sets(const Lines& lines) {
  app::ModelOptions options;
  options.sets = lines;
  validate(options.with_sets(small_model()).model);
}

void check_sweep(const std::string& text) {
  const app::Sweep sweep = app::parse_sweep(text);
  demand_range({sweep.from, sweep.to});
  demand(sweep.count >= 2, "a sweep has two values");
  for (const double value : {sweep.from, sweep.to}) validate(small_model().build({{sweep.name, value}}));
}

void check_range(const std::string& text) {
  const app::ParameterRange range = app::parse_range("--range", text);
  demand_range(range);
  (void)app::value_inside(as_it_is(), "--param", "gap", range);
}

/// The first line is that of --params.
void check_two_ranges(const Lines& lines) {
  const auto names = app::two_parameters(lines.front());
  const auto ranges = app::two_ranges({lines.begin() + 1, lines.end()}, names);
  for (std::size_t i = 0; i < 2; ++i) {
    demand_range(ranges[i]);
    (void)app::value_inside(as_it_is(), "--params", names[i], ranges[i]);
  }
}

void check_orbit(const std::string& text) {
  app::OrbitOptions options;
  options.orbit = text;
  const orbit::OrbitChoice wanted = app::choice_of(options, {});
  demand(wanted.n.value_or(0) >= 0 && wanted.p.value_or(0) >= 0, "a cycle has no negative numbers");
}

void check_event(const std::string& text) {
  static const System system(as_it_is().model);
  const EventChoice events = app::event_choice(text, system);
  demand(events.contact.value_or(0) >= 0, "a contact has a number");
}

void check(std::string_view text) {
  if (text.empty()) return;
  const char option = text.front();
  const Lines lines = lines_of(text.substr(1));
  if (option == 's') check_sets(lines);
  if (option == 'w') check_sweep(lines.front());
  if (option == 'r') check_range(lines.front());
  if (option == 'p') check_two_ranges(lines);
  if (option == 'o') check_orbit(lines.front());
  if (option == 'e') check_event(lines.front());
  if (option == 't') (void)app::StopOptions{lines}.choice(as_it_is().model);
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  (void)succeeds([&] { check(text_of(data, size)); });
  return 0;
}
