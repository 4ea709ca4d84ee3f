/// Lyapunov exponents, at one value of the parameters and at many.
#include <algorithm>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/sweep/parallel.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

struct Exponents {
  LyapunovExponents found;
  std::string failure;  ///< of one among many
};

void compute(Exponents& into, const ModelDefinition& definition, const Overrides& values,
             const std::optional<Start>& start, const LyapunovOptions& how) {
  const System system(build(definition, values));
  into.found = lyapunov(system, start_of(definition, values, start), how);
}

std::unique_ptr<Exponents> one(const ModelDefinition& definition, const Overrides& values,
                               const std::optional<Start>& start, long transient, long periods, double error,
                               nb::object progress) {
  auto found = std::make_unique<Exponents>();
  Watch watch(std::move(progress));
  watch.run([&] {
    compute(*found, definition, values, start, {transient, periods, error, watch.cancel(), [&](long done) {
                                                  watch.go_on_now(static_cast<double>(done));
                                                }});
  });
  watch.finish(false);
  return found;
}

/// Each on its own, by index: the same results on any number of threads. A failure is that row's.
std::vector<std::unique_ptr<Exponents>> many(const ModelDefinition& definition, const std::vector<Overrides>& values,
                                             const std::optional<Start>& start, long transient, long periods,
                                             double error, int threads, nb::object progress) {
  std::vector<std::unique_ptr<Exponents>> rows(values.size());
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    std::atomic<int> done{0};
    const auto compute_row = [&](int i) {
      auto row = std::make_unique<Exponents>();
      const auto at = static_cast<std::size_t>(i);
      try {
        compute(*row, definition, values[at], start, {transient, periods, error, watch.cancel(), {}});
      } catch (const std::runtime_error& failure) {
        row->failure = failure.what();
      }
      if (!row->found.interrupted) rows[at] = std::move(row);
      watch.note(++done);
    };
    sweep::for_each_index(static_cast<int>(values.size()), threads, compute_row, watch.cancel());
  });
  watch.finish(true);
  return rows;  // None where Ctrl-C came first
}

}  // namespace

void bind_lyapunov(nb::module_& module) {
  using E = Exponents;
  nb::class_<E>(module, "Exponents", "The Lyapunov exponents of a motion.")
      .def_prop_ro("per_period", [](E& self) { return column(self.found.per_period); })
      .def_prop_ro("errors_per_period", [](E& self) { return column(self.found.errors); })
      .def_prop_ro("period", [](const E& self) { return self.found.period; })
      .def_prop_ro("dimension", [](const E& self) { return self.found.dimension; })
      .def_prop_ro("sum_per_period", [](const E& self) { return self.found.sum; })
      .def_prop_ro("contraction_per_period", [](const E& self) { return self.found.contraction; })
      .def_prop_ro("sum_rule_holds", [](const E& self) { return self.found.sum_rule_holds(); })
      .def_prop_ro("periods", [](const E& self) { return self.found.periods; })
      .def_prop_ro("reached", [](const E& self) { return self.found.reached; })
      .def_ro("failure", &E::failure);
  module.def("lyapunov", &one, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "periods"_a, "error"_a,
             "progress"_a.none());
  module.def("lyapunov_many", &many, "definition"_a, "values"_a, "start"_a.none(), "transient"_a, "periods"_a,
             "error"_a, "threads"_a, "progress"_a.none());
}

}  // namespace slapstick::python
