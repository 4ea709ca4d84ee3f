/// Hashes twelve motions: of every event its kind, contact, instant, speed and error, and the state before and after
/// it, all bits of the doubles. The models are read from their files, so that formulas count too; the chain has more
/// than 24 numbers in its state, and so takes the ways of large models.
#include "report.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "hash.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

struct Run {
  std::string model;  ///< a built-in one, or `chain`
  Overrides set;
  int periods;
};

struct Summary {
  long events = 0, chatters = 0;
  std::uint64_t hash = 0;
};

/// Twelve bodies in a row, driven at one end, with a stop and dry friction; its numbers need every kind of function.
std::string chain() {
  std::string text = "name = \"chain\"\nomega = 0.8\n[parameters]\nk = 1.3\nz = \"0.02 * exp(sin(k) / 3)\"\n";
  const auto name = [](int i) { return "x" + std::to_string(i); };
  for (int i = 1; i <= 12; ++i)
    text += "[[coordinate]]\nname = \"" + name(i) + "\"\nmass = \"1 + 0.1 * cos(" + std::to_string(i) + ")^2\"\n";
  for (int i = 1; i <= 12; ++i) {
    const std::string between = "between = [\"" + name(i) + "\", \"" + (i == 12 ? "ground" : name(i + 1)) + "\"]\n";
    text += "[[spring]]\n" + between + "stiffness = \"k * " + std::to_string(i) + "^(1 / 3)\"\n";
    text += "[[damper]]\n" + between + "coefficient = \"z * ln(2 + k) + atan2(k, 400)\"\n";
  }
  return text +
         "[[force]]\non = \"x1\"\namplitude = \"tanh(k) + log10(2)\"\nphase = \"asin(0.4)\"\n"
         "[[force]]\non = \"x3\"\nharmonic = 2\namplitude = 0.3\nphase = \"-acosh(k)\"\n"
         "[[stop]]\nname = \"wall\"\nbetween = [\"x1\", \"ground\"]\nclearance = \"sinh(0.2)\"\nrestitution = 0.6\n"
         "[[friction]]\nname = \"floor\"\nbetween = [\"x12\", \"ground\"]\nstatic = 0.05\nkinetic = 0.03\n";
}

Summary summary_of(const Run& run) {
  const ModelDefinition definition =
      run.model == "chain" ? ModelDefinition::parse(chain(), "chain") : load_model(run.model);
  const System system(definition.build(run.set));
  Motion motion(system, definition.start(run.set));
  Summary summary;
  Hash hash;
  while (motion.advance({run.periods, 0.0}) == Outcome::event) {
    const Event& event = motion.event();
    ++summary.events;
    summary.chatters += event.kind == EventKind::chatter;
    hash.add(static_cast<std::uint64_t>(event.kind));
    hash.add(static_cast<std::uint64_t>(event.contact));
    hash.add(static_cast<std::uint64_t>(event.time.period));
    for (const double x : {event.time.fraction, event.w, event.error}) hash.add(x);
    for (const double x : motion.before()) hash.add(x);
    for (const double x : motion.state()) hash.add(x);
  }
  for (const double x : motion.state()) hash.add(x);
  summary.hash = hash.value();
  return summary;
}

/// Periodic, sticking, chaotic and chattering motions; the last two have polylines, a bounded stop, a normal force and
/// restitution over the speed.
std::vector<Run> runs() {
  return {{"vibro-impact", {{"omega", 0.552}}, 2400},
          {"vibro-impact", {{"omega", 4.65}}, 300},
          {"vibro-impact", {{"omega", 2.2}}, 2000},
          {"bouncing-ball", {}, 40},
          {"shaken-table", {{"restitution", 0.3}}, 400},
          {"impact-oscillator", {{"omega", 0.7}, {"restitution", 0.3}}, 400},
          {"spool", {}, 300},
          {"two-blocks-on-belt", {}, 500},
          {"stick-slip-impact", {}, 500},
          {"chain", {}, 300},
          {"drill-string", {}, 300},
          {"buffers", {}, 300}};
}

std::string line(const Run& run, const Summary& summary) {
  std::string text = run.model;
  char numbers[160];
  for (const auto& [name, value] : run.set) {
    std::snprintf(numbers, sizeof numbers, " %s=%g", name.c_str(), value);
    text += numbers;
  }
  std::snprintf(numbers, sizeof numbers, " periods %d events %ld chatters %ld bits %016llx", run.periods,
                summary.events, summary.chatters, static_cast<unsigned long long>(summary.hash));
  return text + numbers;
}

}  // namespace

std::vector<std::string> report_of_bits() {
  std::vector<std::string> lines;
  Hash all;
  int chattering = 0;
  long most = 0;
  for (const Run& run : runs()) {
    const Summary summary = summary_of(run);
    lines.push_back(line(run, summary));
    all.add(summary.hash);
    chattering += summary.chatters > 0;
    most = std::max(most, summary.events);
  }
  if (chattering < 3) throw NumericalError("fewer than three motions chatter");
  if (most < 100'000) throw NumericalError("no motion has 100000 events");
  char text[40];
  std::snprintf(text, sizeof text, "all %016llx", static_cast<unsigned long long>(all.value()));
  lines.emplace_back(text);
  return lines;
}

}  // namespace slapstick
