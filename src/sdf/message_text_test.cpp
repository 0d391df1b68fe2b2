// Messages in protobuf's text format.
#include "sdf/message_text.h"

#include <gtest/gtest.h>

#include <map>

namespace roboss::sdf_import {
namespace {

/// "name=value name=value", texts in quotes, sorted by name; "malformed".
std::string read(const std::string& text, const std::string& type = "gz.msgs.Twist") {
    const MessageType* known = find_message_type(type);
    if (known == nullptr) return "unknown type";
    const auto fields = parse_message(text, *known);
    if (!fields) return "malformed";
    std::map<std::string, std::string> sorted;
    for (const MessageField& field : *fields)
        sorted[field.name] = field.is_text ? "'" + field.text + "'" : std::to_string(field.number);
    std::string all;
    for (const auto& [name, value] : sorted) all += (all.empty() ? "" : " ") + name + "=" + value;
    return all;
}

TEST(MessageText, NestedFieldsAreJoined) {
    EXPECT_EQ(read("linear: {x: 2.5}, angular: {z: -0.5}"), "angular_z=-0.500000 linear_x=2.500000");
    EXPECT_EQ(read("\n linear {\n x: 1 # forward\n y: 2 }"), "linear_x=1.000000 linear_y=2.000000");
    EXPECT_EQ(read("linear < x: 1 >"), "linear_x=1.000000");
}

TEST(MessageText, ScalarsOfAllKinds) {
    EXPECT_EQ(read("data: true", "gz.msgs.Boolean"), "data=1.000000");
    EXPECT_EQ(read("data: 1e1f", "gz.msgs.Float"), "data=10.000000");
    EXPECT_EQ(read("data: 'a' \"b\\\"c\"", "gz.msgs.StringMsg"), "data='ab\"c'");
    EXPECT_EQ(read("type: SPHERE", "gz.msgs.Any"), "type='SPHERE'");
    EXPECT_EQ(read("", "gz.msgs.Empty"), "");
}

TEST(MessageText, ElementsOfRepeatedFieldsAreNumbered) {
    EXPECT_EQ(read("data: 3, data: 4", "gz.msgs.Int32_V"), "data_0=3.000000 data_1=4.000000");
    EXPECT_EQ(read("data: 3", "gz.msgs.Int32_V"), "data_0=3.000000") << "one element is a list too";
    EXPECT_EQ(read("velocity: [1, 2]", "gz.msgs.Actuators"), "velocity_0=1.000000 velocity_1=2.000000");
}

TEST(MessageText, EntriesOfMapsAreNamedByTheirKeys) {
    EXPECT_EQ(read("header { data { key: \"state\" value: \"1\" } data { key: 'frame_id' value: 'f' } }",
                   "gz.msgs.Pose"),
              "frame_id='f' state=1.000000");
    const auto field =
        parse_field("header.data", "{ key: 'state' value: '0' }", *find_message_type("gz.msgs.Pose"));
    ASSERT_TRUE(field && field->size() == 1);
    EXPECT_EQ(field->front().name, "state");
}

TEST(MessageText, AFieldOfAMessage) {
    const auto field = parse_field("position.z", "0.5", *find_message_type("ignition.msgs.Pose"));
    ASSERT_TRUE(field && field->size() == 1);
    EXPECT_EQ(field->front().name, "position_z");
    EXPECT_EQ(field->front().number, 0.5);
}

TEST(MessageText, WhatIsMalformedIsRefused) {
    for (const char* text :
         {"linear: {x: 1", "linear: x: 1}", "linear", "x 1", "x: 'open", ": 3", "x: }", "}"})
        EXPECT_EQ(read(text), "malformed") << text;
    EXPECT_EQ(read(std::string(100'000, '{')), "malformed");
    std::string deep;
    for (int i = 0; i < 10'000; ++i) deep += "a {";
    EXPECT_EQ(read(deep), "malformed") << "no deeper than the stack";
    EXPECT_EQ(read("", "gz.msgs.NoSuchType"), "unknown type");
    EXPECT_EQ(read("", "Twist"), "unknown type");
}

}  // namespace
}  // namespace roboss::sdf_import
