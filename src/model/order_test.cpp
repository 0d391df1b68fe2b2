// Orders from outside: wrong ones are refused in words that name the thing and the remedy.
#include "model/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <support/robots.h>

namespace roboss::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const RobotId kCar(std::size_t{0}), kArm(std::size_t{1}), kTree(std::size_t{2});

std::shared_ptr<const Model> three_robots() {
    World world = empty_world(1e-3);
    place(world, car(), "car_7");
    place(world, arm(), "arm_1");
    place(world, mixed_tree(), "tree_3");
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

class CheckOrder : public testing::Test {
  protected:
    JointId joint(RobotId robot, const char* name) { return *model_->type_of(robot).find_joint(name); }
    std::string refusal(RobotId robot, Action action) {
        const Result<> result =
            check_order(*model_, {0, ClientId(std::size_t{0}), 0, robot, std::move(action)});
        return result.ok() ? "" : result.error().text();
    }
    void expect_refused(RobotId robot, Action action, const std::vector<std::string>& words) {
        const std::string text = refusal(robot, std::move(action));
        EXPECT_NE(text, "") << "was accepted";
        EXPECT_NE(text.find("remedy"), std::string::npos) << text;
        for (const std::string& word : words)
            EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
    }
    std::shared_ptr<const Model> model_ = three_robots();
};

TEST_F(CheckOrder, AcceptsWhatMakesSense) {
    EXPECT_EQ(refusal(kCar, SetPose{{{1, 2, 3}, from_rpy(1, 2, 3)}}), "");
    EXPECT_EQ(refusal(kArm, SetPose{{{1, 2, 3}, {}}}), "");
    EXPECT_EQ(refusal(kCar, SetVelocity{{1, 2, 3}, {4, 5, 6}}), "");
    EXPECT_EQ(refusal(kCar, ApplyWrench{LinkId(std::size_t{4}), {1, 0, 0}, {}, 1}), "");
    EXPECT_EQ(refusal(kCar, SetJoint{joint(kCar, "wheel_0"), 0, MotorMode::kVelocity, 5, -1}), "");
    EXPECT_EQ(refusal(kTree, SetJoint{joint(kTree, "shoulder"), 1, MotorMode::kPosition, 0.5, 2}), "");
    EXPECT_EQ(refusal(kTree, SetJoint{joint(kTree, "ball"), 2, MotorMode::kEffort, 0.5, 2}), "");
}

TEST_F(CheckOrder, RefusesOrdersToAJointWithALimitOfZeroWithTheReason) {
    struct Case {
        double effort, velocity;
        const char *code, *reason;
    };
    for (const Case& c : {Case{0, 0, "no-effort", "effort limit is 0"},
                          {0, 3, "no-effort", "effort limit is 0"},
                          {5, 0, "no-velocity", "velocity limit is 0"},
                          {-1, 0, "no-velocity", "velocity limit is 0"}}) {
        World world = empty_world(1e-3);
        ModelSpec idle = arm();
        const auto moves = [](const JointSpec& joint) { return !joint.axes.empty(); };
        JointSpec& joint = *std::ranges::find_if(idle.joints, moves);
        joint.axes[0].max_effort = c.effort, joint.axes[0].max_velocity = c.velocity;
        place(world, idle, "idle");
        Diagnostics diagnostics;
        model_ = compile(world, {}, diagnostics);
        ASSERT_NE(model_, nullptr);
        ASSERT_EQ(diagnostics.items().size(), 1u) << c.reason;
        const Diagnostic& warned = diagnostics.items()[0];
        EXPECT_EQ(warned.severity, Severity::kWarning);
        EXPECT_EQ(warned.code, c.code);
        EXPECT_NE(warned.message.find("joint '" + joint.name + "'"), std::string::npos) << warned.message;
        EXPECT_NE(warned.message.find("so it moves freely"), std::string::npos) << "one joint";
        const RobotId robot(std::size_t{0});
        const JointId id = *model_->type_of(robot).find_joint(joint.name);
        for (const MotorMode mode : {MotorMode::kVelocity, MotorMode::kPosition, MotorMode::kEffort})
            expect_refused(robot, SetJoint{id, 0, mode, 0.1, -1}, {joint.name, c.reason});
        EXPECT_EQ(refusal(robot, SetJoint{id, 0, MotorMode::kPassive, 0, -1}), "");
    }
}

TEST_F(CheckOrder, TakesStatesOfJointsWithOneNumberForEachAxis) {
    const JointId wheel = joint(kCar, "wheel_0"), shoulder = joint(kTree, "shoulder"),
                  ball = joint(kTree, "ball");
    EXPECT_EQ(refusal(kCar, SetJointState{wheel, {0.5}, {}}), "");
    EXPECT_EQ(refusal(kCar, SetJointState{wheel, {}, {-2}}), "");
    EXPECT_EQ(refusal(kTree, SetJointState{shoulder, {0.5, 1}, {1, 2}}), "");
    EXPECT_EQ(refusal(kTree, SetJointState{ball, {0.5, 1, 2}, {1, 2, 3}}), "");
    expect_refused(kCar, SetJointState{wheel, {0.5, 1}, {}}, {"wheel_0", "car_7", "2 values", "1 axes"});
    expect_refused(kTree, SetJointState{ball, {0.5}, {}}, {"ball", "rotation vector"});
    expect_refused(kCar, SetJointState{wheel, {}, {}}, {"wheel_0", "neither"});
    expect_refused(kCar, SetJointState{wheel, {kNan}, {}}, {"wheel_0", "finite"});
    expect_refused(kCar, SetJointState{wheel, {}, {kInfinity}}, {"wheel_0", "finite"});
    expect_refused(kCar, SetJointState{wheel, {1.1e9}, {}}, {"position", "beyond the limit"});
    expect_refused(kCar, SetJointState{wheel, {}, {-1.1e5}}, {"velocity", "beyond the limit"});
    expect_refused(kCar, SetJointState{JointId(std::size_t{99}), {1}, {}}, {"car_7", "does not have"});
}

TEST_F(CheckOrder, StatesOfJointsAreWhatOneReadsThen) {
    RobotState state = initial_state(*model_, kTree);
    const JointId shoulder = joint(kTree, "shoulder"), ball = joint(kTree, "ball");
    const RobotType& type = model_->type_of(kTree);
    state.rest.still_ticks = 7;
    const RobotState before = state;
    const auto give = [&](Action action) {
        apply_order(*model_, {0, ClientId(), 0, kTree, std::move(action)}, state);
    };
    give(SetJointState{shoulder, {0.5, -1}, {}});
    give(SetJointState{ball, {0.3, 0, 0.4}, {1, 2, 3}});
    EXPECT_EQ(state.rest.still_ticks, 0) << "it wakes";
    EXPECT_EQ(state.motors, before.motors) << "setpoints are kept";
    const auto q = [&](JointId id, int axis) {
        const Joint& j = type.joints[id.index()];
        return state.q[static_cast<std::size_t>(j.q_index + j.axis_offset(axis))];
    };
    EXPECT_EQ(q(shoulder, 0), 0.5);
    EXPECT_EQ(q(shoulder, 1), -1);
    const auto at = static_cast<std::size_t>(type.joints[ball.index()].q_index);
    EXPECT_NEAR(state.q[at], std::cos(0.25), 1e-12) << "half of an angle of 0.5 rad";
    EXPECT_NEAR(state.q[at + 1], 0.6 * std::sin(0.25), 1e-12);
    EXPECT_NEAR(state.q[at + 3], 0.8 * std::sin(0.25), 1e-12);
    const auto v = static_cast<std::size_t>(type.joints[ball.index()].v_index);
    EXPECT_EQ(state.v[v + 1], 2);
    EXPECT_EQ(state.v.size(), before.v.size());
}

TEST_F(CheckOrder, RefusesAnUnknownRobot) {
    expect_refused(RobotId(std::size_t{3}), SetVelocity{}, {"robot number 3", "3 robots"});
    expect_refused(RobotId(), SetVelocity{}, {"3 robots"});
}

TEST_F(CheckOrder, RefusesNumbersThatAreNotFinite) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        expect_refused(kCar, SetPose{{{bad, 0, 0}, {}}}, {"set_pose", "car_7", "finite"});
        expect_refused(kCar, SetPose{{{}, {1, 0, bad, 0}}}, {"set_pose", "car_7", "finite"});
        expect_refused(kCar, SetVelocity{{0, bad, 0}, {}}, {"set_velocity", "car_7", "finite"});
        expect_refused(kCar, SetVelocity{{}, {0, 0, bad}}, {"set_velocity", "car_7", "finite"});
        expect_refused(kCar, ApplyWrench{LinkId(std::size_t{0}), {bad, 0, 0}, {}, 1},
                       {"wrench", "car_7", "finite"});
        expect_refused(kCar, ApplyWrench{LinkId(std::size_t{0}), {}, {0, bad, 0}, 1},
                       {"wrench", "car_7", "finite"});
        expect_refused(kCar, SetJoint{joint(kCar, "wheel_2"), 0, MotorMode::kVelocity, bad, 1},
                       {"wheel_2", "car_7", "finite"});
    }
    expect_refused(kCar, SetJoint{joint(kCar, "wheel_2"), 0, MotorMode::kVelocity, 1, kNan},
                   {"wheel_2", "finite"});
}

