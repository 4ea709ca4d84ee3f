/// toml++ 3.3 asks of characters beyond ASCII whether they are blanks, and for some of them reaches what it says cannot
/// be reached: undefined behaviour (./dev sanitize sees it), found by fuzz/model_file.cpp.
#include <gtest/gtest.h>

#include <vector>

#include "io/refusal.hpp"

namespace slapstick {
namespace {

const std::vector<std::string> characters = {"\xc2\xa1",     "\xc3\xa9",     "\xd2\x99",     "\xe1\x9a\x81",
                                             "\xe2\x80\x8c", "\xe2\x81\xa1", "\xef\xbb\xbe", "\xf0\x9d\x84\x9e"};

TEST(TomlText, characters_beyond_ascii_are_refused_outside_of_strings_and_comments) {
  for (const auto& character : characters)
    for (const std::string before :
         {"a = 1", "a = ", "a = [1", "a = {b = 2", "", "[", "a = 'b'", "a = \"\\\"\"", "a = ''", "# '\na = 3 ",
          "a = 1'", "a=1n=-nae='ns/-", "a = 2024-01-01", "a = 0x", "a = inf"})
      EXPECT_EQ(refusal("\n" + before + character + "\n").substr(0, 7), "f.toml:") << before << character;
}

TEST(TomlText, a_byte_that_is_no_character_is_refused_at_its_line) {
  EXPECT_EQ(refusal("\n\na = 1\xff").substr(0, 9), "f.toml:3:");
}

TEST(TomlText, characters_beyond_ascii_are_text_in_strings_and_comments) {
  const std::string model = "\n[[coordinate]]\nname = 'x'\nmass = 1\n";
  for (const auto& c : characters)
    for (const std::string& text : {"summary = '" + c + "'", "notes = '''" + c + "''" + c + "'''  # " + c,
                                    "notes = \"\"\"\\\n  " + c + "\"\"\"", "summary = \"\\\"" + c + "\""})
      EXPECT_EQ(refusal("name = 'm'  # " + c + " \" '\n" + text + model), "accepted") << text;
}

}  // namespace
}  // namespace slapstick
