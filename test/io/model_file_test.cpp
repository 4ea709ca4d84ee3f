/// Hostile model files: an error of one line, never a crash.
#include "slapstick/io/model_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "io/everything.hpp"
#include "io/same_model.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

namespace fs = std::filesystem;

std::string outcome(std::string_view text) {
  try {
    (void)ModelDefinition::parse(text, "f.toml");
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
    EXPECT_EQ(message.rfind("f.toml:", 0), 0U) << message;
    return message;
  }
  return "accepted";
}

const std::string whole = load_model("vibro-impact").to_toml();

/// Short, with every key: print leaves the comments out.
const std::string full = ModelDefinition::parse(everything(), "f.toml").to_toml();

TEST(HostileFile, a_file_with_every_key_prints_to_a_fixed_point) {
  const auto again = ModelDefinition::parse(full, "f.toml");
  EXPECT_EQ(again.to_toml(), full);
  expect_same(again.build(), ModelDefinition::parse(everything(), "f.toml").build());
}

TEST(HostileFile, every_truncation_is_a_model_or_an_error) {
  int accepted = 0;
  for (std::size_t length = 0; length < whole.size(); ++length)
    if (outcome(std::string_view(whole).substr(0, length)) == "accepted") ++accepted;
  EXPECT_LE(accepted, 60);  // only within the last tables, where what is left is a whole model
}

TEST(HostileFile, every_flipped_byte_is_a_model_or_an_error) {
  std::mt19937 random(1);
  for (const auto& file : {whole, full})
    for (std::size_t i = 0; i < file.size(); ++i)
      for (int repeat = 0; repeat < 3; ++repeat) {
        auto text = file;
        text[i] = static_cast<char>(random() & 255);
        (void)outcome(text);
      }
}

TEST(HostileFile, every_line_that_is_missing_or_doubled_is_a_model_or_an_error) {
  for (std::size_t begin = 0; begin < full.size();) {
    const auto end = full.find('\n', begin) + 1;
    (void)outcome(full.substr(0, begin) + full.substr(end));
    (void)outcome(full.substr(0, end) + full.substr(begin));
    begin = end;
  }
}

TEST(HostileFile, every_value_of_another_type_is_a_model_or_an_error) {
  for (std::size_t begin = 0; begin < full.size();) {
    const auto end = full.find('\n', begin);
    const auto equals = full.find(" = ", begin);
    if (equals < end)
      for (const char* other : {"1", "-1e49", "true", "'x1'", "'gap_wall_upper'", "[]", "{}", "[[1, 0], [0, 1]]",
                                "[{}]", "['x1', 'shaker']", "nan", "1e300", "07:32:00"})
        (void)outcome(full.substr(0, equals + 3) + other + full.substr(end));
    begin = end + 1;
  }
}

TEST(HostileFile, random_pieces_are_a_model_or_an_error) {
  const std::vector<std::string> pieces = {"[",
                                           "]",
                                           "\n",
                                           "\r\n",
                                           "=",
                                           "{",
                                           "}",
                                           "\"",
                                           "'",
                                           "\"\"\"",
                                           "a",
                                           ".",
                                           ",",
                                           "1",
                                           "e",
                                           "-",
                                           "#",
                                           "[[stop]]\n",
                                           "[parameters]\n",
                                           "omega",
                                           "name",
                                           "\\u0000",
                                           "\\U0010FFFF",
                                           "inf",
                                           "nan",
                                           "0x",
                                           "true",
                                           "1979-05-27",
                                           "\xef\xbb\xbf",
                                           "\xff",
                                           " ",
                                           std::string(1, '\0'),
                                           "between",
                                           "ground"};
  std::mt19937 random(2);
  for (int i = 0; i < 60000; ++i) {
    std::string text;
    for (auto length = random() % 24; length-- > 0;) text += pieces[random() % pieces.size()];
    (void)outcome(text);
  }
}

TEST(HostileFile, assertion_of_the_parser_is_an_error) {
  EXPECT_EQ(outcome("[\n").substr(0, 8), "f.toml:1");  // toml++ 3.3 aborts here unless NDEBUG is defined
  EXPECT_EQ(outcome("").substr(0, 8), "f.toml:1");
  EXPECT_EQ(outcome("[[\n").substr(0, 8), "f.toml:1");
}

