// Every message survives the encoding, and no bytes can break the decoder.
#include "wire/codec.h"

#include <gtest/gtest.h>

#include <support/fuzz_rounds.h>
#include <algorithm>
#include <iterator>
#include <limits>
#include <random>

namespace roboss {
namespace {

const RobotId kRobot(7u), kOther(9u);

std::vector<Order> some_orders() {
    return {
        {10, ClientId(1u), 1, kRobot, SetPose{{{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}}}},
        {10, ClientId(1u), 2, kRobot, SetVelocity{{1, 0, 0}, {0, 0, -2}}},
        {11, ClientId(2u), 1, kOther, ApplyWrench{LinkId(2u), {1, 2, 3}, {4, 5, 6}, 12, true}},
        {12, ClientId(2u), 2, kOther, SetJoint{JointId(1u), 1, MotorMode::kPosition, 0.25, 8.5}},
        {13, ClientId(2u), 3, kRobot, Command{2, {0.5, -1, 3}}},
        {14, ClientId(2u), 4, kRobot, Attach{LinkId(1u), kOther, LinkId(3u), 0.25, 40, 2}},
        {15, ClientId(2u), 5, kRobot, Detach{kOther}},
        {16, ClientId(2u), 6, kRobot, Pull{LinkId(1u), {1, 2, 3}, {4, 5, 6}, 7, 8, 9}},
        {17, ClientId(2u), 7, kOther, SetJointState{JointId(1u), {0.25}, {-1, 2, 3}}},
        {17, ClientId(2u), 8, kOther,
         SetJointParameters{
             JointId(1u), 1, true, {{JointParameter::kDamping, 0.5}, {JointParameter::kUpper, 2}}}},
        {17, ClientId(2u), 9, kOther,
         SetLinkParameters{LinkId(1u), true, {{LinkParameter::kMass, 0.5}, {LinkParameter::kFriction, 2}}}},
        {17, ClientId(2u), 10, kOther, SetSurroundings{true, {Vec3{0, 0, -1.62}, Vec3{3, -1, 0.5}}}},
        {17, ClientId(2u), 11, kOther, SetSurroundings{false, {std::nullopt, Vec3{1, 2, 3}}}},
        {18, ClientId(2u), 8, kOther, Transmit{3, kRobot, {1, 0, 255}}}};
}

StepProfile a_profile() {
    StepProfile profile;
    for (std::size_t i = 0; i < kStages; ++i) profile.stages.ns[i] = 1000 * i + 1;
    profile.solver = {9, 8, 7, 6, 5, 4, 1e-9, 3, 2, 0.5};
    return profile;
}

/// Of each kind one in which no field has the value that it has in a message just made, so that none can get
/// lost unnoticed.
std::vector<Message> one_of_each() {
    Assignment assignment{2,
                          17,
                          1,
                          SimulatorId(3u),
                          4,
                          10,
                          26,
                          {0, 1, 2},
                          {kRobot, kOther},
                          {{{Role::kSimulator, 5}, {kOther}}},
                          {{{Role::kSimulator, 6}, {kRobot}}},
                          some_orders(),
                          16,
                          {kRobot},
                          8,
                          3'000'000,
                          true};
    WindowResult result{
        2,
        17,
        1,
        0,
        {{kRobot, {{-1, 0, 2}, {3, 4, 5}}, {1, 2, 3}, {4, 5, 6}, 77}},
        {{kOther, {{-6, 7, 8}, {9, 10, 11}}}},
        {{100, 5, 2, kRobot, 12, JointId(3u), true}, {1ull << 63, 0x3FFF, 0x4000, {}, 0, {}, false}},
        a_profile()};
    StateReply reply{{12, {kRobot, kOther}, {2, 3}, {1, 2, 3, 4, 5}}, 17};
    std::vector<ClientOrder> orders;
    for (const Order& o : some_orders()) orders.push_back({o.sequence, o.robot, o.action});
    return {Hello{0xABCDEF, 4, "elsewhere/17"},
            Welcome{SimulatorId(1u)},
            Refused{"another world"},
            Expelled{SimulatorId(1u)},
            Heartbeat{SimulatorId(1u)},
            LeaveRequest{SimulatorId(1u)},
            Goodbye{SimulatorId(1u)},
            assignment,
            result,
            StateRequest{12, {kRobot, kOther}, 17},
            reply,
            ClientHello{"driver", 5, 20, 10, false, true, 40, 3, 5},
            ClientWelcome{ClientId(0u), 40, 99},
            Observation{40, 3, {{{Role::kController, 0}, {kRobot}}}},
            ClientReply{ClientId(0u), 4, 40, orders},
            ReplyAck{ClientId(0u), 4, {{2, "no such link", "no-link"}}},
            ClientBye{ClientId(0u), 5, true, "it threw"},
            RunOver{"the run has ended"},
            RunOver{"a robot flew away", true},
            ModelRequest{Whole::kScene, 7},
            ModelPart{Whole::kModel, 1, 100, 7, {1, 2, 3}},
            ClientUnknown{ClientId(2u)},
            ModelChanged{99},
            ViewRequest{5, 33, 100, true, {kRobot}},
            ViewDue{2, 77, 1000, {Role::kClient, 4}, {kRobot, kOther}, {kOther}},
            ViewStates{5,
                       2,
                       77,
                       1000,
                       {1, 2, 3, 4},
                       {{{kRobot, LinkId(1u), {1, 2, 3}, {4, 5, 6}, {7, 8, 9}}},
                        {{kRobot, LinkId(0u), kOther, LinkId(2u), {1, 2, 3}}}}},
            OrdersAhead{16, SimulatorId(3u), some_orders()},
            Late{2, 17, 1, 4'000'000},
            WindowResult{2, 17, 1, 9, {}, {}, {{100, 5, 2, {}, 0, {}, false}}},
            Cut{2, 17, 1, SimulatorId(3u)}};
}

/// Every request, and every outcome of one.
std::vector<Message> every_control_message() {
    std::vector<Message> all;
    for (const ControlAction& action :
         {ControlAction(GetStatus{true}),
          ControlAction(GetGroups{}),
          ControlAction(GetBounds{}),
          ControlAction(PauseRun{}),
          ControlAction(ResumeRun{}),
          ControlAction(StepRun{10}),
          ControlAction(SetSpeed{SetSpeed::Kind::kFactor, 2.5}),
          ControlAction(SetWindow{8}),
          ControlAction(AddSimulator{}),
          ControlAction(RemoveSimulator{}),
          ControlAction(KillSimulator{3}),
          ControlAction(SaveRun{"a.roboss", true}),
          ControlAction(QuitRun{}),
          ControlAction(RewindRun{2, 12.5}),
          ControlAction(ChangeAccuracy{"high", {{"tolerance", 1e-10}}}),
          ControlAction(AddModels{"ball.sdf", "<sdf/>", {{1, 2, 3}, {}}, "ball", {}, true}),
          ControlAction(AddModels{"ball.sdf", "<sdf/>", {}, "", {{"a", {{1, 2, 3}, {}}}, {"b", {}}}}),
          ControlAction(RemoveRobots{{"a", "b"}}),
          ControlAction(ResetRun{ResetRun::To::kLastSave}),
          ControlAction(GetTimeline{}),
          ControlAction(PreviewRun{2, 1.5, 50}),
          ControlAction(AddBookmark{"jump", 1, 2.5}),
          ControlAction(RemoveBookmark{3}),
          ControlAction(CopyRobots{{{"a", "b", {{1, 2, 3}, {}}}, {"a", "c", {}}}}),
          ControlAction(RestoreRobots{{"a", "b"}}),
          ControlAction(GetProfile{})})
        all.emplace_back(ControlRequest{all.size() + 1, action});
    const MemberStatus member{2, "host/7", MemberState::kLost, 4, 10, 5, 7.5, 0.9, {1, 2, 3, 4}, true};
    const RunStatus status{"w.sdf", 500,      1.0,   true, true,         2.0, 3,  16, 40,  2, 0.95, 3.5,
                           1,       1,        7,     2,    {5, 6, 7, 8}, 11,  12, 3,  0.5, 4, 1000, 1.5,
                           true,    {member}, {"a"}, 1};
    Box32 box;
    box.min = {0, 1, 2}, box.max = {3, 4, 5};
    for (const ControlOutcome& outcome :
         {ControlOutcome(ControlDone{10, "at tick 10"}),
          ControlOutcome(ControlRefused(Error{"no", "ask later", "busy"})), ControlOutcome(status),
          ControlOutcome(RobotGroups{9, {0, -1}, {0, 1}}), ControlOutcome(RobotBounds{9, {box}}),
          ControlOutcome(RunTimeline{3, 2, {{2, 1, 0.5, 0.5, 2, "rewound"}}, {{1, 2, 1.5, "jump"}}}),
          ControlOutcome(RunPreview{9, 2, 750, 1.5, true, 1, 2, {1, 2, 3}}),
          ControlOutcome(RunProfile{100, {{"orders", 0.25}}, 7, 6, 5, 4, 3, 2, 1e-9, 8, 1, 0.5, 1e-3})})
        all.emplace_back(ControlReply{all.size(), outcome});
    return all;
}

Envelope envelope_of(Message message) {
    return {{Role::kSimulator, 3}, {Role::kController, 0}, std::move(message)};
}

TEST(Codec, GivesBackEveryMessageAsItWas) {
    std::vector<bool> met(std::variant_size_v<Message>, false);
    std::vector<Message> messages = one_of_each();
    std::ranges::move(every_control_message(), std::back_inserter(messages));
    for (const Message& message : messages) {
        met[message.index()] = true;
        const std::vector<std::uint8_t> bytes = encode(envelope_of(message));
        const Result<Envelope> back = decode_envelope(bytes);
        ASSERT_TRUE(back.ok()) << back.error().text();
        EXPECT_EQ(back.value().message.index(), message.index());
        EXPECT_EQ(back.value().from, (Address{Role::kSimulator, 3}));
        EXPECT_TRUE(back.value().message == message) << message_name(message);
        EXPECT_EQ(encode(back.value()), bytes) << message_name(message);
    }
    EXPECT_EQ(std::count(met.begin(), met.end(), false), 0) << "a kind of message is not tested";
}

TEST(Codec, RefusesEveryTruncation) {
    for (const Message& message : one_of_each()) {
        const std::vector<std::uint8_t> bytes = encode(envelope_of(message));
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            const Result<Envelope> back = decode_envelope(std::span(bytes).first(n));
            EXPECT_FALSE(back.ok()) << message_name(message) << " cut to " << n << " of " << bytes.size();
        }
    }
}

TEST(Codec, RefusesOrUnderstandsEveryMutation) {
    const std::size_t rounds = test::fuzz_rounds(3'000);  // of each kind of message
    std::mt19937_64 random(20261121);
    int refused = 0, understood = 0;
    for (const Message& message : one_of_each()) {
        const std::vector<std::uint8_t> good = encode(envelope_of(message));
        for (std::size_t i = 0; i < rounds; ++i) {
            std::vector<std::uint8_t> bytes = good;
            for (std::uint64_t k = 0; k < 1 + random() % 3; ++k)
                bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
            const Result<Envelope> back = decode_envelope(bytes);
            back.ok() ? ++understood : ++refused;
            if (back.ok()) {
                EXPECT_EQ(encode(back.value()), bytes);
            } else {
                EXPECT_FALSE(back.error().message.empty());
            }
        }
    }
    EXPECT_GT(refused, 1000);
    EXPECT_GT(understood, 1000);
}

TEST(Codec, RefusesNoiseAndHugeCounts) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::uint8_t> bytes(random() % 200);
        for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
        if (bytes.size() > 2) bytes[0] = kWireVersion, bytes[1] = 0;
        (void)decode_envelope(bytes).ok();
    }
    std::vector<std::uint8_t> bytes = encode(envelope_of(StateRequest{1, {}}));
    for (std::size_t i = bytes.size() - 4; i < bytes.size(); ++i) bytes[i] = 0xFF;
    const Result<Envelope> back = decode_envelope(bytes);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.error().message.find("StateRequest"), std::string::npos) << back.error().message;
    EXPECT_NE(back.error().message.find("count"), std::string::npos) << back.error().message;
}

