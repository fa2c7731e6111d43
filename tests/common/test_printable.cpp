// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>

namespace pcl_als {
namespace {

TEST(Printable, KeepsTextOfEveryLanguage) {
  for (const char* text : {"", "strip 7, \"a\"", "Bäume – 5 µm", "高度", "\xF0\x9F\x9B\xA9"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesWhatControlsATerminalAndWhatIsNoText) {
  EXPECT_EQ(printable("a\x1b[31m\x7f"), "a?[31m?");
  EXPECT_EQ(printable("a\tb\r\nc"), "a b  c");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "?31m");                            // U+009B, an escape sequence in one character
  EXPECT_EQ(printable("B\xE4ume"), "B?ume");    // Latin-1
  EXPECT_EQ(printable("\xC3"), "?");            // half a character
  EXPECT_EQ(printable("\xED\xA0\x80"), "???");  // half of a pair of UTF-16
  EXPECT_EQ(printable("\xC0\xAF"), "??");       // a form longer than needed
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("äöü", 3), "äöü");
  EXPECT_EQ(printable("äöü", 2), "äö...");
}

// Messages quote files in many places: none may reach the terminal as it is.
TEST(Printable, IsEveryMessageOfAnError) {
  EXPECT_STREQ(InputError("x.las: field '\x01\x1b[2J\xFF'").what(), "x.las: field '??[2J?'");
  EXPECT_STREQ(UsageError("strip '\n'").what(), "strip ' '");
}

}  // namespace
}  // namespace pcl_als
