/// slapstick simulate MODEL
#include <algorithm>
#include <array>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "certified_run.hpp"
#include "io/json.hpp"
#include "model_options.hpp"
#include "motion_plot.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "physical.hpp"
#include "progress.hpp"
#include "retrace.hpp"
#include "run_up.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/quantity/observables.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/section/sampled_motion.hpp"
#include "span_options.hpp"
#include "stop_options.hpp"
#include "until.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

constexpr long long most_periods = 1'000'000'000'000;
constexpr int plotted_periods = 20;
constexpr double most_plotted_periods = 100'000;

struct Options {
  ModelOptions model;
  long long periods = 100;
  double time = 0.0;
  long long samples = 100;
  StopOptions stop;
  std::string events, trajectory, columns, until, certify, plot, plot_size, show, window, out;
  RunUpRange climb;
  bool physical = false, progress = false;
};

/// Everything a run writes to, opened before it starts.
class Run {
 public:
  Run(const Options& options, const ChosenModel& chosen, const System& system, const State& start, Instant end,
      ShownMotion shown, std::pair<Instant, Instant> window)
      : system_(system),
        options_(options),
        end_(end),
        result_(options.out),
        plot_(options.plot, options.plot_size),
        picture_(system_, std::move(shown)),
        observables_(system_, chosen.definition.observer(chosen.overrides)),
        reader_(system_, functions_of_time("--columns", options.columns, chosen)),
        units_(chosen, options.physical) {
    if (!options.certify.empty()) certified_.emplace(options.certify);
    if (!options.events.empty()) events_.emplace(options.events, units_.event_columns(), table_facts(chosen));
    if (!options.trajectory.empty()) trajectory_.emplace(options.trajectory, columns(), table_facts(chosen));
    picture_.keep(window.first, window.second);
    motion_.emplace(Motion(system_, start), trajectory_ ? static_cast<int>(options.samples) : 0);
    if (!options.until.empty()) until_.emplace(options.until, system_);
    if (plot_.wanted()) retrace_.emplace(motion_->motion(), plotted_periods);
  }

  /// @returns false if it was stopped before the end
  bool operator()(const Context& context) {
    Progress progress("periods", end_.since({}), options_.progress);
    Instant stage;  // long runs without an event must look up too
    long steps = 0;
    do {
      stage = next_stage(system_, stage, end_);
      for (auto item = motion_->next(stage); item != SampledMotion::Item::end; item = motion_->next(stage)) {
        if (item == SampledMotion::Item::event && note_event()) return true;
        if (item == SampledMotion::Item::sample) note_sample();
        if (++steps % 1024 == 0) progress.update(motion_->motion().time().since({}));
        if (context.stop.load(std::memory_order_relaxed)) return false;
      }
      if (plot_.wanted()) picture_.add_segment(motion_->motion());
      if (retrace_) retrace_->mark(motion_->motion());
      progress.update(stage.since({}));
      if (context.stop.load(std::memory_order_relaxed)) return stage == end_;
    } while (stage < end_);
    return true;
  }

  /// The run again, for its certificate. @returns false if it was stopped
  bool certify(const State& start, const Context& context) {
    return !certified_ || (*certified_)(system_, start, end_, options_.progress, context);
  }

  /// @returns the exit status
  int write(bool complete, const ChosenModel& chosen, const State& start) {
    if (events_) events_->commit();
    if (trajectory_) trajectory_->commit();
    if (certified_) certified_->commit();
    result_.write(summary(complete, chosen, start).dump() + "\n");
    result_.commit();
    if (plot_.wanted() && picture_.empty()) retrace();
    const int status = plot_.write_or_say(picture_.empty() ? figure::Figure{} : motion_figure(picture_),
                                          picture_.empty(), complete ? done : interrupted);
    if (until_ && complete) until_->demand_met(end_.since({}));
    return status;
  }

 private:
  [[nodiscard]] std::vector<std::string> columns() const {
    std::vector<std::string> all = units_.trajectory_columns();
    for (const Quantity& one : reader_.of()) all.push_back(one.name);
    return all;
  }

  /// @returns whether the run ends here
  bool note_event() {
    const Motion& motion = motion_->motion();
    const Event& event = motion.event();
    ++kinds_[static_cast<std::size_t>(event.kind)];
    if (event.kind == EventKind::knot) {  // the signal's own: no table has it
      if (plot_.wanted()) picture_.add_segment(motion);
      return false;
    }
    if (events_) {
      events_->number(units_.time(event.time.seconds(system_.period())))
          .word(name(event.kind))
          .word(system_.contact_name(event.contact))
          .number(units_.w(event.w));
      events_->numbers(units_.state(motion.before())).end_row();
    }
    if (retrace_) retrace_->mark(motion);
    if (plot_.wanted()) {
      picture_.add_segment(motion);
      picture_.add_event(motion);
    }
    if (!until_ || !until_->ends(event)) return false;
    end_ = event.time;
    return true;
  }

