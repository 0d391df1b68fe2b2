// Orders for own numbers of links: what is refused, and what becomes of a state, its bytes and its hash.
#include "model/link_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <support/mechanisms.h>
#include <support/robots.h>

#include "model/order.h"

namespace roboss::test {
namespace {

using enum LinkParameter;
const RobotId kCar(0u), kBare(2u);
const LinkId kWheel(1u);

class LinkParameters : public testing::Test {
  protected:
    LinkParameters() {
        World world = empty_world(1e-3);
        ModelSpec directed = car();
        directed.links[2].collisions[0].surface.fdir1 = {1, 0, 0};
        directed.links[2].collisions[0].surface.mu2 = 0.25;
        directed.links[0].collisions.push_back(sphere_shape(0.02, surface(0.2), {{0, 0, 0.1}, {}}));
        place(world, directed, "car");
        place(world, four_bar(), "bar");
        place(world, pendulum(), "bare");
        Diagnostics diagnostics;
        model = compile(world, {}, diagnostics);
        state = initial_state(*model, kCar);
    }
    /// The code of the refusal; empty: it is taken.
    std::string code(RobotId robot, const SetLinkParameters& order) const {
        const Result<> checked = check_order(*model, {0, ClientId(0u), 0, robot, order});
        if (!checked) {
            EXPECT_FALSE(checked.error().remedy.empty());
        }
        return checked ? "" : checked.error().code;
    }
    std::string code_of(LinkParameter parameter, double value) const {
        return code(kCar, {kWheel, false, {{parameter, value}}});
    }
    void give(std::vector<LinkParameterValue> values, bool reset = false, LinkId link = kWheel) {
        SetLinkParameters order{link, reset, std::move(values)};
        ASSERT_EQ(code(kCar, order), "");
        apply_order(*model, {0, ClientId(0u), 0, kCar, std::move(order)}, state);
    }
    std::uint64_t hash() const { return state_hash(kCar, 5, state); }
    std::vector<std::uint8_t> bytes() const {
        std::vector<std::uint8_t> out;
        encode(state, out);
        return out;
    }
    const RobotType& type() const { return model->type_of(kCar); }
    const RobotType& own() const { return type_of(type(), state); }
    const BodyShape& wheel_shape() const {
        return *std::ranges::find(own().shapes, kWheel, &BodyShape::link);
    }

