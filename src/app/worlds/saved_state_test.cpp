// <state>: what a saved world says of models, links and joints is where they start.
#include <gtest/gtest.h>

#include "model/coordinates.h"
#include "model/robot_state.h"
#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& axes) {
    return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child +
           "</child>" + axes + "</joint>";
}

std::string axis(const std::string& xyz, const std::string& element = "axis") {
    return "<" + element + "><xyz>" + xyz + "</xyz></" + element + ">";
}

std::string link_at(const std::string& name, const std::string& pose) {
    return "<link name='" + name + "'><pose>" + pose + "</pose>" +
           link(name).substr(link(name).find('>') + 1);
}

std::string numbers(const Pose& X) {
    const Mat3 R = to_matrix(X.q);
    const double roll = fixed_atan2(R(2, 1), R(2, 2)), yaw = fixed_atan2(R(1, 0), R(0, 0));
    const double pitch = -fixed_asin(R(2, 0));
    std::string text;
    for (const double x : {X.p.x, X.p.y, X.p.z, roll, pitch, yaw}) {
        char word[40];
        std::snprintf(word, sizeof word, "%.17g ", x);
        text += word;
    }
    return text;
}

/// A tree with a joint of every kind that moves.
const std::string kTree =
    "<model name='m'><pose>1 2 3 0.1 0.2 0.3</pose>" + link_at("base", "0 0 1 0 0 0") +
    link_at("arm", "1 0 1 0 0.3 0") + link_at("slide", "2 0 1 0 0 0") + link_at("wrist", "3 0 1 0.2 0 0") +
    link_at("ball", "0 1 1 0 0 0") + link_at("nut", "0 2 1 0 0 0") +
    joint("a", "revolute", "base", "arm", axis("0 0.6 0.8")) +
    joint("b", "prismatic", "arm", "slide", axis("1 0 0")) +
    joint("c", "universal", "slide", "wrist", axis("0 0 1") + axis("0 1 0", "axis2")) +
    joint("d", "ball", "base", "ball", "") +
    joint("e", "screw", "base", "nut", axis("0 0 1") + "<thread_pitch>-10</thread_pitch>") + "</model>";

std::shared_ptr<const Model> compiled(const Loaded& loaded) {
    Diagnostics diagnostics;
    auto model = loaded.world ? compile(*loaded.world, {}, diagnostics) : nullptr;
    for (const Diagnostic& d : diagnostics.items())
        EXPECT_EQ(d.code.find("start-does"), std::string::npos) << to_text(d);
    return model;
}

/// Pose and velocity (of its origin) of a link in a state.
struct Moving {
    Pose X;
    Vec3 linear, angular;
};
Moving moving(const RobotType& type, const RobotState& state, const std::string& name) {
    TreePlacement placement;
    place_tree(type, state.q, placement);
    const Link& link = type.links[type.find_link(name)->index()];
    const Transform X_OL = placement.of(link.body) * link.X_BL;
    Spatial motion;
    int last = -1;  // of a fixed base
    if (link.body >= 0) {
        const Body& body = type.bodies[static_cast<std::size_t>(link.body)];
        last = body.v_index + body.nv - 1;
    }
    for (int k = last; k >= 0; k = type.dof_parent[static_cast<std::size_t>(k)])
        motion += placement.axes[static_cast<std::size_t>(k)] * state.v[static_cast<std::size_t>(k)];
    return {to_pose(Transform{X_OL.R, X_OL.p + placement.origin}),
            motion.linear + cross(motion.angular, X_OL.p), motion.angular};
}

std::string state_of(const RobotType& type, const RobotState& state) {
    std::string text;
    for (const Link& link : type.links) {
        const Moving m = moving(type, state, link.name);
        text += "<link name='" + link.name + "'><pose>" + numbers(m.X) + "</pose><velocity>";
        for (const double x : {m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z}) {
            char word[40];
            std::snprintf(word, sizeof word, "%.17g ", x);
            text += word;
        }
        text += "</velocity></link>";
    }
    return "<state world_name='w'><sim_time>12 5</sim_time><model name='m'><pose>9 9 9 0 0 0</pose>" + text +
           "</model></state>";
}

