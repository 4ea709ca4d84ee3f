/// Motions: samples and events of one run, as columns.
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "names.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/quantity/observables.hpp"
#include "slapstick/section/sampled_motion.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

struct Events {
  std::vector<double> t, phase, w, before;
  std::vector<std::int64_t> period;
  Words kind, contact;
};

/// A run: what was asked for of it, column by column.
struct Run {
  std::vector<double> t, y, observables;
  ModeWords mode;
  Events events;
  State start, end;
  std::string end_mode;
  double period = 0.0, duration = 0.0;
  std::size_t width = 0, observed = 0;
  Counters work;
  bool complete = true;
  double seconds = 0.0;  ///< that the library took
};

/// Writes down how long it lived.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// The loop of a run.
class Recorder {
 public:
  Recorder(Run& run, const System& system, Observer observer)
      : run_(run), system_(system), observables_(system, std::move(observer)) {}

  void run(SampledMotion& motion, Instant end, Watch& watch) {
    Instant stage;
    do {
      stage = next_stage(system_, stage, end);
      for (auto item = motion.next(stage); item != SampledMotion::Item::end; item = motion.next(stage)) {
        if (item == SampledMotion::Item::event) note(motion.motion());
        if (item == SampledMotion::Item::sample) note(motion.motion(), motion.sample());
        if (!watch.go_on(motion.motion().time().since({}))) return;
      }
      if (!watch.go_on_now(stage.since({}))) return;
    } while (stage < end);
  }

 private:
  void note(const Motion& motion) {
    const Event& event = motion.event();
    if (event.kind == EventKind::knot) return;  // the signal says where they are
    Events& events = run_.events;
    events.t.push_back(event.time.seconds(system_.period()));
    events.period.push_back(event.time.period);
    events.phase.push_back(event.time.fraction);
    events.w.push_back(event.w);
    events.kind.codes.push_back(static_cast<std::int32_t>(event.kind));
    events.contact.codes.push_back(event.contact);
    const auto before = motion.before();
    events.before.insert(events.before.end(), before.begin(), before.end());
  }

  void note(const Motion& motion, const SampledMotion::Sample& sample) {
    const double time = sample.time.seconds(system_.period());
    run_.t.push_back(time);
    run_.y.insert(run_.y.end(), sample.state.begin(), sample.state.end());
    run_.mode.add(system_, sample.mode);
    if (run_.observed == 0) return;
    const std::vector<double>& seen = observables_.within(motion, sample);
    run_.observables.insert(run_.observables.end(), seen.begin(), seen.end());
  }

  Run& run_;
  const System& system_;
  Observables observables_;
};

/// The end of a run of this many periods, or of this much time. @throws InputError
Instant end_of(double periods, std::optional<double> time, const System& system) {
  constexpr double most_periods = 1e12;
  const double length = time ? *time / system.period() : periods;
  if (length >= 0.0 && length <= most_periods) return Instant{}.plus(length);
  throw InputError(std::string(time ? "time" : "periods") + " is outside [0, 1e12 forcing periods]");
}

std::unique_ptr<Run> simulate(const ModelDefinition& definition, const Overrides& values,
                              const std::optional<Start>& start, double periods, std::optional<double> time,
                              int samples, nb::object progress) {
  auto run = std::make_unique<Run>();
  Watch watch(std::move(progress));
  watch.run([&] {
    const Stopwatch stopwatch(run->seconds);
    const System system(build(definition, values));
    run->start = start_of(definition, values, start);
    run->period = system.period();
    run->width = run->start.size();
    run->observed = definition.observables().size();
    for (std::size_t k = 0; k < event_kinds; ++k) run->events.kind.names.emplace_back(name(static_cast<EventKind>(k)));
    run->events.contact.names = contact_names(system.model());
    SampledMotion motion(Motion(system, run->start), samples);
    Recorder(*run, system, definition.observer(values)).run(motion, end_of(periods, time, system), watch);
    const Motion& reached = motion.motion();
    run->end = reached.state();
    run->end_mode = system.mode_name(reached.mode_id());
    run->duration = reached.time().seconds(system.period());
    run->work = reached.counters();
  });
  run->complete = watch.finish(true);
  return run;
}

void bind_columns(nb::class_<Run>& run) {
  run.def_prop_ro("t", [](Run& self) { return column(self.t); })
      .def_prop_ro("y", [](Run& self) { return transposed(self.y, self.width); })
      .def_prop_ro("observables", [](Run& self) { return transposed(self.observables, self.observed); })
      .def_prop_ro("mode_codes", [](Run& self) { return column(self.mode.words.codes); })
      .def_prop_ro("mode_names", [](const Run& self) { return self.mode.words.names; })
      .def_prop_ro("event_t", [](Run& self) { return column(self.events.t); })
      .def_prop_ro("event_period", [](Run& self) { return column(self.events.period); })
      .def_prop_ro("event_phase", [](Run& self) { return column(self.events.phase); })
      .def_prop_ro("event_w", [](Run& self) { return column(self.events.w); })
      .def_prop_ro("event_before", [](Run& self) { return transposed(self.events.before, self.width); })
      .def_prop_ro("event_kind_codes", [](Run& self) { return column(self.events.kind.codes); })
      .def_prop_ro("event_kind_names", [](const Run& self) { return self.events.kind.names; })
      .def_prop_ro("event_contact_codes", [](Run& self) { return column(self.events.contact.codes); })
      .def_prop_ro("event_contact_names", [](const Run& self) { return self.events.contact.names; });
}

}  // namespace

void bind_motion(nb::module_& module) {
  nb::class_<Run> run(module, "Run", "A motion, sample by sample and event by event.");
  bind_columns(run);
  run.def_prop_ro("start", [](Run& self) { return column(self.start); })
      .def_prop_ro("end", [](Run& self) { return column(self.end); })
      .def_ro("end_mode", &Run::end_mode)
      .def_ro("period", &Run::period)
      .def_ro("duration", &Run::duration)
      .def_ro("complete", &Run::complete)
      .def_ro("seconds", &Run::seconds)
      .def_prop_ro("work", [](const Run& self) {
        return std::map<std::string, long>{
            {"segments", self.work.segments}, {"windows", self.work.windows}, {"evaluations", self.work.evaluations}};
      });
  module.def("simulate", &simulate, "definition"_a, "values"_a, "start"_a.none(), "periods"_a, "time"_a.none(),
             "samples"_a, "progress"_a.none());
}

}  // namespace slapstick::python