    std::shared_ptr<const Model> model;
    RobotState state;
};

TEST_F(LinkParameters, AreKnownByTheirNames) {
    for (std::size_t i = 0; i < kLinkParameters; ++i) {
        const auto parameter = static_cast<LinkParameter>(i);
        EXPECT_EQ(find_link_parameter(info_of(parameter).name), parameter);
    }
    EXPECT_EQ(info_of(kRollingFriction).surface, &Material::rolling);
    EXPECT_EQ(info_of(kCentreX).surface, nullptr);
    EXPECT_FALSE(find_link_parameter("damping"));
}

TEST_F(LinkParameters, ThatNoLinkHasAreRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < kLinkParameters; ++i) {
        const auto p = static_cast<LinkParameter>(i);
        EXPECT_EQ(code_of(p, nan), p == kFrictionAcross ? "no-direction" : "not-finite") << info_of(p).name;
    }
    EXPECT_EQ(code_of(kMass, 12.5), "");
    EXPECT_EQ(code_of(kMass, 0), "bad-parameter");
    EXPECT_EQ(code_of(kMass, -1), "bad-parameter");
    EXPECT_EQ(code_of(kMass, 1e13), "beyond-limit");
    EXPECT_EQ(code_of(kCentreY, -0.25), "");
    EXPECT_EQ(code_of(kFriction, -0.1), "bad-parameter");
    EXPECT_EQ(code_of(kFriction, 1e7), "beyond-limit");
    EXPECT_EQ(code_of(kRestitution, 1), "");
    EXPECT_EQ(code_of(kRestitution, 1.01), "bad-parameter");
    EXPECT_EQ(code_of(kInertiaXx, 1), "half-inertia");
    EXPECT_EQ(code(kCar, {kWheel, false, {}}), "no-parameter");
    EXPECT_EQ(code(kCar, {kWheel, false, {{LinkParameter(kLinkParameters), 1}}}), "no-parameter");
    EXPECT_EQ(code(kCar, {kWheel, false, {{kMass, 1}, {kMass, 2}}}), "repeated-parameter");
    EXPECT_EQ(code(kCar, {LinkId(9u), false, {{kMass, 1}}}), "no-link");
    EXPECT_EQ(code(kBare, {LinkId(0u), false, {{kFriction, 1}}}), "no-shapes");
    EXPECT_EQ(code(kCar, {LinkId(2u), false, {{kFrictionAcross, 1}}}), "");
}

TEST_F(LinkParameters, InertiasAreThoseOfBodies) {
    const auto inertia = [](double xx, double yy, double zz, double xy) {
        return SetLinkParameters{kWheel,
                                 false,
                                 {{kInertiaXx, xx},
                                  {kInertiaYy, yy},
                                  {kInertiaZz, zz},
                                  {kInertiaXy, xy},
                                  {kInertiaXz, 0},
                                  {kInertiaYz, 0}}};
    };
    EXPECT_EQ(code(kCar, inertia(1, 1, 1, 0.1)), "");
    EXPECT_EQ(code(kCar, inertia(1, 1, 2.5, 0)), "bad-inertia") << "one exceeds the sum of the others";
    EXPECT_EQ(code(kCar, inertia(1, 1, 1, 1.1)), "bad-inertia") << "not positive definite";
    EXPECT_EQ(code(kCar, inertia(0, 1, 1, 0)), "bad-inertia");
    EXPECT_EQ(code(kCar, inertia(-1, 1, 1, 0)), "bad-parameter");
}

TEST_F(LinkParameters, AreReadAsTheyWereGiven) {
    give({{kMass, 0.75}, {kCentreX, 0.01}, {kFriction, 0.4}, {kRestitution, 0.5}, {kRollingFriction, 0.002}});
    EXPECT_EQ(link_number(own(), kWheel, kMass), 0.75);
    EXPECT_NEAR(*link_number(own(), kWheel, kCentreX), 0.01, 1e-15);
    EXPECT_NEAR(*link_number(own(), kWheel, kCentreZ), 0, 1e-15);
    EXPECT_EQ(link_number(own(), kWheel, kFriction), 0.4);
    EXPECT_EQ(link_number(own(), kWheel, kRollingFriction), 0.002);
    EXPECT_EQ(link_number(own(), kWheel, kFrictionAcross), std::nullopt);
    EXPECT_EQ(wheel_shape().material.mu2, 0.4) << "the same in all directions";
    EXPECT_EQ(link_number(type(), kWheel, kMass), 0.3) << "of the file";
    for (const LinkParameter p : {kInertiaXx, kInertiaYy, kInertiaZz})
        EXPECT_NEAR(*link_number(own(), kWheel, p), 2.5 * *link_number(type(), kWheel, p), 1e-15)
            << "with the mass";
    EXPECT_NEAR(own().mass, type().mass + 0.45, 1e-12);
    const LinkId directed(2u);
    give({{kFriction, 0.7}}, false, directed);
    EXPECT_EQ(link_number(own(), directed, kFrictionAcross), 0.25);
    EXPECT_EQ(link_number(model->type_of(kBare), LinkId(0u), kFriction), std::nullopt);
}

TEST_F(LinkParameters, ThatAreTheTypesAgainLeaveNoTrace) {
    const std::uint64_t before = hash();
    give({{kMass, 0.75}, {kFriction, 0.4}});
    const std::uint64_t changed = hash();
    EXPECT_NE(changed, before);
    give({{kMass, 0.3}});
    EXPECT_NE(hash(), before);
    EXPECT_EQ(link_number(own(), kWheel, kFriction), 0.4);
    give({{kFriction, 0.9}});
    EXPECT_EQ(hash(), before);
    EXPECT_EQ(state.own_type.get(), nullptr);
    give({{kFriction, 0.4}}), give({{kMass, 0.75}});
    EXPECT_EQ(hash(), changed) << "in any order";
    give({}, true);
    EXPECT_EQ(hash(), before);
}

TEST_F(LinkParameters, OfASurfaceAreThoseOfAllShapesOfTheLink) {
    const LinkId chassis(0u);
    ASSERT_EQ(type().shapes[1].link, chassis);
    ASSERT_NE(type().shapes[0].material.mu, type().shapes[1].material.mu);
    const std::uint64_t before = hash();
    give({{kFriction, type().shapes[0].material.mu}}, false, chassis);
    EXPECT_NE(hash(), before) << "the second shape has another number";
    EXPECT_EQ(own().shapes[1].material.mu, type().shapes[0].material.mu);
    give({}, true, chassis);
    EXPECT_EQ(hash(), before);
}

TEST_F(LinkParameters, KeepAnInertiaThatWasGivenWithTheMassOfTheFile) {
    std::vector<LinkParameterValue> file;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto p = static_cast<LinkParameter>(static_cast<std::size_t>(kInertiaXx) + i);
        file.push_back({p, *link_number(type(), kWheel, p)});
    }
    const std::uint64_t before = hash();
    give(file);
    EXPECT_EQ(hash(), before) << "it is that of the file";
    std::vector<LinkParameterValue> values = file;
    values.push_back({kMass, 3});
    give(values);
    EXPECT_EQ(link_number(own(), kWheel, kInertiaXx), file[0].value) << "it does not grow";
    give({{kMass, 0.3}});
    EXPECT_EQ(hash(), before);
}

