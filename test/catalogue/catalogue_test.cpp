/// The failure catalogue: every entry of catalogue.json does what it expects, one test a member. The keys are told in
/// member.hpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catalogue/run.hpp"
#include "flow/compiled_system.hpp"
#include "flow/oracle_runs.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/section/stroboscopic_section.hpp"

namespace slapstick::catalogue {
namespace {

using library::number;

std::vector<std::string> parts(const std::string& text, const std::string& between) {
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(between, begin), text.size());
    all.push_back(text.substr(begin, end - begin));
    begin = end + between.size();
  }
  return all;
}

void expect_events(const Entry& entry, const Record& record) {
  const std::string found = kinds(record);
  if (entry.contains("events")) {
    const auto allowed = parts(entry["events"].get<std::string>(), " | ");
    EXPECT_TRUE(std::ranges::find(allowed, found) != allowed.end()) << "events: " << found;
  }
  for (const std::string& kind : parts(entry.value("never", "-"), " "))
    EXPECT_EQ(std::ranges::count(record.events, kind, &Seen::kind), 0) << kind;
  if (entry.contains("mode")) {
    EXPECT_EQ(record.mode, entry["mode"].get<std::string>());
  }
  if (entry.contains("start_mode")) {
    EXPECT_EQ(record.start_mode, entry["start_mode"].get<std::string>());
  }
}

void expect_values(const Entry& entry, const Values& values) {
  for (const Entry& expected : entry.value("expect", Entry::array())) {
    try {
      const double within = number(expected.value("within", Entry(0)), values);
      EXPECT_NEAR(number(expected.at("value"), values), number(expected.at("is"), values), within)
          << expected.at("value");
    } catch (const std::out_of_range&) {
      ADD_FAILURE() << expected << " needs something that did not happen";
    }
  }
}

Record check_run(const Member& member, const Way& way) {
  Record record = run(member, way);
  expect_events(member.entry, record);
  expect_values(member.entry, record.values);
  return record;
}

/// Twenty bounds on the window, from its natural length down to a 240th of it.
void check_window_caps(const Member& member) {
  double cap = 1.0 / library::Setup(member.entry, {}, member.given).system.windows_per_period();
  for (int k = 0; k < 20; ++k, cap *= 0.75) {
    SCOPED_TRACE("windows of at most " + std::to_string(cap) + " periods");
    check_run(member, {{cap}, 0.0});
  }
}

void expect_same_event(const Seen& a, const Seen& b, double factor, double within, bool states) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_NEAR(a.since_start.since(b.since_start), 0.0, within);
  for (const auto& [name, value] : a.after) {
    if (states) {
      EXPECT_NEAR(value, factor * b.after.at(name), within) << name;
    }
  }
}

void check_same(const Member& member, const Record& record) {
  const Entry& same = member.entry["same"];
  Member other = member;
  other.entry.merge_patch(same);
  if (same.contains("model")) other.entry["set"] = same.value("set", Entry::object());
  if (other.entry["model"].get<std::string>().starts_with("models/"))
    other.entry["model"] = SLAPSTICK_CATALOGUE + other.entry["model"].get<std::string>();
  auto expected = run(other).events, found = record.events;
  if (same.contains("kind")) {
    const auto other_kind = [&](const Seen& event) { return event.kind != same["kind"].get<std::string>(); };
    std::erase_if(expected, other_kind);
    std::erase_if(found, other_kind);
  }
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("event " + std::to_string(i));
    expect_same_event(found[i], expected[i], same.value("factor", 1.0), number(same.value("within", Entry(0)), {}),
                      !same.contains("kind"));
  }
}

void check_oracle(const Member& member) {
  const library::Setup setup(member.entry, {}, member.given);
  Motion motion(setup.system, setup.start, setup.begin);
  oracle::Oracle exact(setup.system.model(), setup.start, setup.begin.fraction);
  const double time = number(member.entry.at("run"), setup.values);
  const auto c = testing::compare(testing::engine_events(motion, time), testing::oracle_events(exact, time));
  EXPECT_EQ(c.mismatch, "");
  EXPECT_LE(c.worst, number(member.entry["oracle"], member.given));
}

