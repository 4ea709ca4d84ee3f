// A first study of one's own: what the paper's oscillator does at some forcing frequencies, and one cycle of it, event
// by event.
//
// Equations: eq. (2) of the paper, with the defaults of the built-in model (`slapstick show vibro-impact`).
// Expected: at 1.5 one impact per cycle and a short stick (1-1-II), at 2.2 no stick (1-1-I), at 0.552 infinitely many
// impacts per cycle that end in stick; between 4.801 and 4.805 the cycle of four periods loses its stability to an
// invariant curve.
#include <cstdio>

#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace {

/// The events of one forcing period from a state on the attractor.
void print_one_period(const slapstick::System& system, const slapstick::State& state) {
  slapstick::Motion motion(system, state);
  while (motion.advance({.period = 1, .fraction = 0.0}) == slapstick::Outcome::event) {
    const slapstick::Event& event = motion.event();
    std::printf("    %-8s%-9s at %.6f of a period, w = %.6f\n", slapstick::name(event.kind).data(),
                system.contact_name(event.contact).c_str(), event.time.fraction, event.w);
  }
}

void study() {
  const slapstick::ModelDefinition definition = slapstick::load_model("vibro-impact");
  for (const double omega : {0.552, 1.5, 2.2, 4.801, 4.805}) {
    const slapstick::System system(definition.build({{"omega", omega}}));
    const slapstick::Classification found = slapstick::classify(system, definition.start({{"omega", omega}}));
    std::printf("omega = %-5g  %s\n", omega, found.label.c_str());
    if (omega == 1.5 || omega == 2.2) print_one_period(system, found.state);
  }
}

}  // namespace

int main() {
  try {
    study();
  } catch (const slapstick::InputError& error) {  // the caller's mistake; NumericalError: the motion cannot go on
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
