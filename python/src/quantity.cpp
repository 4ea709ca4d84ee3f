/// What can be measured: the list of quantities, statistics, spectra.
#include <algorithm>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "orbits.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/span.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

struct Wish {
  std::optional<double> transient;
  double periods, instead;
};

std::optional<Span> span_of(const ModelDefinition& definition, const Overrides& values,
                            const std::optional<Start>& start, const Wish& wish, const std::atomic<bool>* cancel) {
  const System system(build(definition, values));
  return find_span(definition, values, system, start_of(definition, values, start),
                   {wish.transient, wish.periods, wish.instead, cancel, {}});
}

/// The columns of a stop's impacts, in order of size.
struct StopColumns {
  std::string stop;
  std::vector<double> w, impulse, loss;
};

struct Measures {
  Measured found;
  std::vector<Measured> rates;  ///< by each parameter that was asked for
  std::vector<StopColumns> stops;
  std::string label;  ///< of the cycle, or ""
};

std::vector<Quantity> named(const ModelDefinition& definition, const Overrides& values,
                            const std::vector<std::string>& names) {
  const std::vector<Quantity> all = quantities(definition, values);
  std::vector<Quantity> of;
  for (const std::string& name : names) of.push_back(find_quantity(all, name));
  return of;
}

void add_stops(Measures& measures) {
  for (const StopStatistics& stop : measures.found.stops)
    measures.stops.push_back({stop.stop, stop.w.values, stop.impulse.values, stop.loss.values});
}

/// Derivatives of a cycle's statistics. @param cycle  null: there is no cycle
std::vector<Measured> rates_of(const ModelDefinition& definition, const Overrides& values,
                               const std::vector<std::string>& by, const orbit::Orbit* cycle,
                               const std::vector<Quantity>& of) {
  if (by.empty()) return {};
  if (cycle == nullptr)
    throw InputError(
        "sensitivity: only for a cycle, and here a motion is measured: choose an orbit, as by orbit(..).measure");
  try {
    return measure_rates(definition, values, by, *cycle, of);
  } catch (const InputError& error) {
    throw InputError("sensitivity: " + error.message());
  }
}

std::unique_ptr<Measures> measures(const ModelDefinition& definition, const Overrides& values,
                                   const std::optional<Start>& start, const std::vector<std::string>& of,
                                   const std::vector<std::string>& by, std::optional<double> transient, double periods,
                                   nb::object progress) {
  auto result = std::make_unique<Measures>();
  const std::vector<Quantity> wanted = named(definition, values, of);
  Watch watch(std::move(progress));
  bool complete = false;
  watch.run_aside([&] {
    const auto span = span_of(definition, values, start, {transient, periods, 1000.0}, watch.cancel());
    if (!span) return;
    if (span->cycle) result->label = span->cycle->label;
    result->found = measure(*span, wanted, watch.cancel());
    result->rates = rates_of(definition, values, by, span->cycle ? &span->cycle->orbit : nullptr, wanted);
    complete = result->found.complete;
  });
  watch.finish(complete);
  add_stops(*result);
  return result;
}

/// The same of the cycle of an orbit, stable or not.
std::unique_ptr<Measures> measures_of_orbit(const FoundOrbit& orbit, const std::vector<std::string>& of,
                                            const std::vector<std::string>& by) {
  auto result = std::make_unique<Measures>();
  const std::vector<Quantity> wanted = named(orbit.setting->definition, orbit.values(), of);
  result->found = measure(*orbit.setting->problem, orbit.solution.orbit, wanted);
  result->rates = rates_of(orbit.setting->definition, orbit.values(), by, &orbit.solution.orbit, wanted);
  result->label = orbit.solution.label;
  add_stops(*result);
  return result;
}

double statistic_of(const Measures& self, std::size_t k, const Quantity& quantity, const std::string& name) {
  check_statistic(quantity, name);
  return statistic(self.found.of.at(k), name);
}

double rate_of(const Measures& self, std::size_t parameter, std::size_t k, const std::string& name) {
  return statistic_rate(self.found.of.at(k), self.rates.at(parameter).of.at(k), name);
}

/// Lines or a density, as columns.
struct Spectra {
  std::optional<LineSpectrum> lines;
  DensitySpectrum points;
  std::string label;
  std::vector<double> order, frequency, amplitude, phase;
};

std::unique_ptr<Spectra> spectra(const ModelDefinition& definition, const Overrides& values,
                                 const std::optional<Start>& start, const std::string& of, double orders,
                                 std::optional<double> transient, double periods, double stretch, nb::object progress) {
  auto result = std::make_unique<Spectra>();
  const std::vector<Quantity> wanted = named(definition, values, {of});
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    const auto span = span_of(definition, values, start, {transient, periods, 2048.0}, watch.cancel());
    if (!span) return;
    if (span->cycle) {
      result->label = span->cycle->label;
      result->lines = spectrum(*span->problem, span->cycle->orbit, wanted[0], orders);
    } else {
      result->points = density(*span, wanted[0], {stretch, 1, orders, watch.cancel(), {}});
    }
  });
  watch.finish(false);
  if (!result->lines) {
    result->order = result->points.order;
    result->frequency = result->points.frequency;
    return result;
  }
  for (const SpectralLine& line : result->lines->lines) {
    result->order.push_back(line.order);
    result->frequency.push_back(line.frequency);
    result->amplitude.push_back(line.amplitude());
    result->phase.push_back(line.phase());
  }
  return result;
}