  void note_sample() {
    const SampledMotion::Sample& sample = motion_->sample();
    const double time = sample.time.seconds(system_.period());
    trajectory_->number(units_.time(time)).numbers(units_.state(sample.state)).word(system_.mode_name(sample.mode));
    trajectory_->numbers(units_.observables(observables_.within(motion_->motion(), sample)));
    trajectory_->numbers(reader_.within(motion_->motion(), sample.within)).end_row();
  }

  /// The picture of a run that was ended before the part that it was to show: the last periods that there are.
  void retrace() {
    const Instant end = motion_->motion().time();
    const Motion& from = retrace_->from();
    const double behind = end.since(from.time());
    picture_.keep(from.time().plus(std::max(0.0, behind - plotted_periods)), end);
    Motion last(from);
    for (Outcome outcome = Outcome::event; outcome == Outcome::event;) {
      outcome = last.advance(end);
      picture_.add_segment(last);
      if (outcome == Outcome::event) picture_.add_event(last);
    }
  }

  [[nodiscard]] Json state_json(const State& state) const {
    Json json = Json::object();
    const auto names = state_names(system_.model());
    for (std::size_t i = 0; i < names.size(); ++i) json.set(names[i], state[i]);
    return json;
  }

  [[nodiscard]] Json summary(bool complete, const ChosenModel& chosen, const State& start) const {
    const Motion& motion = motion_->motion();
    Json parameters = Json::object(), events = Json::object(), work = Json::object(), end = Json::object();
    for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
    const Model& model = system_.model();
    const bool compliant = !model.compliant_stops.empty(),
               bent = !model.characteristics.empty() || ranges::any_of(model.compliant_stops, &CompliantStop::bounded),
               loaded =
                   ranges::any_of(model.frictions, [](const FrictionContact&one) { return one.normal.has_value(); });
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      const auto event = static_cast<EventKind>(kind);
      const bool possible = event == EventKind::knot     ? !model.signals.empty()
                            : event == EventKind::corner ? bent
                            : event > EventKind::corner  ? loaded
                                                         : event < EventKind::engage || compliant;
      if (possible) events.set(name(event), kinds_[kind]);
    }
    const Counters& counters = motion.counters();
    work.set("segments", counters.segments).set("windows", counters.windows).set("evaluations", counters.evaluations);
    end.set("time", motion.time().seconds(system_.period())).set("periods", motion.time().since({}));
    end.set("mode", system_.mode_name(motion.mode_id())).set("state", state_json(motion.state()));
    Json json = Json::object();
    json.set("model", chosen.model.name).set("parameters", std::move(parameters)).set("period", system_.period());
    json.set("complete", complete).set("start", state_json(start)).set("end", std::move(end));
    json.set("events", std::move(events)).set("work", std::move(work));
    if (until_) json.set("until", until_->json());
    if (certified_) json.set("certificate", certified_->summary());
    return json;
  }

  System system_;
  const Options& options_;
  Instant end_;
  Output result_;
  Plot plot_;
  MotionRecord picture_;
  Observables observables_;
  Reader reader_;
  TableUnits units_;
  std::optional<TableOutput> events_, trajectory_;
  std::optional<CertifiedRun> certified_;
  std::optional<Until> until_;
  std::optional<SampledMotion> motion_;
  std::optional<Retrace> retrace_;
  std::array<long, event_kinds> kinds_{};
};

Instant end_of(const Options& options, bool by_time, const Model& model) {
  if (!by_time) return {options.periods, 0.0};
  const double periods = options.time / model.forcing_period();
  if (!(periods >= 0.0 && periods <= static_cast<double>(most_periods)))
    throw InputError("--time: " + shown(options.time) + " is outside [0, " + shown(static_cast<double>(most_periods)) +
                     " forcing periods]");
  return Instant{}.plus(periods);
}

/// What the picture shows of the time. @throws InputError naming --window
std::pair<Instant, Instant> window_of(const Options& options, Instant end) {
  const double length = end.since({});
  if (options.window.empty())
    return {end.period >= plotted_periods ? Instant{end.period - plotted_periods, end.fraction} : Instant{}, end};
  const ParameterRange window = parse_range("--window", options.window);
  if (!(window.from >= 0.0 && window.from < length))
    throw InputError("--window: the run has the periods 0 to " + shown(length) + ", and " + shown(window.from) +
                     " is not one of them");
  if (window.to - window.from > most_plotted_periods)
    throw InputError("--window: " + shown(window.to - window.from) + " periods are more than a picture shows (" +
                     shown(most_plotted_periods) + ")");
  return {Instant{}.plus(window.from), std::min(end, Instant{}.plus(window.to))};
}