TEST(HostileFile, deep_nesting_ends_in_an_error) {
  const auto repeated = [](const std::string& piece, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += piece;
    return text;
  };
  for (const char* piece : {"[", "{b=", "[{b="})  // unbounded, tables in tables take minutes
    EXPECT_NE(outcome("a = " + repeated(piece, 200000)).find("dots or brackets in one place"), std::string::npos)
        << piece;
  EXPECT_NE(outcome("a = " + repeated("[\n", 400000)).substr(0, 7), "accepted");
  EXPECT_NE(outcome("a = " + repeated("{a=", 1000)), "accepted");
  EXPECT_NE(outcome("a" + repeated(".a", 400000) + " = 1").find("dots or brackets in one place"), std::string::npos);
  EXPECT_NE(outcome("a" + repeated(".a", 2000) + " = 1").find("nested more than 16 deep"), std::string::npos);
  EXPECT_NE(outcome("[a" + repeated(".a", 2000) + "]\na" + repeated(".a", 2000) + " = 1"), "accepted");
  EXPECT_NE(outcome("[a" + repeated(".a", 2000) + "]\nb = " + repeated("[\n{a" + repeated(".a", 2000) + " = ", 8)),
            "accepted");
  EXPECT_NE(outcome("b = " + repeated("[\n{a" + repeated(".a", 2000) + " = ", 4) + "1" + repeated("}]", 4)),
            "accepted");
}

TEST(HostileFile, size_and_bytes) {
  EXPECT_EQ(outcome(std::string(5 << 20, '\n')), "f.toml: larger than 1048576 bytes");
  EXPECT_EQ(outcome("name = 'a'\n" + std::string(1, '\0')), "f.toml:2: a NUL byte");
  EXPECT_EQ(outcome("name = '\xff'").substr(0, 10), "f.toml:1: ");
  EXPECT_EQ(outcome("name = '\xed\xa0\x80'").substr(0, 10), "f.toml:1: ");  // a lone surrogate
  EXPECT_EQ(outcome("name = 'a'\nname = 'b'").substr(0, 10), "f.toml:2: ");
  EXPECT_EQ(outcome("[a]\n[a]\n").substr(0, 10), "f.toml:2: ");
  std::string many = "name = 'a'\n[parameters]\n";
  const auto name = [](int i) { return std::string(1, 'p').append(std::to_string(i)); };
  for (int i = 0; i < 1001; ++i) many += name(i) + " = 1\n";
  EXPECT_NE(outcome(many).find("more than 1000 entries"), std::string::npos);
  std::string chain = "name = 'a'\n[parameters]\n";
  for (int i = 0; i < 999; ++i) chain += name(i) + " = '" + name(i + 1) + "'\n";
  EXPECT_EQ(outcome(chain + "p999 = 1\n[[coordinate]]\nname = 'x'\nmass = 'p0'\n"), "accepted");
}

TEST(HostileFile, byte_order_mark_and_windows_line_ends_are_harmless) {
  std::string windows = "\xef\xbb\xbf";
  for (const char c : whole) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto definition = ModelDefinition::parse(windows, "f.toml");
  EXPECT_EQ(definition.to_toml(), whole);
}

TEST(HostileFile, names_that_are_no_regular_file) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      (void)load_model(path);
    } catch (const InputError& error) {
      return error.what();
    } catch (const StorageError& error) {
      return std::string("storage: ") + error.what();
    }
    return "accepted";
  };
  const auto folder = fs::temp_directory_path() / ("slapstick-model-" + std::to_string(::getpid()));
  fs::create_directories(folder / "folder.toml");
  ASSERT_EQ(::mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  fs::create_symlink("loop.toml", folder / "loop.toml");
  const auto named = [&](const char* name) { return "storage: model file '" + (folder / name).string() + "': "; };
  EXPECT_EQ(message(folder / "none.toml"), named("none.toml") + "no such file");
  EXPECT_EQ(message(folder / "folder.toml"), named("folder.toml") + "a folder, not a file");
  EXPECT_EQ(message(folder / "pipe.toml"), named("pipe.toml") + "not a regular file");
  EXPECT_EQ(message(folder / "loop.toml"), named("loop.toml") + "Too many levels of symbolic links");
  EXPECT_EQ(message("vibro-impct"),
            "unknown model 'vibro-impct'; did you mean 'vibro-impact'? (a model file's path ends in .toml)");
  std::string known;
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < most; ++i) known += builtin_models()[i] + ", ";
  known += "...";
  EXPECT_EQ(message(""), "unknown model ''; known: " + known + " (a model file's path ends in .toml)");
  std::ofstream(folder / "own.toml") << whole;
  expect_same(load_model(folder / "own.toml").build(), load_model("vibro-impact").build());
  fs::remove_all(folder);
}

}  // namespace
}  // namespace slapstick
