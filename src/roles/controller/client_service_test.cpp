// How far the world may go is what its Clients allow; their replies are accepted in order and acknowledged.
#include "roles/controller/client_service.h"

#include <gtest/gtest.h>

#include <limits>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr Tick kNever = std::numeric_limits<Tick>::max();
const Address kA{Role::kClient, 7}, kB{Role::kClient, 8};

World one_ball() {
    World world = empty_world(1e-3);
    place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball", {{0, 0, 1}, {}});
    return world;
}

/// A Simulator has the robot; windows are committed by hand.
class Clients : public testing::Test {
  protected:
    Clients() {
        bool is_new = false;
        (void)roster.seat_for({Role::kSimulator, 1}, {0, 1, ""}, 0, is_new);
        options.loss_ms = 1000;
    }
    void join(const Address& address, const std::string& name, Tick period, Tick latency,
              bool synchronous = true, const Rights* rights = nullptr) {
        service().take_hello(bus, address, {name, sim.model->hash, period, latency, synchronous},
                             directory.tick(), rights);
    }
    void commit(Tick tick) {
        directory.commit(tick, std::vector<SeatId>{0}, roster);
        service().queue_observations();
    }
    std::size_t reply(const Address& address, ClientId id, std::uint64_t number, Tick observed,
                      const std::vector<ClientOrder>& orders = {}, const Rights* rights = nullptr) {
        return service().take_reply(bus, address, {id, number, observed, orders}, directory.tick(), rights);
    }
    ClientService& service() {
        if (!service_)
            service_.emplace(sim.model, options, model_server, order_log, recorder, directory, notices);
        return *service_;
    }

    const Simulation sim{one_ball()};
    ScriptedBus bus;
    Roster roster;
    OrderLog order_log;
    Recorder recorder{nullptr, 0, 0, {}};
    StateDirectory directory{1, 0};
    RunNotices notices;
    ModelServer model_server{sim.model, nullptr, nullptr, {5}};
    ClientServiceOptions options;
    std::optional<ClientService> service_;
};

TEST_F(Clients, ExpectedOnesGetTheirSeatsWhoeverComesFirst) {
    options.expected = {"a", "b"};
    join(kB, "b", 10, 10);
    EXPECT_EQ(bus.take<ClientWelcome>(kB).at(0).client, ClientId(1u));
    EXPECT_FALSE(service().all_joined());
    join(kA, "a", 10, 10);
    EXPECT_EQ(bus.take<ClientWelcome>(kA).at(0).client, ClientId(0u));
    EXPECT_TRUE(service().all_joined());
    join(kB, "b", 10, 10);
    EXPECT_EQ(bus.take<ClientWelcome>(kB).at(0).client, ClientId(1u)) << "the hello came twice";
    EXPECT_EQ(notices.take().size(), 2u);
    directory.commit(13, std::vector<SeatId>{0}, roster);
    join({Role::kClient, 9}, "c", 10, 10);
    EXPECT_EQ(service().seats().at(2).first, 20);
    EXPECT_EQ(service().names(), (std::vector<std::string>{"a", "b", "c"}));
}

TEST_F(Clients, WithAnotherWorldAreRefused) {
    service().take_hello(bus, kA, {"a", 5, 1, 1, true}, 0);
    EXPECT_EQ(bus.take<ModelChanged>(kA).size(), 1u);
    service().take_hello(bus, kA, {"a", sim.model->hash + 1, 1, 1, true}, 0);
    EXPECT_EQ(bus.take<Refused>(kA).size(), 1u);
    EXPECT_TRUE(service().names().empty());
}

TEST_F(Clients, LimitWindowsToTheNextObservationAndToWhereOrdersMayStillCome) {
    EXPECT_EQ(service().limit(5), kNever);
    directory.commit(3, std::vector<SeatId>{0}, roster);
    join(kA, "a", 10, 4);
    EXPECT_EQ(service().limit(3), 10);
    commit(10);
    EXPECT_EQ(service().limit(10), 14) << "its orders may apply from tick 14 on";
    EXPECT_EQ(service().limit(14), 14) << "waits for its reply";
    reply(kA, ClientId(0u), 1, 10);
    EXPECT_EQ(service().limit(14), 20);
    service().take_bye(bus, kA, {ClientId(0u), 2, false, ""});
    EXPECT_EQ(service().limit(14), kNever);
}