/// One order with 1e308 must not end a run for everybody.
TEST_F(CheckOrder, RefusesNumbersBeyondTheLimitsByNameAndAcceptsThoseAtThem) {
    const OrderLimits& most = kOrderLimits;
    const double more = 1 + 1e-12;
    const JointId wheel = joint(kCar, "wheel_2");
    const LinkId link(0u);
    const auto expect_limit = [&](double limit, const std::function<Action(double)>& action,
                                  const std::vector<std::string>& words) {
        for (const double sign : {1.0, -1.0}) {
            EXPECT_EQ(refusal(kCar, action(sign * limit)), "") << words[0];
            for (const double beyond : {sign * limit * more, sign * 1e308}) {
                expect_refused(kCar, action(beyond), words);
                expect_refused(kCar, action(beyond), {"car_7", "beyond the limit"});
            }
        }
    };
    expect_limit(most.position,
                 [](double x) {
                     return SetPose{{{0, 0, x}, {}}};
                 },
                 {"set_pose", "position", "1e+09 m"});
    expect_limit(most.speed,
                 [](double x) {
                     return SetVelocity{{0, x, 0}, {}};
                 },
                 {"set_velocity", "linear velocity", "m/s"});
    expect_limit(most.turn_rate,
                 [](double x) {
                     return SetVelocity{{}, {x, 0, 0}};
                 },
                 {"set_velocity", "angular velocity", "rad/s"});
    expect_limit(most.force,
                 [&](double x) {
                     return ApplyWrench{link, {x, 0, 0}, {}, 1};
                 },
                 {"wrench", "force", " N"});
    expect_limit(most.torque,
                 [&](double x) {
                     return ApplyWrench{link, {}, {0, 0, x}, 1};
                 },
                 {"wrench", "torque", "N m"});
    const auto target = [&](MotorMode mode) {
        return [=](double x) { return SetJoint{wheel, 0, mode, x, -1}; };
    };
    expect_limit(most.speed, target(MotorMode::kVelocity), {"wheel_2", "velocity", "rad/s"});
    expect_limit(most.position, target(MotorMode::kPosition), {"wheel_2", "position", "rad"});
    expect_limit(most.force, target(MotorMode::kEffort), {"wheel_2", "effort", "N m"});
    EXPECT_EQ(refusal(kCar, SetJoint{wheel, 0, MotorMode::kPassive, 1e308, -1}), "") << "it is not used";
    EXPECT_EQ(refusal(kCar, SetJoint{wheel, 0, MotorMode::kVelocity, 1, kInfinity}), "")
        << "the joint's own bound";
}

