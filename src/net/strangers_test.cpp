// Who may not take part is refused with the reason, on both sides; who misbehaves is cut off, and the run is
// not disturbed.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <support/test_keys.h>
#include <filesystem>
#include <fstream>
#include <random>

#include "net/frames.h"
#include "wire/codec.h"

namespace roboss {
namespace {

using test::all_of, test::becomes, test::checked, test::controller_of, test::expect_refused, test::Keys,
    test::loopback, test::member_of, test::receive, test::with_keys;

const Address kOne{Role::kSimulator, 1}, kTwo{Role::kSimulator, 2};

TEST(Strangers, MembersWithKeysOfTheRunTakePart) {
    const Keys keys;
    const NetOptions options = loopback("keys");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const auto member = member_of(with_keys(options, keys.of("sim-1", Seat::kSimulator)), kOne);
    ASSERT_TRUE(becomes([&] { return member->present(kControllerAddress); }))
        << all_of(member->take_notices());
    member->send(kOne, kControllerAddress, Expelled{});
    EXPECT_EQ(receive(*controller, kControllerAddress, 1).size(), 1u);
}

TEST(Strangers, AKeyOfAnotherAuthorityIsRefusedByBothSides) {
    const Keys keys;
    const NetOptions options = loopback("authority");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const auto member = member_of(with_keys(options, keys.of("sim-1", Seat::kSimulator, "other")), kOne);
    ASSERT_TRUE(becomes([&] { return member->refusal().has_value(); }));
    EXPECT_EQ(member->refusal()->code, "bad-certificate");
    EXPECT_NE(member->refusal()->message.find("authority"), std::string::npos) << member->refusal()->message;
    EXPECT_FALSE(controller->present(kOne));
}

TEST(Strangers, AnExpiredKeyIsRefusedByName) {
    const Keys keys;
    const NetOptions options = loopback("expired");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const auto member = member_of(with_keys(options, keys.of("sim-3", Seat::kSimulator, "ring", -1)), kOne);
    expect_refused(*controller, *member, "bad-certificate", "the certificate of 'sim-3' has expired");
}

TEST(Strangers, ARevokedKeyIsRefusedByName) {
    const Keys keys;
    const NetOptions options = loopback("revoked");
    const std::string boss = keys.of("boss", Seat::kController), sim = keys.of("sim-4", Seat::kSimulator);
    const std::string copy = sim + "-elsewhere";
    std::filesystem::copy(sim, copy);
    EXPECT_TRUE(keys.ring().revoke("sim-4").ok());
    EXPECT_FALSE(std::filesystem::exists(sim));
    const auto controller = controller_of(with_keys(options, boss));
    const auto member = member_of(with_keys(options, copy), kOne);
    expect_refused(*controller, *member, "bad-certificate", "the certificate of 'sim-4' has been revoked");
}

TEST(Strangers, AKeyThatIsRevokedWhileItsMemberIsConnectedCutsItOff) {
    const Keys keys;
    const NetOptions options = loopback("revoked-later");
    const std::string boss = keys.of("boss", Seat::kController), sim = keys.of("sim-5", Seat::kSimulator);
    const auto controller = controller_of(with_keys(options, boss));
    const auto member = member_of(with_keys(options, sim), kOne);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne); }));
    EXPECT_TRUE(keys.ring().revoke("sim-5").ok());
    expect_refused(*controller, *member, "bad-certificate", "'sim-5' has been revoked");
    EXPECT_TRUE(becomes([&] { return !controller->present(kOne); }));
}

TEST(Strangers, ASimulatorsKeyDoesNotMakeAController) {
    const Keys keys;
    const NetOptions options = loopback("role");
    const auto refused = StreamBus::listen(with_keys(options, keys.of("sim-1", Seat::kSimulator)));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, "bad-keys");
}

TEST(Strangers, AClientsKeyDoesNotMakeASimulator) {
    const Keys keys;
    const NetOptions options = loopback("client");
    const auto controller = controller_of(with_keys(options, keys.of("boss", Seat::kController)));
    const auto member = member_of(with_keys(options, keys.of("pilot", Seat::kClient)), kOne);
    expect_refused(*controller, *member, "misbehaves", "its key does not permit the role");
}

TEST(Strangers, WithoutEncryptionNobodyGetsIn) {
    const NetOptions options = loopback("plain");
    const auto controller = controller_of(options);
    NetOptions plain = options;
    plain.insecure = true;
    plain.controller = controller->where();
    const auto member = member_of(plain, kOne);
    std::string said;
    EXPECT_TRUE(becomes([&] {
        return (said += all_of(member->take_notices())).find("--insecure") != std::string::npos;
    })) << said;
    EXPECT_FALSE(member->present(kControllerAddress));
    EXPECT_FALSE(controller->present(kOne));
}

TEST(Strangers, AKeyFileThatOthersMayReadIsNotUsed) {
    const Keys keys;
    const std::string sim = keys.of("sim-1", Seat::kSimulator);
    ASSERT_EQ(chmod((sim + "/member.key").c_str(), 0644), 0);
    const auto member = StreamBus::join(with_keys(loopback("mode"), sim), "simulator", "me");
    ASSERT_FALSE(member.ok());
    EXPECT_EQ(member.error().code, "open-key");
    EXPECT_NE(member.error().remedy.find("chmod 600"), std::string::npos);
}

