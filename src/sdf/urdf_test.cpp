// URDF: masses, joints, names.
#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <map>
#include <thread>
#include <vector>

#include "sdf/test_files.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kArm =
    "<?xml version='1.0'?>\n<robot name='arm'>\n<link name='world'/>\n<link name='base'><inertial><mass "
    "value='2'/>"
    "<inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial>"
    "<collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>\n"
    "<link name='upper'><inertial><origin xyz='0 0 0.5'/><mass value='1'/><inertia ixx='0.1' iyy='0.1' "
    "izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link>\n"
    "<joint name='fix' type='fixed'><parent link='world'/><child link='base'/></joint>\n"
    "<joint name='shoulder' type='revolute'><origin xyz='0 0 0.2'/><parent link='base'/><child "
    "link='upper'/><axis xyz='0 1 0'/>"
    "<limit lower='-1' upper='1.5' effort='20' velocity='3'/><dynamics damping='0.7'/></joint>\n</robot>\n";

TEST(Urdf, LinksOfNoMassAtFixedJointsAddNoneAndAnyVersionIsRead) {
    const auto empty = [](const std::string& name) {
        return "<link name='" + name +
               "'><inertial><mass value='0.0'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/>"
               "</inertial></link>";
    };
    const Loaded loaded = load_text(
        "<robot name='hand' version='1.0.0'><link name='palm'><inertial><mass value='2'/>"
        "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>" +
        empty("tip") + empty("nail") +
        "<joint name='a' type='fixed'><parent link='palm'/><child link='tip'/></joint>"
        "<joint name='b' type='fixed'><parent link='tip'/><child link='nail'/></joint></robot>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_EQ(loaded.world->prototypes.size(), 1u);
    double mass = 0;
    for (const LinkSpec& link : loaded.world->prototypes[0].links) mass += link.mass;
    EXPECT_EQ(mass, 2);
}

TEST(Urdf, WithMacrosIsAnErrorThatNamesXacro) {
    for (const char* inner :
         {"<xacro:property name='r' value='0.1'/><link name='a'/>",
          "<link name='a'><inertial><mass value='${m}'/></inertial></link>",
          "<link name='a'><visual><geometry><mesh filename='$(find car)/a.stl'/></geometry>"
          "</visual></link>"}) {
        const Loaded loaded = load_text("<robot name='car' xmlns:xacro='http://ros.org/wiki/xacro'>\n" +
                                        std::string(inner) + "</robot>");
        const Diagnostic* found = loaded.find("xacro");
        ASSERT_NE(found, nullptr) << loaded.text();
        EXPECT_EQ(found->where.line, 2);
        EXPECT_NE(found->remedy.find("xacro FILE"), std::string::npos);
        EXPECT_EQ(loaded.diagnostics.count(Severity::kError), 1u) << loaded.text();
    }
}

TEST(Urdf, BecomesAWorldWithOneRobot) {
    const Loaded loaded = load_text(kArm, "arm.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const ModelSpec& arm = loaded.world->prototypes.at(0);
    ASSERT_EQ(arm.links.size(), 2u);
    EXPECT_EQ(arm.links[0].mass, 2);
    EXPECT_EQ(arm.links[0].collisions.at(0).geometry.size.x, 0.2);
    EXPECT_EQ(arm.links[1].p_LC.z, 0.5);
    ASSERT_EQ(arm.joints.size(), 2u);
    const JointSpec& shoulder = arm.joints[0].name == "shoulder" ? arm.joints[0] : arm.joints[1];
    EXPECT_NEAR(shoulder.X_MJ.p.z, 0.2, 1e-12);
    EXPECT_NEAR(shoulder.axes.at(0).xyz.y, 1, 1e-12);
    EXPECT_EQ(shoulder.axes[0].upper, 1.5);
    EXPECT_EQ(shoulder.axes[0].max_effort, 20);
    EXPECT_EQ(shoulder.axes[0].damping, 0.7);
    EXPECT_EQ(shoulder.where.line, 7);
}

TEST(Urdf, ThatIsBrokenIsAnErrorAtTheLink) {
    std::string broken = kArm;
    broken.replace(broken.find("mass value='1'"), 14, "mass value='x'");
    const Loaded loaded = load_text(broken, "arm.urdf");
    EXPECT_TRUE(loaded.diagnostics.has_errors());
    EXPECT_NE(loaded.text().find("arm.urdf:5: error"), std::string::npos) << loaded.text();
    EXPECT_TRUE(load_text("<robot name='r'/>", "r.urdf").diagnostics.has_errors());
}

TEST(Urdf, MomentsThatAreMissingAreZero) {
    std::string arm = kArm;
    const std::string products = " ixy='0' ixz='0' iyz='0'/>";
    arm.erase(arm.find(products), products.size() - 2);
    const Loaded loaded = load_text(arm, "arm.urdf");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("missing-inertia"), nullptr);
    EXPECT_EQ(loaded.find("missing-inertia")->where.line, 4);
    EXPECT_EQ(loaded.model("arm")->links[0].inertia_C(0, 0), 0.1);
}

TEST(Urdf, WithoutAnyMassButWithJointsThatMoveHasMassesOfItsCollisions) {
    const std::string axis = "<axis xyz='0 1 0'/></joint>";
    const Loaded loaded = load_text(
        "<robot>\n<link name='base'><collision><geometry><box size='1 1 .1'/></geometry></collision></link>\n"
        "<link name='arm'><inertial><mass value='0'/></inertial></link>\n"
        "<link name='cover'><collision><geometry><box size='.1 .1 1'/></geometry></collision></link>\n"
        "<link name='wire'/>\n"
        "<joint name='j' type='continuous'><parent link='base'/><child link='arm'/>" +
            axis +
            "<joint name='f' type='fixed'><origin xyz='0 0 .5'/><parent link='arm'/><child "
            "link='cover'/></joint>" +
            "<joint name='k' type='continuous'><parent link='arm'/><child link='wire'/>" + axis + "</robot>",
        "folder/bare.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes.size(), 1u);
    const ModelSpec* model = loaded.model("bare");
    ASSERT_NE(model, nullptr) << loaded.text();
    ASSERT_EQ(model->links.size(), 4u);
    EXPECT_NEAR(model->links[0].mass, 100, 1e-9);
    EXPECT_EQ(model->links[1].mass, 0) << "the cover at its fixed joint has the mass of both";
    EXPECT_NEAR(model->links[2].mass, 10, 1e-9);
    EXPECT_NEAR(model->links[2].X_ML.p.z, 0.5, 1e-9);
    EXPECT_NEAR(model->links[2].inertia_C(0, 0), 10 * 1.01 / 12, 1e-9);
    EXPECT_EQ(model->links[3].mass, 0) << "compile() gives it a gram";
    EXPECT_NE(loaded.find("unnamed-robot"), nullptr);
    EXPECT_EQ(loaded.find("no-inertial")->severity, Severity::kWarning);
}

TEST(Urdf, OfRos2ControlInitialPositionsAndMimicJointsCount) {
    const auto control = [](const std::string& joints) {
        std::string arm = kArm;
        const std::string tip =
            "<link name='tip'><inertial><mass value='1'/><inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' "
            "iyz='0'/>"
            "</inertial></link><joint name='wrist' type='continuous'><parent link='upper'/><child "
            "link='tip'/>"
            "<axis xyz='0 1 0'/></joint>\n<ros2_control name='system' "
            "type='system'><hardware><plugin>p</plugin>"
            "</hardware>";
        return load_text(arm.insert(arm.rfind("</robot>"), tip + joints + "</ros2_control>\n"), "arm.urdf");
    };
    const auto start = [](const std::string& joint, const std::string& value) {
        return "<joint name='" + joint +
               "'><command_interface name='effort'/><state_interface name='position'>" +
               "<param name='initial_value'>" + value + "</param></state_interface></joint>\n";
    };
    const Loaded loaded = control(start("shoulder", " 0.5 ") + start("gone", "1") +
                                  "<joint name='wrist'><param name='mimic'>shoulder</param><param "
                                  "name='multiplier'>-2</param></joint>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("ros2-control"), nullptr);
    EXPECT_EQ(loaded.find("ros2-control")->where.line, 9);
    std::map<std::string, AxisSpec> axes;
    for (const JointSpec& joint : loaded.model("arm")->joints)
        if (!joint.axes.empty()) axes[joint.name] = joint.axes.front();
    EXPECT_EQ(axes["shoulder"].initial_position, 0.5);
    ASSERT_TRUE(axes["wrist"].mimic);
    EXPECT_EQ(axes["wrist"].mimic->joint, "shoulder");
    EXPECT_EQ(axes["wrist"].mimic->multiplier, -2);
    for (const char* value : {"1.6", "a"}) {
        const Loaded bad = control(start("shoulder", value));
        EXPECT_FALSE(bad.diagnostics.has_errors()) << bad.text();
        EXPECT_NE(bad.find("initial-position"), nullptr) << value;
    }
}

TEST(Urdf, SaysWhichLinksHaveNoInertial) {
    const Loaded none = load_text(
        "<robot name='r'>\n<link name='base'/>\n<link name='arm'/>\n<joint name='j' type='continuous'>"
        "<parent link='base'/><child link='arm'/></joint></robot>",
        "bare.urdf");
    EXPECT_FALSE(none.world);
    ASSERT_NE(none.find("no-inertial"), nullptr) << none.text();
    EXPECT_EQ(none.find("no-inertial")->where.line, 2);
    for (const char* link : {"'base'", "'arm'"})
        EXPECT_NE(none.find("no-inertial")->message.find(link), std::string::npos) << none.text();
    std::string part = kArm;
    part.insert(part.rfind("</robot>"),
                "<link name='tip'/><joint name='t' type='continuous'><parent link='upper'/><child "
                "link='tip'/></joint>");
    const Loaded some = load_text(part, "part.urdf");
    ASSERT_TRUE(some.world) << some.text();
    EXPECT_EQ(some.model("arm")->links.size(), 3u) << "the tip is kept";
    EXPECT_FALSE(load_text(kArm, "arm.urdf").diagnostics.count(Severity::kWarning));
}

TEST(Urdf, ARobotWithoutMassAndMotionIsScenery) {
    for (const std::string inertial : {"", "<inertial><mass value='0'/></inertial>"}) {
        const std::string table =
            "<robot name='table'>\n<link name='top'>" + inertial +
            "<collision><geometry><box size='1 1 0.1'/></geometry></collision></link>"
            "<link name='leg'>" +
            inertial +
            "<collision><geometry><box size='.1 .1 1'/></geometry></collision></link>"
            "<joint name='j' type='fixed'><parent link='top'/><child link='leg'/></joint></robot>";
        const Loaded loaded = load_text(table, "table.urdf");
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.world->prototypes.at(0).is_static);
        for (const LinkSpec& link : loaded.world->prototypes.at(0).links)
            EXPECT_EQ(link.collisions.size(), 1u) << link.name;
        EXPECT_NE(loaded.text().find("table.urdf:2: warning"), std::string::npos) << loaded.text();
        EXPECT_EQ(loaded.diagnostics.items().size(), 1u) << loaded.text();
    }
    EXPECT_TRUE(load_text("<robot name='r'><link name='a'/></robot>", "r.urdf").diagnostics.has_errors())
        << "nothing to see and nothing to touch";
}

TEST(Urdf, NamesWithDoubleColonsAreWrittenOtherwise) {
    std::string arm = kArm;
    for (std::size_t at = 0; (at = arm.find("upper", at)) != std::string::npos; at += 12)
        arm.replace(at, 5, "arm::upper");
    const Loaded loaded = load_text(arm, "arm.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("renamed"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.items().size(), 1u) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes.at(0).links.at(1).name, "arm__upper");
    EXPECT_EQ(loaded.world->prototypes.at(0).links.at(1).where.line,
              load_text(kArm, "arm.urdf").world->prototypes.at(0).links.at(1).where.line);
}

TEST(Urdf, ANameWithDoubleColonsGetsOneThatIsFree) {
    const std::string box =
        "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    const Loaded loaded =
        load_text("<robot name='r'><link name='a__b'>" + box + "</link><link name='a::b'>" + box +
                      "</link><joint name='j' type='continuous'><parent link='a__b'/>"
                      "<child link='a::b'/></joint></robot>",
                  "r.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes.at(0).links.at(0).name, "a__b");
    EXPECT_EQ(loaded.world->prototypes.at(0).links.at(1).name, "a__b_");
    EXPECT_EQ(loaded.world->prototypes.at(0).joints.at(0).child, "a__b_");
}

TEST(Urdf, BareLinksAtFixedJointsBecomeFramesAndOthersStay) {
    std::string arm = kArm;
    arm.insert(
        arm.rfind("</robot>"),
        "<link name='tip'/><joint name='t' type='fixed'><origin xyz='0 0 0.5' rpy='0 0.3 0'/>"
        "<parent link='upper'/><child link='tip'/></joint>"
        "<link name='tool'><inertial><mass value='1'/><inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' "
        "iyz='0'/></inertial></link><joint name='s' type='fixed'><origin xyz='0.2 0 0'/>"
        "<parent link='tip'/><child link='tool'/></joint>");
    const Loaded loaded = load_text(arm, "arm.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.count(Severity::kWarning), 0u) << loaded.text();
    const std::vector<FrameSpec>& frames = loaded.world->prototypes.at(0).frames;
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].name, "tip");
    EXPECT_EQ(frames[0].link, "upper");
    const Pose tip{{0, 0, 0.5}, from_rpy(0, 0.3, 0)};
    EXPECT_LT(norm(frames[0].X_LF.p - tip.p) + norm(logarithm(conjugate(frames[0].X_LF.q) * tip.q)), 1e-15);
    const LinkSpec& tool = loaded.world->prototypes.at(0).links.back();
    EXPECT_EQ(tool.name, "tool");
    EXPECT_LT(norm(tool.X_ML.p - (Vec3{0, 0, 0.2} + tip * Vec3{0.2, 0, 0})), 1e-15);
    const JointSpec& weld = loaded.world->prototypes.at(0).joints.back();
    EXPECT_EQ(weld.name + weld.parent + weld.child, "suppertool") << "its parent is the link of the frame";
}

TEST(Urdf, NamesThatSdfKeepsForItselfCostNothing) {
    for (const std::string name : {"__tip__", "a&lt;b"}) {
        std::string arm = kArm;
        arm.insert(arm.rfind("</robot>"),
                   "<link name='" + name +
                       "'/><joint name='t' type='fixed'><parent link='upper'/><child link='" + name +
                       "'/></joint><link name='tool'/><joint name='s' type='fixed'><parent link='" + name +
                       "'/><child link='tool'/></joint>");
        const Loaded loaded = load_text(arm, "arm.urdf");
        ASSERT_TRUE(loaded.world) << loaded.text();
        ASSERT_EQ(loaded.world->prototypes.at(0).frames.size(), 2u) << name;
        EXPECT_EQ(loaded.world->prototypes[0].frames[0].name, name == "__tip__" ? "tip" : "a<b");
    }
}

TEST(Urdf, ARootWithoutMassIsFixedToTheWorld) {
    const std::string cart =
        "<link name='cart'><inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
        "iyz='0'/>"
        "</inertial></link>";
    const std::string slide =
        "<joint name='s' type='prismatic'><parent link='rail'/><child link='cart'/><axis xyz='0 1 0'/>"
        "<limit lower='-4' upper='4' effort='9' velocity='9'/></joint>";
    const Loaded loaded =
        load_text("<robot name='r'>\n<link name='rail'/>" + cart + slide + "</robot>", "r.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(loaded.find("no-inertial")->where.line, 2) << loaded.text();
    const ModelSpec& robot = loaded.world->prototypes.at(0);
    EXPECT_TRUE(std::ranges::any_of(robot.joints, [](const JointSpec& j) { return j.name == "s"; }));
    EXPECT_TRUE(std::ranges::any_of(robot.joints, [](const JointSpec& j) { return j.parent == "world"; }));
    const Loaded held =
        load_text("<robot name='r'><link name='rail'/>" + cart + slide +
                  "<link name='foot'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
                  "ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='f' type='fixed'><parent "
                  "link='rail'/><child link='foot'/></joint></robot>");
    ASSERT_TRUE(held.world) << held.text();
    EXPECT_FALSE(held.find("no-inertial")) << "what is fixed to the root has mass";
}

TEST(Urdf, WhatALimitDoesNotSayHasNoBound) {
    std::string text = kArm;
    const std::string numbers = " effort='20' velocity='3'";
    text.erase(text.find(numbers), numbers.size());
    const Loaded partly = load_text(text);
    ASSERT_TRUE(partly.world) << partly.text();
    const AxisSpec& axis = partly.world->prototypes[0].joints.back().axes[0];
    EXPECT_DOUBLE_EQ(axis.upper, 1.5);
    EXPECT_LT(axis.max_effort, 0);
    EXPECT_EQ(partly.find("missing-limit")->severity, Severity::kWarning);
    const std::string limit = "<limit lower='-1' upper='1.5'/>";
    text.erase(text.find(limit), limit.size());
    for (const char* type : {"revolute", "prismatic"}) {
        std::string whole = text;
        whole.replace(whole.find("revolute"), 8, type);
        const Loaded loaded = load_text(whole);
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_FALSE(loaded.world->prototypes[0].joints.back().axes[0].has_limits()) << type;
        EXPECT_TRUE(loaded.find("missing-limit"));
    }
}

TEST(Urdf, MimicJointsFollow) {
    std::string hand = kArm;
    const std::string finger =
        "<link name='finger'><inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.01' ixy='0' "
        "ixz='0' "
        "iyz='0'/></inertial></link>\n"
        "<joint name='follow' type='continuous'><parent link='upper'/><child link='finger'/><axis xyz='0 1 "
        "0'/>"
        "<mimic joint='shoulder' multiplier='-0.5' offset='0.2'/></joint>\n";
    hand.insert(hand.find("</robot>"), finger);
    const Loaded loaded = load_text(hand, "hand.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    for (const JointSpec& joint : loaded.world->prototypes.at(0).joints) {
        const bool follows = joint.name == "follow";
        if (joint.axes.empty()) continue;
        ASSERT_EQ(joint.axes[0].mimic.has_value(), follows) << joint.name;
        if (!follows) continue;
        EXPECT_EQ(joint.axes[0].mimic->joint, "shoulder");
        EXPECT_EQ(joint.axes[0].mimic->multiplier, -0.5);
        EXPECT_EQ(joint.axes[0].mimic->offset, 0.2);
    }
    hand.replace(hand.find("'-0.5'"), 6, "'half'");
    const Loaded broken = load_text(hand, "hand.urdf");
    EXPECT_NE(broken.text().find("hand.urdf:9: error"), std::string::npos) << broken.text();
}

TEST(Urdf, PlanarJointHasItsThreeAxes) {
    std::string table = kArm;
    const std::string puck =
        "<link name='puck'><inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' "
        "iyz='0'/></inertial></link>\n"
        "<joint name='slide' type='planar'><origin xyz='0 0 0.3'/><parent link='upper'/><child link='puck'/>"
        "<axis xyz='1 0 0'/><dynamics damping='0.1'/></joint>\n";
    table.insert(table.find("</robot>"), puck);
    const Loaded loaded = load_text(table, "table.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("unused-axis"), nullptr) << "damping of which axis?";
    EXPECT_EQ(loaded.find("unused-axis")->where.line, 9);
    const auto& joints = loaded.world->prototypes.at(0).joints;
    const auto slide =
        std::find_if(joints.begin(), joints.end(), [](const JointSpec& j) { return j.name == "slide"; });
    ASSERT_NE(slide, joints.end());
    EXPECT_EQ(slide->kind, JointSpecKind::kPlanar);
    EXPECT_EQ(slide->parent, "upper");
    EXPECT_NEAR(slide->X_MJ.p.z, 0.5, 1e-12);
    ASSERT_EQ(slide->axes.size(), 3u);
    EXPECT_EQ(slide->axes[0].xyz, (Vec3{0, 1, 0})) << "y follows x";
    EXPECT_EQ(slide->axes[1].xyz, (Vec3{0, 0, 1}));
    EXPECT_EQ(slide->axes[2].xyz, (Vec3{1, 0, 0}));
    EXPECT_EQ(slide->axes[2].damping, 0);
}

TEST(Urdf, TransmissionHasNoEffectAndANoteSaysSo) {
    std::string geared = kArm;
    geared.insert(geared.find("</robot>"),
                  "<transmission name='gear'><type>transmission_interface/SimpleTransmission</type>"
                  "<joint name='shoulder'><hardwareInterface>EffortJointInterface</hardwareInterface></joint>"
                  "<actuator name='motor'><mechanicalReduction>50</mechanicalReduction></actuator>"
                  "</transmission>\n");
    const Loaded loaded = load_text(geared, "geared.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const Diagnostic* note = loaded.find("transmission");
    ASSERT_NE(note, nullptr) << loaded.text();
    EXPECT_EQ(note->severity, Severity::kNote);
    EXPECT_EQ(note->where.line, 8);
    for (const char* part :
         {"'gear'", "'shoulder'", "<hardwareInterface> EffortJointInterface", "<mechanicalReduction> 50"})
        EXPECT_NE(note->message.find(part), std::string::npos) << note->message;
}

/// As in files for Gazebo Classic: libsdformat 12 takes angles from 0.1 rad.
TEST(Urdf, CamerasMaySeeLessThanATenthOfARadian) {
    std::string seeing = kArm;
    const auto sensor = [](const std::string& name, const std::string& view) {
        return "<gazebo reference='upper'><sensor type='camera' name='" + name +
               "'><camera><horizontal_fov>" + view +
               "</horizontal_fov><image><width>2</width><height>2</height></image><clip><near>0.01</near>"
               "<far>5</far></clip></camera></sensor></gazebo>\n";
    };
    seeing.insert(seeing.find("</robot>"), sensor("wide", "1.5") + sensor("spot", "0.0349"));
    const Loaded loaded = load_text(seeing, "seeing.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    std::map<std::string, double> views;
    for (const LinkSpec& link : loaded.world->prototypes.at(0).links)
        for (const SensorSpec& one : link.sensors)
            views[one.name] = one.as<ColorCameraSpec>()->optics.horizontal_fov;
    EXPECT_EQ(views, (std::map<std::string, double>{{"wide", 1.5}, {"spot", 0.0349}}));
}

/// What libsdformat prints is taken from the streams of the whole program.
TEST(Urdf, ThreadsLoadAtOnce) {
    std::streambuf* const out = std::cout.rdbuf();
    std::streambuf* const err = std::cerr.rdbuf();
    std::atomic<int> loaded = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 2; ++i)
        threads.emplace_back([&] { loaded += load_text(kArm, "arm.urdf").world.has_value(); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(loaded, 2);
    EXPECT_EQ(std::cout.rdbuf(), out);
    EXPECT_EQ(std::cerr.rdbuf(), err);
}

TEST(Urdf, CanBeIncludedInAWorld) {
    const TestFolder folder;
    folder.write("arm.urdf", kArm);
    folder.write("world.sdf",
                 "<sdf version='1.9'><world "
                 "name='w'><include><uri>arm.urdf</uri><name>one</name></include></world></sdf>");
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->instances.at(0).name, "one");
}

}  // namespace
}  // namespace roboss
