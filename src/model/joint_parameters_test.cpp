// Orders for own numbers of joints: what is refused, and what becomes of a state, its bytes and its hash.
#include "model/joint_parameters.h"

#include <gtest/gtest.h>

#include <limits>

#include <support/mechanisms.h>
#include <support/robots.h>

#include "model/order.h"

namespace roboss::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const RobotId kArm(0u), kTree(1u), kBar(2u);
using enum JointParameter;

class JointParameters : public testing::Test {
  protected:
    JointParameters() {
        World world = empty_world(1e-3);
        ModelSpec limited = arm();
        limited.joints[1].axes[0].lower = -2, limited.joints[1].axes[0].upper = 1;
        place(world, limited, "arm");
        place(world, mixed_tree(), "tree");
        place(world, four_bar(), "bar");
        Diagnostics diagnostics;
        model = compile(world, {}, diagnostics);
        state = initial_state(*model, kArm);
    }
    JointId joint(RobotId robot, const char* name) const { return *model->type_of(robot).find_joint(name); }
    /// The code of the refusal; empty: it is taken.
    std::string code(RobotId robot, const SetJointParameters& order) const {
        const Result<> checked = check_order(*model, {0, ClientId(0u), 0, robot, order});
        if (!checked) {
            EXPECT_FALSE(checked.error().remedy.empty());
        }
        return checked ? "" : checked.error().code;
    }
    std::string code_of(JointParameter parameter, double value) const {
        return code(kArm, {JointId(1u), 0, false, {{parameter, value}}});
    }
    void give(SetJointParameters order) {
        ASSERT_EQ(code(kArm, order), "");
        apply_order(*model, {0, ClientId(0u), 0, kArm, std::move(order)}, state);
    }
    std::uint64_t hash() const { return state_hash(kArm, 5, state); }
    std::vector<std::uint8_t> bytes() const {
        std::vector<std::uint8_t> out;
        encode(state, out);
        return out;
    }
    const RobotType& type() const { return model->type_of(kArm); }
    const RobotType& own() const { return type_of(type(), state); }

    std::shared_ptr<const Model> model;
    RobotState state;
};

TEST_F(JointParameters, AreKnownByTheNamesOfTheirMembers) {
    for (std::size_t i = 0; i < kJointParameters; ++i) {
        const auto parameter = static_cast<JointParameter>(i);
        EXPECT_EQ(find_joint_parameter(info_of(parameter).name), parameter);
    }
    EXPECT_EQ(info_of(kSpringStiffness).member, &Dof::spring_stiffness);
    EXPECT_EQ(info_of(kLimitDissipation).member, &Dof::limit_dissipation);
    EXPECT_FALSE(find_joint_parameter("mass"));
}

TEST_F(JointParameters, ThatNoRobotHasAreRefusedByName) {
    for (const JointParameter p : {kDamping, kFriction, kSpringStiffness, kArmature, kPositionGain,
                                   kVelocityGain, kMaxEffort, kMaxVelocity, kLimitDissipation}) {
        EXPECT_EQ(code_of(p, 0), "") << info_of(p).name;
        EXPECT_EQ(code_of(p, 12.5), "") << info_of(p).name;
        EXPECT_EQ(code_of(p, -1e-9), "bad-parameter") << info_of(p).name;
        EXPECT_EQ(code_of(p, kNan), "not-finite") << info_of(p).name;
        EXPECT_EQ(code_of(p, 1.1e12), "beyond-limit") << info_of(p).name;
        const bool endless = p == kMaxEffort || p == kMaxVelocity;
        EXPECT_EQ(code_of(p, kInfinity), endless ? "" : "not-finite") << info_of(p).name;
    }
    EXPECT_EQ(code_of(kSpringReference, -3), "");
    EXPECT_EQ(code_of(kLimitStiffness, kInfinity), "");
    EXPECT_EQ(code_of(kLimitStiffness, 0), "bad-parameter");
    EXPECT_EQ(code(kArm, {JointId(99u), 0, false, {{kDamping, 1}}}), "no-joint");
    EXPECT_EQ(code(kArm, {JointId(1u), 1, false, {{kDamping, 1}}}), "no-axis");
    EXPECT_EQ(code(kArm, {JointId(1u), -1, true, {}}), "no-axis");
    EXPECT_EQ(code(kArm, {JointId(1u), 0, false, {}}), "no-parameter");
    EXPECT_EQ(code(kArm, {JointId(1u), 0, true, {}}), "");
    EXPECT_EQ(code(kArm, {JointId(1u), 0, false, {{static_cast<JointParameter>(13), 1}}}), "no-parameter");
    EXPECT_EQ(code(kArm, {JointId(1u), 0, false, {{kDamping, 1}, {kDamping, 2}}}), "repeated-parameter");
}

TEST_F(JointParameters, LimitsComeInPairsWithinThoseOfTheType) {
    const auto limits = [&](double lower, double upper) {
        return code(kArm, {JointId(1u), 0, false, {{kLower, lower}, {kUpper, upper}}});
    };
    EXPECT_EQ(limits(-2, 1), "");
    EXPECT_EQ(limits(0.5, 0.5), "");
    EXPECT_EQ(limits(0.5, 0.4), "bad-parameter");
    EXPECT_EQ(limits(-2.1, 1), "beyond-type");
    EXPECT_EQ(limits(-2, kInfinity), "beyond-type");
    EXPECT_EQ(code_of(kLower, 0), "half-limits");
    EXPECT_EQ(code_of(kUpper, 0), "half-limits");
    EXPECT_EQ(code(kArm, {JointId(0u), 0, false, {{kLower, -kInfinity}, {kUpper, 7}}}), "");
}

