// A state is found by its tick, and a copy made ahead is stepped on only where it is the right one.
#include "roles/simulator/state_store.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

const RobotId kRobot(0u);

Model one_robot() {
    Model model;
    model.robots.resize(1);
    return model;
}

RobotState at(double x) {
    RobotState state;
    state.q = {x};
    return state;
}

double x_of(const RobotState& state) {
    return state.q.at(0);
}

TEST(StateStore, StepsOnFromTheEndOfTheWindowWithOrWithoutACopyMadeAhead) {
    for (const bool ahead : {false, true}) {
        StateStore store(one_robot());
        store.put(kRobot, 0, at(1));
        store.begin_window(kRobot, 10) = at(2);
        if (ahead) store.copy_ahead(kRobot);
        ASSERT_TRUE(store.start(kRobot, 10));
        RobotState& next = store.begin_window(kRobot, 20);
        EXPECT_EQ(x_of(next), 2);
        next = at(3);
        EXPECT_EQ(x_of(*store.find(kRobot, 10)), 2);
        EXPECT_EQ(x_of(*store.find(kRobot, 20)), 3);
    }
}

TEST(StateStore, ForgetsACopyMadeAheadWhenTheWindowIsSteppedAgain) {
    StateStore store(one_robot());
    store.put(kRobot, 0, at(1));
    store.begin_window(kRobot, 10) = at(2);
    store.copy_ahead(kRobot);
    ASSERT_TRUE(store.start(kRobot, 0));
    EXPECT_EQ(x_of(store.begin_window(kRobot, 10)), 1);
    store.begin_window(kRobot, 10) = at(5);
    ASSERT_TRUE(store.start(kRobot, 10));
    EXPECT_EQ(x_of(store.begin_window(kRobot, 20)), 5);
}

TEST(StateStore, HasTheStateAtAWindowsStartStillWhenItsRestWasStepped) {
    StateStore store(one_robot());
    store.put(kRobot, 0, at(1));
    store.begin_window(kRobot, 10) = at(2);
    store.cut_window(kRobot, 6);
    EXPECT_EQ(store.find(kRobot, 10), nullptr);
    store.set_aside(std::vector{kRobot}, 0);
    ASSERT_TRUE(store.start(kRobot, 6));
    EXPECT_EQ(x_of(store.begin_window(kRobot, 10)), 2);
    store.begin_window(kRobot, 10) = at(3);
    EXPECT_EQ(x_of(*store.find(kRobot, 0)), 1);
    ASSERT_TRUE(store.start(kRobot, 0)) << "the window is stepped again";
    EXPECT_EQ(x_of(store.begin_window(kRobot, 10)), 1);
    store.begin_window(kRobot, 10) = at(3);
    store.set_aside(std::vector{kRobot}, 0);
    store.put(kRobot, 0, at(9));
    EXPECT_EQ(x_of(*store.find(kRobot, 0)), 9) << "what came last counts";
    store.set_aside(std::vector{kRobot}, 0);
    store.put(kRobot, 6, at(4));
    EXPECT_EQ(x_of(*store.find(kRobot, 0)), 9);
    store.begin_window(kRobot, 10) = at(3);
    store.forget_aside_before(10);
    ASSERT_TRUE(store.start(kRobot, 10));
    EXPECT_EQ(store.find(kRobot, 6), nullptr);
}

TEST(StateStore, ForgetsACopyMadeAheadWhenAnotherStateComes) {
    StateStore store(one_robot());
    store.put(kRobot, 0, at(1));
    store.begin_window(kRobot, 10) = at(2);
    store.copy_ahead(kRobot);
    store.put(kRobot, 10, at(7));
    EXPECT_EQ(x_of(store.begin_window(kRobot, 20)), 7);
}

}  // namespace
}  // namespace roboss
