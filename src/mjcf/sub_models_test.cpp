// <attach> and <replicate>: whose names, settings and actuators the copies have. The numbers are MuJoCo's.
#include "mjcf/sub_models.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "mjcf/test_files.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

using mjcf_test::load_bodies;
using mjcf_test::load_text;
using mjcf_test::Loaded;

constexpr const char* kArm = R"(<mujoco model='arm'>
  <compiler angle='radian'/>
  <option gravity='0 0 0'/>
  <default><geom size='.1'/><default class='thick'><geom size='.2'/></default></default>
  <worldbody>
    <geom name='foot'/>
    <frame name='mount' pos='0 0 1' childclass='thick'>
      <body name='upper' pos='1 0 0'>
        <joint name='shoulder' range='0 1'/><geom name='shell'/>
        <body name='lower' pos='0 1 0'><joint name='elbow'/><geom/><site name='tip' pos='0 1 0'/></body>
      </body>
    </frame>
  </worldbody>
  <actuator><motor name='m' joint='elbow' ctrlrange='-3 3'/></actuator>
  <sensor><jointpos joint='shoulder'/><jointpos joint='elbow'/></sensor>
  <contact><exclude body1='upper' body2='lower'/></contact>
</mujoco>)";

class SubModelsTest : public ::testing::Test {
  protected:
    SubModelsTest() : folder_(fs::temp_directory_path() / ("roboss-attach-" + std::to_string(getpid()))) {
        fs::create_directories(folder_);
        std::ofstream(folder_ / "arm.xml") << kArm;
    }
    ~SubModelsTest() override { fs::remove_all(folder_); }

    Loaded load(const std::string& bodies, const std::string& model = "name='arm' file='arm.xml'") const {
        return load_text("<mujoco><asset><model " + model +
                             "/></asset><default><geom size='.7'/></default><worldbody>" + bodies +
                             "</worldbody></mujoco>",
                         (folder_ / "main.xml").string());
    }

    fs::path folder_;
};

TEST_F(SubModelsTest, ABodyComesWithItsOwnSettingsClassesAndActuators) {
    const Loaded loaded = load("<frame pos='0 0 10'><attach model='arm' body='upper' prefix='a_'/></frame>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 1u);
    EXPECT_EQ(loaded.world->instances[0].X_WM.p, (Vec3{1, 0, 10}));  // without the frame around it
    EXPECT_EQ(loaded.world->gravity.z, -9.81);
    const ModelSpec& arm = *loaded.model("a_upper");
    ASSERT_EQ(arm.joints.size(), 2u);
    EXPECT_EQ(arm.joints[0].name, "shoulder");
    EXPECT_EQ(arm.joints[0].axes[0].upper, 1);
    EXPECT_EQ(arm.joints[1].axes[0].max_effort, 3);
    EXPECT_EQ(arm.links[0].collisions[0].geometry.radius, .2);
    ASSERT_EQ(arm.no_contact.size(), 1u);
    ASSERT_EQ(arm.links[0].sensors.size(), 1u);
    EXPECT_EQ(std::get<JointStatesSpec>(arm.links[0].sensors[0].parameters).joints.size(), 2u);
}

TEST_F(SubModelsTest, AFrameComesWithItsPlaceAndAWholeFileWithItsScenery) {
    const Loaded loaded = load(
        "<frame pos='2 0 0'><attach model='arm' frame='mount' prefix='f_'/></frame>"
        "<attach model='arm' prefix='w_'/>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 3u) << loaded.text();
    EXPECT_EQ(loaded.world->instances[1].name, "f_upper");
    EXPECT_EQ(loaded.world->instances[1].X_WM.p, (Vec3{3, 0, 1}));
    EXPECT_EQ(loaded.world->instances[2].name, "w_upper");
    EXPECT_EQ(loaded.world->instances[2].X_WM.p, (Vec3{1, 0, 1}));
    EXPECT_EQ(loaded.model("w_upper")->canonical_link, "upper");  // all copies are of one type
}

TEST_F(SubModelsTest, APartOfARobotKeepsItsPrefix) {
    const Loaded loaded = load(
        "<body name='base'><joint name='turn'/><geom/><attach model='arm' body='lower' prefix='g/'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& robot = *loaded.model("base");
    ASSERT_EQ(robot.joints.size(), 2u);
    EXPECT_EQ(robot.joints[0].name, "turn");
    EXPECT_EQ(robot.joints[1].name, "g/elbow");
    EXPECT_EQ(robot.joints[1].axes[0].max_effort, 3);
}

TEST_F(SubModelsTest, WhatIsNotThereIsAnError) {
    EXPECT_TRUE(load("<attach model='leg' prefix='a_'/>").find("unknown-asset"));
    EXPECT_TRUE(load("<attach model='arm' body='head' prefix='a_'/>").find("unknown-body"));
    EXPECT_TRUE(load("<attach model='arm' frame='head' prefix='a_'/>").find("unknown-frame"));
    EXPECT_TRUE(load("<attach prefix='a_'/>").find("bad-value"));
    EXPECT_TRUE(load("<attach model='leg'/>", "name='leg' file='leg.xml'").find("file-not-found"));
    EXPECT_TRUE(load("<attach model='arm'/><attach model='arm'/>").find("duplicate-name"));
}

TEST_F(SubModelsTest, AFileWithoutANameInTheAssetHasTheNameThatItGivesItself) {
    const Loaded loaded = load("<attach model='arm' body='upper' prefix='a_'/>", "file='arm.xml'");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.model("a_upper"));
}

TEST_F(SubModelsTest, APartOfTheFileItselfIsAttachedAgain) {
    const Loaded loaded = load_bodies(
        "<body name='arm'><joint name='turn'/><geom size='.1'/></body>"
        "<frame pos='0 0 3'><attach body='arm' prefix='b_'/></frame>",
        "<actuator><motor joint='turn' ctrlrange='-2 2'/></actuator>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.model("arm")->joints[0].axes[0].max_effort, 2);
    EXPECT_EQ(loaded.model("b_arm")->joints[0].axes[0].max_effort, 2);
    const Loaded endless =
        load_bodies("<body name='a'><geom size='.1'/><attach body='a' prefix='b'/></body>");
    EXPECT_TRUE(endless.find("attach-in-itself")) << endless.text();
}

TEST_F(SubModelsTest, CopiesHaveTheActuatorsSensorsAndEqualitiesOfTheOriginal) {
    const Loaded loaded = load_bodies(
        "<replicate count='3' offset='1 0 0'><body name='b'><joint name='h'/><geom size='.1'/>"
        "<body name='c'><joint name='k'/><geom size='.1'/></body></body></replicate>",
        "<actuator><position joint='h' kp='5'/></actuator><sensor><jointpos joint='h'/></sensor>"
        "<equality><joint joint1='k' joint2='h'/></equality>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    for (const char* name : {"b0", "b1", "b2"}) {
        const ModelSpec& model = *loaded.model(name);
        EXPECT_EQ(model.joints[0].axes[0].position_gain, 5);
        EXPECT_TRUE(model.joints[1].axes[0].mimic);
        EXPECT_EQ(model.links[0].sensors.size(), 1u);
    }
    const Loaded wrong =
        load_bodies("<replicate count='2'><body name='b'><geom size='.1'/></body></replicate>",
                    "<actuator><motor joint='nobody'/></actuator>");
    EXPECT_TRUE(wrong.find("unknown-joint")) << wrong.text();
}

}  // namespace
}  // namespace roboss