TEST_F(CheckOrder, RefusesAQuaternionThatIsNoRotation) {
    expect_refused(kCar, SetPose{{{}, {0, 0, 0, 0}}}, {"quaternion", "0.0", "unit quaternion"});
    expect_refused(kCar, SetPose{{{}, {1, 1, 0, 0}}}, {"quaternion", "1.41", "[w, x, y, z]"});
}

TEST_F(CheckOrder, RefusesTheVelocityOfAFixedBase) {
    expect_refused(kArm, SetVelocity{{1, 0, 0}, {}}, {"arm_1", "fixed", "joints"});
}

TEST_F(CheckOrder, RefusesUnknownLinksAndJoints) {
    expect_refused(kCar, ApplyWrench{LinkId(std::size_t{5}), {}, {}, 1}, {"link", "car_7"});
    expect_refused(kCar, ApplyWrench{LinkId(), {}, {}, 1}, {"link", "car_7"});
    expect_refused(kCar, SetJoint{JointId(std::size_t{4}), 0, MotorMode::kVelocity, 1, 1},
                   {"joint", "car_7"});
}

TEST_F(CheckOrder, RefusesAxesThatTheJointDoesNotHave) {
    expect_refused(kCar, SetJoint{joint(kCar, "wheel_0"), 1, MotorMode::kVelocity, 1, 1},
                   {"wheel_0", "1 degrees", "axis 1"});
    expect_refused(kCar, SetJoint{joint(kCar, "wheel_0"), -1, MotorMode::kVelocity, 1, 1}, {"axis -1"});
    expect_refused(kTree, SetJoint{joint(kTree, "weld_mast"), 0, MotorMode::kVelocity, 1, 1},
                   {"weld_mast", "fixed joints take no orders"});
    expect_refused(kTree, SetJoint{joint(kTree, "ball"), 0, MotorMode::kPosition, 1, 1},
                   {"ball", "position"});
}

