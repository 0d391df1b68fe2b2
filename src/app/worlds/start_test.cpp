// Where robots start: one rule for URDF, SDFormat, saved states and MJCF.
#include <gtest/gtest.h>

#include "model/on_ground.h"
#include "model/robot_state.h"
#include "physics/start_overlaps.h"
#include "physics/step.h"
#include "sdf/load_world.h"
#include "world/bare_model.h"

namespace roboss {
namespace {

struct Start {
    std::shared_ptr<const Model> model;
    Diagnostics diagnostics;

    explicit Start(const std::string& text, bool on_ground = false) {
        auto world = load_world_text(text, "start", {}, diagnostics);
        if (!world) return;
        if (on_ground) {
            EXPECT_TRUE(complete(*world, {.ground = true, .fixed_base = {}}));
        }
        model = compile(*world, {}, diagnostics);
        if (model && on_ground) model = stood_on_ground(*model, {}, diagnostics);
        if (model) report_overlaps(*model, &*world, diagnostics);
    }
    double at(const std::string& joint) const {
        const RobotType& type = model->types.front();
        const RobotState state = initial_state(*model, RobotId(std::size_t{0}));
        return state.q[static_cast<std::size_t>(type.joints[type.find_joint(joint)->index()].q_index)];
    }
    bool has(const std::string& code) const {
        for (const Diagnostic& d : diagnostics.items())
            if (d.code == code) return true;
        return false;
    }
};

void expect_hand(const Start& start, double leader, double follower) {
    ASSERT_TRUE(start.model);
    EXPECT_NEAR(start.at("leader"), leader, 1e-15);
    EXPECT_NEAR(start.at("follower"), follower, 1e-15);
    EXPECT_TRUE(start.has("start-moved"));
    EXPECT_EQ(start.diagnostics.count(Severity::kWarning), 0u);
}

std::string urdf_link(const std::string& name, const std::string& more = {}) {
    return "<link name='" + name +
           "'><inertial><mass value='.1'/><inertia ixx='1e-4' iyy='1e-4' izz='1e-4' ixy='0' ixz='0' iyz='0'/>"
           "</inertial>" +
           more + "</link>";
}

std::string urdf_hinge(const std::string& name, const std::string& parent, const std::string& child,
                       const std::string& limits, const std::string& more = {}) {
    return "<joint name='" + name + "' type='revolute'><parent link='" + parent + "'/><child link='" + child +
           "'/><axis xyz='0 1 0'/><limit " + limits + " effort='4' velocity='2'/>" + more + "</joint>";
}

TEST(Start, OfAUrdfHandWithAnOffsetMimic) {
    expect_hand(Start("<robot name='hand'><link name='world'/>" + urdf_link("palm") + urdf_link("a") +
                      urdf_link("b") +
                      "<joint name='mount' type='fixed'><parent link='world'/><child link='palm'/></joint>" +
                      urdf_hinge("leader", "palm", "a", "lower='0' upper='1'") +
                      urdf_hinge("follower", "palm", "b", "lower='0' upper='2'",
                                 "<mimic joint='leader' multiplier='1' offset='.4'/>") +
                      "</robot>"),
                0, 0.4);
}

std::string sdf_hand(const std::string& initial, const std::string& state = {}) {
    const auto link = [](const std::string& name) {
        return "<link name='" + name +
               "'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
               "</link>";
    };
    const auto hinge = [](const std::string& name, const std::string& child, const std::string& axis) {
        return "<joint name='" + name + "' type='revolute'><parent>palm</parent><child>" + child +
               "</child><axis><xyz>0 0 1</xyz>" + axis + "</axis></joint>";
    };
    const std::string mimic =
        "<mimic joint='leader'><multiplier>1</multiplier><offset>.4</offset>"
        "<reference>0</reference></mimic>";
    return "<sdf version='1.11'><world name='w'><gravity>0 0 0</gravity><model name='hand'>" + link("palm") +
           link("a") + link("b") +
           "<joint name='mount' type='fixed'><parent>world</parent><child>palm</child></joint>" +
           hinge("leader", "a", "<limit><lower>0</lower><upper>1</upper></limit>" + initial) +
           hinge("follower", "b", mimic + "<limit><lower>0</lower><upper>2</upper></limit>") + "</model>" +
           state + "</world></sdf>";
}

TEST(Start, OfAnSdfHandWithAnOffsetMimicAndAnInitialPositionBeyondItsLimit) {
    expect_hand(Start(sdf_hand("")), 0, 0.4);
    expect_hand(Start(sdf_hand("<initial_position>-.3</initial_position>")), 0, 0.4);
    expect_hand(Start(sdf_hand("<initial_position>.5</initial_position>")), 0.5, 0.9);
}

TEST(Start, OfASavedHand) {
    const std::string state =
        "<state world_name='w'><model name='hand'><joint name='leader'><angle axis='0'>1.5</angle></joint>"
        "<joint name='follower'><angle axis='0'>1.5</angle></joint></model></state>";
    expect_hand(Start(sdf_hand("", state)), 1, 1.4);
}

TEST(Start, OfAnMjcfHandWithReferencesAndAnEquality) {
    const std::string hand =
        "<mujoco><worldbody><body name='palm'><geom size='.1' contype='0' conaffinity='0'/>"
        "<body><geom size='.1' contype='0' conaffinity='0'/>"
        "<joint name='leader' axis='0 0 1' range='.25 1' limited='true' ref='REF'/></body>"
        "<body><geom size='.1' contype='0' conaffinity='0'/><joint name='follower' axis='0 0 1'/></body>"
        "</body></worldbody><compiler angle='radian'/>"
        "<equality><joint joint1='follower' joint2='leader' polycoef='.4 2 0 0 0'/></equality></mujoco>";
    for (const auto& [ref, leader] : {std::pair{"0", 0.25}, {"0.5", 0.5}, {"3", 1.0}}) {
        std::string text = hand;
        text.replace(text.find("REF"), 3, ref);
        // joint1 = its reference (0) + .4 + 2 (joint2 - its reference)
        expect_hand(Start(text), leader, 0.4 + 2 * (leader - std::stod(ref)));
    }
}

/// A trunk with two legs of two links; straight legs are beyond the limits of the knees.
std::string biped() {
    const auto box = [](const std::string& size, const std::string& z) {
        return "<collision><origin xyz='0 0 " + z + "'/><geometry><box size='" + size +
               "'/></geometry></collision>";
    };
    std::string text = "<robot name='biped'>" + urdf_link("trunk", box(".3 .3 .1", "0"));
    for (const std::string side : {"left", "right"}) {
        text += urdf_link(side + "_thigh", box(".03 .03 .2", "-.1")) +
                urdf_link(side + "_calf", box(".03 .03 .2", "-.1")) +
                urdf_hinge(side + "_hip", "trunk", side + "_thigh", "lower='-1' upper='1'",
                           "<origin xyz='0 " + std::string(side == "left" ? ".1" : "-.1") + " 0'/>") +
                urdf_hinge(side + "_knee", side + "_thigh", side + "_calf", "lower='-2.7' upper='-.6'",
                           "<origin xyz='0 0 -.2'/>");
    }
    return text + "</robot>";
}

TEST(Start, OfARobotWhoseFilePutsItsLegsIntoTheGround) {
    const Start bare(biped());
    ASSERT_TRUE(bare.model);
    EXPECT_EQ(bare.at("left_knee"), -0.6);
    EXPECT_FALSE(bare.has("start-overlap")) << "there is no ground";
    Diagnostics found;
    auto world = load_world_text(biped(), "start", {}, found);
    ASSERT_TRUE(complete(*world, {.ground = true, .fixed_base = {}}));
    report_overlaps(*compile(*world, {}, found), &*world, found);
    std::string told;
    for (const Diagnostic& d : found.items())
        if (d.code == "start-overlap") told = d.message;
    EXPECT_NE(told.find("'biped' starts in 'ground_plane'"), std::string::npos) << told;
    EXPECT_NE(told.find("_calf"), std::string::npos) << told;
}

TEST(Start, OnTheGroundThrowsNobody) {
    const Start start(biped(), true);
    ASSERT_TRUE(start.model);
    EXPECT_TRUE(start.has("start-on-ground"));
    EXPECT_FALSE(start.has("start-overlap"));
    RobotState state = initial_state(*start.model, RobotId(std::size_t{0}));
    const double height = state.q[2];
    EXPECT_GT(height, 0.3);
    RobotState* states[] = {&state};
    const RobotId robots[] = {RobotId(std::size_t{0})};
    Aabb bounds[1];
    StepScratch scratch;
    for (Tick t = 0; t < 1000; ++t) {  // its joints are free: it sinks together
        step_island(*start.model, t, robots, states, {}, bounds, scratch);
        ASSERT_LT(state.q[2], height + 1e-3) << t;
        ASSERT_LT(state.v[5], 0.3) << t;
    }
    EXPECT_LT(state.q[2], 0.5 * height);
}

/// A world at one of its keyframes.
std::shared_ptr<const Model> at_keyframe(const std::string& text, const std::string& keyframe,
                                         Diagnostics& diagnostics) {
    LoadOptions options;
    options.keyframe = keyframe;
    auto world = load_world_text(text, "keyed", options, diagnostics);
    return world ? compile(*world, {}, diagnostics) : nullptr;
}

constexpr const char* kKeyed =
    "<mujoco><compiler angle='radian'/><worldbody><body name='dog' pos='0 0 1'><freejoint/><geom size='.1'/>"
    "<body name='leg' pos='.2 0 0'><joint name='hip' axis='0 1 0' ref='.2'/><geom pos='0 0 -.3' size='.05'/>"
    "<body name='foot' pos='0 0 -.3'><joint name='ankle' type='ball' pos='0 0 .02'/><geom size='.05'/></body>"
    "</body></body></worldbody><keyframe><key name='lie' qpos='0 0 .3 1 0 0 0 .5 1 0 0 0'/>"
    "<key name='jump' qpos='1 2 3 0 0 0 1 -.4 .8 0 .6 0' qvel='1 2 3 4 5 6 7 8 9 10'/></keyframe></mujoco>";

TEST(Start, AtAKeyframeOfMujoco) {
    for (const char* name : {"jump", "1"}) {
        Diagnostics diagnostics;
        const auto model = at_keyframe(kKeyed, name, diagnostics);
        ASSERT_TRUE(model);
        EXPECT_FALSE(diagnostics.has_errors());
        const RobotState state = initial_state(*model, RobotId(std::size_t{0}));
        const std::vector<double> q{1, 2, 3, 0, 0, 0, 1, -0.4, 0.8, 0, 0.6, 0};
        ASSERT_EQ(state.q.size(), q.size());
        for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(state.q[i], q[i], 1e-12) << i;
        // The base turns by half a turn about z: its own axes x and y point backwards. The ball turns by
        // 73.7 degrees about y; its rates are in the axes of the foot.
        const std::vector<double> v{-4, -5, 6, 1, 2, 3, 7, 0.28 * 8 + 0.96 * 10, 9, -0.96 * 8 + 0.28 * 10};
        ASSERT_EQ(state.v.size(), v.size());
        for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(state.v[i], v[i], 1e-9) << i;
    }
}

TEST(Start, WithoutAKeyframeBodiesStandWhereTheyAre) {
    Diagnostics diagnostics;
    const auto model = at_keyframe(kKeyed, "", diagnostics);
    ASSERT_TRUE(model);
    const RobotState state = initial_state(*model, RobotId(std::size_t{0}));
    EXPECT_EQ(state.q[2], 1);
    EXPECT_NEAR(state.q[7], 0.2, 1e-15);
    for (const Diagnostic& d : diagnostics.items())
        if (d.code == "keyframe") {
            EXPECT_NE(d.message.find("lie, jump"), std::string::npos) << d.message;
        }
}

TEST(Start, AnUnknownKeyframeIsAnErrorThatNamesThoseThatExist) {
    for (const char* name : {"leap", "2"}) {
        Diagnostics diagnostics;
        at_keyframe(kKeyed, name, diagnostics);
        ASSERT_TRUE(diagnostics.has_errors());
        bool told = false;
        for (const Diagnostic& d : diagnostics.items())
            told |= d.code == "no-keyframe" && d.remedy.find("lie, jump") != std::string::npos;
        EXPECT_TRUE(told);
    }
    Diagnostics diagnostics;
    at_keyframe(
        "<mujoco><worldbody><body><joint/><geom size='1'/></body></worldbody><keyframe><key qpos='1 "
        "2'/></keyframe></mujoco>",
        "0", diagnostics);
    EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace roboss
