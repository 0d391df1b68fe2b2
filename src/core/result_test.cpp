// A Result holds its value or its Error, and taking the wrong one ends the program with the reason.
#include "core/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/error_text.h"

namespace roboss {
namespace {

Result<int> half_of(int number) {
    if (number % 2 != 0) return Error{"7 is odd", "give an even number"};
    return number / 2;
}

TEST(Result, HoldsAValue) {
    const Result<int> result = half_of(8);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(static_cast<bool>(result));
    EXPECT_EQ(result.value(), 4);
}

TEST(Result, HoldsAnErrorWithItsRemedy) {
    const Result<int> result = half_of(7);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().text(), "7 is odd\n  remedy: give an even number");
    EXPECT_EQ((Error{"no remedy", ""}).text(), "no remedy");
}

TEST(Result, MovesOutWhatCannotBeCopied) {
    Result<std::unique_ptr<int>> result(std::make_unique<int>(3));
    const std::unique_ptr<int> taken = std::move(result).value();
    EXPECT_EQ(*taken, 3);
}

TEST(ErrorOfText, TakesTheRemedyOfTheTextBeforeItsOwn) {
    const Error with = error_of_text("it threw: ", Error{"7 is odd", "give 8"}.text(), "mend it", "failed");
    EXPECT_EQ(with.text(), "it threw: 7 is odd [failed]\n  remedy: give 8");
    const Error without = error_of_text("it threw: ", "7 is odd", "mend it", "failed");
    EXPECT_EQ(without.text(), "it threw: 7 is odd [failed]\n  remedy: mend it");
}

TEST(ResultDeathTest, TakingTheValueOfAnErrorEndsTheProgramWithTheReason) {
    const Result<int> result = half_of(7);
    EXPECT_DEATH(static_cast<void>(result.value()), "internal error at .*7 is odd");
}

TEST(Result, OkIsAResultWithoutAValue) {
    const Result<> result = Ok{};
    EXPECT_TRUE(result.ok());
}

}  // namespace
}  // namespace roboss
