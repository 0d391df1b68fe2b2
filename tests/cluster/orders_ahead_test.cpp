// Orders that are known early go to Simulators while they step the window before. Whatever becomes of these
// messages, and whatever is ordered late, every robot gets its orders, once.
#include <gtest/gtest.h>

#include "bus/in_process_bus.h"
#include "faulty_cluster.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr Tick kTicks = 240;
constexpr Tick kLate = 20;  // ticks before theirs that late orders are given

/// Wheels turn anew every few ticks; now and then a robot is pushed, and one is put elsewhere.
std::vector<Order> many_orders(const Model& model) {
    std::vector<Order> orders;
    const auto give = [&](Tick tick, RobotId robot, const Action& action) {
        orders.push_back({tick, ClientId(), orders.size() + 1, robot, action});
    };
    for (Tick tick = 2; tick < kTicks; ++tick) {
        const RobotId robot(static_cast<std::size_t>(tick) % model.robots.size());
        const double speed = static_cast<double>((7 * tick) % 21) - 10;
        for (std::size_t joint = 0; joint < model.type_of(robot).joints.size(); ++joint)
            give(tick, robot, SetJoint{JointId(joint), 0, MotorMode::kVelocity, speed, -1});
        if (tick % 7 == 0) give(tick, robot, ApplyWrench{LinkId(0u), {speed, 4, 0}, {}, 10});
        if (tick % 50 == 0) give(tick, robot, SetVelocity{{1, -1, 0}, {}});
        if (tick % 90 == 0) give(tick, robot, SetPose{{{static_cast<double>(tick) / 30, 3, 0.2}, {}}});
    }
    return orders;
}

/// Every third is given shortly before its time.
bool is_late(const Order& order) {
    return order.sequence % 3 == 0;
}

std::uint64_t undisturbed_hash(const std::shared_ptr<const Model>& model) {
    auto simulation = Simulation::create(model, {});
    for (const Order& order : many_orders(*model)) EXPECT_TRUE(simulation.value()->submit(order).ok());
    EXPECT_TRUE(simulation.value()->run_until(kTicks).ok());
    return simulation.value()->hash();
}

TEST(OrdersAhead, LostDoubledAndOvertakenMessagesAndLateOrdersChangeNothing) {
    const auto model = carts_world(5);
    const std::uint64_t expected = undisturbed_hash(model);
    const std::vector<Order> orders = many_orders(*model);
    std::uint64_t ahead = 0, losses = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const FaultOptions faults{seed, 0.03 * static_cast<double>(seed % 4),
                                  0.03 * static_cast<double>(seed % 3), static_cast<std::int64_t>(seed % 8)};
        ControllerOptions options;
        options.window = 1 + static_cast<Tick>(seed % 6);
        options.checkpoint_ticks = 30;
        const std::uint64_t kill = seed % 2 == 0 ? 100 : 0;
        FaultyCluster cluster(model, options, faults, {kill, kill / 2, kill / 2, 250, 2000}, 1 + seed % 4);
        cluster.turn();
        for (const Order& order : orders)
            if (!is_late(order)) {
                ASSERT_TRUE(cluster.controller().submit(order).ok());
            }
        cluster.controller().run_until(kTicks);
        auto give_late_ones = [&, next = std::size_t{0}]() mutable {
            const Tick until = cluster.controller().tick() + 2 * kLate;
            for (; next < orders.size() && orders[next].apply_at <= until; ++next) {
                if (!is_late(orders[next])) continue;
                const Result<> given = cluster.controller().submit(orders[next]);
                EXPECT_TRUE(given.ok()) << given.error().text();
            }
        };
        for (int turns = 0; turns < 400'000 && !cluster.controller().resting(); ++turns) {
            give_late_ones();
            cluster.turn();
        }
        ASSERT_TRUE(cluster.controller().resting()) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), expected);
        ahead += cluster.controller().counters().orders_ahead;
        losses += cluster.controller().counters().losses;
    }
    EXPECT_GT(ahead, 60 * orders.size() / 4);  // else this test did not test
    EXPECT_GT(losses, 20u);
}

TEST(OrdersAhead, AreOnlyWorthAMessageWhenTheyAreMany) {
    const auto model = carts_world(5);
    const std::uint64_t expected = undisturbed_hash(model);
    for (const std::size_t least : {std::size_t{1}, std::size_t{100'000}}) {
        SimulationOptions options;
        options.simulators = 3;
        options.controller.ahead_least = least;
        auto simulation = Simulation::create(model, options);
        for (const Order& order : many_orders(*model)) ASSERT_TRUE(simulation.value()->submit(order).ok());
        ASSERT_TRUE(simulation.value()->run_until(kTicks).ok());
        EXPECT_EQ(simulation.value()->hash(), expected);
        EXPECT_EQ(simulation.value()->counters().orders_ahead > 0, least == 1);
    }
}

}  // namespace
}  // namespace roboss::test
