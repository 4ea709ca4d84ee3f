/// Classes of attractors, at one value of the parameters and at many.
#include <nanobind/stl/complex.h>

#include <algorithm>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "many.hpp"
#include "slapstick/attractor/classify.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

/// A classification, and its impacts as columns.
struct Classified {
  Classification found;
  std::vector<double> phase, w, before;
  std::vector<std::int32_t> contact;
  std::vector<std::string> contact_names;
  double period = 0.0;
  std::string failure;  ///< of one among many: why there is no class
};

struct Limits {
  int transient, most_periods, most_n;
  std::vector<std::string> stops;
};

void classify(Classified& into, const ModelDefinition& definition, const Overrides& values,
              const std::optional<Start>& start, const Limits& limits, const std::atomic<bool>* cancel,
              std::function<void(long)> progress) {
  const System system(build(definition, values));
  const State state = start_of(definition, values, start);
  into.found = slapstick::classify(system, state,
                                   {.transient_periods = limits.transient,
                                    .most_periods = limits.most_periods,
                                    .most_n = limits.most_n,
                                    .stops = StopChoice(system.model(), limits.stops),
                                    .cancel = cancel,
                                    .progress = std::move(progress)});
  into.period = system.period();
  into.contact_names = contact_names(system.model());
  for (const CycleImpact& impact : into.found.impacts) {
    into.phase.push_back(impact.phase);
    into.w.push_back(impact.w);
    into.contact.push_back(impact.contact);
    into.before.insert(into.before.end(), impact.state.begin(), impact.state.end());
  }
}

std::unique_ptr<Classified> classify_one(const ModelDefinition& definition, const Overrides& values,
                                         const std::optional<Start>& start, int transient, int most_periods, int most_n,
                                         std::vector<std::string> stops, nb::object progress) {
  auto found = std::make_unique<Classified>();
  Watch watch(std::move(progress));
  watch.run([&] {
    classify(*found, definition, values, start, {transient, most_periods, most_n, std::move(stops)}, watch.cancel(),
             [&](long periods) { watch.go_on(static_cast<double>(periods)); });
  });
  watch.finish(false);
  return found;
}

/// Each on its own, by index: the same results on any number of threads. A failure is that row's.
std::vector<std::unique_ptr<Classified>> classify_many(const ModelDefinition& definition,
                                                       const std::vector<Overrides>& values,
                                                       const std::optional<Start>& start, int transient,
                                                       int most_periods, int most_n, std::vector<std::string> stops,
                                                       int threads, nb::object progress) {
  std::vector<std::unique_ptr<Classified>> rows(values.size());
  const Limits limits{transient, most_periods, most_n, std::move(stops)};
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    for_each_index(values.size(), threads, watch, [&](std::size_t i) {
      auto row = std::make_unique<Classified>();
      try {
        classify(*row, definition, values[i], start, limits, watch.cancel(), {});
      } catch (const std::runtime_error& error) {
        row->failure = error.what();
      }
      if (!row->found.interrupted) rows[i] = std::move(row);
    });
  });
  watch.finish(true);
  return rows;  // None where Ctrl-C came first
}

/// The word of an enumerator of the attractor or the chatter.
template <class Enum>
std::string word(Enum value) {
  return std::string(name(value));
}

}  // namespace

void bind_attractor(nb::module_& module) {
  using C = Classified;
  nb::class_<C>(module, "Classified", "What a motion is after its transient.")
      .def_prop_ro("label", [](const C& self) { return self.found.label; })
      .def_prop_ro("attractor", [](const C& self) { return word(self.found.attractor); })
      .def_prop_ro("n", [](const C& self) { return self.found.n; })
      .def_prop_ro("p", [](const C& self) { return self.found.p; })
      .def_prop_ro("sticking", [](const C& self) { return self.found.sticking; })
      .def_prop_ro("chatter", [](const C& self) { return word(self.found.chatter); })
      .def_prop_ro("multipliers", [](C& self) { return column(self.found.multipliers); })
      .def_prop_ro("return_distance", [](const C& self) { return self.found.return_distance; })
      .def_prop_ro("approach", [](const C& self) { return self.found.approach; })
      .def_prop_ro("sticking_fraction", [](const C& self) { return self.found.sticking_fraction; })
      .def_prop_ro("exponent", [](const C& self) { return self.found.exponent; })
      .def_prop_ro("exponent_error", [](const C& self) { return self.found.exponent_error; })
      .def_prop_ro("digits", [](const C& self) { return self.found.digits; })
      .def_prop_ro("periods_used", [](const C& self) { return self.found.periods_used; })
      .def_prop_ro("drift", [](C& self) { return column(self.found.drift); })
      .def_prop_ro("state", [](C& self) { return column(self.found.state); })
      .def_prop_ro("impact_phase", [](C& self) { return column(self.phase); })
      .def_prop_ro("impact_w", [](C& self) { return column(self.w); })
      .def_prop_ro("impact_before", [](C& self) { return transposed(self.before, self.found.state.size()); })
      .def_prop_ro("impact_contact_codes", [](C& self) { return column(self.contact); })
      .def_ro("contact_names", &C::contact_names)
      .def_ro("period", &C::period)
      .def_ro("failure", &C::failure);
  module.def("classify", &classify_one, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "most_periods"_a,
             "most_n"_a, "stops"_a, "progress"_a.none());
  module.def("classify_many", &classify_many, "definition"_a, "values"_a, "start"_a.none(), "transient"_a,
             "most_periods"_a, "most_n"_a, "stops"_a, "threads"_a, "progress"_a.none());
}

}  // namespace slapstick::python
