// The commands of a bag become the orders that an orders file would give; what is wrong is said with its
// place.
#include "app/worlds/bag_orders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <support/drives.h>
#include <support/folder.h>

#include "app/worlds/orders_file.h"
#include "bags/test_bags.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss {
namespace {

using namespace ros2;
using bags::test::channel;
using bags::test::mcap;
using bags::test::message;
using bags::test::schema;

constexpr std::uint64_t kSecond = 1'000'000'000;  // ns

std::string twist(double speed) {
    return to_cdr(TwistMessage{{speed, 0, 0}, {0, 0, -1}});
}

/// Topics of "robot", a drive: plain and stamped velocities, its switch; the clock, and something else.
const std::string kHead = schema(1, "geometry_msgs/msg/Twist") + schema(2, "geometry_msgs/msg/TwistStamped") +
                          schema(3, "std_msgs/msg/Bool") + schema(4, "rosgraph_msgs/msg/Clock") +
                          schema(5, "sensor_msgs/msg/LaserScan") + channel(1, 1, "/robot/cmd_vel") +
                          channel(2, 2, "/robot/cmd_vel") + channel(3, 3, "/robot/enable") +
                          channel(4, 4, "/clock") + channel(5, 5, "/robot/scan");

class BagOrdersOfADrive : public testing::Test {
  protected:
    std::vector<Order> load_file(const std::string& path) {
        diagnostics_ = {};
        BagOrders bag = load_bag_orders(path, model_, diagnostics_);
        summary_ = bag.summary;
        for (std::size_t i = 0; i < bag.orders.size(); ++i) EXPECT_EQ(bag.orders[i].sequence, i + 1);
        return std::move(bag.orders);
    }
    std::vector<Order> load(const std::string& records) {
        return load_file(folder_.write("bag.mcap", mcap(kHead + records)));
    }
    /// Ticks and first values of commands.
    std::vector<std::pair<Tick, double>> commands(const std::string& records) {
        std::vector<std::pair<Tick, double>> found;
        for (const Order& order : load(records))
            found.emplace_back(order.apply_at, std::get<Command>(order.action).values.front());
        return found;
    }
    /// The code of the only finding.
    std::string finding() const {
        if (diagnostics_.items().size() != 1)
            return std::to_string(diagnostics_.items().size()) + " findings";
        return diagnostics_.items().front().code;
    }
    std::string code_of(const std::string& records) {
        load(records);
        return finding();
    }

