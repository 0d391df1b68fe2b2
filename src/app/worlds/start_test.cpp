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

}  // namespace
}  // namespace roboss
