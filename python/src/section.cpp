/// Points of a section of a motion: impacts, phases, events of one kind.
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "names.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/section/event_section.hpp"
#include "slapstick/section/impact_section.hpp"
#include "slapstick/section/stroboscopic_section.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

/// The columns of all three sections; those that a section does not have stay empty.
struct Section {
  std::vector<double> t, phase, w, flight, sliding, return_time, state;
  ModeWords mode;
  Words contact;
  double period = 0.0;
  std::size_t width = 0;
  std::vector<std::vector<double>> of;  ///< a column for each quantity that is asked for
  bool complete = true, whole = true;
  double periods = 0.0;  ///< run through after the transient

  void add(const std::vector<double>& quantities) {
    for (std::size_t k = 0; k < quantities.size(); ++k) of[k].push_back(quantities[k]);
  }
};

struct Wish {
  std::int64_t transient, points, most_periods, patience;
};

/// A section of a motion that takes what comes next, up to an instant.
template <class Next>
void collect(Section& into, const Wish& wish, const Motion& motion, Watch& watch, const Next& next) {
  const Instant last{wish.transient + wish.most_periods, 0.0};
  Instant now = motion.time();
  std::int64_t count = 0;
  while (count < wish.points) {
    const Instant end = std::min(last, Instant{now.period + wish.patience, now.fraction});
    Instant stage = motion.time();
    bool found = false;
    do {
      stage = next_stage(motion.system(), stage, end);
      found = next(stage);
      if (!watch.go_on_now(static_cast<double>(count))) return;
    } while (!found && stage < end);
    if (!found) break;
    now = motion.time();
    ++count;
  }
  into.whole = count == wish.points;
  into.periods = motion.time().since({wish.transient, 0.0});
}

void impacts(Section& into, const Wish& wish, Motion start, const StopChoice& stops, Reader& reader, Watch& watch) {
  ImpactSection section(std::move(start), stops);
  SectionPoint point;
  const auto leave_out = [&](Instant stage) {
    while (section.next(stage, point))
      if (!watch.go_on(0.0)) return;
  };
  Instant stage;
  for (const Instant end{wish.transient, 0.0}; stage < end;) {
    stage = next_stage(section.motion().system(), stage, end);
    leave_out(stage);
    if (!watch.go_on_now(0.0)) return;
  }
  const double period = section.motion().system().period();
  collect(into, wish, section.motion(), watch, [&](Instant end) {
    if (!section.next(end, point)) return false;
    into.t.push_back(point.time.seconds(period));
    into.phase.push_back(point.phase);
    into.w.push_back(point.w);
    into.flight.push_back(point.flight);
    into.sliding.push_back(point.sliding);
    into.add(reader.before(section.motion()));
    into.contact.codes.push_back(point.contact);
    into.state.insert(into.state.end(), point.state.begin(), point.state.end());
    return true;
  });
}

void strobe(Section& into, const Wish& wish, Motion start, double phase, Reader& reader, Watch& watch) {
  StroboscopicSection section(std::move(start), phase);
  StroboscopicPoint point;
  const System& system = section.motion().system();
  for (std::int64_t i = 0; i < wish.transient + wish.points; ++i) {
    if (!watch.go_on_now(static_cast<double>(std::max<std::int64_t>(0, i - wish.transient)))) return;
    if (!section.next(point, watch.cancel())) return;
    if (i < wish.transient) continue;
    into.t.push_back(point.time.seconds(system.period()));
    into.phase.push_back(point.time.fraction);
    into.add(reader.now(section.motion()));
    into.state.insert(into.state.end(), point.state.begin(), point.state.end());
    into.mode.add(system, point.mode);
  }
}

void events(Section& into, const Wish& wish, Motion motion, const EventChoice& choice, Reader& reader, Watch& watch) {
  const Instant begin{wish.transient, 0.0};
  for (Instant stage; stage < begin;) {
    stage = next_stage(motion.system(), stage, begin);
    while (motion.advance(stage) == Outcome::event)
      if (!watch.go_on(0.0)) return;
    if (!watch.go_on_now(0.0)) return;
  }
  EventSection section(std::move(motion), choice);
  EventPoint point;
  const double period = section.motion().system().period();
  collect(into, wish, section.motion(), watch, [&](Instant end) {
    if (!section.next(end, point, watch.cancel())) return false;
    into.t.push_back(point.time.seconds(period));
    into.return_time.push_back(point.return_time);
    into.add(reader.before(section.motion()));
    into.w.push_back(point.w);
    into.contact.codes.push_back(point.contact);
    into.state.insert(into.state.end(), point.state.begin(), point.state.end());
    return true;
  });
}