    std::shared_ptr<const Model> model_ =
        test::compiled(test::on_plane(test::with_onboard(test::two_wheeler(), test::diff_drive()), 0.002));
    test::Folder folder_;
    Diagnostics diagnostics_;
    std::string summary_;
};

using Commands = std::vector<std::pair<Tick, double>>;

TEST_F(BagOrdersOfADrive, AreThoseOfAnOrdersFile) {
    std::vector<Order> orders =
        load(message(5, 3 * kSecond, "a scan") + message(1, 3 * kSecond + kSecond / 2, twist(2)) +
             message(3, 4 * kSecond, to_cdr(Bool{true})) +
             message(2, 4 * kSecond, to_cdr(TwistStamped{{}, {{3, 0, 0}, {0, 0, -1}}})));
    EXPECT_TRUE(diagnostics_.items().empty());
    EXPECT_NE(summary_.find("3 commands on 2 topics"), std::string::npos) << summary_;
    EXPECT_NE(summary_.find("1 other topic drives no robot"), std::string::npos) << summary_;
    Diagnostics none;
    const std::vector<Order> expected =
        parse_orders(R"({"t":0.5,"robot":"robot","command":{"name":"cmd_vel","linear_x":2,"angular_z":-1}})"
                     "\n"
                     R"({"t":1,"robot":"robot","command":{"name":"enable","enable":true}})"
                     "\n"
                     R"({"t":1,"robot":"robot","command":{"name":"cmd_vel","linear_x":3,"angular_z":-1}})"
                     "\n",
                     "orders.jsonl", *model_, none);
    EXPECT_EQ(orders, expected);
}

TEST_F(BagOrdersOfADrive, OfSqliteFilesAndFoldersAreTheSame) {
    const std::string file = folder_.path("bag/bag_0.db3");
    std::filesystem::create_directories(folder_.path("bag"));
    ASSERT_TRUE(bags::test::write_db3(
                    file,
                    {{"/robot/cmd_vel", "geometry_msgs/msg/Twist"}, {"/chatter", "std_msgs/msg/String"}},
                    {{2, 1'000, "hello"}, {1, 500'001'000, twist(2)}})
                    .ok());
    const std::vector<Order> expected = load(message(5, 1'000, "") + message(1, 500'001'000, twist(2)));
    ASSERT_EQ(expected.size(), 1u);
    EXPECT_EQ(expected.front().apply_at, 250);
    EXPECT_EQ(load_file(file), expected);
    EXPECT_EQ(load_file(folder_.path("bag")), expected);
    EXPECT_TRUE(diagnostics_.items().empty());
}

TEST_F(BagOrdersOfADrive, AreInTheOrderOfLogTimesAndThenOfTheFile) {
    EXPECT_EQ(commands(message(1, 40, twist(3)) + message(1, 20, twist(1)) +
                       message(2, 40, to_cdr(TwistStamped{{}, {{4, 0, 0}, {}}})) + message(1, 30, twist(2))),
              (Commands{{0, 1}, {0, 2}, {0, 3}, {0, 4}}));
}

TEST_F(BagOrdersOfADrive, AreDueAtTheTimeOfTheClock) {
    const auto clock = [](std::uint64_t log_ns, std::int32_t sec) {
        return message(4, log_ns, to_cdr(Clock{{sec, 0}}));
    };
    EXPECT_EQ(
        commands(message(1, 100 * kSecond, twist(1)) + clock(101 * kSecond, 7) + clock(105 * kSecond, 9) +
                 message(1, 103 * kSecond, twist(2)) + message(1, 106 * kSecond, twist(3))),
        (Commands{{3000, 1}, {4000, 2}, {5000, 3}}));
    EXPECT_TRUE(diagnostics_.items().empty());
    EXPECT_EQ(commands(message(1, 100 * kSecond, twist(1)) + clock(101 * kSecond, 0)), (Commands{{0, 1}}));
    EXPECT_EQ(finding(), "early-commands");
    EXPECT_EQ(code_of(message(1, 0, twist(1)) + clock(0, 5) + clock(kSecond, 0)), "clock-back");
    EXPECT_EQ(code_of(message(1, 0, twist(1)) + message(4, 0, "no clock")), "bad-message");
}

TEST_F(BagOrdersOfADrive, MessagesThatAreWrongAreNamed) {
    EXPECT_EQ(code_of(message(1, 0, twist(1)) + message(1, 0, twist(1).substr(0, 30))), "bad-message");
    const Diagnostic& found = diagnostics_.items().front();
    EXPECT_EQ(found.where.file, folder_.path("bag.mcap"));
    EXPECT_EQ(found.severity, Severity::kError);
    EXPECT_EQ(found.message.find("message 2 of /robot/cmd_vel: "), 0u) << found.message;
    EXPECT_EQ(code_of(message(1, 0, twist(std::nan("")))), "not-finite");
    EXPECT_EQ(code_of(message(1, 0, "\x28\xB5\x2F\xFD packed")), "compressed-message");
    EXPECT_EQ(code_of(channel(7, 3, "/robot/cmd_vel") + message(7, 0, to_cdr(Bool{}))), "wrong-type");
    EXPECT_EQ(code_of(channel(7, 0, "/robot/cmd_vel") + message(1, 0, twist(1))), "wrong-type")
        << "no schema";
    EXPECT_EQ(code_of(channel(7, 1, "/robot/cmd_vel", "json") + message(7, 0, "{}")), "bad-encoding");
    std::string many;
    for (int n = 0; n < 3'000; ++n) many += message(1, 0, "x");
    load(many);
    EXPECT_EQ(diagnostics_.items().size(), 1'000u) << "more tell nothing new";
}

TEST_F(BagOrdersOfADrive, ABagThatDrivesNobodyIsAWarning) {
    EXPECT_EQ(code_of(message(5, 0, "a scan")), "no-commands");
    EXPECT_FALSE(diagnostics_.has_errors());
    EXPECT_NE(diagnostics_.items().front().remedy.find("/robot/cmd_vel"), std::string::npos);
    load_file(folder_.path("missing.mcap"));
    EXPECT_TRUE(diagnostics_.has_errors());
}

TEST_F(BagOrdersOfADrive, BytesThatAreChangedGiveOrdersOrAReason) {
    const std::string good = mcap(kHead + message(1, 5, twist(1)) + message(3, 6, to_cdr(Bool{true})));
    for (std::size_t at = 0; at < good.size(); at += 2) {
        std::string changed = good;
        changed[at] = static_cast<char>(~changed[at]);
        for (const std::string& bytes : {changed, good.substr(0, at)})
            EXPECT_TRUE(!load_file(folder_.write("bag.mcap", bytes)).empty() ||
                        !diagnostics_.items().empty());
    }
}

TEST(BagOrders, OfJointsAreSetpointsOfRobotsWithoutControllers) {
    const auto model = test::compiled(test::on_plane(test::two_wheeler()));
    const test::Folder folder;
    const auto load = [&](const std::vector<double>& values, Diagnostics& diagnostics) {
        const std::string records = schema(1, "std_msgs/msg/Float64MultiArray") +
                                    channel(1, 1, "/robot/velocity_controller/commands") +
                                    message(1, 9, to_cdr(Float64MultiArray{{}, values}));
        return load_bag_orders(folder.write("bag.mcap", mcap(records)), model, diagnostics).orders;
    };
    Diagnostics none, wrong;
    const std::vector<Order> orders = load({1, 2}, none);
    EXPECT_TRUE(none.items().empty());
    ASSERT_EQ(orders.size(), 2u);
    EXPECT_EQ(std::get<SetJoint>(orders[1].action).target, 2);
    EXPECT_EQ(std::get<SetJoint>(orders[1].action).mode, MotorMode::kVelocity);
    EXPECT_TRUE(load({1, 2, 3}, wrong).empty());
    EXPECT_TRUE(wrong.has_errors());
}

}  // namespace
}  // namespace roboss
