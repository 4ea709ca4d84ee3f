/// A model file that was cut off, by a full disk or a broken copy, is a model or an error in one line.
#include <gtest/gtest.h>

#include "io/builtin.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

/// "" if the text is a model whose printed form is a fixed point; else the message, or what is wrong.
std::string outcome(std::string_view text) {
  try {
    const std::string printed = ModelDefinition::parse(text, "f.toml").to_toml();
    return ModelDefinition::parse(printed, "printed.toml").to_toml() == printed ? "" : "not a fixed point";
  } catch (const InputError& error) {
    return error.what();
  }
}

class Truncation : public ::testing::TestWithParam<BuiltinModel> {};

TEST_P(Truncation, every_prefix_of_a_built_in_model_is_a_model_or_an_error_of_one_line) {
  const std::string_view whole = GetParam().text;
  ASSERT_EQ(outcome(whole), "");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string message = outcome(whole.substr(0, length));
    if (message.empty()) continue;
    EXPECT_EQ(message.rfind("f.toml:", 0), 0U) << length << ": " << message;
    EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << length << ": " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(models, Truncation, ::testing::ValuesIn(builtin_model_files()), [](const auto& each) {
  std::string name(each.param.name);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace slapstick
