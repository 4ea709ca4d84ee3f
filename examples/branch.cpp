#include "slapstick/continuation/branch.hpp"
#include <cstdio>
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"

int main() {
  const slapstick::ModelDefinition definition = slapstick::load_model("vibro-impact");
  const slapstick::Family family = definition.family({"omega"});  // the model as a function of omega
  const auto problem = slapstick::orbit::pose(family, {2.2});
  const slapstick::System system(family.model({2.2}));

  const auto found = settle(*problem, system, definition.start({{"omega", 2.2}})).orbit;
  if (!found) return 1;
  std::printf("%s, %s\n", found->label.c_str(), found->stable() ? "stable" : "unstable");

  const slapstick::orbit::Branch branch = follow(*problem, found->orbit, {.from = 1.3, .to = 3.0});
  for (const slapstick::orbit::SpecialPoint& point : branch.special)
    std::printf("%s at omega = %.8f\n", slapstick::orbit::name(point.type).data(), point.value);
}