TEST(Strangers, NobodySpeaksInTheNameOfAnother) {
    const NetOptions options = loopback("name");
    const auto controller = controller_of(options), honest = member_of(options, kOne),
               forger = member_of(options, kTwo);
    ASSERT_TRUE(becomes([&] { return controller->present(kOne) && controller->present(kTwo); }));
    forger->send(kOne, kControllerAddress, Expelled{});
    expect_refused(*controller, *forger, "misbehaves", "in the name of another");
    honest->send(kOne, kControllerAddress, Expelled{SimulatorId(9u)});
    const auto all = receive(*controller, kControllerAddress, 1);
    ASSERT_EQ(all.size(), 1u) << "the forger stops nobody else";
    EXPECT_EQ(std::get<Expelled>(all[0].message).simulator, SimulatorId(9u));
}

TEST(Strangers, AMemberOfAnotherRunIsToldSo) {
    NetOptions options = loopback("mine");
    const auto controller = controller_of(options);
    NetOptions other = options;
    other.controller = controller->where();
    const auto keys = std::filesystem::path(test::run_keys(options.simulation));
    other.keys = keys.string();
    other.simulation += "-not";
    const auto member = member_of(other, kOne);
    expect_refused(*controller, *member, "other-simulation",
                   "looks for simulation '" + other.simulation + "'");
}

/// A plain connection to a Controller.
class Caller {
  public:
    explicit Caller(const std::string& where) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(where.substr(where.rfind(':') + 1))));
        inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
        EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    }
    ~Caller() { ::close(socket_); }
    void send(const std::vector<std::uint8_t>& bytes) const {
        (void)!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }

  private:
    int socket_;
};

TEST(Strangers, RandomBytesDisturbNoRun) {
    for (const bool insecure : {false, true}) {
        NetOptions options = loopback(insecure ? "noise-plain" : "noise");
        options.insecure = insecure;
        const auto controller = controller_of(options), member = member_of(options, kOne);
        ASSERT_TRUE(becomes([&] { return controller->present(kOne); }));
        std::mt19937 random(7);
        const std::vector<std::uint8_t> hello =
            encode_hello({kWireVersion, options.simulation, "simulator", "noise"});
        const std::vector<std::uint8_t> message =
            encode(Envelope{kTwo, kControllerAddress, Expelled{SimulatorId(1u)}});
        for (int i = 0; i < 300; ++i) {
            const Caller caller(controller->where());
            std::vector<std::uint8_t> bytes;
            if (i % 3 > 0) append_frame(bytes, FrameKind::kHello, hello);
            if (i % 3 == 2) append_frame(bytes, FrameKind::kWhole, message);
            for (int k = 0; k < 3 && !bytes.empty(); ++k)  // a byte of a right beginning is another one
                bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
            for (std::size_t n = random() % 300; n > 0; --n)
                bytes.push_back(static_cast<std::uint8_t>(random()));
            caller.send(bytes);
            if (i % 20 == 0) usleep(1'000);
        }
        std::vector<Envelope> inbox;
        usleep(200'000);
        controller->drain(kControllerAddress, inbox);
        member->send(kOne, kControllerAddress, Expelled{SimulatorId(5u)});
        bool heard = false;
        EXPECT_TRUE(becomes([&] {
            controller->drain(kControllerAddress, inbox);
            for (const Envelope& e : inbox) heard = heard || e.from == kOne;
            return heard;
        })) << "insecure: "
            << insecure;
    }
}

TEST(Strangers, APeersWordsMoveNoCursor) {
    const NetOptions options = loopback("escape");
    const auto controller = controller_of(options);
    const auto member = checked(StreamBus::join(options, "simulator",
                                                "\x1b]0;mine\x07\xc2\x9b"
                                                "31m\nline"));
    ASSERT_TRUE(becomes([&] { return member->present(kControllerAddress); }));
    member->say_farewell({"\x1b[2J gone", true});
    std::string said;
    EXPECT_TRUE(becomes(
        [&] { return (said += all_of(controller->take_notices())).find("[left]") != std::string::npos; }));
    EXPECT_NE(said.find("?]0;mine??31m line at 127.0.0.1"), std::string::npos) << said;
    EXPECT_NE(said.find("?[2J gone"), std::string::npos) << said;
}

TEST(Strangers, CallersWithoutEndDoNotFillTheLog) {
    const NetOptions options = loopback("callers");
    const auto controller = controller_of(options);
    std::size_t lines = 0;
    std::string said;
    for (int i = 0; i < 3'000; ++i) {
        Caller(controller->where()).send({'G', 'E', 'T', ' ', '/', '\n'});
        for (const std::string& line : controller->take_notices()) ++lines, said = line;
    }
    EXPECT_TRUE(becomes([&] {
        for (const std::string& line : controller->take_notices()) ++lines, said = line;
        return said.find("[rate-limited]") != std::string::npos;
    })) << said;
    EXPECT_LT(lines, 1'000u);
}

TEST(Strangers, CallersWhoSayNothingDoNotFillTheController) {
    const NetOptions options = loopback("silent");
    const auto controller = controller_of(options);
    std::vector<std::unique_ptr<Caller>> silent;
    for (int i = 0; i < 700; ++i) silent.push_back(std::make_unique<Caller>(controller->where()));
    const auto member = member_of(options, kOne);
    EXPECT_TRUE(becomes([&] { return member->present(kControllerAddress); }))
        << all_of(member->take_notices()) << all_of(controller->take_notices());
}

}  // namespace
}  // namespace roboss
