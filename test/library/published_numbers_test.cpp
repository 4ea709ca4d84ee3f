/// Known systems come out as published: every entry of cases.json, by the way it says. Expected numbers and tolerances
/// are those of the published list; where the engine differs, the entry says why, and has the number of an independent
/// computation instead.
#include <gtest/gtest.h>

#include <set>

#include "io/table.hpp"
#include "library/published_cases.hpp"

namespace slapstick::library {
namespace {

class Published : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Published, number_comes_out) {
  const Entry& entry = all_cases()[GetParam()];
  const double value = measured(entry), expected = entry.at("expected").get<double>(),
               tolerance = entry.at("tolerance").get<double>();
  RecordProperty("error", number_text(std::abs(value - expected)));
  const auto what = entry.at("id").get<std::string>() + ", " + entry.at("quantity").get<std::string>();
  if (!entry.contains("disagrees")) {
    EXPECT_NEAR(value, expected, tolerance) << what;
    return;
  }
  const Entry& known = entry["disagrees"];
  EXPECT_GT(std::abs(value - expected), tolerance) << what << " agrees after all";
  EXPECT_NEAR(value, known.at("value").get<double>(), known.at("tolerance").get<double>()) << what;
}

std::string name_of(const ::testing::TestParamInfo<std::size_t>& info) {
  auto id = all_cases()[info.param].at("id").get<std::string>();
  std::replace(id.begin(), id.end(), '.', '_');
  return id;
}

INSTANTIATE_TEST_SUITE_P(Cases, Published, ::testing::Range<std::size_t>(0, all_cases().size()), name_of);

TEST(Cases, every_id_is_there_once_and_every_model_is_asked) {
  std::set<std::string> ids, models;
  long published = 0;
  for (const Entry& entry : all_cases()) {
    const auto id = entry.at("id").get<std::string>();
    EXPECT_TRUE(ids.insert(id).second) << id;
    models.insert(entry.at("model").get<std::string>());
    published += id.find("own") == std::string::npos;
  }
  EXPECT_EQ(published, 118);
  for (const auto& name : builtin_models()) EXPECT_EQ(models.count(name), 1u) << name;
}

}  // namespace
}  // namespace slapstick::library