ShownMotion shown_motion(const Options& options, const ChosenModel& chosen) {
  const RelativeMotion pair(chosen.model, shown_contact(chosen.model, options.stop.choice(chosen.model)));
  if (options.show.empty()) return shown_pair(pair, chosen);
  return shown_by_name(
      options.show, options.stop.names.empty() ? all_contacts(chosen.model) : contacts_of(pair, chosen.model), chosen);
}

int simulate(const Options& options, bool by_time, const Context& context) {
  const ChosenModel chosen = options.model.load();
  const State start = options.model.start(chosen);
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add("--events", options.events);
  roles.add("--trajectory", options.trajectory);
  roles.add("--certify", options.certify);
  roles.add_plot(options.plot);
  if (!options.climb.sweep.empty())
    return run_up(options.climb, {options.events, options.trajectory, options.out, options.samples, options.progress},
                  chosen, start, context);
  const Instant end = end_of(options, by_time, chosen.model);
  ShownMotion shown = shown_motion(options, chosen);
  const auto window = window_of(options, end);
  if (!options.certify.empty()) certify::demand_stated(chosen.model);
  const System system = affordable_system(chosen, {end.since({}), by_time ? "--time" : "--periods"});
  Run run(options, chosen, system, start, end, std::move(shown), window);
  const bool complete = run(context) && run.certify(start, context);
  return run.write(complete, chosen, start);
}

/// --plot and what belongs to it.
void declare_picture(Arguments& arguments, Options& options) {
  arguments.text("--plot", options.plot, "F.png",
                 "picture of the last 20 periods: .png, .pdf or .svg; its data and script lie beside it");
  declare_plot_size(arguments, options.plot_size);
  arguments.text("--window", options.window, "A:B", "the periods that the picture shows (the last 20)")
      .with({"--plot"});
  arguments
      .text(
          "--show", options.show, "Q,X:Y,..",
          "its panels: Q over time, Y over X, of `slapstick quantities` (velocity and displacement of the stop's pair)")
      .with({"--plot"});
  options.stop.declare(arguments, "the stop whose pair the picture shows (the first one)").with({"--plot"});
}

}  // namespace

Action add_simulate(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.count("--periods", options->periods, 0, most_periods, "length in forcing periods (100)");
  arguments.number("--time", options->time, "T", "length in the model's unit of time").without({"--periods"});
  options->climb.declare(arguments,
                         {"--periods", "--time", "--certify", "--plot", "--physical", "--columns", "--until"});
  arguments.text("--events", options->events, "F.csv",
                 "every event: time, kind, contact, w, and the state just before; .csv, .npz or .h5");
  arguments.text("--trajectory", options->trajectory, "F.csv",
                 "samples: time, state, mode, and the model's observables; .csv, .npz or .h5");
  arguments
      .text("--columns", options->columns, "Q,..",
            "quantities as further columns, in the model's numbers ('slapstick quantities MODEL' lists them)")
      .with({"--trajectory"})
      .without({"--physical"});
  arguments.text("--until", options->until, "EVENT[:K]",
                 "end at the K-th event of this kind (1), as stick or impact:wall; --periods or --time is the limit");
  arguments.text("--certify", options->certify, "F.txt",
                 "the run with its model, for slapstick-verify to prove (docs/reference/certificate.md)");
  arguments.count("--samples", options->samples, 1, 1'000'000, "samples of --trajectory per forcing period (100)");
  declare_picture(arguments, *options);
  arguments.text("--out", options->out, "F.json", "write the summary there instead of to standard output");
  arguments
      .flag("--physical", options->physical,
            "the tables in the physical units of the model's [scale]; all else stays in the model's numbers")
      .with({"--events", "--trajectory"});
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Example:\n  slapstick simulate vibro-impact --set omega=1.5 --state x1=-0.5,v1=0 --periods 50 --events "
      "events.csv --plot motion.png\n"
      "Events are impact, slip+, slip-, stick, release, graze and chatter (the limit of infinitely many impacts).\n"
      "Compliant stops have engage, disengage and separate; characteristics have corner.\n"
      "Friction contacts with a normal force have unload and load. w is the relative velocity just before.\n"
      "A model without forcing has a period of 1.");
  return [options, &arguments](const Context& context) {
    if (options->stop.names.size() > 1) throw InputError("--stop is given more than once: the picture shows one pair");
    return simulate(*options, arguments.given("--time"), context);
  };
}

}  // namespace slapstick::app
