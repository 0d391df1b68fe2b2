// The quick cases of ./bench.sh accuracy, on RoBOSS, as plain tests: the same figures, truths and bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "accuracy/case.h"
#include "engines/makers.h"

namespace roboss::bench {

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.title;
}

namespace {

std::vector<Case> quick_cases() {
    std::vector<Case> cases = all_cases();
    std::erase_if(cases, [](const Case& c) { return c.slow; });
    return cases;
}

class AccuracyCase : public testing::TestWithParam<Case> {};

TEST_P(AccuracyCase, KeepsItsBounds) {
    const EngineKind roboss{"RoBOSS", make_roboss};
    Contender contender;
    contender.kind = &roboss;
    contender.dt_s = GetParam().dt_s;
    const Outcome outcome = GetParam().run(contender);
    ASSERT_TRUE(outcome.possible);
    ASSERT_EQ(outcome.figures.size(), GetParam().quantities.size());
    for (std::size_t i = 0; i < outcome.figures.size(); ++i) {
        const Quantity& q = GetParam().quantities[i];
        std::printf("    measured: %s = %.6g %s\n", q.name.c_str(), outcome.figures[i], q.unit.c_str());
        EXPECT_TRUE(passes(q, outcome.figures[i])) << q.name << ": " << outcome.figures[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Quick, AccuracyCase, testing::ValuesIn(quick_cases()), [](const auto& c) {
    std::string name = c.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace roboss::bench
