/// docs/reference/model_file.md names every key of the format, and its worked example is a model.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "io/definition.hpp"
#include "io/refusal.hpp"

namespace slapstick {
namespace {

std::string reference() {
  std::ostringstream text;
  text << std::ifstream(SLAPSTICK_REFERENCE).rdbuf();
  return text.str();
}

/// The fenced files of the page, by name.
std::map<std::string, ModelDefinition> examples() {
  const std::string fence = "```toml\n", text = reference();
  std::map<std::string, ModelDefinition> models;
  for (auto begin = text.find(fence); begin != std::string::npos; begin = text.find(fence, begin + 1)) {
    const auto example = text.substr(begin + fence.size(), text.find("```", begin + 3) - begin - fence.size());
    EXPECT_EQ(refusal(example), "accepted");
    const auto model = ModelDefinition::parse(example, "example.toml");
    models.emplace(model.name(), model);
  }
  return models;
}

TEST(Reference, the_example_of_units_gives_the_physical_number) {
  const auto wiper = examples().at("wiper");
  EXPECT_DOUBLE_EQ(wiper.build().frictions.at(0).belt_speed, 0.002);
  EXPECT_DOUBLE_EQ(wiper.build().frictions[0].belt_speed * wiper.physical()->w.factor, 200.0);  // um/s
}

TEST(Reference, the_worked_example_is_a_model) {
  const auto model = examples().at("gear-rattle").build();
  EXPECT_EQ(model.compliant_stops.size(), 2U);
  EXPECT_EQ(model.forces.size(), 2U);
  EXPECT_TRUE(model.forced());
}

TEST(Reference, every_example_is_a_model) { EXPECT_EQ(examples().size(), 9U); }

TEST(Reference, every_key_is_there) {
  const auto text = reference();
  const auto section = [&](const std::string& kind) {  // the rows of a part, up to the next part
    const auto begin = text.find("| `[[" + kind + "]]`");
    return begin == std::string::npos ? "" : text.substr(begin, text.find("| `[[", begin + 1) - begin);
  };
  for (const auto& rule : part_rules()) {
    const auto rows = section(std::string(rule.kind));
    for (const auto& key : part_keys(rule))
      EXPECT_TRUE(key == "description" || rows.find("`" + key + "`") != std::string::npos) << rule.kind << ": " << key;
  }
  const auto named = [&](const std::string& key) {
    EXPECT_TRUE(text.find("`" + key + "`") != std::string::npos || text.find("`[" + key + "]`") != std::string::npos ||
                text.find("`[[" + key + "]]`") != std::string::npos)
        << key;
  };
  for (const auto* keys : {&top_keys(), &parameter_keys(), &matrix_keys(), &scale_keys()})
    for (const auto& key : *keys) named(key);
  for (const auto& law : impact_laws()) named("\"" + law + "\"");
}

}  // namespace
}  // namespace slapstick
