/// Classes of attractors, at one value of the parameters and at many.
#include <nanobind/stl/complex.h>

#include <algorithm>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/sweep/parallel.hpp"
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
  int transient, most_periods, most_n, exponent_periods, quick;
  std::vector<std::string> stops;

  Limits(int first, int most, int longest, int exponent, int fast, std::vector<std::string> chosen)
      : transient(first),
        most_periods(most),
        most_n(longest),
        exponent_periods(exponent),
        quick(fast),
        stops(std::move(chosen)) {}
};

void classify(Classified& into, const ModelDefinition& definition, const Overrides& values,
              const std::optional<Start>& start, const Limits& limits, const std::atomic<bool>* cancel,
              std::function<void(long)> progress) {
  const System system(build(definition, values));
  const State state = start_of(definition, values, start);
  const ClassifyOptions how{.transient_periods = limits.transient,
                            .most_periods = limits.most_periods,
                            .most_n = limits.most_n,
                            .exponent_periods = limits.exponent_periods,
                            .stops = StopChoice(system.model(), limits.stops),
                            .cancel = cancel,
                            .progress = std::move(progress)};
  into.found =
      limits.quick > 0 ? classify_quickly(system, state, limits.quick, how) : slapstick::classify(system, state, how);
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
                                         const std::optional<Start>& start, const Limits& limits, nb::object progress) {
  auto found = std::make_unique<Classified>();
  Watch watch(std::move(progress));
  watch.run([&] {
    classify(*found, definition, values, start, limits, watch.cancel(),
             [&](long periods) { watch.go_on(static_cast<double>(periods)); });
  });
  watch.finish(false);
  return found;
}

/// Each on its own, by index: the same results on any number of threads. A failure is that row's.
std::vector<std::unique_ptr<Classified>> classify_many(const ModelDefinition& definition,
                                                       const std::vector<Overrides>& values,
                                                       const std::optional<Start>& start, const Limits& limits,
                                                       int threads, nb::object progress) {
  std::vector<std::unique_ptr<Classified>> rows(values.size());
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    std::atomic<int> done{0};
    const auto classify_row = [&](int i) {
      auto row = std::make_unique<Classified>();
      const auto at = static_cast<std::size_t>(i);
      try {
        classify(*row, definition, values[at], start, limits, watch.cancel(), {});
      } catch (const std::runtime_error& error) {
        row->failure = error.what();
      }
      if (!row->found.interrupted) rows[at] = std::move(row);
      watch.note(++done);
    };
    sweep::for_each_index(static_cast<int>(values.size()), threads, classify_row, watch.cancel());
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
      .def_prop_ro("cycle", [](const C& self) { return self.found.period; })
      .def_prop_ro("eigenvalues", [](C& self) { return column(self.found.eigenvalues); })
      .def_prop_ro("multipliers", [](C& self) { return column(self.found.multipliers); })
      .def_prop_ro("return_distance", [](const C& self) { return self.found.return_distance; })
      .def_prop_ro("approach", [](const C& self) { return self.found.approach; })
      .def_prop_ro("sticking_fraction", [](const C& self) { return self.found.sticking_fraction; })
      .def_prop_ro("exponent", [](const C& self) { return self.found.exponent; })
      .def_prop_ro("exponent_error", [](const C& self) { return self.found.exponent_error; })
      .def_prop_ro("digits", [](const C& self) { return self.found.digits; })
      .def_prop_ro("rotation", [](const C& self) { return self.found.rotation; })
      .def_prop_ro("rotation_digits", [](const C& self) { return self.found.rotation_digits; })
      .def_prop_ro("curves", [](const C& self) { return self.found.curves; })
      .def_prop_ro("family", [](const C& self) { return self.found.family; })
      .def_prop_ro("doubt", [](const C& self) { return word(self.found.doubt); })
      .def_prop_ro("option_that_decides",
                   [](const C& self) { return std::string(option_that_decides(self.found.doubt)); })
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
  nb::class_<Limits>(module, "Limits", "How long a motion is looked at, and whose impacts are counted.")
      .def(nb::init<int, int, int, int, int, std::vector<std::string>>(), "transient"_a, "most_periods"_a, "most_n"_a,
           "exponent_periods"_a, "quick"_a, "stops"_a);
  module.def("classify", &classify_one, "definition"_a, "values"_a, "start"_a.none(), "limits"_a, "progress"_a.none());
  module.def("classify_many", &classify_many, "definition"_a, "values"_a, "start"_a.none(), "limits"_a, "threads"_a,
             "progress"_a.none());
}

}  // namespace slapstick::python
