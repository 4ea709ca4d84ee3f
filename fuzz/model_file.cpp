/// Bytes as a model file: read, evaluated, validated, printed. A text that ends with a blank is also flown, if it is small.
#include "slapstick/io/model_file.hpp"

#include "flight.hpp"
#include "slapstick/io/observer.hpp"
#include "target.hpp"

namespace slapstick::fuzz {
namespace {

void check_printing(const ModelDefinition& definition) {
  const std::string printed = definition.to_toml();
  std::string again;
  demand(succeeds([&] { again = ModelDefinition::parse(printed, "printed.toml").to_toml(); }),
         "what is printed can be read", printed);
  demand(again == printed, "parse, print, parse is a fixed point", printed + "\n---\n" + again);
}

void check(std::string_view text) {
  std::optional<ModelDefinition> definition;
  try {
    definition = ModelDefinition::parse(text, "f.toml");
  } catch (const InputError& error) {
    const std::string message = error.what();
    demand(message.rfind("f.toml:", 0) == 0, "a message begins with the file's name", message);
    throw;
  }
  check_printing(*definition);
  const Model model = definition->build();
  const State start = definition->start();
  (void)definition->observer().read(0.25, start);
  if (text.back() != ' ' || model.size() > 3 || model.frictions.size() + model.stops.size() > 3) return;
  fly(System(model), start);
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  (void)succeeds([&] { check(text_of(data, size)); });
  return 0;
}