std::vector<std::vector<double>> bands(const Spectra& self, int parts, double unit_of_time) {
  const std::vector<Band> found =
      self.lines ? octaves(*self.lines, parts, unit_of_time) : octaves(self.points, parts, unit_of_time);
  std::vector<std::vector<double>> rows;
  for (const Band& band : found) rows.push_back({band.centre, band.from, band.to, band.mean_square});
  return rows;
}

void bind_measures(nb::module_& module) {
  nb::class_<Quantity>(module, "Quantity", "Something that can be measured on a model.")
      .def_ro("name", &Quantity::name)
      .def_ro("unit", &Quantity::unit)
      .def_prop_ro("kind", [](const Quantity& self) { return std::string(name(self.kind)); })
      .def_ro("meaning", &Quantity::meaning)
      .def("__repr__", [](const Quantity& self) { return "<Quantity " + self.name + ": " + self.meaning + ">"; });
  module.def("quantities", nb::overload_cast<const ModelDefinition&, const Overrides&>(&quantities), "definition"_a,
             "values"_a);
  module.def("find_quantity", &find_quantity, "all"_a, "name"_a);
  module.def("usual_statistics", &usual_statistics, "quantity"_a);
  module.def("check_statistic", &check_statistic, "quantity"_a, "name"_a);
  nb::class_<StopColumns>(module, "StopImpacts", "The impacts of a stop, each column in order of size.")
      .def_ro("stop", &StopColumns::stop)
      .def_prop_ro("w", [](StopColumns& self) { return column(self.w); })
      .def_prop_ro("impulse", [](StopColumns& self) { return column(self.impulse); })
      .def_prop_ro("energy_lost", [](StopColumns& self) { return column(self.loss); });
  nb::class_<Measures>(module, "Measures", "Statistics of quantities.")
      .def_prop_ro("duration", [](const Measures& self) { return self.found.duration; })
      .def_ro("label", &Measures::label)
      .def_ro("stops", &Measures::stops, nb::rv_policy::reference_internal)
      .def("statistic", &statistic_of, "k"_a, "quantity"_a, "name"_a)
      .def("rate", &rate_of, "parameter"_a, "k"_a, "name"_a);
  module.def("measure", &measures, "definition"_a, "values"_a, "start"_a.none(), "of"_a, "sensitivity"_a,
             "transient"_a.none(), "periods"_a, "progress"_a.none());
  module.def("measure_orbit", &measures_of_orbit, "orbit"_a, "of"_a, "sensitivity"_a);
}

}  // namespace

void bind_quantity(nb::module_& module) {
  bind_measures(module);
  nb::class_<Spectra>(module, "Spectra", "The lines of a cycle, or the power density of a motion.")
      .def_ro("label", &Spectra::label)
      .def_prop_ro("of_cycle", [](const Spectra& self) { return self.lines.has_value(); })
      .def_prop_ro("order", [](Spectra& self) { return column(self.order); })
      .def_prop_ro("frequency", [](Spectra& self) { return column(self.frequency); })
      .def_prop_ro("amplitude", [](Spectra& self) { return column(self.amplitude); })
      .def_prop_ro("phase", [](Spectra& self) { return column(self.phase); })
      .def_prop_ro("density", [](Spectra& self) { return column(self.points.density); })
      .def_prop_ro("impulses", [](const Spectra& self) { return self.lines ? self.lines->impulses : 0; })
      .def_prop_ro("mean_square", [](const Spectra& self) { return self.lines ? self.lines->mean_square : 0.0; })
      .def_prop_ro("mean_square_of_lines",
                   [](const Spectra& self) { return self.lines ? self.lines->mean_square_of_lines : 0.0; })
      .def_prop_ro("resolution", [](const Spectra& self) { return self.points.resolution; })
      .def_prop_ro("degrees_of_freedom", [](const Spectra& self) { return self.points.degrees_of_freedom; })
      .def_prop_ro("confidence", [](const Spectra& self) { return std::pair(self.points.low, self.points.high); })
      .def("octaves", &bands, "parts"_a, "unit_of_time"_a);
  module.def("spectrum", &spectra, "definition"_a, "values"_a, "start"_a.none(), "of"_a, "orders"_a,
             "transient"_a.none(), "periods"_a, "stretch"_a, "progress"_a.none());
  module.def("a_weighting", &a_weighting, "hertz"_a);
}

}  // namespace slapstick::python
