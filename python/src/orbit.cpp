/// Periodic orbits: the one that is meant, all that a search finds, and what an orbit is.
#include <nanobind/stl/complex.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "names.hpp"
#include "orbits.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::python {

SharedSetting setting(const ModelDefinition& definition, const Overrides& values, const std::vector<std::string>& names,
                      const std::vector<double>& at) {
  Overrides here = values;
  for (std::size_t i = 0; i < names.size(); ++i) here[names[i]] = at[i];
  return std::make_shared<const Setting>(Setting{definition, here, names, System(build(definition, here)),
                                                 orbit::pose(definition.family(names, here), at)});
}

Overrides FoundOrbit::values() const {
  Overrides all = setting->values;
  for (std::size_t i = 0; i < setting->names.size(); ++i) all[setting->names[i]] = solution.orbit.values[i];
  return all;
}

namespace {

/// Options as Python's users write them.
std::string spelled(std::string_view option) { return option == "unstable" ? "stable=False" : std::string(option); }

}  // namespace

FoundOrbit find_orbit(SharedSetting of, const State& start, const orbit::OrbitWish& wish,
                      const std::atomic<bool>* stop) {
  orbit::Chosen chosen = orbit::find_orbit(*of->problem, of->system, start, wish, stop, spelled);
  return {std::move(of), std::move(*chosen.orbit), chosen.settles};
}

namespace {

/// The events of a cycle as columns.
struct OrbitEvents {
  std::vector<double> t, w, before;
  Words kind, contact, mode;
  std::size_t width = 0;
};

std::unique_ptr<OrbitEvents> events_of(const FoundOrbit& self) {
  auto columns = std::make_unique<OrbitEvents>();
  const System& system = self.setting->system;
  ModeWords modes;
  for (std::size_t k = 0; k < event_kinds; ++k) columns->kind.names.emplace_back(name(static_cast<EventKind>(k)));
  columns->contact.names = contact_names(system.model());
  columns->width = 2 * static_cast<std::size_t>(system.model().size());
  const double period = build(self.setting->definition, self.values()).forcing_period();
  for (const orbit::EventOfOrbit& event : orbit::events(*self.setting->problem, self.solution.orbit)) {
    columns->t.push_back(event.t * period);
    columns->w.push_back(event.w);
    columns->kind.codes.push_back(static_cast<std::int32_t>(event.kind));
    columns->contact.codes.push_back(event.contact);
    columns->before.insert(columns->before.end(), event.before.begin(), event.before.end());
    modes.add(system, system.mode_id(event.after));
  }
  columns->mode = std::move(modes.words);
  return columns;
}

std::map<std::string, std::pair<double, double>> extremes(const FoundOrbit& self) {
  const std::vector<orbit::Range> ranges = orbit::ranges(*self.setting->problem, self.solution.orbit);
  const std::vector<std::string> names = state_names(self.setting->system.model());
  const std::size_t n = names.size() / 2;
  std::map<std::string, std::pair<double, double>> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const orbit::Range& range = ranges[i / 2 + (i % 2 == 0 ? 0 : n)];
    all[names[i]] = {range.least, range.most};
  }
  return all;
}

std::map<std::string, std::variant<double, std::map<std::string, double>>> energy(const FoundOrbit& self) {
  const CycleEnergy energy = cycle_energy(*self.setting->problem, self.solution.orbit);
  const Model& model = self.setting->system.model();
  std::map<std::string, double> friction, impacts;
  const std::vector<std::string> names = friction_names(model);
  for (std::size_t i = 0; i < names.size(); ++i) friction[names[i]] = energy.friction[i];
  for (std::size_t i = 0; i < energy.impacts.size(); ++i) impacts[model.stops[i].name] = energy.impacts[i];
  return {{"input", energy.input},
          {"damping", energy.damping},
          {"friction", friction},
          {"impacts", impacts},
          {"balance", energy.balance()}};
}

/// What is measured, of which contact, its least value.
std::vector<std::tuple<std::string, std::string, double>> margins(const FoundOrbit& self) {
  std::vector<std::tuple<std::string, std::string, double>> all;
  const System& system = self.setting->system;
  for (const orbit::Margin& margin : orbit::margins(*self.setting->problem, self.solution.orbit))
    all.emplace_back(margin.reversal ? "reversal" : std::string(mode::name(margin.kind)),
                     system.contact_name(mode::contact_index(margin.kind, margin.contact, system.model())),
                     margin.value);
  return all;
}

std::unique_ptr<FoundOrbit> find(const ModelDefinition& definition, const Overrides& values,
                                 const std::optional<Start>& start, const orbit::OrbitWish& wish, nb::object progress) {
  std::optional<FoundOrbit> found;
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    const State state = start_of(definition, values, start);
    found = find_orbit(setting(definition, values, {}, {}), state, wish, watch.cancel());
  });
  watch.finish(false);
  return std::make_unique<FoundOrbit>(std::move(*found));
}

