// Numbers in text are read whole or not at all.
#include "core/number_text.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(NumberText, ReadsWholeNumbersOnly) {
    EXPECT_EQ(read_number("1.5"), 1.5);
    EXPECT_EQ(read_number("+2"), 2.0);
    EXPECT_EQ(read_number("-3e2"), -300.0);
    EXPECT_EQ(read_number("1e-400"), 0.0) << "too small for a double";
    for (const char* text : {"", "+", "1.5x", " 1", "1 ", "0x10", "1,5", "1e400", "inf", "nan", "--1"})
        EXPECT_FALSE(read_number(text)) << text;
    EXPECT_TRUE(parse_number("inf")) << "SDFormat writes it";
}

}  // namespace
}  // namespace roboss
