/// Runs `simulate --sweep`.
#include "run_up.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "arguments.hpp"
#include "base/text.hpp"
#include "io/json.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/run_up.hpp"

namespace slapstick::app {
namespace {

/// The tables and the counts of a run-up.
class Tables {
 public:
  Tables(const RunUpFiles& files, const Model& model, const std::string& name) {
    std::vector<std::string> events{"time", name, "kind", "contact", "w"}, samples{"time", name};
    for (auto* columns : {&events, &samples})
      for (const auto& state : state_names(model)) columns->push_back(state);
    samples.emplace_back("mode");
    if (!files.events.empty()) events_.emplace(files.events, events);
    if (!files.trajectory.empty()) samples_.emplace(files.trajectory, samples);
    if (samples_) per_period_ = files.samples;
  }

  void event(const RunUp& run, const Motion& motion) {
    const Event& event = motion.event();
    ++kinds_[static_cast<std::size_t>(event.kind)];
    if (!events_ || event.kind == EventKind::knot) return;
    events_->number(run.time(event.time)).number(run.value()).word(name(event.kind));
    events_->word(motion.system().contact_name(event.contact)).number(event.w).numbers(motion.before()).end_row();
  }

  void sample(const RunUp& run, const Motion& motion) {
    if (!samples_) return;
    samples_->number(run.time(motion.time())).number(run.value()).numbers(motion.state());
    samples_->word(motion.system().mode_name(motion.mode_id())).end_row();
  }

  /// Samples per period; 0: no table of them.
  [[nodiscard]] long long per_period() const { return per_period_; }
  void commit() {
    if (events_) events_->commit();
    if (samples_) samples_->commit();
  }
  [[nodiscard]] Json counts() const {
    Json json = Json::object();
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
      if (kinds_[kind] > 0) json.set(name(static_cast<EventKind>(kind)), kinds_[kind]);
    return json;
  }

 private:
  std::optional<TableOutput> events_, samples_;
  std::array<long, event_kinds> kinds_{};
  long long per_period_ = 0;
};

/// @returns false if it was stopped
bool step(RunUp& run, Tables& tables, const Context& context) {
  Motion& motion = run.motion();
  const auto stages = std::max(1LL, tables.per_period()) * run.end().period;
  for (long long k = 0; k < stages; ++k) {
    tables.sample(run, motion);
    const double share = static_cast<double>(k + 1) / static_cast<double>(stages);
    const Instant end = k + 1 == stages ? run.end() : Instant{}.plus(share * static_cast<double>(run.end().period));
    while (motion.advance(end) == Outcome::event) {
      tables.event(run, motion);
      if (context.stop.load(std::memory_order_relaxed)) return false;
    }
    if (context.stop.load(std::memory_order_relaxed)) return false;
  }
  return true;
}

Json state_json(const Motion& motion) {
  Json json = Json::object();
  const auto names = state_names(motion.system().model());
  const State state = motion.state();
  for (std::size_t i = 0; i < names.size(); ++i) json.set(names[i], state[i]);
  return json;
}

}  // namespace

void RunUpRange::declare(Arguments& arguments, const std::vector<std::string>& others) {
  constexpr long long most = 1'000'000'000;
  arguments
      .text("--sweep", sweep, "NAME=A:B",
            "run-up: the parameter goes from A to B over --over periods, in steps of --hold")
      .with({"--over"})
      .without(others);
  arguments.count("--over", over, 2, most, "forcing periods of the run-up").with({"--sweep"});
  arguments.count("--hold", hold, 1, most, "forcing periods at each value of it (1)").with({"--sweep"});
  arguments.flag("--log", logarithmic, "values in equal ratios: a logarithmic sweep, with as many in each octave")
      .with({"--sweep"});
}

Climb RunUpRange::climb(const ChosenModel& chosen) const {
  const auto [name, text] = name_and_text("--sweep", sweep, "NAME=A:B");
  const auto parts = split(text, ':');
  if (parts.size() != 2) throw InputError("--sweep: " + in_quotes(sweep) + " is not of the form NAME=A:B");
  Climb climb{name, {parse_number("--sweep A", parts[0]), parse_number("--sweep B", parts[1]), 0, hold, logarithmic}};
  if (climb.options.from == climb.options.to) throw InputError("--sweep: both ends are " + parts[0]);
  if (logarithmic && !(climb.options.from * climb.options.to > 0.0))
    throw InputError("--log: no equal ratios lead from " + parts[0] + " to " + parts[1] +
                     "; both ends have one sign, and neither is 0");
  climb.options.steps = over / hold;
  if (climb.options.steps < 2 || over % hold != 0)
    throw InputError("--over: " + std::to_string(over) + " periods are not two or more steps of --hold " +
                     std::to_string(hold));
  for (const double value : {climb.options.from, climb.options.to}) {
    (void)blaming({{name, value}}, [&](const Overrides& sets) {
      Overrides all = chosen.overrides;
      for (const auto& [key, number] : sets) all[key] = number;
      return chosen.definition.build(all);
    });
  }
  return climb;
}

RunUp run_of(const Climb& climb, const ChosenModel& chosen, const State& start) {
  return {[&climb, &chosen](double value) {
            Overrides values = chosen.overrides;
            values[climb.name] = value;
            return chosen.definition.build(values);
          },
          climb.options, start};
}

int run_up(const RunUpRange& range, const RunUpFiles& files, const ChosenModel& chosen, const State& start,
           const Context& context) {
  const Climb climb = range.climb(chosen);
  Output out(files.out);
  Tables tables(files, chosen.model, climb.name);
  RunUp run = run_of(climb, chosen, start);
  Progress progress("periods", static_cast<double>(range.over), files.progress);
  bool complete = true;
  long long periods = 0;
  while (complete && run.next()) {
    complete = step(run, tables, context);
    progress.update(static_cast<double>(periods += range.hold));
  }
  tables.commit();
  Json json = Json::object(), end = Json::object();
  end.set("time", run.time(complete ? Instant{} : run.motion().time())).set(climb.name, run.value());
  end.set("state", state_json(run.motion()));
  json.set("model", chosen.model.name).set("complete", complete).set("steps", climb.options.steps);
  json.set("end", std::move(end)).set("events", tables.counts());
  out.write(json.dump() + "\n");
  out.commit();
  return complete ? done : interrupted;
}

}  // namespace slapstick::app