/// Every orbit that a search finds, as far as the wish admits it. Of a search that was stopped: those so far.
std::tuple<std::vector<FoundOrbit>, bool> find_all(const ModelDefinition& definition, const Overrides& values,
                                                   const std::optional<Start>& start, const orbit::OrbitWish& wish,
                                                   int most_n, nb::object progress) {
  std::vector<FoundOrbit> found;
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    const SharedSetting of = setting(definition, values, {}, {});
    orbit::SearchOptions search = orbit::search_options(wish, watch.cancel());
    search.most_n = most_n;
    search.progress = [&](int motions) { watch.note(motions); };
    const State state = start_of(definition, values, start);
    const orbit::OrbitChoice choice = orbit::choice_of(wish, state, spelled);
    for (orbit::Solution& one : orbit::search(*of->problem, of->system, state, search).orbits)
      if (choice.admits(*of->problem, one)) found.push_back({of, std::move(one)});
  });
  const bool complete = watch.finish(true);
  return {std::move(found), complete};
}

void bind_events(nb::module_& module) {
  nb::class_<OrbitEvents>(module, "OrbitEvents", "The events of a cycle.")
      .def_prop_ro("t", [](OrbitEvents& self) { return column(self.t); })
      .def_prop_ro("w", [](OrbitEvents& self) { return column(self.w); })
      .def_prop_ro("before", [](OrbitEvents& self) { return transposed(self.before, self.width); })
      .def_prop_ro("kind_codes", [](OrbitEvents& self) { return column(self.kind.codes); })
      .def_prop_ro("kind_names", [](const OrbitEvents& self) { return self.kind.names; })
      .def_prop_ro("contact_codes", [](OrbitEvents& self) { return column(self.contact.codes); })
      .def_prop_ro("contact_names", [](const OrbitEvents& self) { return self.contact.names; })
      .def_prop_ro("mode_codes", [](OrbitEvents& self) { return column(self.mode.codes); })
      .def_prop_ro("mode_names", [](const OrbitEvents& self) { return self.mode.names; });
}

void bind_wish(nb::module_& module) {
  nb::class_<orbit::OrbitWish>(module, "OrbitWish", "Which orbit is meant, and how long it is sought.")
      .def(nb::init<std::string, std::optional<bool>, std::optional<bool>, bool, long, int, double, std::uint32_t>(),
           "orbit"_a, "stable"_a.none(), "symmetric"_a.none(), "nearest"_a, "transient"_a, "starts"_a, "seconds"_a,
           "seed"_a);
}

}  // namespace

void bind_orbit(nb::module_& module) {
  bind_events(module);
  bind_wish(module);
  using O = FoundOrbit;
  nb::class_<O>(module, "Orbit", "A periodic orbit.")
      .def_prop_ro("values", &O::values)
      .def_prop_ro("label", [](const O& self) { return self.solution.label; })
      .def_prop_ro("n",
                   [](const O& self) {
                     const orbit::Itinerary& shape = self.solution.orbit.shape;
                     return shape.n > 0 ? shape.n : orbit::returns(shape);
                   })
      .def_prop_ro("impacts", [](const O& self) { return self.solution.impacts; })
      .def_prop_ro("chatter", [](const O& self) { return self.solution.chatter; })
      .def_prop_ro("sticking", [](const O& self) { return self.solution.sticking; })
      .def_prop_ro("sticks", [](const O& self) { return self.solution.sticks; })
      .def_prop_ro("reversals", [](const O& self) { return self.solution.reversals; })
      .def_prop_ro("chatters", [](const O& self) { return self.solution.chatters; })
      .def_prop_ro("stable",
                   [](const O& self) -> std::optional<bool> {
                     if (!orbit::differentiable(self.solution.orbit.shape)) return std::nullopt;
                     return self.solution.stable();
                   })
      .def_prop_ro("family", [](const O& self) { return self.solution.family; })
      .def_prop_ro("multipliers", [](O& self) { return column(self.solution.multipliers); })
      .def_prop_ro("cycle", [](const O& self) { return self.solution.cycle; })
      .def_prop_ro("is_motion", [](const O& self) { return self.solution.is_motion; })
      .def_prop_ro("why", [](const O& self) { return self.solution.why; })
      .def_prop_ro("drift", [](O& self) { return column(self.solution.drift); })
      .def_prop_ro("settles", [](const O& self) { return self.settles; })
      .def_prop_ro("symmetric",
                   [](const O& self) { return orbit::symmetric(*self.setting->problem, self.solution.orbit); })
      .def_prop_ro("state",
                   [](const O& self) { return orbit::at_phase_zero(*self.setting->problem, self.solution.orbit); })
      .def_prop_ro("events", &events_of)
      .def_prop_ro("extremes", &extremes)
      .def_prop_ro("energy", &energy)
      .def_prop_ro("margins", &margins);
  module.def("find_orbit", &find, "definition"_a, "values"_a, "start"_a.none(), "wish"_a, "progress"_a.none());
  module.def("find_orbits", &find_all, "definition"_a, "values"_a, "start"_a.none(), "wish"_a, "most_n"_a,
             "progress"_a.none());
}

}  // namespace slapstick::python
