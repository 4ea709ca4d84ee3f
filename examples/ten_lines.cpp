#include <cstdio>
#include "slapstick/attractor/classify.hpp"
#include "slapstick/io/model_file.hpp"

int main() {
  const auto definition = slapstick::load_model("vibro-impact");  // or the path of a .toml file
  const slapstick::System system(definition.build({{"omega", 1.5}}));
  const auto found = slapstick::classify(system, definition.start());
  std::printf("%s, impact with w = %.6f\n", found.label.c_str(), found.impacts.at(0).w);
}
