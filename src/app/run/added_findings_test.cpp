// Findings about models that are added to a run: names, groups, numbers.
#include "app/run/added_findings.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(AddedFindings, BearTheNameThatTheSenderKnows) {
    Diagnostics found;
    found.warning({"/tmp/add-1/quad.urdf", 3}, "x", "a file /tmp/add-1/quad.urdf of /tmp/add-1/quad.urdf",
                  "Mend it.");
    const Diagnostics named = under_name(found, "/tmp/add-1/quad.urdf", "robots/quad.urdf");
    ASSERT_EQ(named.items().size(), 1u);
    EXPECT_EQ(named.items()[0].where.file, "robots/quad.urdf");
    EXPECT_EQ(named.items()[0].where.line, 3);
    EXPECT_EQ(named.items()[0].message, "a file robots/quad.urdf of robots/quad.urdf");
    EXPECT_EQ(named.items()[0].remedy, "Mend it.");
}

TEST(AddedFindings, AreToldInGroupsErrorsFirstWithoutOrdinaryNotes) {
    Diagnostics found;
    found.note({}, "detail", "ordinary");
    found.note({}, "start-on-ground", "'a' stands");
    for (const char* link : {"'a'", "'b'", "'c'"})
        found.warning({}, "w", "link " + std::string(link) + " lacks mass");
    found.error({}, "e", "broken");
    const std::vector<std::string> lines = told_findings(found);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NE(lines[0].find("broken"), std::string::npos);
    EXPECT_NE(lines[1].find("'a'"), std::string::npos);
    EXPECT_NE(lines[1].find("2 more"), std::string::npos) << lines[1];
    EXPECT_NE(lines[2].find("stands"), std::string::npos);
}

TEST(AddedFindings, OfManyKindsSomeAreToldAndTheRestIsCounted) {
    Diagnostics found;
    for (int i = 0; i < 23; ++i) found.warning({}, "w" + std::to_string(i), "one of a kind");
    const std::vector<std::string> lines = told_findings(found);
    ASSERT_EQ(lines.size(), 21u);
    EXPECT_EQ(lines.back().find("3 more findings"), 0u) << lines.back();
}

}  // namespace
}  // namespace roboss