TEST_F(CheckOrder, RefusesWrenchesOfNoDurationOrOfOneThatOverflows) {
    expect_refused(kCar, ApplyWrench{LinkId(std::size_t{0}), {}, {}, 0}, {"tick", "duration"});
    expect_refused(kCar, ApplyWrench{LinkId(std::size_t{0}), {}, {}, -3}, {"tick", "duration"});
    expect_refused(kCar, ApplyWrench{LinkId(std::size_t{0}), {}, {}, std::numeric_limits<Tick>::max()},
                   {"duration"});
}

TEST(OrderSequence, IsByTickThenClientThenNumber) {
    const auto order = [](Tick tick, std::size_t client, std::uint64_t number) {
        return Order{tick, ClientId(client), number, RobotId(std::size_t{0}), SetVelocity{}};
    };
    EXPECT_TRUE(comes_before(order(1, 9, 9), order(2, 0, 0)));
    EXPECT_TRUE(comes_before(order(1, 0, 9), order(1, 1, 0)));
    EXPECT_TRUE(comes_before(order(1, 1, 2), order(1, 1, 3)));
    EXPECT_FALSE(comes_before(order(1, 1, 3), order(1, 1, 3)));
}

/// A universal joint that the tree walks backwards still takes its orders by the axis numbers of the file.
TEST(ApplyOrder, AxisNumbersAreThoseOfTheFileWhenTheJointIsReversed) {
    ModelSpec m = one_link(link("a", 1, box_inertia(1, {1, 1, 1})));
    m.name = "reversed";
    for (const char* name : {"b", "c"}) m.links.push_back(link(name, 1, box_inertia(1, {1, 1, 1})));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "ac", "a", "c", {}, {1, 0, 0}));
    m.joints.push_back(joint(JointSpecKind::kUniversal, "bc", "b", "c", {}, {0, 0, 1}));
    m.joints[1].axes.push_back({});
    m.joints[1].axes[1].xyz = {0, 1, 0};
    m.joints[1].axes[0].max_effort = 10;
    m.joints[1].axes[1].max_effort = 20;
    World world = empty_world(1e-3);
    place(world, m, "reversed");
    Diagnostics diagnostics;
    const auto model = compile(world, {}, diagnostics);
    const RobotType& type = model->types[0];
    for (int axis = 0; axis < 2; ++axis) {
        RobotState state = initial_state(*model, kCar);
        apply_order(*model,
                    {0, ClientId(std::size_t{0}), 0, kCar,
                     SetJoint{*type.find_joint("bc"), axis, MotorMode::kEffort, 1, -1}},
                    state);
        for (std::size_t d = 0; d < type.dofs.size(); ++d) {
            if (state.motors[d].mode != MotorMode::kEffort) continue;
            EXPECT_EQ(state.motors[d].max_effort, axis == 0 ? 10 : 20);
            const Vec3 moved = type.bodies[static_cast<std::size_t>(type.dofs[d].body)].axis_J;
            EXPECT_EQ(moved, axis == 0 ? (Vec3{0, 0, -1}) : (Vec3{0, -1, 0}));
        }
    }
}

}  // namespace
}  // namespace roboss::test