/// Items may be twenty times as large in memory as their bytes.
TEST(Codec, RefusesListsThatWouldFillTheMemory) {
    constexpr std::size_t kMany = (std::size_t{1} << 22) + 1;
    WindowResult result;
    result.islands.resize(kMany);
    const Result<Envelope> back = decode_envelope(encode(envelope_of(result)));
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.error().message.find("too many items"), std::string::npos) << back.error().message;
    RemoveRobots remove;
    remove.names.resize(kMany);
    EXPECT_FALSE(decode_envelope(encode(envelope_of(ControlRequest{1, remove}))).ok());
}

TEST(Codec, RefusesAnotherVersionByName) {
    std::vector<std::uint8_t> bytes = encode(envelope_of(Heartbeat{SimulatorId(1u)}));
    bytes[0] = 200;
    const Result<Envelope> back = decode_envelope(bytes);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.error().message.find("wire version 200"), std::string::npos);
}

TEST(Codec, RefusesAssignmentsWhoseIslandsDoNotCoverTheirRobots) {
    Assignment assignment;
    assignment.island_offsets = {0, 2, 1};
    assignment.robots = {kRobot};
    EXPECT_FALSE(decode_envelope(encode(envelope_of(assignment))).ok());
    assignment.island_offsets = {0, 0, 1};
    EXPECT_FALSE(decode_envelope(encode(envelope_of(assignment))).ok());
    assignment.island_offsets = {0, 1};
    EXPECT_TRUE(decode_envelope(encode(envelope_of(assignment))).ok());
}