TEST_F(Clients, AFreeRunningOneMakesBoundariesButNobodyWaits) {
    join(kA, "a", 10, 0, false);
    commit(10);
    EXPECT_EQ(service().limit(10), 20);
    EXPECT_EQ(service().limit(19), 20);
    EXPECT_TRUE(service().all_replied(20));
}

TEST_F(Clients, GetAnObservationUntilTheyReply) {
    join(kA, "a", 10, 10);
    bus.take<ClientWelcome>(kA);
    service().send_observations(bus, roster);
    const auto first = bus.take<Observation>(kA);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].tick, 0);
    EXPECT_EQ(first[0].holders.at(0).source, kControllerAddress);
    service().send_observations(bus, roster);
    EXPECT_TRUE(bus.take<Observation>(kA).empty()) << "not yet again";
    service().holders_changed();
    service().send_observations(bus, roster);
    EXPECT_EQ(bus.take<Observation>(kA).size(), 1u);
    bus.time_ms += options.resend_ms;
    service().send_observations(bus, roster);
    EXPECT_EQ(bus.take<Observation>(kA).size(), 1u);
    EXPECT_FALSE(service().all_replied(10));
    reply(kA, ClientId(0u), 1, 0);
    EXPECT_TRUE(directory.wanted().empty());
    bus.time_ms += options.resend_ms;
    service().send_observations(bus, roster);
    EXPECT_TRUE(bus.take<Observation>(kA).empty());
}

TEST_F(Clients, RepliesAreAcceptedInOrderAndOnce) {
    join(kA, "a", 1, 3);
    const std::vector<ClientOrder> orders{{1, RobotId(0u), SetVelocity{}}, {2, RobotId(9u), SetVelocity{}}};
    EXPECT_EQ(reply(kA, ClientId(0u), 2, 0, orders), 0u) << "the first one is missing";
    EXPECT_EQ(order_log.size(), 0u);
    EXPECT_EQ(reply(kA, ClientId(0u), 1, 0, orders), 1u) << "there is no robot 9";
    EXPECT_EQ(reply(kA, ClientId(0u), 1, 0, orders), 0u);
    ASSERT_EQ(order_log.pending(1).size(), 1u);
    EXPECT_EQ(order_log.pending(1)[0].order.apply_at, 3);
    service().acknowledge(bus);
    const auto acks = bus.take<ReplyAck>(kA);
    ASSERT_EQ(acks.size(), 1u);
    EXPECT_EQ(acks[0].number, 1u);
    EXPECT_EQ(acks[0].refused.size(), 1u);
    reply(kB, ClientId(0u), 2, 1);
    EXPECT_EQ(bus.take<ClientUnknown>(kB).size(), 1u) << "not its address";
}

TEST_F(Clients, ASynchronousOneThatIsSilentEndsTheRun) {
    join(kA, "a", 10, 10);
    service().notice_losses(1000);
    EXPECT_FALSE(notices.failure());
    service().notice_losses(1001);
    ASSERT_TRUE(notices.failure());
    EXPECT_EQ(notices.failure()->code, "client-lost");
    EXPECT_TRUE(directory.wanted().empty());
}

TEST_F(Clients, AVanishedOneIsGivenUpAfterAWhile) {
    options.loss_ms = 0;
    options.gone_ms = 50;
    join(kA, "a", 10, 10, false);
    service().take_vanished(kA, 100);
    service().notice_losses(150);
    EXPECT_EQ(service().names_serving().size(), 1u);
    service().notice_losses(151);
    EXPECT_TRUE(service().names_serving().empty());
    EXPECT_FALSE(notices.failure());
}

