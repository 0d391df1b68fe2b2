// <population>: the number of clones, where they stand, and that they stand there every time.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

Loaded populate(const std::string& region, const std::string& distribution, int count = 4) {
    return load_elements("<population name='p'><model name='x'>" + link("a") +
                         "</model><pose>10 20 0 0 0 0</pose>" + region + "<model_count>" +
                         std::to_string(count) + "</model_count><distribution>" + distribution +
                         "</distribution></population>");
}

const std::string kBox = "<box><size>8 4 2</size></box>";

TEST(Population, GridIsCentredOnItsPose) {
    const Loaded loaded = populate("", "<type>grid</type><rows>2</rows><cols>3</cols><step>2 3 0</step>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 6u) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes.size(), 1u);
    EXPECT_EQ(loaded.world->instances[0].name, "x_clone_0");
    EXPECT_EQ(loaded.world->instances[0].X_WM.p, (Vec3{8, 18.5, 0}));
    EXPECT_EQ(loaded.world->instances[5].X_WM.p, (Vec3{12, 21.5, 0}));
}

TEST(Population, LinearStandsInARow) {
    const Loaded loaded = populate(kBox, "<type>linear-x</type>");
    ASSERT_EQ(loaded.world->instances.size(), 4u) << loaded.text();
    EXPECT_EQ(loaded.world->instances[0].X_WM.p, (Vec3{6, 20, 0}));
    EXPECT_EQ(loaded.world->instances[3].X_WM.p, (Vec3{12, 20, 0}));
    EXPECT_EQ(populate(kBox, "<type>linear-z</type>").world->instances[0].X_WM.p, (Vec3{10, 20, -1}));
}

TEST(Population, RandomStaysInItsRegionAndIsTheSameEveryTime) {
    for (const std::string type : {"<type>random</type>", "<type>uniform</type>"}) {
        const Loaded first = populate(kBox, type, 50), again = populate(kBox, type, 50);
        ASSERT_EQ(first.world->instances.size(), 50u) << first.text();
        for (std::size_t i = 0; i < 50; ++i) {
            const Vec3 p = first.world->instances[i].X_WM.p;
            EXPECT_LE(std::fabs(p.x - 10), 4);
            EXPECT_LE(std::fabs(p.y - 20), 2);
            EXPECT_EQ(p, again.world->instances[i].X_WM.p);
            if (i > 0) {
                EXPECT_NE(p, first.world->instances[i - 1].X_WM.p);
            }
        }
    }
    const Loaded round =
        populate("<cylinder><radius>2</radius><length>1</length></cylinder>", "<type>random</type>", 50);
    for (const ModelInstance& i : round.world->instances) {
        EXPECT_LE(norm(i.X_WM.p - Vec3{10, 20, i.X_WM.p.z}), 2.0);
        EXPECT_GE(i.X_WM.p.z, 0);
    }
}

TEST(Population, ThatMakesNoSenseIsAnError) {
    EXPECT_NE(populate("", "<type>random</type>").find("population"), nullptr);
    EXPECT_NE(populate(kBox, "<type>heaped</type>").find("population"), nullptr);
    EXPECT_NE(populate(kBox, "<type>random</type>", 0).find("population"), nullptr);
    EXPECT_NE(populate("<cylinder><radius>1</radius></cylinder>", "<type>linear-x</type>").find("population"),
              nullptr);
}

}  // namespace
}  // namespace roboss
