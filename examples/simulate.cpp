#include <cstdio>
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

int main() try {
  const slapstick::ModelDefinition definition = slapstick::load_model("vibro-impact");
  const slapstick::System system(definition.build({{"omega", 2.2}}));
  slapstick::Motion motion(system, definition.start());
  while (motion.advance({.period = 2, .fraction = 0.0}) == slapstick::Outcome::event) {
    const slapstick::Event& event = motion.event();
    std::printf("%-8s%-9s at %.9f periods, w = %.6f\n", slapstick::name(event.kind).data(),
                system.contact_name(event.contact).c_str(), event.time.since({}), event.w);
  }
  const slapstick::State state = motion.state();  // x1, v1, x2, v2
  std::printf("after two periods x1 = %.9f, in mode %s\n", state[0], system.mode_name(motion.mode_id()).c_str());
} catch (const slapstick::InputError& error) {  // the caller's mistake; NumericalError: the motion cannot go on
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
