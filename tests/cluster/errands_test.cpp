// worlds/errands.sdf: breadcrumbs, an elevator, an actor that follows, a sensor that starts a message. What
// they do, and the same bits for all groupings, over saves, and with kills.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/worlds/orders_file.h"
#include "client/triggers/triggers.h"
#include "faulty_cluster.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace roboss::test {
namespace {

constexpr Tick kEnd = 2000;  // 4 s
const std::string kWorld = std::string(ROBOSS_WORLDS) + "/errands.sdf";

std::shared_ptr<const Model> errands() {
    Diagnostics diagnostics;
    const auto world = load_world(kWorld, {}, diagnostics);
    auto model = world ? compile(*world, {}, diagnostics) : nullptr;
    for (const Diagnostic& d : diagnostics.items())
        if (d.severity != Severity::kNote) ADD_FAILURE() << to_text(d);
    return model;
}

/// Those of worlds/errands.jsonl.
std::vector<Order> orders_for(const Model& model) {
    Diagnostics diagnostics;
    auto orders = load_orders(std::string(ROBOSS_WORLDS) + "/errands.jsonl", model, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return orders;
}

/// Notes the events that it sees.
class Listener : public ControlProgram {
  public:
    explicit Listener(std::vector<std::string>& seen) : seen_(&seen) {}
    ControlOptions options() const override { return {0.02, 0.02, true}; }
    void control(Client& client) override {
        for (const RobotEvent& event : client.events()) seen_->push_back(to_text(event));
    }

  private:
    std::vector<std::string>* seen_;
};

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model, std::size_t simulators = 1,
                                 Tick window = 0, const SavedRun* from = nullptr,
                                 std::vector<std::string>* seen = nullptr) {
    SimulationOptions options;
    options.simulators = simulators, options.threads = 2, options.controller.window = window;
    std::vector<NamedProgram> programs;
    if (seen != nullptr) programs.push_back({"listener", std::make_unique<Listener>(*seen)});
    programs.push_back({Triggers::kName, std::make_unique<Triggers>(model)});
    auto made = Simulation::create(model, options, std::move(programs), from);
    EXPECT_TRUE(made.ok());
    if (from != nullptr) return std::move(made).value();
    for (const Order& order : orders_for(*model)) EXPECT_TRUE(made.value()->submit(order).ok());
    return std::move(made).value();
}

Tick at(const Model& model, double seconds) {
    return static_cast<Tick>(seconds / model.dt_s + 0.5);
}

Vec3 place(const Model& model, Simulation& run, const std::string& robot) {
    return base_pose(run.states()[model.find_robot(robot)->index()]).p;
}

TEST(Breadcrumbs, AreDroppedOneByOneBehindTheCarrierUntilNoneIsLeft) {
    const auto model = errands();
    ASSERT_NE(model, nullptr);
    auto run = make(model);
    ASSERT_TRUE(run->run_until(at(*model, 0.19)).ok());
    for (const char* beacon : {"beacon_0", "beacon_1", "beacon_2"}) {
        EXPECT_LT(place(*model, *run, beacon).z, -900) << "stored";
        EXPECT_TRUE(run->states()[model->find_robot(beacon)->index()].rest.asleep);
    }
    ASSERT_TRUE(run->run_until(at(*model, 0.25)).ok());
    const Vec3 dropped = place(*model, *run, "beacon_0");
    EXPECT_NEAR(dropped.x, -0.6, 1e-3) << "at its pose in the carrier's frame";
    EXPECT_NEAR(dropped.z, 0.2, 0.02);
    EXPECT_LT(place(*model, *run, "beacon_1").z, -900);
    ASSERT_TRUE(run->run_until(at(*model, 0.6)).ok());
    EXPECT_NEAR(place(*model, *run, "beacon_0").z, 0.1, 1e-3) << "it has fallen to the ground";
    // The carrier drives: each is dropped behind it, where it is by then.
    for (const auto& [beacon, seconds] : {std::pair{"beacon_1", 1.51}, std::pair{"beacon_2", 2.21}}) {
        ASSERT_TRUE(run->run_until(at(*model, seconds)).ok());
        EXPECT_LT(place(*model, *run, beacon).z, -900);
        const double behind = place(*model, *run, "carrier").x - 0.6;
        ASSERT_TRUE(run->run_until(at(*model, seconds + 0.01)).ok());
        EXPECT_NEAR(place(*model, *run, beacon).x, behind, 0.02);
    }
    ASSERT_TRUE(run->run_until(kEnd).ok()) << "a fourth one is not there";
}

TEST(Breadcrumbs, AreFixedWhereTheyAreAfterTheirTime) {
    const auto model = errands();
    auto run = make(model);
    ASSERT_TRUE(run->run_until(at(*model, 1.0)).ok());
    const Vec3 lamp = place(*model, *run, "lamp_0");
    // It falls for 0.2 s from 2.1 m, as the bond allows a tick more.
    EXPECT_NEAR(lamp.z, 2.1 - 0.5 * 9.8 * 0.2 * 0.2, 0.01);
    ASSERT_TRUE(run->run_until(kEnd).ok());
    EXPECT_LT(norm(place(*model, *run, "lamp_0") - lamp), 1e-6);
    EXPECT_LT(place(*model, *run, "lamp_1").z, -900) << "no command asked for it";
}

TEST(Breadcrumbs, SayHowManyAreLeft) {
    const auto model = errands();
    std::vector<std::string> seen;
    auto run = make(model, 1, 0, nullptr, &seen);
    ASSERT_TRUE(run->run_until(kEnd).ok());
    std::vector<std::string> left;
    for (const std::string& event : seen)
        if (event.starts_with("/model/carrier/breadcrumbs/beacon/deploy/remaining")) left.push_back(event);
    ASSERT_EQ(left.size(), 3u) << ::testing::PrintToString(seen);
    EXPECT_TRUE(left[0].ends_with("data=2") && left[1].ends_with("data=1") && left[2].ends_with("data=0"));
}

TEST(Elevator, GoesToTheFloorOpensItsDoorAndComesBack) {
    const auto model = errands();
    const RobotId elevator = *model->find_robot("elevator");
    const auto q = [&](Simulation& run, const char* joint) {
        const RobotType& type = model->type_of(elevator);
        const Joint& j = type.joints[type.find_joint(joint)->index()];
        return run.states()[elevator.index()].q[static_cast<std::size_t>(j.q_index)];
    };
    std::vector<std::string> seen;
    auto run = make(model, 1, 0, nullptr, &seen);
    ASSERT_TRUE(run->run_until(at(*model, 1.35)).ok());
    EXPECT_NEAR(q(*run, "lift"), 1.5, 0.01);
    EXPECT_NEAR(q(*run, "door_1"), 0.7, 0.02) << "open upstairs";
    EXPECT_NEAR(q(*run, "door_0"), 0, 0.02);
    ASSERT_TRUE(run->run_until(kEnd).ok());
    EXPECT_NEAR(q(*run, "lift"), 0, 0.01) << "the second command had to wait for the door";
    EXPECT_NEAR(q(*run, "door_1"), 0, 0.02);
    std::vector<std::string> floors;
    for (const std::string& event : seen)
        if (event.starts_with("/model/elevator/state")) floors.push_back(event);
    ASSERT_EQ(floors.size(), 3u) << ::testing::PrintToString(seen);
    EXPECT_TRUE(floors[1].ends_with("data=1") && floors[2].ends_with("data=0"));
}

TEST(FollowActor, WalksAfterTheCarrierAndKeepsItsDistance) {
    const auto model = errands();
    auto run = make(model);
    ASSERT_TRUE(run->run_until(at(*model, 1.0)).ok());
    const Vec3 from{-2, 0.5, 1}, walked = place(*model, *run, "walker") - from;
    // 0.6 m/s since the first observation, in the first tick, until it is 1.2 m away.
    const double way = norm(Vec3{2, -0.5, 0}) - 1.2;
    EXPECT_NEAR(norm(walked), std::min(way, 0.6 * 1.0), 0.05);
    EXPECT_EQ(walked.z, 0);
    ASSERT_TRUE(run->run_until(kEnd).ok());
    const Vec3 apart = place(*model, *run, "walker") - place(*model, *run, "carrier");
    EXPECT_GE(std::sqrt(apart.x * apart.x + apart.y * apart.y), 1.19);
}

TEST(SensorTopic, StartsAMessage) {
    const auto model = errands();
    auto run = make(model);
    // The parcel has fallen 2.1 m after sqrt(2 h / g) = 0.655 s. The altimeter measures every 0.02 s.
    ASSERT_TRUE(run->run_until(at(*model, 0.658)).ok());
    const RobotId carrier = *model->find_robot("carrier");
    EXPECT_EQ(run->states()[carrier.index()].onboard[0], -1);
    ASSERT_TRUE(run->run_until(at(*model, 0.67)).ok());
    EXPECT_EQ(run->states()[carrier.index()].onboard[0], static_cast<double>(at(*model, 0.66)));
}

TEST(Errands, TheSameBitsForAllGroupings) {
    const auto model = errands();
    auto reference = make(model);
    ASSERT_TRUE(reference->run_until(kEnd).ok());
    for (const std::size_t simulators : {2u, 3u})
        for (const Tick window : {Tick{0}, Tick{3}}) {
            auto other = make(model, simulators, window);
            ASSERT_TRUE(other->run_until(kEnd).ok());
            EXPECT_EQ(other->hash(), reference->hash()) << simulators << " Simulators, window " << window;
        }
}

TEST(Errands, ASavedRunGoesOnExactly) {
    const auto model = errands();
    auto whole = make(model);
    ASSERT_TRUE(whole->run_until(kEnd).ok());
    for (const double half_s : {0.0, 0.2, 0.202, 0.208, 0.21, 0.5, 0.7, 1.3, 2.2}) {
        auto first = make(model);
        ASSERT_TRUE(first->run_until(at(*model, half_s)).ok());
        const SavedRun saved = first->saved_run();
        auto second = make(model, 2, 4, &saved);
        ASSERT_TRUE(second->run_until(kEnd).ok());
        EXPECT_EQ(second->hash(), whole->hash()) << "saved at " << half_s << " s";
    }
}

TEST(Errands, SeedsOfABadBusWithKillsEndWithTheUndisturbedHash) {
    const auto model = errands();
    auto undisturbed = make(model);
    ASSERT_TRUE(undisturbed->run_until(kEnd).ok());
    int kills = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ControllerOptions options;
        options.checkpoint_ticks = 20 + static_cast<Tick>(seed % 4) * 30;
        FaultyCluster cluster(model, options, bad_network(seed), {60, 30, 20, 250, 2000}, 1 + seed % 3);
        cluster.add_program(Triggers::kName, std::make_unique<Triggers>(model));
        cluster.turn();  // makes the Controller
        for (const Order& order : orders_for(*model)) ASSERT_TRUE(cluster.controller().submit(order).ok());
        ASSERT_TRUE(cluster.run_until(kEnd)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), undisturbed->hash());
        kills += cluster.kills();
    }
    EXPECT_GT(kills, 3) << "else this test did not test";
}

}  // namespace
}  // namespace roboss::test
