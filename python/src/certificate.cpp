/// Runs written down as certificates.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/certify/certificate.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

struct Certified {
  certify::Tally tally;
  double periods = 0.0;
  bool complete = true;
};

/// A file that must be written whole.
class Text {
 public:
  explicit Text(const std::string& path) : path_(path), file_(path) { check(); }
  void add(const std::string& text) {
    file_ << text;
    check();
  }
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (!file_) throw StorageError("cannot write '" + path_ + "': " + std::strerror(errno));
  }

  std::string path_;
  std::ofstream file_;
};

std::unique_ptr<Certified> certify_run(const ModelDefinition& definition, const Overrides& values,
                                       const std::optional<Start>& start, double periods, const std::string& path,
                                       nb::object progress) {
  auto certified = std::make_unique<Certified>();
  Watch watch(std::move(progress));
  watch.run([&] {
    const System system(build(definition, values));
    const State state = start_of(definition, values, start);
    Text file(path);
    certify::Certificate certificate(system, state, [&](const std::string& text) { file.add(text); });
    certificate.run(Instant{}.plus(periods), [&](Instant now) { return watch.go_on_now(now.since({})); });
    certificate.finish();
    file.close();
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
      .def_prop_ro("impacts", [](const Certified& self) { return self.tally.impacts; })
      .def_prop_ro("chatters", [](const Certified& self) { return self.tally.chatters; })
      .def_prop_ro("unproved", [](const Certified& self) { return self.tally.unproved; })
      .def_ro("periods", &Certified::periods)
      .def_ro("complete", &Certified::complete);
  module.def("certify", &certify_run, "definition"_a, "values"_a, "start"_a.none(), "periods"_a, "path"_a,
             "progress"_a.none());
}

}  // namespace slapstick::python
