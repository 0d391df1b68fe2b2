// Diagnostics keep everything in order, count by severity and print as an editor can jump to.
#include "core/diagnostics.h"

#include <gtest/gtest.h>

#include <string>

namespace roboss {
namespace {

/// The text of the one warning given.
std::string text_of(const SourceLocation& where, const char* code, const char* remedy) {
    Diagnostics diagnostics;
    diagnostics.warning(where, code, "link 'arm' has no inertial", remedy);
    return to_text(diagnostics.items().at(0));
}

TEST(Diagnostics, PrintsFileLineSeverityMessageCodeAndRemedy) {
    EXPECT_EQ(text_of({"city.sdf", 12}, "missing-inertia", "add <inertial>"),
              "city.sdf:12: warning: link 'arm' has no inertial [missing-inertia]\n    add <inertial>");
}

TEST(Diagnostics, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ(text_of({}, "", ""), "warning: link 'arm' has no inertial");
    EXPECT_EQ(text_of({"a.sdf", 0}, "", ""), "a.sdf: warning: link 'arm' has no inertial");
}

TEST(Diagnostics, NamesEverySeverity) {
    EXPECT_STREQ(to_text(Severity::kNote), "note");
    EXPECT_STREQ(to_text(Severity::kWarning), "warning");
    EXPECT_STREQ(to_text(Severity::kError), "error");
}

TEST(Diagnostics, KeepsTheOrderAndCountsBySeverity) {
    Diagnostics diagnostics;
    diagnostics.note({"a", 3}, "n", "first");
    diagnostics.warning({"a", 2}, "w", "second");
    diagnostics.warning({"a", 1}, "w", "third");
    EXPECT_EQ(diagnostics.count(Severity::kNote), 1u);
    EXPECT_EQ(diagnostics.count(Severity::kWarning), 2u);
    EXPECT_EQ(diagnostics.count(Severity::kError), 0u);
    ASSERT_EQ(diagnostics.items().size(), 3u);
    EXPECT_EQ(diagnostics.items()[2].message, "third");
}

TEST(Diagnostics, OnlyAnErrorIsAnError) {
    Diagnostics diagnostics;
    diagnostics.note({}, "n", "note");
    diagnostics.warning({}, "w", "warning");
    EXPECT_FALSE(diagnostics.has_errors());
    diagnostics.error({}, "e", "error");
    EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace roboss
