// The Bus over real connections on the loopback interface: what is said arrives, however long; who dies is
// missed; members reach each other; runs side by side never mix.
#include "net/stream_bus.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <support/loopback_bus.h>
#include <algorithm>
#include <csignal>

namespace roboss {
namespace {

using test::becomes, test::controller_of, test::loopback, test::member_of, test::receive;

const Address kOne{Role::kSimulator, 1}, kTwo{Role::kSimulator, 2};

StateReply reply_of(std::size_t bytes) {
    StateReply reply;
    reply.states.robots = {RobotId(7u)};
    reply.states.sizes = {static_cast<std::uint32_t>(bytes)};
    for (std::size_t i = 0; i < bytes; ++i)
        reply.states.bytes.push_back(static_cast<std::uint8_t>(i * 31 + i / 999));
    return reply;
}

bool connected(StreamBus& member) {
    return becomes([&] { return member.present(kControllerAddress); });
}

TEST(StreamBus, MessagesArriveOnceAndInOrder) {
    const NetOptions options = loopback("order");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    for (std::uint32_t i = 0; i < 500; ++i) member->send(kOne, kControllerAddress, Expelled{SimulatorId(i)});
    const auto all = receive(*controller, kControllerAddress, 500);
    ASSERT_EQ(all.size(), 500u);
    for (std::uint32_t i = 0; i < 500; ++i)
        EXPECT_EQ(std::get<Expelled>(all[i].message).simulator, SimulatorId(i));
    EXPECT_EQ(all[0].from, kOne);
    EXPECT_TRUE(member->flush(2'000));
    EXPECT_TRUE(member->take_notices().empty());
    EXPECT_TRUE(controller->take_notices().empty());
}

TEST(StreamBus, LongMessagesArriveWhole) {
    const NetOptions options = loopback("long");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    for (const std::size_t bytes : {100u, 65'536u, 70'000u, 6'000'000u, 50'000'000u}) {
        const StateReply reply = reply_of(bytes);
        member->send(kOne, kControllerAddress, reply);
        const auto all = receive(*controller, kControllerAddress, 1);
        ASSERT_EQ(all.size(), 1u) << bytes;
        EXPECT_EQ(std::get<StateReply>(all[0].message).states, reply.states);
    }
}

TEST(StreamBus, AHeartbeatOvertakesALongMessage) {
    const NetOptions options = loopback("overtakes");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    member->send(kOne, kControllerAddress, reply_of(50'000'000));
    member->send(kOne, kControllerAddress, Heartbeat{SimulatorId(1u)});
    const auto all = receive(*controller, kControllerAddress, 2);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(std::holds_alternative<Heartbeat>(all[0].message));
}

TEST(StreamBus, TheControllerReachesAMemberThatHasSentNothing) {
    const NetOptions options = loopback("first");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne); }));
    controller->send(kControllerAddress, kOne, Expelled{});
    EXPECT_EQ(receive(*member, kOne, 1).size(), 1u);
}

