// What becomes of the parts of an MJCF file. Numbers are checked against MuJoCo in python/tests/test_mjcf.py.
#include "mjcf/load_mjcf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "mjcf/test_files.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using mjcf_test::load_bodies;
using mjcf_test::load_text;
using mjcf_test::Loaded;

TEST(LoadMjcf, TreesOfBodiesAreRobotsNamedByTheirRoots) {
    const Loaded loaded = load_bodies(
        "<geom type='plane' size='1 1 1'/>"
        "<body name='ball'><freejoint/><geom size='.1'/></body>"
        "<body name='arm'><geom size='.1'/><body name='hand'><joint name='wrist'/><geom "
        "size='.1'/></body></body>"
        "<body name='wall'><geom type='box' size='1 1 1'/></body>"
        "<body name='hand_of_god' mocap='true'><geom size='.1'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 5u);
    EXPECT_TRUE(loaded.model("worldbody")->is_static);
    EXPECT_TRUE(loaded.model("wall")->is_static);
    EXPECT_TRUE(loaded.model("hand_of_god")->kinematic);
    EXPECT_TRUE(loaded.model("ball")->joints.empty());
    const ModelSpec& arm = *loaded.model("arm");
    ASSERT_EQ(arm.joints.size(), 2u);
    EXPECT_EQ(arm.joints[0].parent, "world");
    EXPECT_EQ(joint_type(arm.joints[0].kind).name, "fixed");
    EXPECT_EQ(arm.joints[1].name, "wrist");
    EXPECT_TRUE(arm.self_collide);
}

TEST(LoadMjcf, SeveralJointsOfABodyAreAChainOfLinksWithoutMass) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='x' type='slide' axis='1 0 0'/><joint name='z' type='slide'/>"
        "<joint name='turn' axis='0 1 0'/><geom size='.1'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = *loaded.model("b");
    ASSERT_EQ(model.links.size(), 3u);
    ASSERT_EQ(model.joints.size(), 3u);
    EXPECT_TRUE(model.links[0].between_joints && model.links[1].between_joints);
    EXPECT_EQ(model.links[0].mass, 0);
    EXPECT_FALSE(model.links[2].between_joints);
    EXPECT_EQ(model.joints[0].parent, "world");
    EXPECT_EQ(model.joints[1].parent, model.joints[0].child);
    EXPECT_EQ(model.joints[2].child, "b");
}

TEST(LoadMjcf, ReferencePositionsMoveTheLinksAndKeepTheCoordinates) {
    const Loaded loaded = load_bodies(
        "<body name='b' pos='0 0 1.5'><joint name='lift' type='slide' ref='1.25' range='0 2'/><geom "
        "size='.1'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = *loaded.model("b");
    EXPECT_DOUBLE_EQ(model.links[0].X_ML.p.z, -1.25);
    EXPECT_DOUBLE_EQ(model.joints[0].axes[0].initial_position, 1.25);
    EXPECT_DOUBLE_EQ(model.joints[0].axes[0].upper, 2);
    EXPECT_DOUBLE_EQ(loaded.world->instances[0].X_WM.p.z, 1.5);
}

TEST(LoadMjcf, SizesAreHalfLengths) {
    const Loaded loaded = load_bodies(
        "<body name='b'><freejoint/><geom type='box' size='.1 .2 .3' density='100'/>"
        "<geom type='capsule' size='.05' fromto='0 0 0 0 0 .4' mass='0'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const LinkSpec& link = loaded.model("b")->links[0];
    EXPECT_EQ(link.collisions[0].geometry.size, (Vec3{.2, .4, .6}));
    EXPECT_DOUBLE_EQ(link.mass, 100 * .2 * .4 * .6);
    EXPECT_DOUBLE_EQ(link.collisions[1].geometry.length, .4);
    EXPECT_DOUBLE_EQ(link.collisions[1].X_LS.p.z, .2);
}

TEST(LoadMjcf, AnObjFileWithoutFacesIsTheConvexHullOfItsPoints) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("roboss-points-" + std::to_string(getpid()) + ".obj"))
            .string();
    std::ofstream(path) << "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv .1 .1 .1\nvn 0 0 1\n";
    const Loaded loaded =
        load_bodies("<body name='b'><freejoint/><geom type='mesh' mesh='m' density='300'/></body>",
                    "<asset><mesh name='m' file='" + path + "'/></asset>");
    std::filesystem::remove(path);
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NEAR(loaded.model("b")->links[0].mass, 300 * 8.0 / 6, 1e-6);
}