TEST_F(Clients, TwoOfOneNameAreRefused) {
    join(kA, "a", 10, 10);
    join(kB, "a", 10, 10);
    const auto refused = bus.take<Refused>(kB);
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_NE(refused[0].reason.find("[name-taken]"), std::string::npos) << refused[0].reason;
    EXPECT_EQ(service().names(), (std::vector<std::string>{"a"}));
    service().take_bye(bus, kA, {ClientId(0u), 1, false, ""});
    join(kB, "a", 10, 10);
    EXPECT_EQ(bus.take<ClientWelcome>(kB).size(), 1u) << "the first one has left";
}

TEST_F(Clients, OfObserversManyMayHaveOneName) {
    for (const Address& address : {kA, kB}) {
        service().take_hello(bus, address, {"viewer", sim.model->hash, 10, 10, false, true}, 0);
        EXPECT_EQ(bus.take<ClientWelcome>(address).size(), 1u);
    }
}

TEST_F(Clients, ASuccessorAnswersWhatItsPredecessorDidNot) {
    options.gone_ms = 50;
    join(kA, "a", 10, 20);
    const std::vector<ClientOrder> orders{{1, RobotId(0u), SetVelocity{}}, {2, RobotId(0u), SetVelocity{}}};
    reply(kA, ClientId(0u), 1, 0, orders);
    commit(10);
    commit(20);
    service().take_vanished(kA, 100);
    EXPECT_NE(notices.take().back().find("[client-vanished]"), std::string::npos);
    bus.time_ms = 120;
    join(kB, "a", 10, 20);
    const auto welcome = bus.take<ClientWelcome>(kB);
    ASSERT_EQ(welcome.size(), 1u);
    EXPECT_EQ(welcome[0].client, ClientId(0u)) << "the seat is the same";
    EXPECT_EQ(welcome[0].first, 10);
    service().send_observations(bus, roster);
    EXPECT_EQ(bus.take<Observation>(kB).size(), 2u) << "of ticks 10 and 20";
    EXPECT_EQ(service().limit(20), 30);
    reply(kB, ClientId(0u), 1, 10, orders);
    EXPECT_EQ(service().limit(20), 30);
    reply(kB, ClientId(0u), 2, 20, {{3, RobotId(0u), SetVelocity{}}});
    EXPECT_EQ(service().limit(20), 30) << "the next observation";
    EXPECT_EQ(order_log.size(), 5u) << "no order of the successor is taken for one of its predecessor";
    bus.time_ms = 1'000;
    service().notice_losses(bus.time_ms);
    EXPECT_FALSE(notices.failure());
    reply(kA, ClientId(0u), 2, 10);
    EXPECT_EQ(bus.take<ClientUnknown>(kA).size(), 1u) << "the predecessor has no seat any more";
    join(kA, "a", 10, 20);
    EXPECT_EQ(bus.take<Refused>(kA).size(), 1u);
}

TEST_F(Clients, ASuccessorIsNotAskedAgainWhatItsPredecessorAnswered) {
    options.gone_ms = 50;
    join(kA, "a", 10, 10);
    commit(10);
    reply(kA, ClientId(0u), 1, 0);
    reply(kA, ClientId(0u), 2, 10);
    service().take_vanished(kA, 100);
    join(kB, "a", 10, 10);
    EXPECT_EQ(bus.take<ClientWelcome>(kB).at(0).first, 20);
    service().send_observations(bus, roster);
    EXPECT_TRUE(bus.take<Observation>(kB).empty());
    EXPECT_EQ(service().limit(10), 20);
    commit(20);
    service().send_observations(bus, roster);
    EXPECT_EQ(bus.take<Observation>(kB).size(), 1u);
}

TEST_F(Clients, ASuccessorWithOtherTimesIsRefusedAndHearsHowToBranch) {
    options.gone_ms = 50;
    join(kA, "a", 10, 10);
    service().take_vanished(kA, 100);
    join(kB, "a", 20, 10);
    const auto refused = bus.take<Refused>(kB);
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_NE(refused[0].reason.find("[other-times]"), std::string::npos) << refused[0].reason;
    EXPECT_NE(refused[0].reason.find("--from"), std::string::npos) << refused[0].reason;
    service().notice_losses(151);
    ASSERT_TRUE(notices.failure());
    EXPECT_EQ(notices.failure()->code, "client-lost");
}

