#include "drivers/printable_text.h"

#include <gtest/gtest.h>

#include "drivers/quoted.h"

namespace mocap {
namespace {

TEST(PrintableText, LettersOfAllLanguagesStay) {
  for (const char* text :
       {"plain", "Jürgen", "カメラ", "кино 😀", "می‌خواهم 👩‍🔬", "a\\b \"c\""}) {
    EXPECT_EQ(Printable(text), text);
  }
}

TEST(PrintableText, ControlCharactersAreSpelledOut) {
  EXPECT_EQ(Printable("a\x1b]0;owned\x07z"), "a\\x1b]0;owned\\x07z");
  EXPECT_EQ(Printable("\r\x7f\t"), "\\x0d\\x7f\\x09");
  EXPECT_EQ(Printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(Printable("\xc2\x9b"
                      "31m"),
            "\\u{9b}31m")
      << "C1 as UTF-8";
}

TEST(PrintableText, ANameForgesNoLine) {
  EXPECT_EQ(Printable("x\nmocapd: error: forged"), "x\\x0amocapd: error: forged");
  EXPECT_EQ(Printable("a\xe2\x80\xa8"
                      "b\xc2\x85"
                      "c"),
            "a\\u{2028}b\\u{85}c");
  EXPECT_EQ(PrintableLines("a\nb\r\x1b"), "a\nb\\x0d\\x1b");
}

TEST(PrintableText, WhatTurnsTheDirectionOfWritingIsSpelledOut) {
  EXPECT_EQ(Printable("\xe2\x80\xae"
                      "gnp\xe2\x81\xa6"),
            "\\u{202e}gnp\\u{2066}");
}

TEST(PrintableText, WhatNobodySeesIsSpelledOut) {
  EXPECT_EQ(Printable("a\xe2\x80\x8b"
                      "b\xef\xbb\xbf\xf3\xa0\x81\x81"),
            "a\\u{200b}b\\u{feff}\\u{e0041}");
}

TEST(PrintableText, BytesThatAreNoUtf8AreSpelledOut) {
  EXPECT_EQ(Printable("a\xff\xc3"), "a\\xff\\xc3");
  EXPECT_EQ(Printable("\x9b"
                      "31m"),
            "\\x9b31m")
      << "C1 as a byte";
  EXPECT_EQ(Printable("\xc0\x8a"), "\\xc0\\x8a") << "a line's end written too long";
  EXPECT_EQ(Printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a character";
  EXPECT_EQ(Printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last one";
  EXPECT_EQ(Printable("\xe2\x82"), "\\xe2\\x82") << "cut off";
}

TEST(PrintableText, IsShortenedBetweenCharacters) {
  EXPECT_EQ(Shortened("äöü", 3), "äöü");
  EXPECT_EQ(Shortened("äöü", 2), "äö...");
  EXPECT_EQ(Quoted(std::string(50, 'x')), std::string("\"").append(40, 'x').append("...\""));
}

TEST(PrintableText, CountsOneThing) {
  EXPECT_EQ(Counted(1, "frame"), "1 frame");
  EXPECT_EQ(Counted(0, "frame"), "0 frames");
  EXPECT_EQ(Counted(2u, "frame"), "2 frames");
}

}  // namespace
}  // namespace mocap