TEST(Codec, RefusesResultsThatWereCutShortAndListRobots) {
    WindowResult result;
    result.left = 12;
    result.islands.resize(1);
    EXPECT_TRUE(decode_envelope(encode(envelope_of(result))).ok());
    result.robots.resize(1);
    EXPECT_FALSE(decode_envelope(encode(envelope_of(result))).ok());
    result.robots.clear();
    result.earlier.push_back({kRobot, {}});
    EXPECT_FALSE(decode_envelope(encode(envelope_of(result))).ok());
}

bool accepted(Message message) {
    return decode_envelope(encode(envelope_of(std::move(message)))).ok();
}

TEST(Codec, RefusesTicksWhoseSumsOverflow) {
    constexpr Tick kLowest = std::numeric_limits<Tick>::min(), kHighest = std::numeric_limits<Tick>::max();
    for (const Tick wrong : {kLowest, Tick{-2}, (Tick{1} << 60) + 1, kHighest}) {
        EXPECT_FALSE(accepted(ClientReply{ClientId(0u), 1, wrong, {}})) << wrong;
        EXPECT_FALSE(accepted(ClientWelcome{ClientId(0u), wrong, 1})) << wrong;
        EXPECT_FALSE(accepted(Observation{wrong, 0, {}})) << wrong;
        EXPECT_FALSE(accepted(StateRequest{wrong, {}, 0})) << wrong;
        EXPECT_FALSE(accepted(StateReply{{wrong, {}, {}, {}}, 0})) << wrong;
        EXPECT_FALSE(accepted(ViewDue{0, 0, wrong, {}, {}, {}})) << wrong;
        EXPECT_FALSE(accepted(ViewStates{0, 0, 0, wrong, {}, {}})) << wrong;
        EXPECT_FALSE(accepted(OrdersAhead{1, SimulatorId(0u), {{wrong, {}, 0, kRobot, SetVelocity{}}}}))
            << wrong;
        EXPECT_FALSE(accepted(ClientHello{"a", 1, 1, 1, true, false, wrong, 0, 0})) << wrong;
        WindowResult result;
        result.islands.push_back({1, 0, 0, kRobot, wrong, {}, false});
        EXPECT_FALSE(accepted(result)) << wrong;
        for (Tick Assignment::*tick :
             {&Assignment::window_from, &Assignment::from, &Assignment::until, &Assignment::release_before}) {
            Assignment assignment;
            assignment.island_offsets = {0};
            assignment.*tick = wrong;
            EXPECT_FALSE(accepted(assignment)) << wrong;
        }
    }
    EXPECT_TRUE(accepted(ClientReply{ClientId(0u), 1, -1, {}})) << "it has seen nothing yet";
    EXPECT_TRUE(accepted(ClientWelcome{ClientId(0u), Tick{1} << 60, 1}));
}

