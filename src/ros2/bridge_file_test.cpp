// Files of ros_gz_bridge are read as the bridge reads them; others are refused with their line.
#include "ros2/bridge_file.h"

#include <gtest/gtest.h>

#include <support/folder.h>

#include <chrono>

namespace roboss::ros2 {
namespace {

using Direction = BridgeEntry::Direction;

Bridge read(const std::string& text) {
    Result<Bridge> bridge = parse_bridge("b.yaml", text);
    if (!bridge) return ADD_FAILURE() << bridge.error().text(), Bridge{};
    return std::move(bridge).value();
}

/// The message of the Error; empty: there is none.
std::string refusal(const std::string& text) {
    const Result<Bridge> bridge = parse_bridge("b.yaml", text);
    if (bridge) return {};
    EXPECT_EQ(bridge.error().code, "bad-bridge");
    EXPECT_FALSE(bridge.error().remedy.empty());
    return bridge.error().message;
}

/// An entry with both types and these lines.
std::string entry_with(const std::string& lines) {
    return "- ros_type_name: std_msgs/msg/String\n  gz_type_name: gz.msgs.StringMsg\n" + lines;
}

TEST(BridgeFile, TheExampleOfTheBridgeIsRead) {
    const Bridge bridge = read(R"(
 # Set just topic name, applies to both
- topic_name: "chatter"
  ros_type_name: "std_msgs/msg/String"
  gz_type_name: "gz.msgs.StringMsg"

# Set just ROS topic name, applies to both
- ros_topic_name: "chatter_ros"
  ros_type_name: "std_msgs/msg/String"
  gz_type_name: "gz.msgs.StringMsg"

# Set just GZ topic name, applies to both
- gz_topic_name: "chatter_gz"
  ros_type_name: "std_msgs/msg/String"
  gz_type_name: "gz.msgs.StringMsg"

# Set each topic name explicitly
- ros_topic_name: "chatter_both_ros"
  gz_topic_name: "chatter_both_gz"
  ros_type_name: "std_msgs/msg/String"
  gz_type_name: "gz.msgs.StringMsg"

# Full set of configurations
- ros_topic_name: "ros_chatter"
  gz_topic_name: "gz_chatter"
  ros_type_name: "std_msgs/msg/String"
  gz_type_name: "gz.msgs.StringMsg"
  subscriber_queue: 5       # Default 10
  publisher_queue: 6        # Default 10
  lazy: true                # Default "false"
  direction: ROS_TO_GZ
)");
    ASSERT_EQ(bridge.entries.size(), 5u);
    const std::vector<std::pair<std::string, std::string>> names{{"/chatter", "/chatter"},
                                                                 {"/chatter_ros", "/chatter_ros"},
                                                                 {"/chatter_gz", "/chatter_gz"},
                                                                 {"/chatter_both_ros", "/chatter_both_gz"},
                                                                 {"/ros_chatter", "/gz_chatter"}};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(bridge.entries[i].ros_name, names[i].first);
        EXPECT_EQ(bridge.entries[i].gz_name, names[i].second);
        EXPECT_EQ(bridge.entries[i].type, "std_msgs/msg/String");
        EXPECT_EQ(bridge.entries[i].direction, i < 4 ? Direction::kBoth : Direction::kToGazebo);
    }
    EXPECT_EQ(bridge.entries[0].line, 3);
    EXPECT_EQ(bridge.entries[4].line, 24);
    EXPECT_TRUE(bridge.notices.empty());
}

TEST(BridgeFile, OlderKeysAndShortTypesAreRead) {
    const Bridge bridge = read(
        "- ros_topic_name: scan\n  ign_topic_name: /lidar/\n  ros_type_name: sensor_msgs/LaserScan\n"
        "  ign_type_name: ignition.msgs.LaserScan\n  direction: IGN_TO_ROS\n");
    ASSERT_EQ(bridge.entries.size(), 1u);
    EXPECT_EQ(bridge.entries[0].ros_name, "/scan");
    EXPECT_EQ(bridge.entries[0].gz_name, "/lidar");
    EXPECT_EQ(bridge.entries[0].type, "sensor_msgs/msg/LaserScan");
    EXPECT_EQ(bridge.entries[0].direction, Direction::kToRos);
}

TEST(BridgeFile, ServicesAndPrivateNamesAreRead) {
    const Bridge bridge = read(
        "- service_name: /world/w/control\n  ros_type_name: ros_gz_interfaces/srv/ControlWorld\n"
        "  gz_req_type_name: gz.msgs.WorldControl\n  gz_rep_type_name: gz.msgs.Boolean\n" +
        entry_with("  ros_topic_name: ~/out\n  gz_topic_name: out\n  qos_profile: SENSOR_DATA\n"));
    ASSERT_EQ(bridge.entries.size(), 2u);
    EXPECT_TRUE(bridge.entries[0].is_service);
    EXPECT_EQ(bridge.entries[0].ros_name, "/world/w/control");
    EXPECT_FALSE(bridge.entries[1].is_service);
    EXPECT_EQ(bridge.entries[1].ros_name, "/ros_gz_bridge/out");
}

TEST(BridgeFile, ValuesMayBeAliases) {
    const Bridge bridge = read(
        "- {topic_name: a, ros_type_name: &type std_msgs/msg/Bool, gz_type_name: gz.msgs.Boolean}\n"
        "- {topic_name: b, ros_type_name: *type, gz_type_name: gz.msgs.Boolean}\n");
    ASSERT_EQ(bridge.entries.size(), 2u);
    EXPECT_EQ(bridge.entries[1].type, "std_msgs/msg/Bool");
}

TEST(BridgeFile, AKeyThatIsNotKnownIsReported) {
    const Bridge bridge = read(entry_with("  topic_name: a\n  directoin: GZ_TO_ROS\n"));
    ASSERT_EQ(bridge.notices.size(), 1u);
    EXPECT_TRUE(bridge.notices[0].starts_with("b.yaml:4: the key 'directoin'")) << bridge.notices[0];
}

TEST(BridgeFile, WhatIsWrongIsRefusedWithItsLine) {
    const auto in_entry = [](const std::string& lines) { return refusal(entry_with(lines)); };
    EXPECT_TRUE(in_entry("  topic_name: a\n  direction: SIDEWAYS\n").starts_with("b.yaml:4: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  publisher_queue: many\n").starts_with("b.yaml:4: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  subscriber_queue: -1\n").starts_with("b.yaml:4: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  lazy: perhaps\n").starts_with("b.yaml:4: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  topic_name: b\n").starts_with("b.yaml:4: "));
    EXPECT_TRUE(in_entry("  topic_name: [a, b]\n").starts_with("b.yaml:3: "));
    EXPECT_TRUE(in_entry("  topic_name:\n").starts_with("b.yaml:3: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  ros_topic_name: b\n").starts_with("b.yaml:1: "));
    EXPECT_TRUE(in_entry("  topic_name: a\n  gz_topic_name: b\n").starts_with("b.yaml:1: "));
    EXPECT_TRUE(in_entry("  lazy: true\n").starts_with("b.yaml:1: ")) << "no topic";
    EXPECT_TRUE(refusal("- topic_name: a\n  ros_type_name: std_msgs/msg/Bool\n").starts_with("b.yaml:1: "));
    EXPECT_TRUE(refusal("- topic_name: a\n  gz_type_name: gz.msgs.Boolean\n").starts_with("b.yaml:1: "));
    EXPECT_TRUE(refusal("- service_name: /world/w/control\n").starts_with("b.yaml:1: "));
    EXPECT_TRUE(refusal("- /clock\n").starts_with("b.yaml:1: ")) << "an entry is no map";
    EXPECT_TRUE(refusal("- topic_name: a\n bad: indent\n").starts_with("b.yaml:2: "));
}

TEST(BridgeFile, WhatIsNoListIsRefused) {
    EXPECT_NE(refusal(""), "");
    EXPECT_NE(refusal("topic_name: a\nros_type_name: b\ngz_type_name: c\n"), "");
    EXPECT_NE(refusal("just text"), "");
}

TEST(BridgeFile, NamesThatRosRefusesAreRefused) {
    for (const char* name : {"/front-lidar", "/1/scan", "/a//b", "/a/", "/a b", "\"/\"", "/\xc3\xa4"})
        EXPECT_NE(refusal(entry_with("  gz_topic_name: a\n  ros_topic_name: " + std::string(name) + "\n")),
                  "")
            << name;
    EXPECT_NE(refusal(entry_with("  topic_name: " + std::string(300, 'a') + "\n")), "");
    EXPECT_EQ(refusal(entry_with("  gz_topic_name: /front-lidar\n  ros_topic_name: /front_lidar\n")), "");
}

TEST(BridgeFile, BombsAreRefusedAtOnce) {
    const auto begin = std::chrono::steady_clock::now();
    std::string laughs = "- &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 40; ++i) {
        laughs += "- &a" + std::to_string(i) + " [";
        for (int k = 0; k < 10; ++k) laughs += (k > 0 ? ", *a" : "*a") + std::to_string(i - 1);
        laughs += "]\n";
    }
    EXPECT_NE(refusal(laughs), "");
    EXPECT_NE(refusal(std::string(100'000, '[')), "") << "deep";
    std::string wide = "- &w {";
    for (int i = 0; i < 20'000; ++i) wide += (i > 0 ? ", k" : "k") + std::to_string(i) + ": 1";
    EXPECT_NE(refusal(wide + "}\n"), "");
    std::string many;
    for (int i = 0; i < 10'001; ++i) many += "- {topic_name: a}\n";
    EXPECT_NE(refusal(many).find("10000 entries"), std::string::npos);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(BridgeFile, LongTextsAreNotCopiedForEachAlias) {
    const auto aliased = [](const std::string& lines) {
        std::string text =
            "- &a\n  ros_type_name: std_msgs/msg/Bool\n  gz_type_name: gz.msgs.Boolean\n" + lines;
        for (int i = 0; i < 9'000; ++i) text += "- *a\n";
        return text;
    };
    const std::string longest(200'000, 'k');
    const Bridge bridge = read(aliased("  topic_name: a\n  ? " + longest + "\n  : 1\n"));
    std::size_t bytes = 0;
    for (const std::string& notice : bridge.notices) bytes += notice.size();
    EXPECT_LT(bytes, 1'000'000u);
    EXPECT_NE(refusal(aliased("  ros_topic_name: a\n  gz_topic_name: " + longest + "\n")), "");
}

TEST(BridgeFile, FilesThatAreTooLargeOrAbsentAreRefused) {
    const test::Folder folder;
    const std::string good = entry_with("  topic_name: a\n");
    ASSERT_TRUE(read_bridge(folder.write("good.yaml", good)));
    EXPECT_EQ(read_bridge(folder.path("good.yaml")).value().file, folder.path("good.yaml"));
    EXPECT_FALSE(read_bridge(folder.write("large.yaml", good + std::string(1'000'000, '#'))));
    EXPECT_FALSE(read_bridge(folder.path("absent.yaml")));
    EXPECT_FALSE(read_bridge(folder.path(""))) << "a folder";
}

}  // namespace
}  // namespace roboss::ros2
