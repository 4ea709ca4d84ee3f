/// basins: which attractor each start of a plane comes to.
#include <nanobind/nanobind.h>
#include <nanobind/stl/complex.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "map_wish.hpp"
#include "slapstick/chart/start_plane.hpp"
#include "watch.hpp"

using namespace nanobind::literals;

namespace slapstick::python {
namespace {

struct Basins {
  sweep::Basins found;
  sweep::BasinEntropy entropy;
  sweep::Uncertainty uncertainty;
  std::vector<std::tuple<int, std::string>> failures;  ///< pixel, reason
  bool complete = true;
};

/// The start, whose numbers along the axes are replaced: the model's own, with them, may be behind a stop.
State start_beside(const ModelDefinition& definition, const Overrides& fixed, const std::optional<Start>& start,
                   const Wish& wish) {
  const Overrides* named = start ? std::get_if<Overrides>(&*start) : nullptr;
  if (start && named == nullptr) return start_of(definition, fixed, start);
  for (const double x : {std::get<0>(wish.x), std::get<1>(wish.x)})
    for (const double y : {std::get<0>(wish.y), std::get<1>(wish.y)}) {
      Overrides there = named == nullptr ? Overrides{} : *named;
      there[wish.x_name] = x;
      there[wish.y_name] = y;
      try {
        return start_of(definition, fixed, Start(there));
      } catch (const InputError&) {
      }
    }
  return start_of(definition, fixed, start);  // says why
}

std::unique_ptr<Basins> basins(const ModelDefinition& definition, const Overrides& fixed,
                               const std::optional<Start>& start, const Wish& wish, int box, nb::object progress) {
  chart::StartPlane plane = chart::starts_over(definition, fixed, start_beside(definition, fixed, start, wish),
                                               wish.x_name, axis_of(wish.x), wish.y_name, axis_of(wish.y));
  analyse_as(wish, build(definition, fixed), plane.problem);
  plane.stops = wish.stops;
  Watch watch(std::move(progress));
  plane.problem.cancel = watch.cancel();
  plane.problem.progress = [&](long done, long) { watch.note(static_cast<double>(done)); };
  auto into = std::make_unique<Basins>();
  watch.run_aside([&] {
    into->found =
        wish.store.empty() ? sweep::run_basins(plane.problem) : chart::stored_basins(plane, wish.store, wish.resume);
    into->entropy = sweep::basin_entropy(into->found, box);
    into->uncertainty = sweep::uncertainty(into->found);
  });
  for (const auto& failure : into->found.failures) into->failures.emplace_back(failure.first, failure.second);
  into->complete = watch.finish(true);
  return into;
}

/// Infinite with complete chatter, NaN without a cycle.
double impacts(const Classification& found) {
  if (found.n == 0) return std::numeric_limits<double>::quiet_NaN();
  return found.chatter == Chatter::complete ? std::numeric_limits<double>::infinity() : static_cast<double>(found.p);
}

}  // namespace

void bind_basins(nb::module_& module) {
  nb::class_<sweep::Basin>(module, "Basin", "The starts that come to one attractor.")
      .def_prop_ro("label", [](const sweep::Basin& self) { return self.attractor.label; })
      .def_prop_ro("attractor", [](const sweep::Basin& self) { return std::string(name(self.attractor.attractor)); })
      .def_prop_ro("n", [](const sweep::Basin& self) { return self.attractor.n; })
      .def_prop_ro("p", [](const sweep::Basin& self) { return impacts(self.attractor); })
      .def_prop_ro("exponent", [](const sweep::Basin& self) { return self.attractor.exponent; })
      .def_prop_ro("multipliers", [](const sweep::Basin& self) { return self.attractor.multipliers; })
      .def_prop_ro("state", [](const sweep::Basin& self) { return self.attractor.state; })
      .def_ro("by_class", &sweep::Basin::by_class)
      .def_ro("starts", &sweep::Basin::starts)
      .def_ro("share", &sweep::Basin::share)
      .def_ro("share_from", &sweep::Basin::share_from)
      .def_ro("share_to", &sweep::Basin::share_to);
  nb::class_<Basins>(module, "Basins", "Which attractor each start of a plane comes to.")
      .def_prop_ro("basins", [](const Basins& self) { return self.found.basins; })
      .def_prop_ro("of", [](Basins& self) { return column(self.found.of); })
      .def_prop_ro("box", [](const Basins& self) { return self.entropy.box; })
      .def_prop_ro("boxes", [](const Basins& self) { return self.entropy.boxes; })
      .def_prop_ro("boxes_on_boundary", [](const Basins& self) { return self.entropy.on_boundary; })
      .def_prop_ro("entropy", [](const Basins& self) { return self.entropy.whole; })
      .def_prop_ro("boundary_entropy", [](const Basins& self) { return self.entropy.boundary; })
      .def_prop_ro("distances", [](const Basins& self) { return self.uncertainty.distances; })
      .def_prop_ro("uncertain", [](const Basins& self) { return self.uncertainty.shares; })
      .def_prop_ro("uncertainty_exponent", [](const Basins& self) { return self.uncertainty.exponent; })
      .def_prop_ro("uncertainty_error", [](const Basins& self) { return self.uncertainty.error; })
      .def_ro("failures", &Basins::failures)
      .def_ro("complete", &Basins::complete);
  module.def("basins", &basins, "definition"_a, "fixed"_a, "start"_a.none(), "wish"_a, "box"_a, "progress"_a.none());
}

}  // namespace slapstick::python