TEST(Codec, RefusesAssignmentsWithOrdersForTicksThatTheyDoNotStep) {
    Assignment assignment;
    assignment.window_from = 10, assignment.from = 12, assignment.until = 20;
    assignment.island_offsets = {0};
    for (const Tick tick : {Tick{11}, Tick{12}, Tick{19}, Tick{20}}) {
        assignment.orders = {{tick, ClientId(0u), 1, kRobot, SetVelocity{}}};
        EXPECT_EQ(accepted(assignment), tick == 12 || tick == 19) << tick;
    }
}

TEST(Codec, RefusesBoundsThatAreNoNumbers) {
    for (std::size_t k = 0; k < 6; ++k) {
        Box32 box{{-1, 0, 2}, {3, 4, 5}};
        (k < 3 ? box.min : box.max)[k % 3] = std::numeric_limits<float>::quiet_NaN();
        WindowResult result;
        result.robots.push_back({kRobot, box, {}, {}, 0});
        EXPECT_FALSE(accepted(result)) << k;
        result = {};
        result.earlier.push_back({kRobot, box});
        EXPECT_FALSE(accepted(result)) << k;
    }
}

TEST(Codec, RefusesSimulatorsWithoutThreadsOrWithTooMany) {
    for (const std::uint32_t threads : {0u, 1u, 1024u, 0xFFFFFFFFu})
        EXPECT_EQ(accepted(Hello{1, threads, "here"}), threads == 1 || threads == 1024) << threads;
}

