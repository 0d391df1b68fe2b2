// The names of a world as text.
#include "app/worlds/world_names.h"

#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

TEST(WorldNames, ConsecutiveNumbersAreShortenedFromFiveOn) {
    EXPECT_EQ(shortened({"car_1", "car_2", "car_3", "car_4"}), "car_1, car_2, car_3, car_4");
    EXPECT_EQ(shortened({"car_8", "car_9", "car_10", "car_11", "car_12", "bus"}),
              "car_8 ... car_12 (5), bus");
    EXPECT_EQ(shortened({"a0", "a1", "b2", "a2", "x_01", "x_02", "7"}), "a0, a1, b2, a2, x_01, x_02, 7");
    EXPECT_EQ(shortened({}), "");
}

TEST(WorldNames, AllRobotsLinksJointsSensorsAndCommandsAreListed) {
    Diagnostics diagnostics;
    const auto world = load_world(ROBOSS_WORLDS "/crossroads.sdf", {}, diagnostics);
    ASSERT_TRUE(world);
    const auto model = compile(*world, {}, diagnostics);
    ASSERT_TRUE(model);
    const std::vector<TypeNames> types = list_names(*model, *world);
    std::size_t robots = 0;
    for (const TypeNames& type : types) robots += type.robots.size();
    EXPECT_EQ(robots, model->robots.size());
    const std::string text = to_text(types);
    for (const char* name : {"car_0 ... car_15 (16)", "front_left (continuous)", "laser (", "chassis"})
        EXPECT_NE(text.find(name), std::string::npos) << name << " in\n" << text;
}

TEST(WorldNames, LinksOfUrdfThatAreFramesAreListedWithTheirLink) {
    Diagnostics diagnostics;
    const std::string mass =
        "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    const auto world = load_world_text("<robot name='r'><link name='arm'>" + mass +
                                           "</link><link name='tip'/><joint name='weld' type='fixed'>"
                                           "<parent link='arm'/><child link='tip'/></joint></robot>",
                                       "r.urdf", {}, diagnostics);
    ASSERT_TRUE(world);
    const std::vector<TypeNames> types = list_names(*compile(*world, {}, diagnostics), *world);
    ASSERT_EQ(types.size(), 1u);
    EXPECT_EQ(types[0].frames, (std::vector<NamedFrame>{{"tip", "arm"}}));
    EXPECT_NE(to_text(types).find("tip (on arm)"), std::string::npos) << to_text(types);
}

}  // namespace
}  // namespace roboss
