/// Hostile names in messages: nothing that a terminal would obey, nothing that is no text.
#include "base/text.hpp"

#include <gtest/gtest.h>

namespace slapstick {
namespace {

TEST(Quotes, characters_of_every_length_stay) {
  for (const std::string text :
       {"", "a b", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9d\x84\x9e", "\xc2\xa0", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(in_quotes(text), "'" + text + "'");
}

TEST(Quotes, control_characters_are_spelt_out) {
  EXPECT_EQ(in_quotes(std::string_view("\0\n\x1b[31m\x7f", 8)), "'\\x00\\x0a\\x1b[31m\\x7f'");
  EXPECT_EQ(in_quotes("\xc2\x9b"), "'\\xc2\\x9b'");  // U+009B begins an escape sequence, too
}

TEST(Quotes, bytes_that_are_no_utf8_are_spelt_out) {
  EXPECT_EQ(in_quotes("\xff"), "'\\xff'");
  EXPECT_EQ(in_quotes("\xc3"), "'\\xc3'");           // cut off
  EXPECT_EQ(in_quotes("\xc3("), "'\\xc3('");         // not continued
  EXPECT_EQ(in_quotes("\x80"), "'\\x80'");           // a continuation alone
  EXPECT_EQ(in_quotes("\xc0\xaf"), "'\\xc0\\xaf'");  // longer than needed, in two, three and four bytes
  EXPECT_EQ(in_quotes("\xe0\x9f\xbf"), "'\\xe0\\x9f\\xbf'");
  EXPECT_EQ(in_quotes("\xf0\x8f\xbf\xbf"), "'\\xf0\\x8f\\xbf\\xbf'");
  EXPECT_EQ(in_quotes("\xed\xa0\x80"), "'\\xed\\xa0\\x80'");           // a surrogate
  EXPECT_EQ(in_quotes("\xf4\x90\x80\x80"), "'\\xf4\\x90\\x80\\x80'");  // beyond U+10FFFF
}

TEST(Quotes, a_cut_does_not_halve_a_character) {
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(100, 'x') + "'");
  EXPECT_EQ(in_quotes(std::string(101, 'x')), "'" + std::string(100, 'x') + "...'");
  EXPECT_EQ(in_quotes(std::string(99, 'x') + "\xc3\xa9"), "'" + std::string(99, 'x') + "...'");
}

}  // namespace
}  // namespace slapstick