TEST_F(Clients, AnOrderThatTheKeyDoesNotPermitIsRefusedOnBothSidesAndReachesNoLog) {
    const Rights rights = make_rights({"*"}, {"velocity"}, false).value();
    const std::vector<ClientOrder> orders{{1, RobotId(0u), SetPose{}}, {2, RobotId(0u), SetVelocity{}}};
    join(kA, "a", 1, 3);
    notices.take();
    for (std::uint64_t number = 1; number <= 50; ++number) {
        EXPECT_EQ(reply(kA, ClientId(0u), number, static_cast<Tick>(number) - 1, orders, &rights), 1u);
        service().acknowledge(bus);
        const auto acks = bus.take<ReplyAck>(kA);
        ASSERT_EQ(acks.size(), 1u);
        ASSERT_FALSE(acks[0].refused.empty());
        EXPECT_EQ(acks[0].refused.back().code, "not-permitted");
    }
    ASSERT_EQ(order_log.size(), 50u);
    for (const LoggedOrder& logged : order_log.pending(1'000))
        EXPECT_TRUE(std::holds_alternative<SetVelocity>(logged.order.action));
    const std::vector<std::string> lines = notices.take();
    ASSERT_EQ(lines.size(), 1u) << "not once for each order";
    EXPECT_NE(lines[0].find("client 'a'"), std::string::npos) << lines[0];
    EXPECT_NE(lines[0].find("[not-permitted]"), std::string::npos) << lines[0];
    const Rights others = make_rights({"car_*"}, {"velocity"}, false).value();
    EXPECT_EQ(reply(kA, ClientId(0u), 51, 50, orders, &others), 2u) << "the rights come with each message";
}

TEST_F(Clients, OneThatMayLookOnlyDisturbsNothing) {
    options.expected = {"driver"};
    const Rights rights = make_rights({"*"}, {}, false).value();
    join(kA, "driver", 10, 10, true, &rights);
    const auto refused = bus.take<Refused>(kA);
    ASSERT_EQ(refused.size(), 1u) << "the world would wait for it";
    EXPECT_NE(refused[0].reason.find("[not-permitted]"), std::string::npos) << refused[0].reason;
    join(kA, "driver", 10, 10, false, &rights);
    ASSERT_EQ(bus.take<ClientWelcome>(kA).size(), 1u);
    EXPECT_FALSE(service().all_joined()) << "it takes no other Client's place";
    join(kB, "driver", 10, 10);
    ASSERT_EQ(bus.take<ClientWelcome>(kB).at(0).client, ClientId(0u));
    const std::vector<ClientOrder> orders{{1, RobotId(0u), SetVelocity{}}};
    EXPECT_EQ(reply(kA, ClientId(1u), 1, 0, orders, &rights), 1u);
    EXPECT_EQ(order_log.size(), 0u);
    service().take_bye(bus, kA, {ClientId(1u), 2, true, "no eyes"}, &rights);
    EXPECT_FALSE(notices.failure());
    EXPECT_EQ(service().names_serving(), std::vector<std::string>{"driver"});
}

TEST_F(Clients, AFailureOfOneEndsTheRun) {
    join(kA, "a", 10, 10);
    service().take_bye(bus, kA, {ClientId(0u), 1, true, "no wheels"});
    ASSERT_TRUE(notices.failure());
    EXPECT_EQ(notices.failure()->code, "client-failed");
    EXPECT_FALSE(notices.failure()->remedy.empty());
}

TEST_F(Clients, TheRemedyOfAFailureIsTheProgramsOwn) {
    join(kA, "a", 10, 10);
    service().take_bye(bus, kA, {ClientId(0u), 1, true, "no wheels\n  remedy: mount wheels"});
    ASSERT_TRUE(notices.failure());
    EXPECT_EQ(notices.failure()->remedy, "mount wheels");
}

}  // namespace
}  // namespace roboss::test
