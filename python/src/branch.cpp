/// Branches of orbits, and the special points on them.
#include "branches.hpp"

#include <nanobind/stl/complex.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"

namespace slapstick::python {
namespace {

struct Steps {
  double longest;
  int points;
  bool same_events;
};

/// Follows the branch through an orbit, both ways. Works aside.
std::shared_ptr<FollowedBranch> follow(const SharedSetting& of, const orbit::Orbit& first, double from, double to,
                                       const Steps& steps, Watch& watch) {
  if (!(steps.longest > 0.0 && steps.longest <= 0.2))
    throw InputError("step: " + std::to_string(steps.longest) + " is outside (0, 0.2]");
  orbit::ContinuationOptions how;
  how.from = from;
  how.to = to;
  how.most_points = steps.points;
  how.step = 0.5 * steps.longest;
  how.longest_step = steps.longest;
  how.through_changes = !steps.same_events;
  how.stop = watch.cancel();
  how.progress = [&](double, long points) { watch.note(static_cast<double>(points)); };
  return std::make_shared<FollowedBranch>(FollowedBranch{of, orbit::follow(*of->problem, first, how), from, to});
}

std::shared_ptr<FollowedBranch> continuation(const ModelDefinition& definition, const Overrides& values,
                                             const std::string& name, double from, double to,
                                             const std::optional<Start>& start, const orbit::OrbitWish& wish,
                                             double step, int points, bool same_events, nb::object progress) {
  std::shared_ptr<FollowedBranch> found;
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    definition.check_range(name, values, from, to);
    const State state = start_of(definition, values, start);
    const SharedSetting of = setting(definition, values, {name}, {definition.present_value(name, values)});
    const FoundOrbit first = find_orbit(of, state, wish, watch.cancel());
    found = follow(of, first.solution.orbit, from, to, {step, points, same_events}, watch);
  });
  const bool complete = watch.finish(found != nullptr);
  found->complete = complete;
  return found;
}

/// The branch through an orbit that is known.
std::shared_ptr<FollowedBranch> continue_orbit(const FoundOrbit& first, const std::string& name, double from, double to,
                                               double step, int points, bool same_events, nb::object progress) {
  std::shared_ptr<FollowedBranch> found;
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    const ModelDefinition& definition = first.setting->definition;
    definition.check_range(name, first.values(), from, to);
    const double value = definition.present_value(name, first.values());
    const SharedSetting of = setting(definition, first.values(), {name}, {value});
    orbit::Orbit orbit = first.solution.orbit;
    orbit.values = {value};
    found = follow(of, orbit, from, to, {step, points, same_events}, watch);
  });
  const bool complete = watch.finish(found != nullptr);
  found->complete = complete;
  return found;
}

using B = FollowedBranch;

/// One number of every point; truths as 0 and 1.
template <class T, class Read>
Column<T> gathered(const B& self, const Read& read) {
  auto values = std::make_unique<std::vector<T>>();
  for (const orbit::Solution& point : self.branch.points) values->push_back(static_cast<T>(read(point)));
  return owned(std::move(values));
}

/// The states at phase 0, point by point.
Table<double> states(const B& self) {
  auto rows = std::make_unique<std::vector<double>>();
  for (const orbit::Solution& point : self.branch.points) {
    const State state = orbit::at_phase_zero(*self.setting->problem, point.orbit);
    rows->insert(rows->end(), state.begin(), state.end());
  }
  return owned_transposed(std::move(rows), 2 * static_cast<std::size_t>(self.setting->system.model().size()));
}

/// Impacts and engagements of all points: which point, speed, contact.
std::tuple<Column<std::int64_t>, Column<double>, Column<std::int32_t>> speeds(const B& self) {
  auto point = std::make_unique<std::vector<std::int64_t>>();
  auto w = std::make_unique<std::vector<double>>();
  auto contact = std::make_unique<std::vector<std::int32_t>>();
  for (std::size_t i = 0; i < self.branch.points.size(); ++i) {
    for (const orbit::EventOfOrbit& event : orbit::events(*self.setting->problem, self.branch.points[i].orbit)) {
      if (event.kind != EventKind::impact && event.kind != EventKind::engage) continue;
      point->push_back(static_cast<std::int64_t>(i));
      w->push_back(event.w);
      contact->push_back(event.contact);
    }
  }
  return {owned(std::move(point)), owned(std::move(w)), owned(std::move(contact))};
}

FoundOrbit orbit_at(const B& self, std::size_t index) {
  if (index >= self.branch.points.size()) throw nb::index_error();
  return {self.setting, self.branch.points[index]};
}

/// Of one way: kind, whether it failed, the sentence.
std::tuple<std::string, bool, std::string> end_of(const B& self, const orbit::BranchEnd& end) {
  return {std::string(name(end.kind)), end.failed, orbit::sentence(self.branch, end)};
}

