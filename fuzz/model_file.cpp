/// Bytes as a model file: read, evaluated, validated, built, observed, printed, and what is printed read again. No
/// motion: that is motion.cpp.
#include "slapstick/io/model_file.hpp"

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
  (void)definition->observer().read(0.25, definition->start());
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  (void)succeeds([&] { check(text_of(data, size)); });
  return 0;
}