TEST_F(JointParameters, ThatAJointOfItsKindHasNotAreRefused) {
    const JointId ball = joint(kTree, "ball"), closing = joint(kBar, "closing");
    EXPECT_EQ(code(kTree, {ball, 2, false, {{kDamping, 1}, {kVelocityGain, 1}}}), "");
    for (const JointParameter p : {kLower, kSpringStiffness, kPositionGain, kLimitStiffness})
        EXPECT_EQ(code(kTree, {ball, 0, false, {{p, 1}}}), "no-position") << info_of(p).name;
    EXPECT_EQ(code(kBar, {closing, 0, false, {{kSpringStiffness, 1}}}), "");
    EXPECT_EQ(code(kBar, {closing, 0, false, {{kArmature, 1}}}), "loop-joint");
}

TEST_F(JointParameters, OnlyWhatIsNamedChangesAndOnlyOnThatAxis) {
    give({JointId(1u), 0, false, {{kDamping, 0.5}, {kLower, -1}, {kUpper, 0.5}}});
    give({JointId(1u), 0, false, {{kFriction, 0.25}}});
    std::vector<Dof> expected = type().dofs;
    expected[1].damping = 0.5, expected[1].lower = -1, expected[1].upper = 0.5, expected[1].friction = 0.25;
    EXPECT_EQ(own().dofs, expected);
    EXPECT_EQ(&dof_of(type(), state, type().joints[1], 0), &own().dofs[1]);
    give({JointId(1u), 0, true, {{kFriction, 0.125}}});
    expected = type().dofs, expected[1].friction = 0.125;
    EXPECT_EQ(own().dofs, expected);
    EXPECT_EQ(state.own.joints, (std::vector<OwnJointNumber>{{JointId(1u), 0, {kFriction, 0.125}}}));
}

TEST_F(JointParameters, ThatAreThoseOfTheTypeAreNotKept) {
    const std::uint64_t plain = hash();
    give({JointId(1u), 0, false, {{kDamping, 0.5}}});
    EXPECT_NE(hash(), plain);
    give({JointId(1u), 0, true, {}});
    EXPECT_TRUE(state.own.empty());
    EXPECT_EQ(hash(), plain);
}

TEST_F(JointParameters, WakeASleeper) {
    state.rest.asleep = true;
    give({JointId(1u), 0, false, {{kDamping, 0.5}}});
    EXPECT_FALSE(state.rest.asleep);
}

/// The mobility that a robot with a rotor inertia of its own has is that of a type with it.
TEST_F(JointParameters, ARotorInertiaChangesMobilitiesAsInAFile) {
    World world = empty_world(1e-3);
    ModelSpec heavy = arm();
    heavy.joints[2].axes[0].armature = 0.3;
    place(world, heavy, "heavy");
    Diagnostics diagnostics;
    const auto other = compile(world, {}, diagnostics);
    give({JointId(2u), 0, false, {{kArmature, 0.3}}});
    for (std::size_t d = 0; d < type().dofs.size(); ++d)
        EXPECT_EQ(own().dofs[d].inverse_inertia, other->types[0].dofs[d].inverse_inertia) << d;
    for (std::size_t b = 0; b < type().bodies.size(); ++b)
        EXPECT_EQ(own().bodies[b].inverse_mass_linear, other->types[0].bodies[b].inverse_mass_linear) << b;
    EXPECT_LT(own().dofs[2].inverse_inertia, type().dofs[2].inverse_inertia);
    give({JointId(2u), 0, false, {{kArmature, 0}}});
    EXPECT_TRUE(state.own.empty());
}

TEST_F(JointParameters, TravelWithTheStateAndChangeItsHash) {
    const std::size_t plain = bytes().size();
    give({JointId(1u), 0, false, {{kDamping, 0.5}, {kMaxEffort, kInfinity}}});
    const std::vector<std::uint8_t> sent = bytes();
    EXPECT_EQ(sent.size(), plain + 8 * (2 + 4 * state.own.joints.size()));
    const Result<RobotState> arrived = decode_state(sent, type());
    ASSERT_TRUE(arrived.ok()) << arrived.error().text();
    EXPECT_EQ(arrived.value(), state);
    EXPECT_EQ(state_hash(kArm, 5, arrived.value()), hash());
}

TEST_F(JointParameters, ThatNoOrderGivesAreRefusedInAState) {
    give({JointId(1u), 0, false, {{kDamping, 0.5}}});
    const RobotState good = state;
    const auto decodes = [&] { return decode_state(bytes(), type()).ok(); };
    EXPECT_TRUE(decodes());
    const auto refused = [&](std::vector<OwnJointNumber> joints) {
        state = good, state.own.joints = std::move(joints);
        return !decodes();
    };
    const JointId joint(1u);
    for (const JointParameter p : {kDamping, kFriction, kArmature, kPositionGain, kLimitStiffness})
        for (const double wrong : {-1.0, kNan}) EXPECT_TRUE(refused({{joint, 0, {p, wrong}}})) << wrong;
    EXPECT_TRUE(refused({{joint, 0, {kUpper, 1.5}}})) << "wider than the type's";
    EXPECT_TRUE(refused({{joint, 0, {kLower, 0.9}}, {joint, 0, {kUpper, 0.8}}}));
    EXPECT_FALSE(refused({{joint, 0, {kUpper, 0.8}}}));
    EXPECT_TRUE(refused({{joint, 1, {kDamping, 1}}})) << "it has one axis";
    EXPECT_TRUE(refused({{JointId(99u), 0, {kDamping, 1}}}));
    EXPECT_TRUE(refused({{joint, 0, {kFriction, 1}}, {joint, 0, {kDamping, 1}}})) << "not sorted";
    EXPECT_TRUE(refused({{joint, 0, {JointParameter(kJointParameters), 1}}}));
}

}  // namespace
}  // namespace roboss::test