TEST(LoadMjcf, AFileIsIncludedOnceByEachOfItsNamesAndNeverInItself) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("roboss-include-" + std::to_string(getpid()));
    fs::create_directory(folder);
    std::ofstream(folder / "part.xml") << "<mujocoinclude><geom size='.1'/></mujocoinclude>";
    fs::create_symlink("part.xml", folder / "again.xml");
    std::ofstream(folder / "cycle.xml") << "<mujocoinclude><include file='ring.xml'/></mujocoinclude>";
    fs::create_symlink("cycle.xml", folder / "ring.xml");
    const auto load = [&](const std::string& first, const std::string& second) {
        return load_text("<mujoco><worldbody><body><freejoint/><include file='" + first +
                             "'/><include file='" + second + "'/></body></worldbody></mujoco>",
                         folder / "robot.xml");
    };
    const Loaded linked = load("part.xml", "again.xml"), twice = load("part.xml", "./part.xml"),
                 ring = load("part.xml", "cycle.xml");
    fs::remove_all(folder);
    ASSERT_TRUE(linked.world) << linked.text();
    EXPECT_EQ(linked.world->prototypes[0].links[0].collisions.size(), 2u);
    EXPECT_NE(twice.find("include-twice"), nullptr) << twice.text();
    EXPECT_NE(ring.find("include-twice"), nullptr) << ring.text();
}

TEST(LoadMjcf, AnEndTagTooManyAtTheEndIsAWarningAndOneTooFewAnError) {
    const std::string file =
        "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>\n";
    const Loaded loaded = load_text(file + "</mujoco> </mujoco>\n");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_NE(loaded.find("stray-end-tag"), nullptr);
    EXPECT_EQ(loaded.find("stray-end-tag")->where.line, 2);
    EXPECT_EQ(loaded.world->prototypes.size(), 1u);
    for (const char* text : {"<mujoco><worldbody><mujoco></mujoco></mujoco>",
                             "<mujoco></mujoco></mujoco><a/>", "<mujoco><a></b></mujoco>", "</mujoco>"})
        EXPECT_NE(load_text(text).find("malformed-xml"), nullptr) << text;
}

