// What a joint or a flag says without effect is told, with its line.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

/// A model with one joint, whose elements begin on line 2.
Loaded load_joint(const std::string& type, const std::string& rest) {
    return load_elements("<model name='m'>" + link("a") + link("b") + "<joint name='j' type='" + type +
                         "'><parent>a</parent><child>b</child>\n" + rest + "</joint></model>");
}

TEST(UnusedValues, WhatAJointCannotUseIsReported) {
    const auto load = load_joint;
    const std::string damped = "<xyz>0 0 1</xyz><dynamics><damping>1</damping></dynamics>";
    const std::string rubbed = "<xyz>0 0 1</xyz><dynamics><friction>1</friction></dynamics>";
    EXPECT_NE(load("ball", "<axis>" + rubbed + "</axis>").find("unused-axis"), nullptr);
    const Loaded ball = load("ball", "<axis>" + damped + "</axis>");
    EXPECT_EQ(ball.find("unused-axis"), nullptr);
    EXPECT_EQ(ball.world->prototypes[0].joints[0].ball_damping, 1);
    EXPECT_NE(
        load("revolute", "<axis><xyz>0 0 1</xyz></axis><axis2>" + damped + "</axis2>").find("unused-axis"),
        nullptr);
    EXPECT_EQ(
        load("universal", "<axis>" + damped + "</axis><axis2>" + damped + "</axis2>").find("unused-axis"),
        nullptr);
    EXPECT_NE(
        load("ball", "<physics><ode><cfm_damping>1</cfm_damping></ode></physics>").find("joint-physics"),
        nullptr);
}

TEST(UnusedValues, SelfCollisionThatOneLinkAsksForIsToldOnceForItsModel) {
    const auto load = [](const std::string& of_model) {
        const std::string asks = "\n<self_collide>1</self_collide>";
        return load_elements("<model name='m'>" + of_model + link("a", asks) + link("b", asks) + "</model>");
    };
    const Loaded of_link = load("");
    EXPECT_TRUE(of_link.world->prototypes[0].self_collide);
    ASSERT_EQ(of_link.diagnostics.items().size(), 1u) << of_link.text();
    EXPECT_EQ(of_link.diagnostics.items()[0].code, "self-collide");
    EXPECT_EQ(of_link.diagnostics.items()[0].where.line, 2);
    EXPECT_TRUE(load("<self_collide>1</self_collide>").diagnostics.items().empty());
}

TEST(UnusedValues, FlagsOfANestedModelThatItsOuterModelDoesNotShareAreReported) {
    const auto load = [](const std::string& outer, const std::string& inner) {
        return load_elements("<model name='m'>" + outer + link("a") + "<model name='n'>\n" + inner +
                             link("b") + "</model></model>");
    };
    for (const char* flag :
         {"<self_collide>1</self_collide>", "<allow_auto_disable>0</allow_auto_disable>"}) {
        const Loaded nested = load("", flag);
        ASSERT_NE(nested.find("nested-flag"), nullptr) << flag;
        EXPECT_EQ(nested.find("nested-flag")->where.line, 2);
        EXPECT_TRUE(load(flag, flag).diagnostics.items().empty()) << load(flag, flag).text();
    }
}

TEST(UnusedValues, LimitsOfAContinuousJointAreReported) {
    const auto load = [](const std::string& limit) {
        return load_joint("continuous", "<axis><xyz>0 0 1</xyz>\n<limit>" + limit + "</limit></axis>");
    };
    for (const char* limit : {"<lower>-1</lower>", "<upper>1</upper>", "<stiffness>100</stiffness>",
                              "<dissipation>7</dissipation>"}) {
        const Loaded loaded = load(limit);
        ASSERT_NE(loaded.find("unused-limit"), nullptr) << limit;
        EXPECT_EQ(loaded.find("unused-limit")->where.line, 3);
        EXPECT_EQ(loaded.diagnostics.items().size(), 1u) << loaded.text();
    }
    for (const char* limit : {"<lower>-1e16</lower><upper>1e16</upper>", "<lower>-inf</lower>",
                              "<effort>3</effort><velocity>2</velocity>"})
        EXPECT_TRUE(load(limit).diagnostics.items().empty()) << limit;
}

TEST(UnusedValues, SoftnessWithoutLimitsIsReported) {
    const auto load = [](const std::string& limit) {
        return load_joint("revolute", "<axis><xyz>0 0 1</xyz><limit>\n" + limit + "</limit></axis>");
    };
    const Loaded both = load("<stiffness>100</stiffness>\n<dissipation>7</dissipation>");
    EXPECT_NE(both.text().find("world.sdf:3: note: <stiffness> has no effect: the axis has no limits"),
              std::string::npos)
        << both.text();
    EXPECT_NE(both.text().find("world.sdf:4: note: <dissipation> has no effect: the axis has no limits"),
              std::string::npos)
        << both.text();
    EXPECT_NE(load("<upper>1e16</upper><stiffness>100</stiffness>").find("axis-element"), nullptr);
    for (const char* limit : {"<upper>1</upper><stiffness>100</stiffness><dissipation>7</dissipation>",
                              "<stiffness>1e8</stiffness><dissipation>1</dissipation>"})
        EXPECT_TRUE(load(limit).diagnostics.items().empty()) << limit;
}

TEST(UnusedValues, MotorsAndStartsWithoutAnAxisAreReported) {
    const std::string motor = "<roboss:motor><position_gain>5</position_gain></roboss:motor>";
    for (const char* type : {"ball", "fixed"}) {
        const Loaded at_joint = load_joint(type, motor);
        ASSERT_NE(at_joint.find("unused-motor"), nullptr) << type;
        EXPECT_EQ(at_joint.find("unused-motor")->where.line, 2);
        EXPECT_NE(load_joint(type, "<axis><xyz>0 0 1</xyz>" + motor + "</axis>").find("unused-axis"), nullptr)
            << type;
    }
    EXPECT_TRUE(load_joint("revolute", motor + "<axis><xyz>0 0 1</xyz></axis>").diagnostics.items().empty());
    const auto surplus = [](const std::string& rest) {
        return load_joint("revolute",
                          "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz>" + rest + "</axis2>");
    };
    EXPECT_NE(surplus(motor).find("unused-axis"), nullptr);
    EXPECT_NE(surplus("<initial_position>.1</initial_position>").find("unused-axis"), nullptr);
    EXPECT_NE(surplus("<limit><stiffness>9</stiffness></limit>").find("unused-axis"), nullptr);
    EXPECT_TRUE(surplus("<initial_position>0</initial_position>").diagnostics.items().empty());
}

}  // namespace
}  // namespace roboss
