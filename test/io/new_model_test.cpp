/// The file of `slapstick new` is sound, and so is all that it shows as an example; no key of the format is left out.
#include <gtest/gtest.h>

#include "io/definition.hpp"
#include "io/everything.hpp"
#include "io/refusal.hpp"

namespace slapstick {
namespace {

TEST(NewModel, as_written_and_with_everything_switched_on) {
  const auto text = new_model("my-model");
  EXPECT_EQ(refusal(text), "accepted");
  EXPECT_EQ(refusal(switched_on(text)), "accepted");
  const auto model = ModelDefinition::parse(text, "f.toml").build();
  EXPECT_EQ(model.name, "my-model");
  EXPECT_TRUE(model.stops.size() == 1 && model.frictions.size() == 1 && model.forced());
  EXPECT_EQ(ModelDefinition::parse(switched_on(text), "f.toml").build().stops.size(), 3U);
}

TEST(NewModel, every_key_has_an_example) {
  const auto text = everything();
  const auto shows = [&](const std::string& key) {
    EXPECT_TRUE(text.find("\n" + key + " = ") != std::string::npos ||
                text.find("{ " + key + " = ") != std::string::npos ||
                text.find(", " + key + " = ") != std::string::npos || text.find("[" + key + "]") != std::string::npos)
        << key;
  };
  for (const auto& key : top_keys()) shows(key);
  for (const auto* keys : {&parameter_keys(), &matrix_keys(), &scale_keys(), &quantity_keys()})
    for (const auto& key : *keys) shows(key);
  for (const auto& rule : part_rules()) {
    const auto parts = read_definition(text, "f.toml").of(rule.kind);
    for (const auto& field : rule.fields) {
      const std::string key(field.key);
      if (rule.kind == "signal" && (key == "file" || key == "column")) continue;  // there is no such file here
      bool given = field.holds == Holds::harmonics;
      for (const auto& part : parts)
        given = given || (field.holds == Holds::points && !part.points.empty()) ||
                (field.holds == Holds::interval && !part.within.empty()) ||
                (field.holds == Holds::ratio && part.ratio) ||
                (field.holds == Holds::stribeck && !part.stribeck.empty()) ||
                (field.holds == Holds::band && !part.band.empty()) ||
                (field.holds == Holds::load && !part.load.empty() && !part.load_stop.empty()) ||
                part.fields.count(key) + part.flags.count(key) + part.texts.count(key) != 0;
      EXPECT_TRUE(given) << rule.kind << ": " << key;
    }
  }
}

TEST(NewModel, names) {
  EXPECT_THROW((void)new_model(""), InputError);
  EXPECT_THROW((void)new_model("a b"), InputError);
  EXPECT_THROW((void)new_model("a\"\nomega = 3"), InputError);
  EXPECT_THROW((void)new_model(std::string(65, 'a')), InputError);
  EXPECT_NO_THROW((void)new_model(std::string(64, 'a')));
}

}  // namespace
}  // namespace slapstick