/// Loads, then runs one of the sections above.
template <class Take>
std::unique_ptr<Section> take(const ModelDefinition& definition, const Overrides& values,
                              const std::optional<Start>& start, const std::vector<Quantity>& of, nb::object progress,
                              const Take& take_points) {
  for (const Quantity& quantity : of)
    if (quantity.at_impacts())
      throw InputError("of: '" + quantity.name + "' is a quantity at impacts: no function of time");
  auto into = std::make_unique<Section>();
  into->of.resize(of.size());
  Watch watch(std::move(progress));
  watch.run([&] {
    const System system(build(definition, values));
    const State state = start_of(definition, values, start);
    into->period = system.period();
    into->width = state.size();
    into->contact.names = contact_names(system.model());
    Reader reader(system, of);
    take_points(*into, system, Motion(system, state), reader, watch);
  });
  into->complete = watch.finish(true);
  return into;
}

std::unique_ptr<Section> impact_section(const ModelDefinition& definition, const Overrides& values,
                                        const std::optional<Start>& start, std::int64_t transient, std::int64_t points,
                                        std::int64_t most_periods, std::int64_t patience,
                                        const std::vector<std::string>& stops, const std::vector<Quantity>& of,
                                        nb::object progress) {
  const Wish wish{transient, points, most_periods, patience};
  return take(definition, values, start, of, std::move(progress),
              [&](Section& into, const System& system, Motion motion, Reader& reader, Watch& watch) {
                if (stop_contacts(system.model()).empty())
                  throw InputError("model '" + system.model().name + "' has no stop");
                impacts(into, wish, std::move(motion), StopChoice(system.model(), stops), reader, watch);
              });
}

std::unique_ptr<Section> strobe_section(const ModelDefinition& definition, const Overrides& values,
                                        const std::optional<Start>& start, std::int64_t transient, std::int64_t points,
                                        double phase, const std::vector<Quantity>& of, nb::object progress) {
  const Wish wish{transient, points, 0, 0};
  return take(definition, values, start, of, std::move(progress),
              [&](Section& into, const System&, Motion motion, Reader& reader, Watch& watch) {
                strobe(into, wish, std::move(motion), phase, reader, watch);
              });
}

std::unique_ptr<Section> event_section(const ModelDefinition& definition, const Overrides& values,
                                       const std::optional<Start>& start, std::int64_t transient, std::int64_t points,
                                       std::int64_t most_periods, std::int64_t patience, const std::string& event,
                                       const std::vector<Quantity>& of, nb::object progress) {
  const Wish wish{transient, points, most_periods, patience};
  return take(definition, values, start, of, std::move(progress),
              [&](Section& into, const System& system, Motion motion, Reader& reader, Watch& watch) {
                events(into, wish, std::move(motion), parse_event_choice(event, system), reader, watch);
              });
}

}  // namespace

void bind_section(nb::module_& module) {
  nb::class_<Section>(module, "Section", "The points of a section.")
      .def_prop_ro("t", [](Section& self) { return column(self.t); })
      .def_prop_ro("phase", [](Section& self) { return column(self.phase); })
      .def_prop_ro("w", [](Section& self) { return column(self.w); })
      .def_prop_ro("flight", [](Section& self) { return column(self.flight); })
      .def_prop_ro("sliding", [](Section& self) { return column(self.sliding); })
      .def_prop_ro("return_time", [](Section& self) { return column(self.return_time); })
      .def_prop_ro("state", [](Section& self) { return transposed(self.state, self.width); })
      .def_prop_ro("mode_codes", [](Section& self) { return column(self.mode.words.codes); })
      .def_prop_ro("mode_names", [](const Section& self) { return self.mode.words.names; })
      .def_prop_ro("contact_codes", [](Section& self) { return column(self.contact.codes); })
      .def_prop_ro("contact_names", [](const Section& self) { return self.contact.names; })
      .def(
          "of", [](Section& self, std::size_t k) { return column(self.of.at(k)); }, "k"_a)
      .def_ro("period", &Section::period)
      .def_ro("complete", &Section::complete)
      .def_ro("whole", &Section::whole)
      .def_ro("periods", &Section::periods);
  module.def("impact_section", &impact_section, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "points"_a,
             "most_periods"_a, "patience"_a, "stops"_a, "of"_a, "progress"_a.none());
  module.def("strobe_section", &strobe_section, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "points"_a,
             "phase"_a, "of"_a, "progress"_a.none());
  module.def("event_section", &event_section, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "points"_a,
             "most_periods"_a, "patience"_a, "event"_a, "of"_a, "progress"_a.none());
}

}  // namespace slapstick::python
