// Plugins that send and pass on messages become a message board.
#include "sdf/event_conversion.h"

#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss::sdf_import {
namespace {

using sdf_test::Loaded;
using sdf_test::TestFolder;

constexpr const char* kBody =
    "<link name='body'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy>"
    "<izz>1</izz></inertia></inertial><collision name='c1'><geometry><sphere>"
    "<radius>1</radius></sphere></geometry></collision>SENSOR</link>";
constexpr const char* kContact =
    "<sensor name='s' type='contact'><contact><collision>c1</collision></contact></sensor>";

std::string model(const std::string& name, const std::string& inside = "", bool senses = false) {
    std::string body = kBody;
    body.replace(body.find("SENSOR"), 6, senses ? kContact : "");
    return "<model name='" + name + "'>" + body + inside + "</model>\n";
}

std::string plugin(const std::string& name, const std::string& inside) {
    return "<plugin filename='f' name='gz::sim::systems::" + name + "'>" + inside + "</plugin>\n";
}

std::string trigger(const std::string& inside) {
    return plugin("TriggeredPublisher", inside);
}

const std::string kDrives = plugin("VelocityControl", "");

Loaded load(const std::string& inside) {
    TestFolder folder;
    folder.write("w.sdf", "<sdf version='1.9'><world name='w'>\n" + inside + "</world></sdf>");
    return folder.load("w.sdf");
}

/// The board of the world; nullptr: it has none.
const MessageBoardSpec* board_in(const Loaded& loaded) {
    for (const ModelSpec& spec : loaded.world->prototypes)
        for (const OnboardSpec& onboard : spec.onboard)
            if (const auto* board = std::get_if<MessageBoardSpec>(&onboard.parameters)) return board;
    return nullptr;
}

const BoardTopic* topic_of(const MessageBoardSpec& board, const std::string& topic) {
    for (const BoardTopic& t : board.topics)
        if (t.topic == topic) return &t;
    return nullptr;
}

TEST(EventConversion, ATriggerOfAMessageToACommand) {
    const Loaded loaded =
        load(model("car", kDrives) + trigger("<input type='gz.msgs.Empty' topic='/start'/>"
                                             "<output type='gz.msgs.Twist' topic='/model/car/cmd_vel'>"
                                             "linear: {x: 3}</output><delay_ms>250</delay_ms>"));
    ASSERT_TRUE(loaded.world);
    const MessageBoardSpec* board = board_in(loaded);
    ASSERT_NE(board, nullptr) << loaded.text();
    ASSERT_EQ(board->topics.size(), 1u) << "the command is the car's own";
    EXPECT_EQ(board->topics[0].topic, "/start");
    EXPECT_TRUE(board->topics[0].values.empty());
    ASSERT_EQ(board->triggers.size(), 1u);
    EXPECT_EQ(board->triggers[0].delay, 0.25);
    ASSERT_EQ(board->triggers[0].outputs.size(), 1u);
    EXPECT_EQ(board->triggers[0].outputs[0].values, (std::vector<BoardValue>{{"linear_x", 3}}));
    EXPECT_EQ(loaded.world->extensions[0].fate, PluginFate::kRuns);
    EXPECT_EQ(loaded.world->instances.back().name, "message_board");
}

TEST(EventConversion, AWorldWithoutSuchPluginsHasNoBoard) {
    const Loaded loaded = load(model("car", kDrives));
    EXPECT_EQ(board_in(loaded), nullptr);
    EXPECT_EQ(loaded.world->instances.size(), 1u);
}

TEST(EventConversion, AnOutputThatTheCommandDoesNotHaveIsReported) {
    const Loaded loaded =
        load(model("car", kDrives) + trigger("<input type='gz.msgs.Empty' topic='/start'/>"
                                             "<output type='gz.msgs.Double' topic='/model/car/cmd_vel'>"
                                             "data: 3</output>"));
    ASSERT_NE(loaded.find("plugin-not-run"), nullptr);
    EXPECT_EQ(board_in(loaded), nullptr) << "nothing of it stays";
    EXPECT_EQ(loaded.world->extensions[0].fate, PluginFate::kNotRun);
    EXPECT_FALSE(loaded.world->extensions[0].reason.empty());
}

TEST(EventConversion, MatchesWithFieldsTolerancesAndTexts) {
    const Loaded loaded = load(model("car") + trigger("<input type='gz.msgs.Pose' topic='t'>"
                                                      "<match field='position.z' tol='0.2'>-7.5</match>"
                                                      "<match logic_type='negative'>name: 'b'</match></input>"
                                                      "<output type='gz.msgs.StringMsg' topic='/out'>"
                                                      "data: 'hi'</output>"));
    const MessageBoardSpec* board = board_in(loaded);
    ASSERT_NE(board, nullptr) << loaded.text();
    const auto& matches = board->triggers[0].matches;
    ASSERT_EQ(matches.size(), 2u);
    EXPECT_EQ(matches[0].values, (std::vector<BoardValue>{{"position_z", -7.5}}));
    EXPECT_EQ(matches[0].tolerance, 0.2);
    EXPECT_FALSE(matches[0].whole);
    EXPECT_TRUE(matches[1].whole && matches[1].negative);
    EXPECT_EQ(matches[1].values, (std::vector<BoardValue>{{"name", 1, true}}));
    EXPECT_EQ(board->words, (std::vector<BoardWord>{{"b"}, {"hi"}}));
    ASSERT_NE(topic_of(*board, "/t"), nullptr);
    EXPECT_EQ(topic_of(*board, "/t")->values.size(), 8u)
        << "seven of a pose, position_z among them, and the name";
    EXPECT_EQ(board->triggers[0].outputs[0].values, (std::vector<BoardValue>{{"data", 2, true}}));
}

TEST(EventConversion, ServicesPutModelsOrAreMessages) {
    const Loaded loaded = load(
        model("car") + trigger("<input type='gz.msgs.Empty' topic='/reset'/>"
                               "<service name='/world/w/set_pose' reqType='gz.msgs.Pose' "
                               "repType='gz.msgs.Boolean' reqMsg=\"name: 'car', position: {x: -3, z: 0.5}\"/>"
                               "<service name='/mine' reqType='gz.msgs.StringMsg' repType='gz.msgs.Empty' "
                               "reqMsg=\"data: 'a'\"/>"));
    const MessageBoardSpec* board = board_in(loaded);
    ASSERT_NE(board, nullptr) << loaded.text();
    const auto& outputs = board->triggers[0].outputs;
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_EQ(outputs[0].robot, "car");
    EXPECT_EQ(outputs[0].X_WR.p, (Vec3{-3, 0, 0.5}));
    EXPECT_EQ(outputs[0].X_WR.q.w, 1.0);
    EXPECT_EQ(outputs[1].topic, "/mine");
    EXPECT_NE(topic_of(*board, "/mine"), nullptr);
}

TEST(EventConversion, WhatCannotRunSaysWhy) {
    for (const char* inside :
         {"<input type='gz.msgs.NoSuchType' topic='/a'/><output type='gz.msgs.Empty' topic='/b'/>",
          "<input type='gz.msgs.Empty' topic='/a'/>", "<output type='gz.msgs.Empty' topic='/b'/>",
          "<input type='gz.msgs.Empty'/><output type='gz.msgs.Empty' topic='/b'/>",
          "<input type='gz.msgs.Int32' topic='/a'><match>data: </match></input>"
          "<output type='gz.msgs.Empty' topic='/b'/>",
          "<input type='gz.msgs.Empty' topic='/a'/><output type='gz.msgs.Mine' topic='/b'/>",
          "<input type='gz.msgs.Empty' topic='/a'/><service name='/s' reqType='gz.msgs.Mine' "
          "repType='gz.msgs.Empty' reqMsg=''/>",
          "<input type='gz.msgs.Empty' topic='/a'/><service name='/world/w/set_pose' reqType='gz.msgs.Pose' "
          "repType='gz.msgs.Boolean' reqMsg=\"name: 'nobody'\"/>"}) {
        const Loaded loaded = load(model("car") + trigger(inside));
        EXPECT_NE(loaded.find("plugin-not-run"), nullptr) << inside;
        EXPECT_EQ(board_in(loaded), nullptr) << inside;
        EXPECT_EQ(loaded.world->extensions[0].fate, PluginFate::kNotRun) << inside;
    }
}

TEST(EventConversion, ATouchOfTheLinksWithContactSensors) {
    const std::string touch =
        "<target>car</target><time>0.5</time><namespace>gate</namespace>"
        "<enabled>true</enabled>";
    const Loaded loaded = load(model("car") + model("gate_model", plugin("TouchPlugin", touch), true));
    const MessageBoardSpec* board = board_in(loaded);
    ASSERT_NE(board, nullptr) << loaded.text();
    ASSERT_EQ(board->touches.size(), 1u);
    const BoardTouch& found = board->touches[0];
    EXPECT_EQ(found.model, "gate_model");
    EXPECT_EQ(found.links, (std::vector<BoardWord>{{"body"}}));
    EXPECT_EQ(found.target, "car");
    EXPECT_EQ(found.time, 0.5);
    EXPECT_TRUE(found.enabled);
    EXPECT_EQ(found.enable, "/gate/enable");
    ASSERT_NE(topic_of(*board, "/gate/touched"), nullptr);
    EXPECT_EQ(topic_of(*board, "/gate/touched")->name, found.told);
    EXPECT_EQ(topic_of(*board, "/gate/touched")->model, "gate_model");
    EXPECT_NE(load(model("gate_model", plugin("TouchPlugin", touch))).find("plugin-not-run"), nullptr)
        << "no contact sensor";
}

TEST(EventConversion, ADetectorHasAChannelForEachPerformer) {
    const std::string detector =
        "<topic>/here</topic><pose>0 0 1 0 0 0</pose><geometry><box><size>2 3 4</size>"
        "</box></geometry><header_data><key>zone</key><value>7</value></header_data>";
    const std::string performers =
        "<plugin name='gz::sim' filename='dummy'><performer name='p'><ref>car</ref><geometry><box>"
        "<size>1 1 1</size></box></geometry></performer></plugin>";
    const Loaded loaded = load(model("car") + model("a", plugin("PerformerDetector", detector)) +
                               model("b", plugin("PerformerDetector", detector)) + performers);
    const MessageBoardSpec* board = board_in(loaded);
    ASSERT_NE(board, nullptr) << loaded.text();
    ASSERT_EQ(board->detectors.size(), 2u) << "equal models, each with its own region";
    EXPECT_EQ(board->detectors[0].size, (Vec3{2, 3, 4}));
    EXPECT_EQ(board->detectors[0].offset, (Vec3{0, 0, 1}));
    EXPECT_EQ(board->detectors[1].performer, "car");
    EXPECT_NE(board->detectors[0].told, board->detectors[1].told);
    EXPECT_NE(board->detectors[0].group, board->detectors[1].group);
    bool has_zone = false;
    for (const BoardValue& value : board->topics[0].values)
        has_zone |= value.name == "zone" && value.value == 7;
    EXPECT_TRUE(has_zone);
    EXPECT_NE(load(model("a", plugin("PerformerDetector", detector))).find("plugin-not-run"), nullptr)
        << "nobody to detect";
}

TEST(EventConversion, CopiesOfAModelHaveOneTrigger) {
    const std::string keys = trigger(
        "<input type='gz.msgs.Int32' topic='/key'><match field='data'>87</match>"
        "</input><output type='gz.msgs.Empty' topic='/go'/>");
    const Loaded loaded = load(model("a", keys) + model("b", keys));
    ASSERT_NE(board_in(loaded), nullptr);
    EXPECT_EQ(board_in(loaded)->triggers.size(), 1u);
    EXPECT_EQ(loaded.world->prototypes[0].extensions[0].fate, PluginFate::kRuns);
}

}  // namespace
}  // namespace roboss::sdf_import
