// On-board controllers in the Model, their commands as orders, and what they keep in the state.
#include <gtest/gtest.h>

#include <limits>

#include <support/robots.h>

#include "model/edit.h"
#include "model/order.h"

namespace roboss::test {
namespace {

const RobotId kFirst(std::size_t{0}), kSecond(std::size_t{1});

ModelSpec controlled_car() {
    ModelSpec spec = car();
    VelocityControlSpec control;
    control.initial_linear = {0.5, 0, 0};
    spec.onboard.push_back({"go", control, {}});
    return spec;
}

std::shared_ptr<const Model> compiled_cars(const ModelSpec& first) {
    World world = empty_world(1e-3);
    place(world, first, "first");
    place(world, car(), "second", {{3, 0, 0}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

Order to_first(Action action, Tick at = 7) {
    return {at, ClientId(std::size_t{0}), 0, kFirst, std::move(action)};
}

TEST(OnboardModel, ListsTheCommandsOfARobot) {
    const auto model = compiled_cars(controlled_car());
    const RobotType& type = model->type_of(kFirst);
    ASSERT_EQ(type.channels.size(), 1u);
    EXPECT_EQ(type.channels[0].channel.name, "cmd_vel");
    EXPECT_EQ(type.onboard_size, 7);  // the tick of the last command, and six values
    EXPECT_EQ(type.find_channel("cmd_vel"), 0u);
    EXPECT_FALSE(type.find_channel("other"));
    EXPECT_TRUE(model->type_of(kSecond).onboard.empty());
}

TEST(OnboardModel, ReportsADetachableJointBetweenLinksOfOneRobot) {
    for (const char* child : {"wheel_0", "elsewhere"}) {
        DetachableJointSpec joint;
        joint.parent_link = LinkNames{"chassis"}, joint.child_model = "__model__", joint.child_link = child;
        ModelSpec spec = car();
        spec.onboard.push_back({"bond", joint, {}});
        World world = empty_world(1e-3);
        place(world, spec, "first");
        Diagnostics found;
        const auto model = compile(world, {}, found);
        ASSERT_NE(model, nullptr);
        const bool runs = std::string(child) == "elsewhere";
        EXPECT_EQ(model->type_of(kFirst).onboard.size(), runs ? 1u : 0u);
        EXPECT_EQ(found.count(Severity::kWarning), runs ? 0u : 1u);
    }
}

TEST(OnboardModel, HashesParametersAndLeavesOtherTypesAlone) {
    const auto plain = compiled_cars(car()), controlled = compiled_cars(controlled_car());
    EXPECT_NE(plain->hash, controlled->hash);
    EXPECT_EQ(plain->type_of(kSecond).hash, controlled->type_of(kSecond).hash);
    ModelSpec faster = controlled_car();
    std::get<VelocityControlSpec>(faster.onboard[0].parameters).initial_linear.x = 0.6;
    EXPECT_NE(compiled_cars(faster)->hash, controlled->hash);
}

TEST(OnboardCommand, IsLatchedWithItsTick) {
    const auto model = compiled_cars(controlled_car());
    RobotState state = initial_state(*model, kFirst);
    EXPECT_EQ(state.onboard, (std::vector<double>{-1, 0, 0, 0, 0, 0, 0}));
    const Order order = to_first(Command{0, {1, 2, 3, 4, 5, 6}}, 12);
    ASSERT_TRUE(check_order(*model, order).ok());
    state.rest.asleep = true;
    apply_order(*model, order, state);
    EXPECT_EQ(state.onboard, (std::vector<double>{12, 1, 2, 3, 4, 5, 6}));
    EXPECT_FALSE(state.rest.asleep);
}

TEST(OnboardCommand, IsRefusedWhereItDoesNotFit) {
    const auto model = compiled_cars(controlled_car());
    const auto refused = [&](const Command& command) { return !check_order(*model, to_first(command)).ok(); };
    EXPECT_TRUE(refused({1, {0, 0, 0, 0, 0, 0}}));
    EXPECT_TRUE(refused({0, {0, 0, 0, 0, 0}}));
    EXPECT_TRUE(refused({0, {}}));
    EXPECT_TRUE(refused({0, {0, 0, 2e9, 0, 0, 0}}));
    EXPECT_TRUE(refused({0, {0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0}}));
    EXPECT_FALSE(refused({0, {0, 0, 1e9, 0, 0, 0}}));
    EXPECT_FALSE(check_order(*model, {0, {}, 0, kSecond, Command{0, {0, 0, 0, 0, 0, 0}}}).ok());
}

TEST(AttachOrder, IsRefusedWhereItNamesNothing) {
    const auto model = compiled_cars(controlled_car());
    const LinkId chassis(std::size_t{0}), none(std::size_t{99});
    const auto refused = [&](const Attach& attach) { return !check_order(*model, to_first(attach)).ok(); };
    EXPECT_FALSE(refused({chassis, kSecond, chassis}));
    EXPECT_TRUE(refused({chassis, kFirst, chassis}));
    EXPECT_TRUE(refused({chassis, RobotId(std::size_t{2}), chassis}));
    EXPECT_TRUE(refused({none, kSecond, chassis}));
    EXPECT_TRUE(refused({chassis, kSecond, none}));
    EXPECT_TRUE(refused({chassis, kSecond, chassis, -1}));
    EXPECT_TRUE(refused({chassis, kSecond, chassis, 0.1, 0}));
    EXPECT_TRUE(refused({chassis, kSecond, chassis, 0.1, 1, std::numeric_limits<double>::quiet_NaN()}));
}

RobotState busy_state(const Model& model) {
    RobotState state = initial_state(model, kFirst);
    state.onboard[3] = 0.25;
    SurfaceMotion belt;
    belt.link = LinkId(std::size_t{1});
    belt.linear_L = {1, 2, 3}, belt.angular_L = {4, 5, 6}, belt.belt_L = {7, 8, 9};
    belt.turns = true, belt.centre_W = {10, 11, 12};
    state.surfaces.push_back(belt);
    Bond bond;
    bond.phase = BondPhase::kHolds;
    bond.link = LinkId(std::size_t{0}), bond.other = 1, bond.other_link = LinkId(std::size_t{2});
    bond.X_LO.p = {1, 2, 3}, bond.p_L = {0.5, 0, 0.25}, bond.reach = 0.1;
    bond.max_force = 50, bond.max_torque = 2;
    bond.force_impulse = {1, 0, 0}, bond.torque_impulse = {0, 1, 0};
    state.bonds.push_back(bond);
    return state;
}

TEST(OnboardState, SurvivesItsBytes) {
    const auto model = compiled_cars(controlled_car());
    const RobotState state = busy_state(*model);
    std::vector<std::uint8_t> bytes;
    encode(state, bytes);
    const Result<RobotState> back = decode_state(bytes, model->type_of(kFirst), 2);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value(), state);
    EXPECT_FALSE(decode_state(bytes, model->type_of(kSecond), 2).ok());  // it has no controllers
    EXPECT_FALSE(decode_state(bytes, model->type_of(kFirst), 1).ok());   // there is no robot 1 to hold
    bytes.pop_back();
    EXPECT_FALSE(decode_state(bytes, model->type_of(kFirst), 2).ok());
}

TEST(OnboardState, CountsInTheHashInEveryPart) {
    const auto model = compiled_cars(controlled_car());
    const RobotState state = busy_state(*model);
    const std::uint64_t hash = state_hash(kFirst, 5, state);
    const auto differs = [&](auto&& change) {
        RobotState other = state;
        change(other);
        return state_hash(kFirst, 5, other) != hash;
    };
    EXPECT_TRUE(differs([](RobotState& s) { s.onboard[3] = 0.5; }));
    EXPECT_TRUE(differs([](RobotState& s) { s.surfaces[0].linear_L.x = 0; }));
    EXPECT_TRUE(differs([](RobotState& s) { s.surfaces.clear(); }));
    EXPECT_TRUE(differs([](RobotState& s) { s.bonds[0].max_force = 49; }));
    EXPECT_TRUE(differs([](RobotState& s) { s.bonds[0].phase = BondPhase::kLoosed; }));
    EXPECT_TRUE(differs([](RobotState& s) { s.bonds[0].p_L.z = 0; }));
    EXPECT_TRUE(differs([](RobotState& s) { s.bonds.clear(); }));
}

TEST(OnboardEdit, ForgetsBondsWithRobotsThatAreGone) {
    const auto model = compiled_cars(controlled_car());
    const Result<ModelEdit> edit = without_robots(*model, {"second"});
    ASSERT_TRUE(edit.ok());
    const auto states = carry_over(edit.value(), {busy_state(*model), initial_state(*model, kSecond)});
    ASSERT_EQ(states.size(), 1u);
    EXPECT_TRUE(states[0].bonds.empty());
    EXPECT_EQ(states[0].onboard[3], 0.25);
    RobotState on_scenery = busy_state(*model);
    on_scenery.bonds[0].other = RobotId::kNone, on_scenery.bonds[0].other_link = {};
    const auto kept = carry_over(edit.value(), {on_scenery, initial_state(*model, kSecond)});
    EXPECT_EQ(kept[0].bonds, on_scenery.bonds);
    Order detach = to_first(Detach{kSecond});
    EXPECT_FALSE(carry_over(edit.value(), detach));
    Order let_go = to_first(Detach{});
    EXPECT_TRUE(carry_over(edit.value(), let_go));
}

}  // namespace
}  // namespace roboss::test
