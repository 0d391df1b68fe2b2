// A viewer gets views at its rate, each tick once, from those who hold the states, and is dropped soon after
// its last request.
#include "roles/controller/view_service.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const Address kViewer{Role::kClient, 7};

std::shared_ptr<const Model> empty_model() {
    return std::make_shared<Model>();
}

void request(ViewService& service, const ViewRequest& request, std::int64_t now_ms,
             const Address& viewer = kViewer) {
    ScriptedBus bus;
    bus.time_ms = now_ms;
    service.take(bus, viewer, request);
}

TEST(ViewService, ShowsAtMostOnceInAnIntervalAndEachTickOnce) {
    ViewService service(empty_model());
    EXPECT_TRUE(service.empty());
    request(service, {0, 30, 0, false, {}}, 1000);
    int shown = 0;
    for (std::int64_t ms = 1000; ms < 2000; ++ms) shown += static_cast<int>(service.take_due(ms, ms).size());
    EXPECT_NEAR(shown, 33, 2);
    EXPECT_EQ(service.take_due(2000, 2200).size(), 1u);
    EXPECT_TRUE(service.take_due(2000, 2300).empty()) << "the tick of the last view";
}

TEST(ViewService, ShowsATickAgainWhenAskedAgain) {
    ViewService service(empty_model());
    request(service, {0, 30, 0, false, {}}, 1000);
    EXPECT_EQ(service.take_due(5, 1000).size(), 1u);
    EXPECT_TRUE(service.take_due(5, 1500).empty());
    request(service, {0, 30, 0, false, {}}, 1600);
    EXPECT_EQ(service.take_due(5, 1600).size(), 1u);
}

TEST(ViewService, ExactStatesHaveAPaceOfTheirOwn) {
    ViewService service(empty_model());
    request(service, {0, 10, 100, false, {RobotId(3u)}}, 0);
    int views = 0, exact = 0;
    for (std::int64_t ms = 0; ms < 1000; ++ms)
        for (const ViewService::Due& due : service.take_due(ms, ms)) {
            views += due.view ? 1 : 0;
            exact += due.exact.size() == 1 ? 1 : 0;
        }
    EXPECT_NEAR(views, 100, 3);
    EXPECT_NEAR(exact, 10, 1);
}

TEST(ViewService, AsksForWindowsThatEndWhenAViewIsDue) {
    ViewService service(empty_model());
    EXPECT_FALSE(service.window_max()) << "nobody watches";
    request(service, {0, 30, 0, false, {}}, 0);
    for (Tick tick = 0; tick < 400; tick += 4) service.note(tick, 2 * tick);
    EXPECT_EQ(service.window_max(), 15) << "at 2 ms a tick";
    for (std::int64_t ms = 800; ms < 9'000; ++ms) service.note(396, ms);  // it rests
    EXPECT_EQ(service.window_max(), 15) << "a rest does not change the measured speed";
    request(service, {0, 0, 100, false, {RobotId(1u)}}, 0);
    EXPECT_FALSE(service.window_max()) << "exact states do not limit windows";
}

TEST(ViewService, DropsAViewerThatFallsSilent) {
    ViewService service(empty_model());
    request(service, {0, 30, 0, false, {}}, 0);
    EXPECT_EQ(service.take_due(1, 2900).size(), 1u);
    EXPECT_TRUE(service.take_due(2, 3100).empty());
    EXPECT_TRUE(service.empty());
}

TEST(ViewService, ServesALimitedNumberOfViewers) {
    ViewService service(empty_model());
    for (std::uint64_t i = 0; i < 1000; ++i) request(service, {0, 30, 0, false, {}}, 0, {Role::kClient, i});
    EXPECT_LE(service.take_due(1, 0).size(), 16u);
}

TEST(ViewService, SendsAViewerOfAnEarlierModelToTheCurrentOne) {
    ScriptedBus bus;
    ViewService service(empty_model());
    service.take(bus, kViewer, {5, 30, 0, false, {}});
    EXPECT_TRUE(service.empty());
    ASSERT_EQ(bus.take<ModelChanged>(kViewer).size(), 1u);
}

/// Two balls: the first is at a Simulator, the second still at the Controller.
TEST(ViewService, MakesHoldersSendTheirRobotsAndSendsThoseOfTheController) {
    World world = empty_world(1e-3);
    for (int i = 0; i < 2; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{9.0 * i, 0, 1}, {}});
    const Simulation sim{world};
    const Address simulator{Role::kSimulator, 3};
    Roster roster;
    bool is_new = false;
    const SeatId seat = roster.seat_for(simulator, {}, 0, is_new).value();
    StateDirectory directory(2, 0);
    directory.commit(4, std::vector<SeatId>{seat, seat}, roster);
    const std::vector<RobotId> second{RobotId(1u)};
    directory.begin_recovery(second, 4);
    ScriptedBus bus;
    ViewService service(sim.model);
    service.take(bus, kViewer, {sim.model->hash, 30, 30, false, second});
    service.serve(bus, {9, directory, roster, &sim.states});
    const auto due = bus.take<ViewDue>(simulator);
    ASSERT_EQ(due.size(), 1u);
    EXPECT_EQ(due[0], (ViewDue{9, 1, 4, kViewer, {RobotId(0u)}, {}}));
    std::vector<Envelope> inbox;
    bus.drain(kViewer, inbox);
    ASSERT_EQ(inbox.size(), 2u);
    EXPECT_EQ(std::get<ViewStates>(inbox[0].message).tick, 4);
    EXPECT_EQ(std::get<StateReply>(inbox[1].message).states.robots, second);

    roster.seat(seat).alive = false;
    bus.time_ms = 1000;
    service.take(bus, kViewer, {sim.model->hash, 30, 0, false, {}});
    service.serve(bus, {9, directory, roster, nullptr});
    bus.drain(kViewer, inbox);
    EXPECT_TRUE(inbox.empty()) << "nobody has a state of this tick";
}

}  // namespace
}  // namespace roboss::test
