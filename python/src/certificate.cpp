/// Runs written down as certificates.
#include <memory>

#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/certify/certificate.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

struct Certified {
  certify::Tally tally;
  double periods = 0.0;
  bool complete = true;
};

/// @param write  takes the text piece by piece, with the GIL
std::unique_ptr<Certified> certify_run(const ModelDefinition& definition, const Overrides& values,
                                       const std::optional<Start>& start, double periods, const nb::callable& write,
                                       nb::object progress) {
  auto certified = std::make_unique<Certified>();
  Watch watch(std::move(progress));
  watch.run([&] {
    const System system(build(definition, values));
    certify::Certificate certificate(system, start_of(definition, values, start), [&](const std::string& text) {
      const nb::gil_scoped_acquire acquire;
      write(text);
    });
    certificate.run(Instant{}.plus(periods), [&](Instant now) { return watch.go_on_now(now.since({})); });
    certificate.finish();
    certified->tally = certificate.tally();
    certified->periods = certificate.time().since({});
  });
  certified->complete = watch.finish(true);
  return certified;
}

}  // namespace

void bind_certificate(nb::module_& module) {
  nb::class_<Certified>(module, "Certified", "What a certificate holds, in numbers.")
      .def_prop_ro("segments", [](const Certified& self) { return self.tally.segments; })
      .def_prop_ro("guards", [](const Certified& self) { return self.tally.guards; })
      .def_prop_ro("steps", [](const Certified& self) { return self.tally.steps; })
      .def_prop_ro("touches", [](const Certified& self) { return self.tally.touches; })
      .def_prop_ro("chatters", [](const Certified& self) { return self.tally.chatters; })
      .def_prop_ro("unproved", [](const Certified& self) { return self.tally.unproved; })
      .def_ro("periods", &Certified::periods)
      .def_ro("complete", &Certified::complete);
  module.def("certify", &certify_run, "definition"_a, "values"_a, "start"_a.none(), "periods"_a, "write"_a,
             "progress"_a.none());
}

}  // namespace slapstick::python
