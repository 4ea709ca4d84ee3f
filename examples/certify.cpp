#include <cstdio>
#include <fstream>
#include "slapstick/certify/certificate.hpp"
#include "slapstick/io/model_file.hpp"

int main() {
  const slapstick::ModelDefinition definition = slapstick::load_model("vibro-impact");
  const slapstick::System system(definition.build({{"omega", 1.5}}));
  std::ofstream file("run.cert");
  slapstick::certify::Certificate certificate(system, definition.start({{"omega", 1.5}}),
                                              [&](const std::string& lines) { file << lines; });
  certificate.run({.period = 20, .fraction = 0.0}, [](slapstick::Instant) { return true; });
  certificate.finish();
  file.close();
  const slapstick::certify::Tally& tally = certificate.tally();
  std::printf("%ld segments; pile-ups, which are not proved: %ld\n", tally.segments, tally.unproved);
  // slapstick-verify run.cert
}
