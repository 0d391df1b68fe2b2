// Groups of findings.
#include "app/output/findings.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(Findings, ThoseThatDifferInNamesNumbersAndPlacesAreOneGroup) {
    Diagnostics found;
    found.warning({"w.sdf", 3}, "mass", "link 'a' of 'car_0' has a mass of 1e-05 kg", "give more");
    found.warning({"w.sdf", 9}, "mass", "link 'b' of 'car_12' has a mass of 3e-07 kg", "give more");
    found.warning({"w.sdf", 9}, "mass", "link 'b' of 'car_12' has no mass", "give one");
    found.error({"w.sdf", 4}, "mass", "link 'c' of 'car_1' has a mass of 1e-05 kg", "give more");
    const auto warnings = group_findings(found, Severity::kWarning);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].first->where.line, 3);
    EXPECT_EQ(warnings[0].more, 1u);
    EXPECT_EQ(warnings[1].more, 0u);
    EXPECT_EQ(group_findings(found, Severity::kError).size(), 1u) << "severities are not mixed";
    EXPECT_TRUE(group_findings(found, Severity::kNote).empty());
}

TEST(Findings, AGroupSaysHowManyMoreInTheLineOfTheMessage) {
    Diagnostics found;
    for (int line = 1; line < 4; ++line) found.note({"w.sdf", line}, "x", "joint 'j' is odd", "fix it");
    const std::string text = to_text(group_findings(found, Severity::kNote).front());
    EXPECT_NE(text.find("[x] (and 2 more like it)\n"), std::string::npos) << text;
    EXPECT_NE(text.find("fix it"), std::string::npos) << text;
}

}  // namespace
}  // namespace roboss