TEST(Codec, KeepsRobotsOfAResultInAnyOrder) {
    WindowResult result;
    for (const std::uint32_t id : {9u, 7u, 7u, 0u, 0x80000000u, 1u, 0xFFFFFFFFu, 0u}) {
        result.robots.push_back({RobotId(id), {{-1, 0, 2}, {3, 4, 5}}, {0, 128, 255}, {1, 2, 65535}, ~0ull});
        result.earlier.push_back({RobotId(~id), {{-1, 0, 2}, {3, 4, 5}}});
    }
    const Result<Envelope> back = decode_envelope(encode(envelope_of(result)));
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(std::get<WindowResult>(back.value().message), result);
}

TEST(Codec, TakesSixtyFourBytesARobotWhereASimulatorHasFour) {
    WindowResult result{1000, 100'000, 3, 0, {}, {}, {}};
    for (std::uint32_t id = 100; id < 104; ++id) {
        result.robots.push_back({RobotId(id), {{-1, 0, 2}, {3, 4, 5}}, {}, {}, ~0ull});
        result.islands.push_back({2'000'000, 1000, 1000, {}, 0, {}, false});
    }
    EXPECT_LE(encode(envelope_of(result)).size(), 4 * 64u);
}

TEST(Codec, RefusesASecondWayToWriteAnAddress) {
    std::vector<std::uint8_t> bytes = encode(envelope_of(Heartbeat{SimulatorId(1u)}));
    bytes[2] = 0x81;  // the sender: a Simulator without a number, where it has one
    EXPECT_FALSE(decode_envelope(bytes).ok());
    bytes = encode({{Role::kSimulator, 1}, {Role::kController, 0}, Heartbeat{SimulatorId(1u)}});
    bytes[3] = 0;
    const Result<Envelope> back = decode_envelope(bytes);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.error().message.find("an address has no number"), std::string::npos);
    bytes[2] = 3;
    EXPECT_NE(decode_envelope(bytes).error().message.find("an unknown role"), std::string::npos);
}

TEST(Codec, KeepsOrders) {
    const std::vector<std::uint8_t> bytes = encode_orders(some_orders());
    const auto back = decode_orders(bytes);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(encode_orders(back.value()), bytes);
    EXPECT_FALSE(decode_orders(std::span(bytes).first(bytes.size() - 1)).ok());
}

}  // namespace
}  // namespace roboss
