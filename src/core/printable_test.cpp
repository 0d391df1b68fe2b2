#include "core/printable.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(Printable, WordsOfAllLanguagesPass) {
    for (const char* text : {"", "a line\n\tand another", "Größe", "機器人 🤖", "naïve ½ µ €"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, NoEscapeSequenceIsLeft) {
    EXPECT_EQ(printable("\x1b]0;title\x07\x1b[2J"), "?]0;title??[2J");
    EXPECT_EQ(printable("\x7f\r\b" + std::string(1, '\0')), "????");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "?31m")
        << "CSI as one character";
    EXPECT_EQ(printable("\x9b"
                        "31m"),
              "?31m")
        << "CSI as one byte";
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "fds.dlrow"),
              "?fds.dlrow")
        << "right to left";
}

TEST(Printable, WhatIsNoUtf8IsReplacedByteByByte) {
    EXPECT_EQ(printable("\xc3"), "?") << "cut";
    EXPECT_EQ(printable("\xc3("), "?(");
    EXPECT_EQ(printable("\xc0\x9b"), "??") << "longer than needed";
    EXPECT_EQ(printable("\xe0\x82\x9b"), "???");
    EXPECT_EQ(printable("\xed\xa0\x80"), "???") << "half of a pair";
    EXPECT_EQ(printable("\xf5\x80\x80\x80"), "????");
}

TEST(Printable, ALineIsOneLine) {
    EXPECT_EQ(printable_line("a\nb\tc\xe2\x80\xa8"
                             "d\r"),
              "a b c?d?");
}

TEST(Printable, EveryByteAndEveryPairGivesTextThatIsLeftAlone) {
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b) {
            const std::string text{static_cast<char>(a), static_cast<char>(b)};
            const std::string shown = printable(text);
            EXPECT_EQ(printable(shown), shown) << a << ' ' << b;
            for (const char c : shown)
                EXPECT_TRUE(c == '\n' || c == '\t' || static_cast<unsigned char>(c) >= 0x20);
        }
}

}  // namespace
}  // namespace roboss