TEST(SavedState, LinksAndJointsOfEveryKindStartWhereTheyWereSavedAndMoveOn) {
    for (const bool fixed : {false, true}) {
        std::string tree = kTree;
        if (fixed) tree.insert(tree.find("</model>"), joint("w", "fixed", "world", "base", ""));
        const auto model = compiled(load_elements(tree));
        ASSERT_TRUE(model);
        const RobotType& type = model->types[0];
        RobotState there = initial_state(*model, RobotId(0u));
        std::vector<double> turn(there.v.size());
        for (std::size_t k = static_cast<std::size_t>(type.base_nv()); k < turn.size(); ++k)
            turn[k] = 0.7 + 0.31 * static_cast<double>(k % 5);
        advance_coordinates<double>(type, turn, 1.0, there.q);
        if (!fixed) set_base_pose(there, {{-4, 5, 6}, from_rpy(-1, 0.5, 2)});
        for (std::size_t k = 0; k < turn.size(); ++k) there.v[k] = 0.3 * static_cast<double>(k) - 1;
        std::string state = state_of(type, there);
        if (fixed) state.replace(state.find("9 9 9 0 0 0"), 11, "1 2 3 0.1 0.2 0.3");
        const Loaded loaded = load_elements(tree + state);
        EXPECT_TRUE(loaded.find("state")) << loaded.text();
        const auto saved = compiled(loaded);
        ASSERT_TRUE(saved);
        const RobotState start = initial_state(*saved, RobotId(0u));
        for (const Link& link : type.links) {
            const Moving a = moving(type, there, link.name), b = moving(type, start, link.name);
            EXPECT_LT(norm(a.X.p - b.X.p), 1e-9) << link.name;
            EXPECT_LT(norm(logarithm(a.X.q * conjugate(b.X.q))), 1e-9) << link.name;
            EXPECT_LT(norm(a.linear - b.linear), 1e-8) << link.name;
            EXPECT_LT(norm(a.angular - b.angular), 1e-8) << link.name;
        }
        const Joint& screw = type.joints[type.find_joint("e")->index()];
        const auto at = static_cast<std::size_t>(screw.q_index);
        EXPECT_NEAR(start.q[at], there.q[at], 1e-9);
        EXPECT_NE(saved->hash, model->hash) << "the start is part of the Model";
    }
}

TEST(SavedState, AScrewMayHaveTurnedManyTimes) {
    const std::string screw =
        "<model name='m'>" + link("base") + link_at("nut", "0 0 1 0 0 0") +
        joint("e", "screw", "base", "nut", axis("0 0 1") + "<thread_pitch>-10</thread_pitch>") + "</model>";
    const auto model = compiled(load_elements(screw));
    RobotState there = initial_state(*model, RobotId(0u));
    there.q[7] = 40;
    const auto saved = compiled(load_elements(screw + state_of(model->types[0], there)));
    EXPECT_NEAR(initial_state(*saved, RobotId(0u)).q[7], 40, 1e-9);
}

TEST(SavedState, WithoutLinksTheModelMovesAsItIsAndAnglesCount) {
    const Loaded loaded =
        load_elements(kTree +
                      "<state world_name='w'><model name='m'><pose>5 0 0 0 0 0</pose><scale>1 1 1</scale>"
                      "<joint name='a'><angle axis='0'>0.25</angle></joint>"
                      "<joint name='c'><angle axis='1'>-0.5</angle></joint></model></state>");
    const auto model = compiled(loaded);
    ASSERT_TRUE(model) << loaded.text();
    const RobotState start = initial_state(*model, RobotId(0u));
    EXPECT_EQ(base_pose(start).p, (Vec3{5, 0, 1}));
    const RobotType& type = model->types[0];
    const auto q_of = [&](const char* name, int axis) {
        const Joint& joint = type.joints[type.find_joint(name)->index()];
        return start.q[static_cast<std::size_t>(joint.q_index + joint.axis_offset(axis))];
    };
    EXPECT_EQ(q_of("a", 0), 0.25);
    EXPECT_EQ(q_of("c", 0), 0);
    EXPECT_EQ(q_of("c", 1), -0.5);
    EXPECT_TRUE(std::all_of(start.v.begin(), start.v.end(), [](double v) { return v == 0; }));
}

TEST(SavedState, ModelsComeAndGoAndStaticOnesAndClonesAreMoved) {
    const std::string box = link("a");
    const Loaded loaded = load_elements(
        "<model name='gone'>" + box + "</model><model name='wall'><static>1</static>" + box +
        "</model><population name='p'><model name='x'>" + box +
        "</model><model_count>2</model_count><distribution><type>linear-x</type></distribution>"
        "<box><size>4 4 4</size></box></population><state world_name='other'><insertions><model name='new'>" +
        box +
        "<pose>7 0 0 0 0 0</pose></model><light name='l' type='point'/></insertions><deletions>"
        "<name>gone</name><name>never</name></deletions>"
        "<model name='wall'><pose>1 1 1 0 0 0</pose><link name='a'><pose>1 1 1 0 0 0</pose></link></model>"
        "<model name='x_clone_1'><pose>3 3 3 0 0 0</pose></model>"
        "<model name='who'><pose>0 0 0 0 0 0</pose></model><light name='sun'><pose>0 0 9 0 0 0</pose></light>"
        "</state><state world_name='later'/>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    std::map<std::string, Vec3> places;
    for (const ModelInstance& instance : loaded.world->instances) places[instance.name] = instance.X_WM.p;
    EXPECT_EQ(places.size(), 4u);
    EXPECT_FALSE(places.contains("gone"));
    EXPECT_EQ(places["new"], (Vec3{7, 0, 0}));
    EXPECT_EQ(places["wall"], (Vec3{1, 1, 1}));
    EXPECT_EQ(places["x_clone_1"], (Vec3{3, 3, 3}));
    ASSERT_TRUE(loaded.find("state-unknown-model"));
    EXPECT_NE(loaded.find("state-unknown-model")->message.find("'who'"), std::string::npos);
    EXPECT_TRUE(loaded.find("second-state"));
    EXPECT_FALSE(loaded.find("state-unknown-link"));
}

TEST(SavedState, NestedLinksHaveTheNameOfTheirModelInFront) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + "<model name='in'>" + link("b") + "</model>" +
        joint("j", "revolute", "a", "in::b", axis("0 0 1")) +
        "</model><state world_name='w'><model name='m'><link name='a'><pose>0 0 1 0 0 0</pose></link>"
        "<model name='in'><link name='b'><pose>0 0 1 0 0 1.5</pose></link></model>"
        "<link name='c'><pose>0 0 0 0 0 0</pose></link></model></state>");
    const auto model = compiled(loaded);
    ASSERT_TRUE(model) << loaded.text();
    EXPECT_NEAR(initial_state(*model, RobotId(0u)).q[7], 1.5, 1e-12);
    EXPECT_TRUE(loaded.find("state-unknown-link")) << "c";
}

