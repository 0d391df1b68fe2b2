// The Bus over real Fast DDS on the loopback interface: what is said arrives, however long; who dies is
// missed; runs side by side never mix; and it all works without multicast.
#include "dds/dds_bus.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include <support/loopback_bus.h>

namespace roboss {
namespace {

using test::bus_of, test::loopback;

const Address kOne{Role::kSimulator, 1}, kTwo{Role::kSimulator, 2};

/// Drains `self` until `count` messages have come, for at most ten seconds.
std::vector<Envelope> receive(DdsBus& bus, const Address& self, std::size_t count, DdsBus* sender = nullptr) {
    std::vector<Envelope> all, inbox;
    const std::int64_t end = bus.now_ms() + 10'000;
    while (all.size() < count && bus.now_ms() < end) {
        bus.wait(5);
        if (sender != nullptr) sender->wait(0);
        bus.drain(self, inbox);
        for (Envelope& e : inbox) all.push_back(std::move(e));
    }
    return all;
}

/// Waits until `self` sees that another process reads `address`, or that none does, for at most five seconds.
/// Discovery announces readers and writers apart: a message may come before the reader of its sender is
/// known.
bool sees_reader(DdsBus& self, const Address& address, bool is_there) {
    const std::int64_t end = self.now_ms() + 5'000;
    while (self.taken_elsewhere(address) != is_there && self.now_ms() < end) self.wait(5);
    return self.taken_elsewhere(address) == is_there;
}

StateReply reply_of(std::size_t bytes) {
    StateReply reply;
    reply.states.robots = {RobotId(7u)};
    reply.states.sizes = {static_cast<std::uint32_t>(bytes)};
    for (std::size_t i = 0; i < bytes; ++i)
        reply.states.bytes.push_back(static_cast<std::uint8_t>(i * 31 + i / 999));
    return reply;
}

TEST(DdsBus, WhatIsSentBeforeTheOtherIsFoundArrivesOnceAndInOrder) {
    const auto a = bus_of(loopback("order")), b = bus_of(loopback("order"));
    std::vector<Envelope> inbox;
    b->drain(kTwo, inbox);
    for (std::uint32_t i = 0; i < 500; ++i) a->send(kOne, kTwo, Expelled{SimulatorId(i)});
    const auto all = receive(*b, kTwo, 500, a.get());
    ASSERT_EQ(all.size(), 500u);
    for (std::uint32_t i = 0; i < 500; ++i)
        EXPECT_EQ(std::get<Expelled>(all[i].message).simulator, SimulatorId(i));
    EXPECT_EQ(all[0].from, kOne);
    EXPECT_TRUE(a->flush(2000));
    EXPECT_TRUE(a->take_notices().empty());
}

TEST(DdsBus, MessagesOfManyDatagramsArriveWhole) {
    const auto a = bus_of(loopback("long")), b = bus_of(loopback("long"));
    std::vector<Envelope> inbox;
    b->drain(kTwo, inbox);
    for (const std::size_t bytes : {100u, 70'000u, 6'000'000u}) {
        const StateReply reply = reply_of(bytes);
        a->send(kOne, kTwo, reply);
        const auto all = receive(*b, kTwo, 1, a.get());
        ASSERT_EQ(all.size(), 1u) << bytes;
        EXPECT_EQ(std::get<StateReply>(all[0].message).states, reply.states);
    }
}

TEST(DdsBus, SignsOfLifeOfManyAllCome) {
    const auto a = bus_of(loopback("signs")), b = bus_of(loopback("signs"));
    std::vector<Envelope> inbox;
    b->drain(kControllerAddress, inbox);
    const std::int64_t end = b->now_ms() + 10'000;
    std::vector<bool> heard(12, false);
    while (std::count(heard.begin(), heard.end(), false) > 0 && b->now_ms() < end) {
        for (std::uint32_t i = 0; i < 12; ++i)
            a->send({Role::kSimulator, i}, kControllerAddress, Heartbeat{SimulatorId(i)});
        b->wait(20);
        b->drain(kControllerAddress, inbox);
        for (const Envelope& e : inbox) heard[std::get<Heartbeat>(e.message).simulator.index()] = true;
    }
    EXPECT_EQ(std::count(heard.begin(), heard.end(), false), 0);
}

TEST(DdsBus, AddressesOfOneProcessTalkWithoutTheNetwork) {
    const auto bus = bus_of(loopback("local"));
    std::vector<Envelope> inbox;
    bus->drain(kOne, inbox);
    bus->send(kTwo, kOne, Heartbeat{SimulatorId(3u)});
    bus->drain(kOne, inbox);
    ASSERT_EQ(inbox.size(), 1u);
    EXPECT_TRUE(bus->present(kOne));
    EXPECT_FALSE(bus->present(kTwo));
    EXPECT_FALSE(bus->taken_elsewhere(kOne));
}

TEST(DdsBus, RunsOfDifferentNamesNeverMix) {
    const auto a = bus_of(loopback("mine")), mine = bus_of(loopback("mine")),
               other = bus_of(loopback("other"));
    std::vector<Envelope> inbox;
    mine->drain(kTwo, inbox);
    other->drain(kTwo, inbox);
    a->send(kOne, kTwo, Heartbeat{SimulatorId(1u)});
    a->send(kOne, kTwo, Expelled{SimulatorId(1u)});
    const auto all = receive(*mine, kTwo, 1, a.get());
    EXPECT_GE(all.size(), 1u);
    EXPECT_TRUE(a->flush(1000));
    other->wait(200);
    other->drain(kTwo, inbox);
    EXPECT_TRUE(inbox.empty());
}

TEST(DdsBus, WhoEndsIsMissedAndWhoOpensTheSameAddressIsSeen) {
    auto a = bus_of(loopback("end"));
    const auto b = bus_of(loopback("end"));
    std::vector<Envelope> inbox;
    b->drain(kTwo, inbox);
    a->drain(kOne, inbox);
    a->send(kOne, kTwo, Expelled{});
    ASSERT_EQ(receive(*b, kTwo, 1, a.get()).size(), 1u);
    EXPECT_TRUE(b->take_vanished(kTwo).empty());
    EXPECT_TRUE(sees_reader(*b, kOne, true));
    EXPECT_FALSE(b->taken_elsewhere(kTwo));
    a.reset();
    std::vector<Address> vanished;
    const std::int64_t end = b->now_ms() + 5'000;
    while (vanished.empty() && b->now_ms() < end) {
        b->wait(20);
        b->drain(kTwo, inbox);
        vanished = b->take_vanished(kTwo);
    }
    ASSERT_FALSE(vanished.empty());
    EXPECT_EQ(vanished[0], kOne);
    EXPECT_TRUE(sees_reader(*b, kOne, false));
}

/// Says it again until it is heard, as the roles do: what is sent to one who has just gone is lost.
bool gets_through(DdsBus& sender, const Address& from, DdsBus& receiver, const Address& to) {
    std::vector<Envelope> inbox;
    for (int turn = 0; turn < 500; ++turn) {
        if (turn % 10 == 0) sender.send(from, to, Expelled{});
        receiver.wait(10);
        sender.wait(0);
        receiver.drain(to, inbox);
        if (!inbox.empty()) return inbox[0].from == from;
    }
    return false;
}

TEST(DdsBus, WhoJoinsTheNetworkAfreshIsFoundAgain) {
    const auto a = bus_of(loopback("again")), b = bus_of(loopback("again"));
    std::vector<Envelope> inbox;
    b->drain(kTwo, inbox);
    a->drain(kOne, inbox);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(b->heard_ms(kOne).has_value(), i > 0);
        EXPECT_TRUE(gets_through(*a, kOne, *b, kTwo)) << i;
        EXPECT_TRUE(gets_through(*b, kTwo, *a, kOne)) << i;
        const Result<> reconnected = i % 2 == 0 ? a->reconnect() : b->reconnect();
        EXPECT_TRUE(reconnected) << i;
    }
}

TEST(DdsBus, AMemberBelongsToOneOfTwoControllersOfTheSameName) {
    const auto first = bus_of(loopback("two")), second = bus_of(loopback("two")),
               member = bus_of(loopback("two"));
    std::vector<Envelope> inbox;
    first->drain(kControllerAddress, inbox);
    ASSERT_TRUE(gets_through(*member, kOne, *first, kControllerAddress));
    member->drain(kOne, inbox);
    ASSERT_TRUE(gets_through(*first, kControllerAddress, *member, kOne));
    second->drain(kControllerAddress, inbox);
    int turns_together = 0;  // since the second Controller found the member
    for (int turn = 0; turn < 1'000 && turns_together < 40; ++turn) {
        if (second->present(kOne)) ++turns_together;
        second->send(kControllerAddress, kOne, RunOver{"of another"});
        member->send(kOne, kControllerAddress, Expelled{});
        member->wait(10);
        member->drain(kOne, inbox);
        for (const Envelope& e : inbox) EXPECT_FALSE(std::holds_alternative<RunOver>(e.message));
        second->drain(kControllerAddress, inbox);
        EXPECT_TRUE(inbox.empty());
    }
    EXPECT_TRUE(second->present(kOne)) << "else this test did not test";
}

TEST(DdsBus, MembersThatSeeOnlyTheControllerReachEachOtherThroughIt) {
    DdsOptions options = loopback("star");
    options.peers.clear();
    options.port = static_cast<std::uint16_t>(50'000 + getpid() % 10'000);
    const auto controller = bus_of(options);
    options.peers = {"127.0.0.1:" + std::to_string(std::exchange(options.port, std::uint16_t{0}))};
    const auto a = bus_of(options), b = bus_of(options);
    std::vector<Envelope> inbox;
    for (int turn = 0; turn < 1'000 && inbox.empty(); ++turn) {
        if (turn % 10 == 0) a->send(kOne, kTwo, reply_of(100'000));
        a->wait(10);
        a->drain(kOne, inbox);
        controller->drain(kControllerAddress, inbox);
        b->drain(kTwo, inbox);
    }
    EXPECT_TRUE(a->present(kControllerAddress));
    EXPECT_TRUE(controller->present(kTwo));
    ASSERT_FALSE(inbox.empty());
    EXPECT_EQ(inbox[0].from, kOne);
    EXPECT_EQ(std::get<StateReply>(inbox[0].message).states, reply_of(100'000).states);
    EXPECT_FALSE(a->present(kTwo)) << "else this test did not test";
}

TEST(DdsBus, MembersToldSoReachOthersThroughTheControllerFromTheFirstMessageOn) {
    DdsOptions options = loopback("through");
    options.peers.clear();
    options.port = static_cast<std::uint16_t>(40'000 + getpid() % 10'000);
    const auto controller = bus_of(options);
    options.peers = {"127.0.0.1:" + std::to_string(std::exchange(options.port, std::uint16_t{0}))};
    options.through_controller = true;
    const auto a = bus_of(options), b = bus_of(options);
    const Address client{Role::kClient, 3};  // in the Controller's process
    std::vector<Envelope> inbox;
    a->drain(kOne, inbox);
    b->drain(kTwo, inbox);
    controller->drain(client, inbox);
    a->send(kOne, kTwo, Expelled{SimulatorId(1u)});
    a->send(kOne, client, Expelled{SimulatorId(2u)});
    std::vector<SimulatorId> at_b, at_client;
    for (int turn = 0; turn < 1'000 && (at_b.empty() || at_client.empty()); ++turn) {
        a->wait(5);
        controller->drain(kControllerAddress, inbox);
        EXPECT_TRUE(inbox.empty()) << "it was for others";
        b->drain(kTwo, inbox);
        for (const Envelope& e : inbox) at_b.push_back(std::get<Expelled>(e.message).simulator);
        controller->drain(client, inbox);
        for (const Envelope& e : inbox) at_client.push_back(std::get<Expelled>(e.message).simulator);
    }
    EXPECT_EQ(at_b, std::vector<SimulatorId>{SimulatorId(1u)});
    EXPECT_EQ(at_client, std::vector<SimulatorId>{SimulatorId(2u)});
}

TEST(DdsBus, WrongOptionsAreRefusedInWords) {
    DdsOptions options = loopback("bad");
    options.interface = "no-such-interface";
    auto bus = DdsBus::create(options);
    ASSERT_FALSE(bus.ok());
    EXPECT_NE(bus.error().remedy.find("127.0.0.1"), std::string::npos) << bus.error().text();
    options = loopback("bad/name");
    EXPECT_NE(DdsBus::create(options).error().message.find("name of a simulation"), std::string::npos);
    options = loopback("bad");
    options.domain = 233;
    EXPECT_NE(DdsBus::create(options).error().message.find("233"), std::string::npos);
    options = loopback("bad");
    options.peers = {"127.0.0.1:99999"};
    EXPECT_NE(DdsBus::create(options).error().message.find("port"), std::string::npos);
    options.peers.clear();
    options.discovery_server = "127.0.0.1";
    EXPECT_NE(DdsBus::create(options).error().message.find("no port"), std::string::npos);
}

}  // namespace
}  // namespace roboss
