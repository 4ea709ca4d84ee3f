/// toml++ 3.3 asks of every character beyond ASCII whether it is a blank, and for some of them reaches what it says cannot be reached:
/// undefined behaviour, found by fuzz/model_file.cpp. Such characters are for strings and comments only, and are refused elsewhere.
#include <gtest/gtest.h>

#include "io/refusal.hpp"

namespace slapstick {
namespace {

TEST(TomlText, characters_beyond_ascii_are_refused_outside_of_strings_and_comments) {
  for (const std::string character :
       {"\xc2\xa1", "\xc3\xa9", "\xd2\x99", "\xe1\x9a\x80", "\xe2\x80\x83", "\xef\xbb\xbf", "\xf0\x9d\x84\x9e"})
    for (const std::string before : {"a = 1", "a = ", "a = [1", "a = {b = 2", "", "[", "a = 'b'", "a = \"\\\"\"",
                                     "a = ''", "a = \"\"\"\"\"\"\"\"", "a = '''''b'''''", "# '\nb = 3 ", "a = 1'"})
      EXPECT_NE(refusal("\n" + before + character + " ")
                    .find("character '" + character + "' has no meaning outside of quotes"),
                std::string::npos)
          << before;
}

TEST(TomlText, a_byte_that_is_no_character_is_named_with_its_line) {
  EXPECT_EQ(refusal("\n\na = 1\xff"), "f.toml:3: character '\\xff' has no meaning outside of quotes");
}

TEST(TomlText, quotes_in_strings_and_comments_do_not_mislead) {
  const std::string model = "\n[[coordinate]]\nname = 'x'\nmass = 1\n";
  for (const std::string text :
       {"summary = 'é'", "notes = '''é''é'''  # é", "notes = \"\"\"\"é\"\"é\"\"\"\"\"  # é",
        "summary = \"\\\\\"  # \"é", "summary = \"\\\"é\"", "notes = '''é'''''", "notes = \"\"\"\\\n  é\"\"\""})
    EXPECT_EQ(refusal("name = 'm'  # é \" '\n" + text + model), "accepted") << text;
}

}  // namespace
}  // namespace slapstick