TEST(SavedState, WhatIsWrongLeavesItsModelOutAndIsNamed) {
    const Loaded loaded = load_elements(
        "<model name='good'>" + link("a") + "</model><model name='m'>" + link("a") +
        "</model><state world_name='w'><model name='m'><pose>1 2 x 0 0 0</pose></model></state>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 1u);
    EXPECT_EQ(loaded.world->instances[0].name, "good");
    EXPECT_TRUE(loaded.find("left-out"));
    const Loaded odd =
        load_elements("<model name='m'>" + link("a") +
                      "</model><state world_name='w'><model name='m'><pose relative_to='f'>1 2 3 0 0 "
                      "0</pose><scale>2 0 1</scale><psoe/></model></state>");
    for (const char* code : {"state-frame", "state-scale", "unknown-element"})
        EXPECT_TRUE(odd.find(code)) << code << "\n" << odd.text();
}

TEST(SavedState, ScaleMultipliesTheSizesOfThatModelOnly) {
    const auto box = [](const std::string& name) {
        return link(name,
                    "<collision name='c'><pose>0 0 1 0 0 0</pose><geometry><box><size>1 2 4</size></box>"
                    "</geometry></collision><visual name='v'><geometry><sphere><radius>2</radius>"
                    "</sphere></geometry></visual>");
    };
    const std::string scaled = "<model name='in'><scale>1 1 3</scale></model>";
    const auto model = [&](const std::string& name) {
        return "<model name='" + name + "'>" + box("a") + "<model name='in'>" + box("b") + "</model></model>";
    };
    const Loaded loaded =
        load_elements(model("x") + model("y") + model("z") +
                      "<state world_name='w'><model name='y'><scale>2 1 0.5</scale>" + scaled +
                      "</model><model name='z'><scale>2 1 0.5</scale>" + scaled + "</model></state>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.find("state-scale"), nullptr) << loaded.text();
    const World& world = *loaded.world;
    ASSERT_EQ(world.prototypes.size(), 2u) << "equal scales share a prototype";
    EXPECT_EQ(world.instances.at(1).prototype, world.instances.at(2).prototype);
    const ModelSpec& plain = world.prototypes[world.instances.at(0).prototype];
    const ModelSpec& changed = world.prototypes[world.instances[1].prototype];
    EXPECT_EQ(plain.links.at(0).collisions.at(0).geometry.size, (Vec3{1, 2, 4}));
    EXPECT_EQ(changed.links.at(0).collisions.at(0).geometry.size, (Vec3{2, 2, 2}));
    EXPECT_EQ(changed.links[0].collisions[0].X_LS.p.z, 1) << "places stay";
    EXPECT_EQ(changed.links[0].visuals.at(0).geometry.radius, 4) << "by the largest factor";
    EXPECT_EQ(changed.links[0].mass, plain.links[0].mass);
    EXPECT_EQ(changed.links.at(1).collisions.at(0).geometry.size, (Vec3{1, 2, 12}))
        << "the nested model's own";
}

TEST(SavedState, LinksThatDoNotFitTheirJointsAreToldAndTheRestIsKept) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + link("b") + joint("j", "revolute", "a", "b", axis("0 0 1")) +
        "</model><state world_name='w'><model name='m'><link name='a'><pose>0 0 0 0 0 0</pose></link>"
        "<link name='b'><pose>0 0 0.5 0 0 1</pose></link></model></state>");
    Diagnostics diagnostics;
    const auto model = compile(*loaded.world, {}, diagnostics);
    ASSERT_TRUE(model);
    EXPECT_NEAR(initial_state(*model, RobotId(0u)).q[7], 1, 1e-12);
    ASSERT_EQ(diagnostics.items().size(), 1u);
    EXPECT_EQ(diagnostics.items()[0].code, "start-does-not-fit");
}

}  // namespace
}  // namespace roboss
