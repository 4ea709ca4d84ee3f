/// Batches: many starts and parameter values at once, in the lanes of the library.
#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/batch.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

/// What is asked for, as the caller has it.
struct BatchWish {
  int transient = 0, periods = 1, points = 0;
  bool events = false, exponent = false;
  int lanes = 0, threads = 0;
};

/// The runs as columns: a number for each run; a state; for each event.
struct Runs {
  std::vector<double> speeds, exponent, end, points;
  std::vector<std::int64_t> impacts, lane_events, motion_events, point_impacts;
  std::vector<std::uint8_t> done, in_lanes;
  std::vector<std::int32_t> event_run, event_kind, event_contact;
  std::vector<double> event_t, event_w;
  std::vector<std::string> contacts, failure;
  std::string kernel;
  std::size_t numbers = 0, points_each = 0;  ///< of a state; of a run
  bool complete = true;
};

std::vector<std::string> kinds() {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < event_kinds; ++k) all.emplace_back(name(static_cast<EventKind>(k)));
  return all;
}

void fill(std::vector<double>& into, const std::vector<double>& numbers, std::size_t size) {
  into.insert(into.end(), numbers.begin(), numbers.end());
  into.insert(into.end(), size - numbers.size(), std::numeric_limits<double>::quiet_NaN());
}

/// @param period  of the run's model
void add(Runs& into, const BatchRun& run, bool exponent, double period) {
  const auto index = static_cast<std::int32_t>(into.done.size());
  into.done.push_back(run.done ? 1 : 0);
  into.in_lanes.push_back(run.in_lanes ? 1 : 0);
  into.failure.push_back(run.failure);
  into.impacts.push_back(run.impacts);
  into.speeds.push_back(run.speeds);
  into.exponent.push_back(run.done && exponent ? run.exponent : std::numeric_limits<double>::quiet_NaN());
  into.lane_events.push_back(run.lane_events);
  into.motion_events.push_back(run.motion_events);
  fill(into.end, run.done ? run.end : std::vector<double>(), into.numbers);
  fill(into.points, run.done ? run.points : std::vector<double>(), into.numbers * into.points_each);
  for (std::size_t k = 0; k < into.points_each; ++k) into.point_impacts.push_back(run.done ? run.point_impacts[k] : 0);
  for (const Event& event : run.events) {
    into.event_run.push_back(index);
    into.event_kind.push_back(static_cast<std::int32_t>(event.kind));
    into.event_contact.push_back(event.contact);
    into.event_t.push_back(event.time.seconds(period));
    into.event_w.push_back(event.w);
  }
}

/// What is wrong with every run is an error before the work; what is wrong with some is their failure.
void demand_a_start(std::size_t count, const std::function<State(std::size_t)>& start_at) {
  std::optional<InputError> first;
  for (std::size_t i = 0; i < count; ++i) {
    try {
      static_cast<void>(start_at(i));
      return;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  if (first) throw InputError(*first);
}

std::unique_ptr<Runs> batch(const ModelDefinition& definition, const std::vector<Overrides>& values,
                            const std::vector<std::optional<Start>>& starts, const BatchWish& wish,
                            nb::object progress) {
  const auto start_at = [&](std::size_t i) {
    return start_of(definition, values[i], starts[starts.size() == 1 ? 0 : i]);
  };
  demand_a_start(values.size(), start_at);
  sweep::BatchProblem problem;
  problem.count = values.size();
  problem.model_at = [&](std::size_t i) { return build(definition, values[i]); };
  problem.start_at = start_at;
  problem.plan = {wish.transient, wish.periods, wish.points, wish.events, wish.exponent};
  problem.lanes = wish.lanes;
  problem.threads = wish.threads;
  Watch watch(std::move(progress));
  problem.cancel = watch.cancel();
  std::vector<BatchRun> all(values.size());
  std::atomic<int> ended{0};
  problem.take = [&](std::size_t i, BatchRun&& run) {
    all[i] = std::move(run);
    watch.note(++ended);
  };
  auto runs = std::make_unique<Runs>();
  const Model first = build(definition, values[0]);
  runs->contacts = contact_names(first);
  runs->numbers = 2 * static_cast<std::size_t>(first.size());
  runs->points_each = static_cast<std::size_t>(wish.points);
  watch.run_aside([&] {
    runs->kernel = sweep::run_batch(problem).kernel;
    for (std::size_t i = 0; i < all.size(); ++i)
      add(*runs, all[i], wish.exponent, all[i].events.empty() ? 1.0 : build(definition, values[i]).forcing_period());
  });
  runs->complete = watch.finish(true);
  return runs;
}

}  // namespace

void bind_batch(nb::module_& module) {
  nb::class_<Runs>(module, "Runs", "What the runs of a batch have recorded.")
      .def_prop_ro("impacts", [](Runs& self) { return column(self.impacts); })
      .def_prop_ro("speeds", [](Runs& self) { return column(self.speeds); })
      .def_prop_ro("exponent", [](Runs& self) { return column(self.exponent); })
      .def_prop_ro("end", [](Runs& self) { return transposed(self.end, self.numbers); })
      .def_prop_ro("points", [](Runs& self) { return transposed(self.points, self.numbers * self.points_each); })
      .def_prop_ro("point_impacts", [](Runs& self) { return transposed(self.point_impacts, self.points_each); })
      .def_prop_ro("lane_events", [](Runs& self) { return column(self.lane_events); })
      .def_prop_ro("motion_events", [](Runs& self) { return column(self.motion_events); })
      .def_prop_ro("done", [](Runs& self) { return column(self.done); })
      .def_prop_ro("in_lanes", [](Runs& self) { return column(self.in_lanes); })
      .def_prop_ro("event_run", [](Runs& self) { return column(self.event_run); })
      .def_prop_ro("event_t", [](Runs& self) { return column(self.event_t); })
      .def_prop_ro("event_w", [](Runs& self) { return column(self.event_w); })
      .def_prop_ro("event_kind_codes", [](Runs& self) { return column(self.event_kind); })
      .def_prop_ro("event_kind_names", [](const Runs&) { return kinds(); })
      .def_prop_ro("event_contact_codes", [](Runs& self) { return column(self.event_contact); })
      .def_prop_ro("event_contact_names", [](const Runs& self) { return self.contacts; })
      .def_ro("failures", &Runs::failure)
      .def_ro("kernel", &Runs::kernel)
      .def_ro("complete", &Runs::complete);
  nb::class_<BatchWish>(module, "BatchWish", "What a batch is asked for.")
      .def(nb::init<>())
      .def_rw("transient", &BatchWish::transient)
      .def_rw("periods", &BatchWish::periods)
      .def_rw("points", &BatchWish::points)
      .def_rw("events", &BatchWish::events)
      .def_rw("exponent", &BatchWish::exponent)
      .def_rw("lanes", &BatchWish::lanes)
      .def_rw("threads", &BatchWish::threads);
  module.def("batch", &batch, "definition"_a, "values"_a, "starts"_a, "wish"_a, "progress"_a.none());
}

}  // namespace slapstick::python