TEST_F(LinkParameters, TravelAsBytes) {
    give({{kMass, 0.75}, {kFriction, 0.4}}), give({{kCentreZ, 0.125}}, false, LinkId(0u));
    const Result<RobotState> back = decode_state(bytes(), type(), model->robots.size());
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value(), state);
    const RobotType& again = type_of(type(), back.value());
    EXPECT_EQ(again.bodies[1].mass, own().bodies[1].mass);
    EXPECT_EQ(again.bodies[0].p_BC, own().bodies[0].p_BC);
    EXPECT_EQ(again.bodies[0].inverse_mass_linear, own().bodies[0].inverse_mass_linear);
    EXPECT_EQ(again.shapes[2].material.mu, 0.4);
}

TEST_F(LinkParameters, ThatNoOrderGivesAreRefusedAsBytes) {
    const auto refused = [&](std::vector<OwnLinkNumber> own) {
        state.own.links = std::move(own);
        return !decode_state(bytes(), type(), model->robots.size()).ok();
    };
    EXPECT_FALSE(refused({{kWheel, {kMass, 1}}}));
    EXPECT_TRUE(refused({{kWheel, {kMass, -1}}}));
    EXPECT_TRUE(refused({{kWheel, {kMass, 0.3}}})) << "that of the type";
    EXPECT_TRUE(refused({{kWheel, {kMass, 1}}, {kWheel, {kMass, 2}}}));
    EXPECT_TRUE(refused({{kWheel, {kFriction, 1}}, {kWheel, {kMass, 2}}})) << "not sorted";
    EXPECT_TRUE(refused({{LinkId(9u), {kMass, 1}}}));
    EXPECT_TRUE(refused({{kWheel, {kInertiaXx, 1}}}));
    EXPECT_TRUE(refused({{kWheel, {LinkParameter(kLinkParameters), 1}}}));
}

TEST_F(LinkParameters, AndThoseOfJointsMakeOneType) {
    const JointId joint(0u);
    const Order damped{0, ClientId(0u), 0, kCar,
                       SetJointParameters{joint, 0, false, {{JointParameter::kDamping, 0.5}}}};
    const Order heavy{0, ClientId(0u), 0, kCar, SetLinkParameters{kWheel, false, {{kMass, 3}}}};
    RobotState other = state;
    apply_order(*model, damped, state), apply_order(*model, heavy, state);
    apply_order(*model, heavy, other), apply_order(*model, damped, other);
    EXPECT_EQ(state, other) << "in either order";
    EXPECT_EQ(own().dofs[0].damping, 0.5);
    EXPECT_LT(own().dofs[0].inverse_inertia, 0.2 * type().dofs[0].inverse_inertia);
    EXPECT_EQ(own().dofs[0].inverse_inertia, type_of(type(), other).dofs[0].inverse_inertia);
}

}  // namespace
}  // namespace roboss::test
