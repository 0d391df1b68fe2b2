#include "fastdds/peers.h"

#include <gtest/gtest.h>

using namespace roboss::fastdds;

namespace {

const std::string kOne = "RIHS01_" + std::string(64, '1'), kTwo = "RIHS01_" + std::string(64, '2');
const DdsTopic kTopic = message_topic("/cmd_vel", "geometry_msgs/msg/Twist");

}  // namespace

TEST(Names, AreThoseOfRos) {
    EXPECT_EQ(kTopic.name, "rt/cmd_vel");
    EXPECT_EQ(kTopic.type, "geometry_msgs::msg::dds_::Twist_");
    EXPECT_EQ(request_topic("/a/b", "x/srv/Y").name, "rq/a/bRequest");
    EXPECT_EQ(request_topic("/a/b", "x/srv/Y").type, "x::srv::dds_::Y_Request_");
    EXPECT_EQ(reply_topic("/a/b", "x/action/Y_SendGoal").name, "rr/a/bReply");
    EXPECT_EQ(reply_topic("/a/b", "x/action/Y_SendGoal").type, "x::action::dds_::Y_SendGoal_Response_");
    EXPECT_EQ(ros_topic("rt/cmd_vel"), "/cmd_vel");
    EXPECT_EQ(ros_topic("other"), "other");
    EXPECT_EQ(ros_type("geometry_msgs::msg::dds_::Twist_"), "geometry_msgs/msg/Twist");
    EXPECT_EQ(ros_type("Twist"), "Twist");
}

TEST(Names, HashIsFoundAmongOtherData) {
    EXPECT_EQ(hash_in(user_data(kOne)), kOne);
    EXPECT_EQ(hash_in("serviceid=1;typehash=" + kOne), kOne);
    EXPECT_EQ(hash_in("typehash=RIHS01_1;"), "");
    EXPECT_EQ(hash_in(";;=;typehash;"), "");
    EXPECT_TRUE(is_cyclone_service("clientid=01.02;"));
    EXPECT_FALSE(is_cyclone_service(user_data(kOne)));
}

TEST(Peers, PeerOfAnotherTypeIsToldOnceWhoeverComesFirst) {
    for (const bool is_peer_first : {false, true}) {
        Notices notices;
        Peers peers(notices);
        const auto find = [&] { peers.found(Guid{1}, {kTopic, kTwo, false, true}); };
        if (is_peer_first) find();
        peers.add_own(kTopic, kOne);
        find();
        const auto lines = notices.take();
        ASSERT_EQ(lines.size(), 1u);
        for (const std::string& word : {std::string("/cmd_vel"), kOne, kTwo})
            EXPECT_NE(lines[0].find(word), std::string::npos) << lines[0];
        find();
        EXPECT_TRUE(notices.take().empty());
    }
}

TEST(Peers, PeersWithoutAHashOrOfOtherTopicsAreNotTold) {
    Notices notices;
    Peers peers(notices);
    peers.add_own(kTopic, kOne);
    peers.found(Guid{1}, {kTopic, "", false, true});
    peers.found(Guid{2}, {message_topic("/other", "x/msg/Y"), kTwo, false, true});
    EXPECT_TRUE(notices.take().empty());
    peers.found(Guid{3}, {message_topic("/cmd_vel", "x/msg/Y"), "", false, false});
    EXPECT_EQ(notices.take().size(), 1u);
    peers.remove_own(kTopic.name);
    peers.found(Guid{4}, {kTopic, kTwo, false, true});
    EXPECT_TRUE(notices.take().empty());
}

TEST(Peers, PeersThatAreLostAreForgotten) {
    Notices notices;
    Peers peers(notices);
    peers.found(Guid{1}, {kTopic, kTwo, false, true});
    EXPECT_EQ(peers.of(Guid{1}).hash, kTwo);
    peers.lost(Guid{1});
    peers.lost(Guid{1});
    EXPECT_EQ(peers.of(Guid{1}).hash, "");
}

TEST(Notices, NamesOfPeersCannotDriveATerminalAndFewWait) {
    Notices notices;
    notices.tell_once("key", "evil \x1b[2J");
    EXPECT_EQ(notices.take(), std::vector<std::string>{"evil ?[2J"});
    for (int i = 0; i < 5000; ++i) notices.tell_once(std::to_string(i), "x");
    EXPECT_EQ(notices.take().size(), 100u);
    for (int i = 0; i < 7; ++i) notices.count_dropped("/scan\n");
    EXPECT_EQ(notices.take(),
              std::vector<std::string>{
                  "7 messages were dropped, the last on /scan : they come faster than they are taken"});
}