TEST(LoadMjcf, AttributesThatNoSpacePartsAreReadWithAWarning) {
    const Loaded loaded = load_text(
        "<mujoco><!-- \"a\"b -->\n<worldbody><body><freejoint/>\n"
        "<geom name=\"it's\"type='box'size='.1 .2 .3'/></body></worldbody></mujoco>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_NE(loaded.find("attributes-together"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("attributes-together")->where.line, 3);
    const auto& box = loaded.world->prototypes[0].links[0].collisions.at(0);
    EXPECT_EQ(box.where.line, 3);
    EXPECT_EQ(box.geometry.size.y, 0.4);
    EXPECT_NE(load_text("<mujoco a='1'b=></mujoco>").find("malformed-xml"), nullptr);
}

TEST(LoadMjcf, ClassesReachElementsThroughChildclass) {
    const Loaded loaded = load_bodies(
        "<body name='b' childclass='c'><joint name='j'/><geom size='.1'/><geom class='main' "
        "size='.1'/></body>",
        "<default><geom contype='2'/><default class='c'><joint damping='3'/><geom conaffinity='4' rgba='1 0 "
        "0 1'/>"
        "</default></default>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = *loaded.model("b");
    EXPECT_DOUBLE_EQ(model.joints[0].axes[0].damping, 3);
    const auto& collisions = model.links[0].collisions;
    EXPECT_EQ(collisions[0].surface.category_bitmask, 2u);
    EXPECT_EQ(collisions[0].surface.collide_bitmask, 4u);
    EXPECT_EQ(collisions[1].surface.collide_bitmask, 1u);
    EXPECT_EQ(model.links[0].visuals[0].rgb, (Vec3{1, 0, 0}));
}

TEST(LoadMjcf, GeomsThatTouchNothingAreVisualsAndHaveMass) {
    const Loaded loaded = load_bodies(
        "<body name='b'><freejoint/><geom size='.1' mass='2' contype='0' conaffinity='0'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const LinkSpec& link = loaded.model("b")->links[0];
    EXPECT_TRUE(link.collisions.empty());
    EXPECT_EQ(link.visuals.size(), 1u);
    EXPECT_DOUBLE_EQ(link.mass, 2);
}

TEST(LoadMjcf, ActuatorsBecomeGainsAndBoundsOfTheJoint) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='a'/><geom size='.1'/><body><joint name='m'/><geom "
        "size='.1'/></body></body>",
        "<default><position kp='10'/></default><actuator>"
        "<position joint='a' kv='2' gear='3' forcerange='-5 4'/><motor joint='m' gear='50' ctrlrange='-1 1'/>"
        "</actuator>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = *loaded.model("b");
    const AxisSpec &servo = model.joints[0].axes[0], &motor = model.joints[1].axes[0];
    EXPECT_DOUBLE_EQ(servo.position_gain, 90);
    EXPECT_DOUBLE_EQ(servo.velocity_gain, 18);
    EXPECT_DOUBLE_EQ(servo.max_effort, 15);
    EXPECT_DOUBLE_EQ(motor.position_gain, 0);
    EXPECT_DOUBLE_EQ(motor.max_effort, 50);
}

TEST(LoadMjcf, AnActuatorOfAFixedTendonDrivesTheJointThatAnEqualityTiesTheOthersTo) {
    const auto load = [](const std::string& equality) {
        return load_bodies(
            "<body name='b'><geom size='.1'/><body><joint name='l' type='slide'/><geom size='.1'/></body>"
            "<body><joint name='r' type='slide'/><geom size='.1'/></body></body>",
            "<tendon><fixed name='both'><joint joint='r' coef='.5'/><joint joint='l' "
            "coef='.25'/></fixed></tendon>" +
                equality + "<actuator><position tendon='both' kp='100' forcerange='-40 40'/></actuator>");
    };
    const Loaded tied = load("<equality><joint joint1='r' joint2='l' polycoef='0 3 0 0 0'/></equality>");
    ASSERT_TRUE(tied.world) << tied.text();
    EXPECT_EQ(tied.find("ignored-actuator"), nullptr) << tied.text();
    const ModelSpec& model = *tied.model("b");
    const AxisSpec &leader = model.joints[1].axes[0], &follower = model.joints[2].axes[0];
    ASSERT_EQ(model.joints[1].name, "l");
    constexpr double kGear = .25 + 3 * .5;
    EXPECT_DOUBLE_EQ(leader.position_gain, 100 * kGear * kGear);
    EXPECT_DOUBLE_EQ(leader.max_effort, 40 * kGear);
    EXPECT_EQ(follower.position_gain, 0);
    EXPECT_NE(load("").find("ignored-actuator"), nullptr) << "two joints, each free";
}

TEST(LoadMjcf, DampingRatiosCountTheInertiaThatTheJointMoves) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='a' axis='0 1 0' armature='.5'/><geom size='.1' mass='2' pos='0 0 "
        "3'/></body>",
        "<actuator><position joint='a' kp='4' dampratio='1'/></actuator>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const double inertia = .5 + 2 * 9 + .4 * 2 * .01;
    EXPECT_NEAR(loaded.model("b")->joints[0].axes[0].velocity_gain, 2 * std::sqrt(4 * inertia), 1e-12);
}

TEST(LoadMjcf, EqualitiesAreLoopsAndFollowers) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='a'/><geom size='.1'/><body name='c' pos='1 0 0'><joint name='d' "
        "ref='10'/>"
        "<geom size='.1'/></body></body>",
        "<equality><connect name='pin' body1='c' body2='world' anchor='.5 0 0'/>"
        "<joint joint1='d' joint2='a' polycoef='.1 2 0 0 0'/></equality>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = *loaded.model("b");
    ASSERT_EQ(model.joints.size(), 3u);
    EXPECT_TRUE(model.joints[2].closes_loop);
    EXPECT_EQ(model.joints[2].parent, "world");
    EXPECT_EQ(model.joints[2].child, "c");
    ASSERT_TRUE(model.joints[1].axes[0].mimic);
    EXPECT_DOUBLE_EQ(model.joints[1].axes[0].mimic->multiplier, 2);
    EXPECT_NEAR(model.joints[1].axes[0].mimic->offset, .1 + 10 * kPi / 180, 1e-15);
}

TEST(LoadMjcf, AnEqualityOfJointsMayBeAPolynomial) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='a'/><geom size='.1'/><body name='c' pos='1 0 0'><joint name='d'/>"
        "<geom size='.1'/></body></body>",
        "<equality><joint joint1='d' joint2='a' polycoef='.1 2 .3 .4 .5'/></equality>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const auto& mimic = loaded.model("b")->joints.at(1).axes.at(0).mimic;
    ASSERT_TRUE(mimic);
    EXPECT_FALSE(mimic->is_linear());
    EXPECT_EQ(mimic->higher, (std::array<double, 3>{.3, .4, .5}));
    EXPECT_EQ(mimic->multiplier, 2);
}