TEST(StreamBus, MembersReachEachOtherAndClientsInTheControllersProcess) {
    const NetOptions options = loopback("star");
    const auto controller = controller_of(options), a = member_of(options, kOne),
               b = member_of(options, kTwo);
    const Address client{Role::kClient, 3};
    std::vector<Envelope> inbox;
    controller->drain(client, inbox);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne) && controller->present(kTwo); }));
    a->send(kOne, kTwo, reply_of(100'000));
    a->send(kOne, client, Expelled{SimulatorId(2u)});
    const auto at_b = receive(*b, kTwo, 1), at_client = receive(*controller, client, 1);
    ASSERT_EQ(at_b.size(), 1u);
    EXPECT_EQ(at_b[0].from, kOne);
    EXPECT_EQ(std::get<StateReply>(at_b[0].message).states, reply_of(100'000).states);
    ASSERT_EQ(at_client.size(), 1u);
    controller->drain(kControllerAddress, inbox);
    EXPECT_TRUE(inbox.empty()) << "it was for others";
}

TEST(StreamBus, AddressesOfOneProcessTalkWithoutTheNetwork) {
    const auto bus = controller_of(loopback("local"));
    std::vector<Envelope> inbox;
    bus->drain(kOne, inbox);
    bus->send(kTwo, kOne, Heartbeat{SimulatorId(3u)});
    bus->drain(kOne, inbox);
    ASSERT_EQ(inbox.size(), 1u);
    EXPECT_TRUE(bus->present(kOne));
    EXPECT_FALSE(bus->present(kTwo));
}

TEST(StreamBus, AMemberThatEndsIsMissedAtOnce) {
    const NetOptions options = loopback("end");
    const auto controller = controller_of(options);
    auto member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    member->send(kOne, kControllerAddress, Expelled{});
    ASSERT_EQ(receive(*controller, kControllerAddress, 1).size(), 1u);
    EXPECT_TRUE(controller->take_vanished(kControllerAddress).empty());
    member.reset();
    std::vector<Address> vanished;
    ASSERT_TRUE(becomes([&] { return !(vanished = controller->take_vanished(kControllerAddress)).empty(); }));
    EXPECT_EQ(vanished, std::vector<Address>{kOne});
    EXPECT_FALSE(controller->present(kOne));
}

TEST(StreamBus, AMemberFindsAControllerThatIsStartedLaterAndStartedAgain) {
    const NetOptions options = loopback("again");
    const auto member = member_of(options, kOne);
    for (int i = 0; i < 3; ++i) {
        const auto controller = controller_of(options);
        ASSERT_TRUE(connected(*member)) << i;
        member->send(kOne, kControllerAddress, Expelled{});
        ASSERT_EQ(receive(*controller, kControllerAddress, 1).size(), 1u) << i;
        controller->send(kControllerAddress, kOne, Expelled{});
        ASSERT_EQ(receive(*member, kOne, 1).size(), 1u) << i;
    }
    ASSERT_TRUE(becomes([&] { return !member->present(kControllerAddress); }));
    std::vector<Envelope> inbox;
    member->drain(kOne, inbox);
    EXPECT_EQ(member->take_vanished(kOne), (std::vector<Address>(3, kControllerAddress)));
}

TEST(StreamBus, AControllersNameIsTakenWhileItLives) {
    const NetOptions options = loopback("taken");
    auto first = controller_of(options);
    const auto second = StreamBus::listen(options);
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().code, "controller-exists");
    first.reset();
    EXPECT_TRUE(StreamBus::listen(options).ok());
}

TEST(StreamBus, APortThatIsTakenIsNamed) {
    NetOptions options = loopback("port");
    const auto first = controller_of(options);
    options.port =
        static_cast<std::uint16_t>(std::stoi(first->where().substr(first->where().rfind(':') + 1)));
    options.simulation += "-other";
    const auto second = StreamBus::listen(options);
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().code, "port-taken");
    EXPECT_NE(second.error().message.find(first->where()), std::string::npos) << second.error().message;
}

TEST(StreamBus, ABusyRoleIsKeptAliveByItsHeartbeats) {
    const NetOptions options = loopback("beat");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    member->keep_alive(kOne, kControllerAddress, Heartbeat{SimulatorId(4u)});
    const auto beats = receive(*controller, kControllerAddress, 3);
    ASSERT_EQ(beats.size(), 3u);
    EXPECT_EQ(std::get<Heartbeat>(beats[2].message).simulator, SimulatorId(4u));
    member->end_keep_alive(kOne);
    usleep(300'000);
    std::vector<Envelope> inbox;
    controller->drain(kControllerAddress, inbox);
    usleep(500'000);
    controller->drain(kControllerAddress, inbox);
    EXPECT_TRUE(inbox.empty());
}

TEST(StreamBus, AConnectionInWhichNothingIsSaidLastsLongerThanALease) {
    NetOptions options = loopback("idle");
    options.liveliness_ms = 300;
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    usleep(1'500'000);
    EXPECT_TRUE(member->present(kControllerAddress));
    EXPECT_TRUE(controller->present(kOne));
    EXPECT_TRUE(member->take_notices().empty());
}

TEST(StreamBus, AMemberHearsWhyTheRunIsOver) {
    const NetOptions options = loopback("over");
    auto controller = controller_of(options);
    const auto member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    EXPECT_FALSE(member->run_end());
    controller->say_farewell({"its duration was over", false});
    EXPECT_TRUE(controller->flush(1'000));
    controller.reset();
    ASSERT_TRUE(becomes([&] { return member->run_end() && !member->present(kControllerAddress); }));
    EXPECT_EQ(member->run_end()->reason, "its duration was over");
    EXPECT_FALSE(member->run_end()->failed);
    EXPECT_TRUE(member->take_notices().empty()) << "nothing is lost";
    controller = controller_of(options);
    EXPECT_TRUE(becomes([&] { return member->present(kControllerAddress); }));
    EXPECT_FALSE(member->run_end()) << "another run has begun";
}

/// A member in a process of its own that can be stopped. It writes why its run was over.
class StoppedMember {
  public:
    explicit StoppedMember(const NetOptions& options) {
        EXPECT_EQ(pipe(said_), 0);
        process_ = fork();
        if (process_ == 0) {
            const auto member = member_of(options, kOne);
            becomes([&] { return member->run_end().has_value(); });
            const std::string reason = member->run_end() ? member->run_end()->reason : "nothing";
            (void)!write(said_[1], reason.data(), reason.size());
            _exit(0);
        }
        close(said_[1]);
    }
    ~StoppedMember() {
        signal(SIGKILL);
        waitpid(process_, nullptr, 0);
        close(said_[0]);
    }
    void signal(int number) const { kill(process_, number); }
    std::string said() const {
        char text[200];
        const ssize_t length = read(said_[0], text, sizeof text);
        return {text, static_cast<std::size_t>(std::max<ssize_t>(length, 0))};
    }

  private:
    pid_t process_ = -1;
    int said_[2] = {-1, -1};
};

TEST(StreamBus, AMemberThatWasStoppedAcrossTheEndHearsOfItAfterwards) {
    NetOptions options = loopback("stopped");
    options.liveliness_ms = 300;
    const StoppedMember member(options);  // before this process has threads
    auto controller = controller_of(options);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne); }));
    controller->send(kControllerAddress, kOne, Expelled{});
    member.signal(SIGSTOP);
    EXPECT_TRUE(becomes([&] { return !controller->present(kOne); })) << "it counts as lost";
    controller->say_farewell({"a signal ended it", true});
    controller->flush(500);
    controller.reset();
    usleep(200'000);
    member.signal(SIGCONT);
    EXPECT_EQ(member.said(), "a signal ended it");
}

TEST(StreamBus, AMemberThatWasStoppedForAWhileIsBack) {
    NetOptions options = loopback("back");
    options.liveliness_ms = 300;
    const StoppedMember member(options);
    const auto controller = controller_of(options);
    for (int times = 0; times < 3; ++times) {
        ASSERT_TRUE(becomes([&] { return controller->present(kOne); }));
        member.signal(SIGSTOP);
        EXPECT_TRUE(becomes([&] { return !controller->present(kOne); }));
        usleep(300'000);
        member.signal(SIGCONT);
    }
    EXPECT_TRUE(becomes([&] { return controller->present(kOne); }));
}

TEST(StreamBus, WhoSendsMoreThanIsReadHasToWait) {
    const NetOptions options = loopback("flood");
    const auto controller = controller_of(options), member = member_of(options, kOne);
    ASSERT_TRUE(connected(*member));
    constexpr std::size_t kMessages = 200;
    for (std::size_t i = 0; i < kMessages; ++i) member->send(kOne, kControllerAddress, reply_of(1'000'000));
    usleep(1'500'000);  // longer than a lease
    std::uint64_t arrived = 0;
    for (const Flow& flow : controller->flows()) arrived += flow.bytes;
    EXPECT_LT(arrived, 80u << 20) << "of 200 MB";
    EXPECT_EQ(receive(*controller, kControllerAddress, kMessages).size(), kMessages);
    EXPECT_TRUE(controller->take_vanished(kControllerAddress).empty());
}

TEST(StreamBus, WhoDoesNotReadFillsNoSenderAndLosesMessages) {
    const NetOptions options = loopback("slow");
    const auto controller = controller_of(options), slow = member_of(options, kOne),
               other = member_of(options, kTwo);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne) && controller->present(kTwo); }));
    constexpr std::size_t kMessages = 100;
    for (std::size_t i = 0; i < kMessages; ++i)  // 64 MiB there, 256 MiB here, some MB in the kernel
        controller->send(kControllerAddress, kOne, reply_of(4'000'000));
    controller->send(kControllerAddress, kTwo, Expelled{});
    EXPECT_EQ(receive(*other, kTwo, 1).size(), 1u) << "the others are served";
    std::vector<Envelope> inbox;
    std::size_t arrived = 0;
    for (int quiet = 0; quiet < 20; ++quiet) {
        slow->drain(kOne, inbox);
        if (!inbox.empty()) quiet = 0;
        arrived += inbox.size();
        slow->wait(100);
    }
    EXPECT_GT(arrived, 70u);
    EXPECT_LT(arrived, 95u) << "of 400 MB";
    controller->send(kControllerAddress, kOne, Expelled{});
    EXPECT_EQ(receive(*slow, kOne, 1).size(), 1u);
    EXPECT_TRUE(controller->present(kOne));
}

TEST(StreamBus, WrongOptionsAreRefusedInWords) {
    NetOptions options = loopback("bad");
    options.interface = "no-such-interface";
    auto bus = StreamBus::listen(options);
    ASSERT_FALSE(bus.ok());
    EXPECT_NE(bus.error().remedy.find("127.0.0.1"), std::string::npos) << bus.error().text();
    EXPECT_EQ(StreamBus::listen(loopback("bad/name")).error().code, "bad-name");
    options = loopback("bad");
    options.keys = "/nowhere";
    EXPECT_EQ(StreamBus::listen(options).error().code, "no-keys");
    EXPECT_EQ(StreamBus::join(options, "client", "me").error().code, "no-keys");
    options.insecure = true;
    EXPECT_EQ(StreamBus::listen(options).error().code, "bad-keys");
}

}  // namespace
}  // namespace roboss