void expect_words(const std::string& what, const Entry& words) {
  EXPECT_EQ(what.find('\n'), std::string::npos) << "more than one line";
  for (const auto& part : words) EXPECT_NE(what.find(part.get<std::string>()), std::string::npos) << what;
}

void check_refused(const Member& member) {
  try {
    const library::Setup setup(member.entry, {}, member.given);
    const Motion motion(setup.system, setup.start, setup.begin);
    if (member.entry.contains("section")) StroboscopicSection(motion, 0.0);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    expect_words(error.what(), member.entry["refused"]);
  }
}

void check_fails(const Member& member) {
  try {
    run(member);
    ADD_FAILURE() << "no error";
  } catch (const NumericalError& error) {
    expect_words(error.what(), member.entry["fails"]);
  }
}

void check_guards(const Member& member) {
  constexpr const char* names[] = {"gap",    "slip",  "stick_above", "stick_below", "press",
                                   "engage", "leave", "let_go",      "push"};
  const Entry& wanted = member.entry["guards"];
  const library::Setup setup(member.entry, {}, member.given);
  std::string found = "no such mode";
  for (ModeId id = 0; id < setup.system.mode_count(); ++id) {
    if (setup.system.mode_name(id) != wanted.at("mode").get<std::string>()) continue;
    found.clear();
    for (const mode::Guard& guard : setup.system.compiled().mode(id).guards())
      found += (found.empty() ? "" : " ") + std::string(names[static_cast<int>(guard.kind)]);
  }
  EXPECT_EQ(found, wanted.at("are").get<std::string>());
}

class Item : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Item, holds) {
  const Member& member = all_members()[GetParam()];
  const Entry& entry = member.entry;
  if (entry.contains("refused")) return check_refused(member);
  if (entry.contains("fails")) return check_fails(member);
  if (entry.contains("guards")) return check_guards(member);
  const Record record = check_run(member, {});
  if (entry.value("window_caps", false)) check_window_caps(member);
  for (const Entry& piece : entry.value("cuts", Entry::array())) {
    SCOPED_TRACE("in pieces of " + piece.dump());
    check_run(member, {{}, piece.get<double>()});
  }
  if (entry.contains("same")) check_same(member, record);
  if (entry.contains("oracle")) check_oracle(member);
}

std::string name_of(const ::testing::TestParamInfo<std::size_t>& info) { return all_members()[info.param].name; }

INSTANTIATE_TEST_SUITE_P(Catalogue, Item, ::testing::Range<std::size_t>(0, all_members().size()), name_of);

TEST(CatalogueItself, says_of_every_entry_what_it_guards_and_what_it_expects) {
  const auto any = [](const Entry& entry, std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return entry.contains(key); });
  };
  for (const Member& member : all_members()) {
    for (const char* key : {"id", "title", "danger", "source"})
      EXPECT_FALSE(member.entry.value(key, "").empty()) << member.name << " has no " << key;
    EXPECT_TRUE(any(member.entry, {"events", "expect", "each", "same", "oracle", "refused", "fails", "guards"}))
        << member.name << " expects nothing";
  }
}

/// Every item from K01 to K40, except those that are tests of their own.
TEST(CatalogueItself, has_all_items) {
  for (int k = 1; k <= 40; ++k) {
    if (k == 34 || k == 35) continue;  // hostile_test.cpp
    char id[16];
    std::snprintf(id, sizeof id, "K%02d", k);
    EXPECT_TRUE(std::ranges::any_of(all_members(), [&](const Member& m) { return m.name.starts_with(id); })) << id;
  }
}

}  // namespace
}  // namespace slapstick::catalogue