TEST(LoadMjcf, AnEqualityOfJointsTiesTwoFixedRobots) {
    const Loaded tied = load_bodies(
        "<body name='one'><joint name='a'/><geom size='.1'/></body>"
        "<body name='two' pos='1 0 0'><joint name='d'/><geom size='.1'/></body>",
        "<equality><joint joint1='d' joint2='a' polycoef='.1 2 .3 .4 .5'/></equality>");
    ASSERT_TRUE(tied.world) << tied.text();
    EXPECT_TRUE(tied.diagnostics.items().empty()) << tied.text();
    ASSERT_EQ(tied.world->instances.size(), 1u);
    const ModelSpec& model = *tied.model("one");
    ASSERT_EQ(model.joints.size(), 2u);
    EXPECT_TRUE(model.joints[1].axes[0].mimic);
}

TEST(LoadMjcf, PairsTouchWhateverTheMasksSay) {
    const std::string geom = " size='.1' contype='0' conaffinity='0'/><freejoint/></body>";
    const Loaded loaded =
        load_bodies("<body name='a'><geom name='x'" + geom + "<body name='b'><geom name='y'" + geom +
                        "<body name='c'><geom name='z'" + geom,
                    "<contact><pair geom1='x' geom2='y' friction='.3'/></contact>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const SurfaceSpec &x = loaded.model("a")->links[0].collisions[0].surface,
                      &y = loaded.model("b")->links[0].collisions[0].surface;
    EXPECT_NE(x.category_bitmask & y.collide_bitmask, 0u);
    EXPECT_DOUBLE_EQ(x.mu, .3);
    EXPECT_TRUE(loaded.model("c")->links[0].collisions.empty());
}

TEST(LoadMjcf, CopiesAreNumbered) {
    const Loaded loaded = load_bodies(
        "<replicate count='10' offset='1 0 0'><body name='post'><freejoint/><geom "
        "size='.1'/></body></replicate>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_NE(loaded.model("post09"), nullptr);
    EXPECT_DOUBLE_EQ(loaded.world->instances[9].X_WM.p.x, 9);
    EXPECT_EQ(loaded.model("post09")->links[0].name, loaded.model("post00")->links[0].name);
}

TEST(LoadMjcf, SensorsStandOnTheLinksOfTheirSites) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='j'/><geom size='.1'/><site name='s' pos='0 0 1'/></body>",
        "<sensor><gyro site='s'/><accelerometer site='s'/><rangefinder name='eye' site='s' cutoff='3'/>"
        "<force name='f' site='s'/><jointpos joint='j'/><jointvel joint='j'/><framepos objtype='site' "
        "objname='s'/>"
        "</sensor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto& sensors = loaded.model("b")->links[0].sensors;
    ASSERT_EQ(sensors.size(), 4u) << loaded.text();
    EXPECT_NE(sensors[0].as<ImuSpec>(), nullptr);
    EXPECT_EQ(sensors[0].name, "s");
    EXPECT_DOUBLE_EQ(sensors[0].X_LS.p.z, 1);
    EXPECT_DOUBLE_EQ(sensors[1].as<LaserSpec>()->range_max, 3);
    EXPECT_EQ(sensors[2].as<ForceTorqueSpec>()->joint, "j");
    EXPECT_EQ(sensors[3].as<JointStatesSpec>()->joints.size(), 1u);
    EXPECT_NE(loaded.find("unsupported-sensor"), nullptr);
}

TEST(LoadMjcf, SitesAreFrames) {
    const Loaded loaded = load_bodies(
        "<body name='b'><freejoint/><geom size='.1'/><site name='s' pos='0 0 1' euler='90 0 0'/></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const FrameSpec& frame = loaded.model("b")->frames.at(0);
    EXPECT_EQ(frame.name, "s");
    EXPECT_NEAR(frame.X_LF.q.x, std::sqrt(.5), 1e-15);
}

// Bad input.

struct BadFile {
    const char* claim;
    const char* bodies;
    const char* sections;
    const char* code;
};
void PrintTo(const BadFile& file, std::ostream* out) {
    *out << file.claim;
}

class BadMjcf : public testing::TestWithParam<BadFile> {};

TEST_P(BadMjcf, IsRefusedWithTheLine) {
    const Loaded loaded = load_bodies("\n" + std::string(GetParam().bodies), GetParam().sections);
    const Diagnostic* found = loaded.find(GetParam().code);
    ASSERT_NE(found, nullptr) << loaded.text();
    EXPECT_EQ(found->severity, Severity::kError);
    EXPECT_GT(found->where.line, 0);
    EXPECT_FALSE(found->remedy.empty());
    EXPECT_TRUE(loaded.diagnostics.refuses());
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMjcf,
    testing::Values(
        BadFile{"word", "<body pos='0 zero 0'><freejoint/><geom size='.1'/></body>", "", "bad-value"},
        BadFile{"nan", "<body><freejoint/><geom size='nan'/></body>", "", "bad-value"},
        BadFile{"few", "<body pos='0 0'><freejoint/><geom size='.1'/></body>", "", "bad-value"},
        BadFile{"quat", "<body quat='0 0 0 0'><freejoint/><geom size='.1'/></body>", "", "bad-value"},
        BadFile{"axis", "<body><joint axis='0 0 0'/><geom size='.1'/></body>", "", "bad-value"},
        BadFile{"type", "<body><joint type='screw'/><geom size='.1'/></body>", "", "bad-value"},
        BadFile{"two", "<body euler='1 0 0' quat='1 0 0 0'><freejoint/><geom size='.1'/></body>", "",
                "two-orientations"},
        BadFile{"size", "<body><freejoint/><geom type='box' size='.1'/></body>", "", "bad-size"},
        BadFile{"class", "<body><freejoint/><geom class='x' size='.1'/></body>", "", "unknown-class"},
        BadFile{"mesh", "<body><freejoint/><geom type='mesh' mesh='x'/></body>", "", "unknown-asset"},
        BadFile{"file", "<body><freejoint/><geom type='mesh' mesh='x'/></body>",
                "<asset><mesh name='x' file='none.stl'/></asset>", "file-not-found"},
        BadFile{"face", "<body><freejoint/><geom type='mesh' mesh='x'/></body>",
                "<asset><mesh name='x' vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 9'/></asset>", "bad-mesh"},
        BadFile{"names", "<body name='a'><freejoint/><geom size='.1'/></body><body name='a'/>", "",
                "duplicate-name"},
        BadFile{"inside", "<body><geom size='.1'/><body><freejoint/><geom size='.1'/></body></body>", "",
                "free-joint-inside"},
        BadFile{"other", "<body><freejoint/><joint/><geom size='.1'/></body>", "", "free-joint-and-other"},
        BadFile{"inertia", "<body><freejoint/><inertial pos='0 0 0' mass='1'/></body>", "",
                "missing-inertia"},
        BadFile{"joint", "<body><freejoint/><geom size='.1'/></body>",
                "<actuator><motor joint='x'/></actuator>", "unknown-joint"},
        BadFile{"body", "<body><freejoint/><geom size='.1'/></body>",
                "<equality><weld body1='x'/></equality>", "unknown-body"},
        BadFile{"include", "<include file='none.xml'/>", "", "include-not-found"},
        BadFile{"global", "<body><freejoint/><geom size='.1'/></body>", "<compiler coordinate='global'/>",
                "global-coordinates"}),
    [](const auto& row) { return std::string(row.param.claim); });

TEST(LoadMjcf, AMassWithoutMomentsMayStandOnAnotherBody) {
    const Loaded loaded = load_bodies(
        "<body><freejoint/><geom size='.1'/><body><inertial pos='0 0 0' mass='2'/></body></body>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.find("missing-inertia")->severity, Severity::kWarning);
}

TEST(LoadMjcf, WhatHasNoEffectIsTold) {
    const Loaded loaded = load_bodies(
        "<body name='b'><joint name='j' springdamper='1 1' stifness='2'/><geom size='.1' solref='.1 1'/>"
        "<bodi/></body>",
        "<tendon><spatial name='t'><site site='a'/><site site='b'/></spatial></tendon>"
        "<actuator><motor tendon='t'/></actuator><option viscosity='1'/>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("unknown-attribute"), nullptr);
    EXPECT_NE(loaded.find("unknown-element"), nullptr);
    EXPECT_NE(loaded.find("ignored-element"), nullptr);
    EXPECT_NE(loaded.find("ignored-actuator"), nullptr);
    EXPECT_NE(loaded.text().find("solref"), std::string::npos);
    EXPECT_NE(loaded.text().find("viscosity"), std::string::npos);
    EXPECT_NE(loaded.text().find("springdamper"), std::string::npos);
}

TEST(LoadMjcf, ACleanFileHasNoFindings) {
    const Loaded loaded = load_text(
        "<mujoco model='m'><option timestep='0.01'/><worldbody><geom type='plane' size='1 1 1'/>"
        "<body name='b' pos='0 0 1'><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.text(), "");
    EXPECT_EQ(loaded.world->name, "m");
    EXPECT_DOUBLE_EQ(loaded.world->dt_s, .01);
    EXPECT_FALSE(loaded.world->sleep);
}

}  // namespace
}  // namespace roboss
