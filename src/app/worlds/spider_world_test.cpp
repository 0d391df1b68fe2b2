// Generated spiders: terrains are what their options say.
#include "app/worlds/spider_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/worlds/spider_body.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

TEST(SpiderWorld, AnUnknownTerrainIsEmpty) {
    SpiderOptions options;
    options.terrain = "swamp";
    EXPECT_EQ(spider_sdf(options), "");
}

TEST(SpiderWorld, OfEveryTerrainHasTheMassAndMotorsThatWereAsked) {
    for (const char* terrain : {"flat", "rubble", "slope", "steps"}) {
        SpiderOptions options;
        options.spiders = 3, options.terrain = terrain, options.motor_torque = 2.5, options.motor_speed = 6;
        Diagnostics diagnostics;
        const auto world = load_world_text(spider_sdf(options), "spiders.sdf", {}, diagnostics);
        ASSERT_TRUE(world);
        EXPECT_TRUE(diagnostics.items().empty()) << terrain;
        ASSERT_EQ(world->instances.size(), 4u) << "the ground and the spiders";
        const ModelSpec& spider = world->prototypes[world->instances[1].prototype];
        double mass = 0;
        for (const LinkSpec& link : spider.links) mass += link.mass;
        EXPECT_NEAR(mass, spider::kMass, 1e-12);
        ASSERT_EQ(spider.joints.size(), spider::kJoints);
        for (const JointSpec& joint : spider.joints) {
            EXPECT_EQ(joint.axes[0].max_effort, 2.5);
            EXPECT_EQ(joint.axes[0].max_velocity, 6);
        }
    }
}

}  // namespace
}  // namespace roboss
