/// Loci of special points in two parameters.
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "branches.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"

namespace slapstick::python {
namespace {

struct Locus {
  SharedSetting setting;
  orbit::Curve curve;
  bool complete = true;
};
using L = Locus;

std::unique_ptr<L> locus(const Special& special, const std::string& second, double from, double to, double second_from,
                         double second_to, double step, int points, nb::object progress) {
  auto found = std::make_unique<L>();
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    const Setting& of = *special.of->setting;
    if (!(step > 0.0 && step <= 0.2)) throw InputError("step: " + std::to_string(step) + " is outside (0, 0.2]");
    if (second == of.names.front())
      throw InputError("locus: two different parameters are wanted, not " + second + " twice");
    orbit::SpecialPoint point = special.point();
    of.definition.check_range(second, of.values, second_from, second_to);
    const double value = of.definition.present_value(second, of.values);
    point.solution.orbit.values = {point.value, value};
    found->setting = setting(of.definition, of.values, {of.names.front(), second}, point.solution.orbit.values);
    orbit::CurveOptions how{.from = from, .to = to, .second_from = second_from, .second_to = second_to};
    how.longest_step = step;
    how.most_points = points;
    how.stop = watch.cancel();
    how.progress = [&](long count) { watch.note(static_cast<double>(count)); };
    found->curve = orbit::locus(*found->setting->problem, point, how);
  });
  found->complete = watch.finish(true);
  return found;
}

/// One of both parameters at every point.
auto values(const L& self, std::size_t which) {
  auto all = std::make_unique<std::vector<double>>();
  for (const orbit::CurvePoint& point : self.curve.points) all->push_back(point.values[which]);
  return owned(std::move(all));
}

/// What is met on the way: type, both values, the sentence, the point before.
std::vector<std::tuple<std::string, double, double, std::string, std::size_t>> met(const L& self) {
  std::vector<std::tuple<std::string, double, double, std::string, std::size_t>> all;
  for (const orbit::CurveEvent& event : self.curve.met)
    all.emplace_back(name(event.met.front()), event.values[0], event.values[1],
                     orbit::sentence(self.curve, event, self.setting->system), event.after);
  return all;
}

FoundOrbit orbit_at(const L& self, std::size_t index) {
  if (index >= self.curve.points.size()) throw nb::index_error();
  return {self.setting, self.curve.points[index].solution};
}

}  // namespace

void bind_locus(nb::module_& module) {
  nb::class_<L>(module, "Locus", "A special point followed in two parameters.")
      .def("__len__", [](const L& self) { return self.curve.points.size(); })
      .def_prop_ro("parameters", [](const L& self) { return self.curve.parameters; })
      .def("values", &values, "which"_a, nb::rv_policy::reference)
      .def_prop_ro(
          "is_motion",
          [](const L& self) {
            auto motions = std::make_unique<std::vector<std::uint8_t>>();
            for (const orbit::CurvePoint& point : self.curve.points)
              motions->push_back(point.solution.is_motion ? 1 : 0);
            return owned(std::move(motions));
          },
          nb::rv_policy::reference)
      .def_prop_ro("met", &met)
      .def("orbit", &orbit_at, "index"_a)
      .def_ro("complete", &L::complete)
      .def_prop_ro("failed", [](const L& self) { return self.curve.failed(); })
      .def_prop_ro("ended", [](const L& self) { return orbit::sentence(self.curve, self.setting->system); })
      .def_prop_ro("down", [](const L& self) { return std::string(name(self.curve.down.kind)); })
      .def_prop_ro("up", [](const L& self) { return std::string(name(self.curve.up.kind)); });
  module.def("locus", &locus, "special"_a, "second"_a, "begin"_a, "end"_a, "second_begin"_a, "second_end"_a, "step"_a,
             "points"_a, "progress"_a.none());
}

}  // namespace slapstick::python