void bind_points(nb::class_<B>& branch) {
  branch.def("__len__", [](const B& self) { return self.branch.points.size(); })
      .def("orbit", &orbit_at, "index"_a)
      .def_prop_ro("parameter", [](const B& self) { return self.branch.parameter; })
      .def_prop_ro(
          "value",
          [](const B& self) {
            return gathered<double>(self, [](const orbit::Solution& point) { return point.orbit.parameter(); });
          },
          nb::rv_policy::reference)
      .def_prop_ro(
          "cycle",
          [](const B& self) {
            return gathered<double>(self, [](const orbit::Solution& point) { return point.cycle; });
          },
          nb::rv_policy::reference)
      .def_prop_ro(
          "stable",
          [](const B& self) {
            return gathered<std::uint8_t>(self, [](const orbit::Solution& point) { return point.stable(); });
          },
          nb::rv_policy::reference)
      .def_prop_ro(
          "is_motion",
          [](const B& self) {
            return gathered<std::uint8_t>(self, [](const orbit::Solution& point) { return point.is_motion; });
          },
          nb::rv_policy::reference)
      .def_prop_ro("labels",
                   [](const B& self) {
                     std::vector<std::string> labels;
                     for (const orbit::Solution& point : self.branch.points) labels.push_back(point.label);
                     return labels;
                   })
      .def_prop_ro("multipliers",
                   [](const B& self) {
                     std::vector<std::vector<std::complex<double>>> all;
                     for (const orbit::Solution& point : self.branch.points) all.push_back(point.multipliers);
                     return all;
                   })
      .def_prop_ro("state", &states, nb::rv_policy::reference)
      .def_prop_ro("impacts", &speeds, nb::rv_policy::reference);
}

void bind_ways(nb::class_<B>& branch) {
  branch.def_prop_ro("special_count", [](const B& self) { return self.branch.special.size(); })
      .def(
          "special",
          [](const std::shared_ptr<B>& self, std::size_t index) {
            if (index >= self->branch.special.size()) throw nb::index_error();
            return Special{self, index};
          },
          "index"_a)
      .def_ro("begin", &B::from)
      .def_ro("end", &B::to)
      .def_ro("complete", &B::complete)
      .def_prop_ro("failed", [](const B& self) { return self.branch.failed(); })
      .def_prop_ro("ended", [](const B& self) { return orbit::sentence(self.branch); })
      .def_prop_ro("down", [](const B& self) { return end_of(self, self.branch.down); })
      .def_prop_ro("up", [](const B& self) { return end_of(self, self.branch.up); });
}

using S = Special;

/// The classes before and behind a change of events; empty words where there are none.
std::pair<std::string, std::string> classes(const S& self) {
  return orbit::classes_around(self.of->branch, self.point()).value_or(std::pair<std::string, std::string>());
}

/// d value / d other, and how it is known.
std::pair<double, std::string> sensitivity(const S& self, const std::string& other) {
  const Setting& of = *self.of->setting;
  const std::vector<double> values = {self.point().value, of.definition.present_value(other, of.values)};
  const Family family = of.definition.family({of.names.front(), other}, of.values);
  const nb::gil_scoped_release release;
  const auto rate = orbit::sensitivities(family, values, self.point(), self.of->to - self.of->from).front();
  return {rate.value, std::string(name(rate.known))};
}

std::vector<FoundOrbit> born(const S& self) {
  std::vector<FoundOrbit> orbits;
  const SharedSetting& of = self.of->setting;
  for (const orbit::Orbit& orbit : self.point().born)
    orbits.push_back({of, orbit::describe(*of->problem, orbit, nullptr)});
  return orbits;
}

std::optional<std::string> jump(const S& self) {
  const auto& jump = self.point().jump;
  if (!jump) return std::nullopt;
  return jump->kind == orbit::Jump::Kind::settles ? jump->label : std::string(name(jump->kind));
}

void bind_special(nb::module_& module) {
  nb::class_<S>(module, "Special", "A point of a branch at which something changes.")
      .def_prop_ro("type", [](const S& self) { return std::string(name(self.point().type)); })
      .def_prop_ro("value", [](const S& self) { return self.point().value; })
      .def_prop_ro("error", [](const S& self) { return self.point().error; })
      .def_prop_ro("orbit",
                   [](const S& self) {
                     return FoundOrbit{self.of->setting, self.point().solution};
                   })
      .def_prop_ro("occurrence", [](const S& self) { return std::string(name(self.point().occurrence)); })
      .def_prop_ro("passage", [](const S& self) { return std::string(name(self.point().passage)); })
      .def_prop_ro("sliding", [](const S& self) { return std::string(name(self.point().sliding)); })
      .def_prop_ro("jump", &jump)
      .def_prop_ro("what", [](const S& self) { return orbit::what_happens(self.point(), self.of->setting->system); })
      .def_prop_ro("outcome", [](const S& self) { return orbit::what_becomes(self.point()); })
      .def_prop_ro("classes", &classes)
      .def_prop_ro("rotation", [](const S& self) { return self.point().rotation; })
      .def_prop_ro("coefficient", [](const S& self) { return self.point().normal_form.coefficient; })
      .def_prop_ro("coefficient_error", [](const S& self) { return self.point().normal_form.error; })
      .def_prop_ro("verdict", [](const S& self) { return std::string(name(self.point().normal_form.verdict)); })
      .def_prop_ro("normal_form", [](const S& self) { return orbit::sentence(self.point().normal_form); })
      .def_prop_ro("after", [](const S& self) { return self.point().after; })
      .def_prop_ro("born", &born)
      .def("sensitivity", &sensitivity, "other"_a);
}

}  // namespace

void bind_branch(nb::module_& module) {
  nb::class_<B> branch(module, "Branch", "Orbits followed in a parameter.");
  bind_points(branch);
  bind_ways(branch);
  bind_special(module);
  module.def("continuation", &continuation, "definition"_a, "values"_a, "name"_a, "begin"_a, "end"_a, "start"_a.none(),
             "wish"_a, "step"_a, "points"_a, "same_events"_a, "progress"_a.none());
  module.def("continue_orbit", &continue_orbit, "orbit"_a, "name"_a, "begin"_a, "end"_a, "step"_a, "points"_a,
             "same_events"_a, "progress"_a.none());
}

}  // namespace slapstick::python
