#include "foxglove/foxglove_transport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <charconv>
#include <thread>

#include "foxglove/test_client_session.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/standard_messages.h"
#include "ros2_types/messages/standard_services.h"

namespace roboss::foxglove {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;

std::string little_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value |= std::uint64_t{static_cast<std::uint8_t>(bytes[at + i])} << (8 * i);
    return value;
}

std::string text_message(const std::string& text) {
    ros2::String message;
    message.data = text;
    return ros2::to_cdr(message);
}

std::string clock_message(std::int32_t s) {
    ros2::Clock message;
    message.clock.sec = s;
    return ros2::to_cdr(message);
}

class FoxgloveServer : public testing::Test {
  protected:
    FoxgloveServer() {
        FoxgloveOptions options;
        options.port = 0, options.clients_max = 4;
        options.origins = {"https://viewer.example.org"};
        transport_ = FoxgloveTransport::listen(options).value();
        const std::string url = transport_->url();
        const std::string digits = url.substr(url.rfind(':') + 1);
        std::from_chars(digits.data(), digits.data() + digits.size(), port_);
        node_ = transport_->add_node("/", "roboss");
    }
    ros2::EntityId publisher(const std::string& topic, const ros2::Qos& qos = {}) {
        const auto made = transport_->add_publisher(node_, topic, ros2::type_of<ros2::String>(), qos);
        transport_->announce();
        return made.value();
    }
    /// Waits until the publisher has so many.
    bool has_subscribers(ros2::EntityId publisher, std::size_t count) {
        for (int i = 0; i < 1000 && transport_->subscribers(publisher) != count; ++i)
            (void)transport_->take(5);
        return transport_->subscribers(publisher) == count;
    }
    static Json subscribe(std::uint32_t id, ros2::EntityId channel) {
        return {{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}};
    }

    std::unique_ptr<FoxgloveTransport> transport_;
    std::uint16_t port_ = 0;
    ros2::EntityId node_ = 0;
};

TEST_F(FoxgloveServer, BothSubprotocolsAreSpokenAndOthersRefused) {
    EXPECT_EQ(TestClient(port_, "foxglove.sdk.v1").subprotocol(), "foxglove.sdk.v1");
    EXPECT_EQ(TestClient(port_, "foxglove.websocket.v1").subprotocol(), "foxglove.websocket.v1");
    EXPECT_EQ(TestClient(port_, "x, foxglove.websocket.v1, foxglove.sdk.v1").subprotocol(),
              "foxglove.websocket.v1");
    EXPECT_FALSE(TestClient(port_, "other.v1").is_open());
    EXPECT_FALSE(TestClient(port_, "").is_open());
}

TEST_F(FoxgloveServer, PagesOfStrangersMayNotConnect) {
    const auto is_open = [&](const char* origin) {
        return TestClient(port_, "foxglove.sdk.v1", origin).is_open();
    };
    for (const char* origin : {"https://app.foxglove.dev", "http://localhost:8080", "http://127.0.0.1",
                               "http://[::1]:80", "https://[::1]", "file://", "https://viewer.example.org"})
        EXPECT_TRUE(is_open(origin)) << origin;
    for (const char* origin :
         {"https://evil.example.org", "http://app.foxglove.dev", "null", "http://localhost.evil.org",
          "https://app.foxglove.dev.evil.org", "http://[", "https://viewer.example.org:81"})
        EXPECT_FALSE(is_open(origin)) << origin;
}

TEST_F(FoxgloveServer, ClientsHearOfChannelsAndGetTheirMessages) {
    const ros2::EntityId chatter = publisher("/chatter");
    TestClient client(port_);
    const Json info = client.receive_op("serverInfo");
    EXPECT_EQ(info["supportedEncodings"], Json::array({"cdr"}));
    const Json channel = client.receive_op("advertise")["channels"][0];
    EXPECT_EQ(channel["id"], chatter);
    EXPECT_EQ(channel["topic"], "/chatter");
    EXPECT_EQ(channel["encoding"], "cdr");
    EXPECT_EQ(channel["schemaEncoding"], "ros2msg");
    EXPECT_EQ(channel["schemaName"], "std_msgs/msg/String");
    EXPECT_EQ(channel["schema"], ros2::type_of<ros2::String>().definition);
    client.send(subscribe(7, chatter));
    ASSERT_TRUE(has_subscribers(chatter, 1));
    transport_->publish(chatter, text_message("hello"));
    EXPECT_TRUE(transport_->await_confirmed(chatter, 10'000));
    const std::string frame = client.receive_bytes(1);
    ASSERT_GE(frame.size(), 13u);
    EXPECT_EQ(number_at(frame, 1, 4), 7u);
    EXPECT_EQ(frame.substr(13), text_message("hello"));
    client.send({{"op", "unsubscribe"}, {"subscriptionIds", {7}}});
    EXPECT_TRUE(has_subscribers(chatter, 0));
}

TEST_F(FoxgloveServer, ClientsHearOfLaterChannelsAndOfTheirEnd) {
    TestClient client(port_);
    EXPECT_EQ(client.receive_op("advertise")["channels"].size(), 0u);
    const ros2::EntityId late = publisher("/late");
    EXPECT_EQ(client.receive_op("advertise")["channels"][0]["topic"], "/late");
    client.send(subscribe(1, late));
    ASSERT_TRUE(has_subscribers(late, 1));
    transport_->remove(late);
    transport_->announce();
    EXPECT_EQ(client.receive_op("unadvertise")["channelIds"], Json::array({late}));
    EXPECT_EQ(transport_->subscribers(late), 0u);
    client.send(subscribe(2, late));
    EXPECT_EQ(client.receive_op("status")["level"], 1);
}

TEST_F(FoxgloveServer, LatchedMessagesReachWhoComesLater) {
    const ros2::EntityId latched = publisher("/latched", {true, true, 2});
    for (const char* text : {"one", "two", "three"}) transport_->publish(latched, text_message(text));
    TestClient client(port_);
    EXPECT_EQ(client.receive_op("advertise")["op"], "advertise");
    client.send(subscribe(1, latched));
    EXPECT_EQ(client.receive_bytes(1).substr(13), text_message("two"));
    EXPECT_EQ(client.receive_bytes(1).substr(13), text_message("three"));
}

TEST_F(FoxgloveServer, TheTimeIsThatOfTheClock) {
    const ros2::EntityId chatter = publisher("/chatter");
    const auto clock = transport_->add_publisher(node_, "/clock", ros2::type_of<ros2::Clock>(), {}).value();
    transport_->announce();
    EXPECT_EQ(transport_->subscribers(clock), 0u);
    TestClient client(port_);
    ASSERT_TRUE(has_subscribers(clock, 1));
    transport_->publish(clock, clock_message(5));
    EXPECT_EQ(number_at(client.receive_bytes(2), 1, 8), 5'000'000'000u);
    client.send(subscribe(1, chatter));
    ASSERT_TRUE(has_subscribers(chatter, 1));
    transport_->publish(chatter, text_message("x"));
    EXPECT_EQ(number_at(client.receive_bytes(1), 5, 8), 5'000'000'000u);
}

TEST_F(FoxgloveServer, TheTimePrecedesStampedMessages) {
    const auto scan =
        transport_->add_publisher(node_, "/scan", ros2::type_of<ros2::TwistStamped>(), {}).value();
    transport_->announce();
    TestClient client(port_);
    client.receive_op("advertise");
    client.send(subscribe(1, scan));
    ASSERT_TRUE(has_subscribers(scan, 1));
    ros2::TwistStamped message;
    message.header.stamp.sec = 7;
    transport_->publish(scan, ros2::to_cdr(message));
    EXPECT_EQ(number_at(client.receive_bytes(2), 1, 8), 7'000'000'000u);
    EXPECT_EQ(number_at(client.receive_bytes(1), 5, 8), 7'000'000'000u);
}

TEST_F(FoxgloveServer, LatchedMessagesComeAgainWhenTheTimeGoesBack) {
    const ros2::EntityId latched = publisher("/latched", {true, true, 1});
    const auto clock = transport_->add_publisher(node_, "/clock", ros2::type_of<ros2::Clock>(), {}).value();
    transport_->announce();
    transport_->publish(latched, text_message("x"));
    TestClient client(port_);
    client.receive_op("advertise");
    client.send(subscribe(1, latched));
    EXPECT_EQ(client.receive_bytes(1).substr(13), text_message("x"));
    for (const std::int32_t s : {5, 2}) {
        transport_->publish(clock, clock_message(s));
        EXPECT_EQ(number_at(client.receive_bytes(2), 1, 8), static_cast<std::uint64_t>(s) * 1'000'000'000);
    }
    EXPECT_EQ(client.receive_bytes(1).substr(13), text_message("x"));
}

TEST_F(FoxgloveServer, MessagesOfClientsArrive) {
    const auto twist = ros2::type_of<ros2::TwistMessage>();
    const ros2::EntityId command = transport_->add_subscription(node_, "/car/cmd_vel", twist, {}).value();
    std::atomic<bool> has_rung = false;
    transport_->on_arrival([&] { has_rung = true; });
    TestClient client(port_);
    const auto advertise = [&](int id, const char* topic, const char* type, const char* encoding) {
        client.send(
            {{"op", "advertise"},
             {"channels", {{{"id", id}, {"topic", topic}, {"schemaName", type}, {"encoding", encoding}}}}});
    };
    advertise(1, "/car/cmd_vel", "geometry_msgs/Twist", "cdr");
    client.send_bytes("\x01" + little_endian(1, 4) + ros2::to_cdr(ros2::TwistMessage{}));
    std::vector<ros2::Incoming> arrived = transport_->take(10'000);
    ASSERT_EQ(arrived.size(), 1u);
    EXPECT_EQ(arrived[0].entity, command);
    EXPECT_EQ(arrived[0].bytes, ros2::to_cdr(ros2::TwistMessage{}));
    for (int i = 0; i < 1000 && !has_rung; ++i) std::this_thread::sleep_for(milliseconds(5));
    EXPECT_TRUE(has_rung);
    advertise(2, "/nobody", "geometry_msgs/msg/Twist", "cdr");
    EXPECT_EQ(client.receive_op("status")["level"], 1);
    client.send_bytes("\x01" + little_endian(2, 4) + ros2::to_cdr(ros2::TwistMessage{}));
    advertise(3, "/car/cmd_vel", "std_msgs/msg/String", "cdr");
    EXPECT_EQ(client.receive_op("status")["id"], "channel-3") << "each problem is told once";
    advertise(4, "/car/cmd_vel", "geometry_msgs/msg/Twist", "protobuf");
    EXPECT_EQ(client.receive_op("status")["level"], 2);
    client.send_bytes("\x01" + little_endian(4, 4) + "data");
    EXPECT_EQ(client.receive_op("status")["level"], 2);
    client.send_bytes("\x01" + little_endian(1, 4) + "x");
    EXPECT_EQ(client.receive_op("status")["level"], 2);
    EXPECT_TRUE(transport_->take(0).empty());
}

TEST_F(FoxgloveServer, OnlyTheLastMessagesOfAClientWait) {
    const auto type = ros2::type_of<ros2::String>();
    (void)transport_->add_subscription(node_, "/in", type, {true, false, 3}).value();
    const auto echo = publisher("/echo");
    TestClient client(port_);
    client.send(
        {{"op", "advertise"},
         {"channels", {{{"id", 1}, {"topic", "/in"}, {"schemaName", type.name}, {"encoding", "cdr"}}}}});
    for (int i = 0; i < 100; ++i)
        client.send_bytes("\x01" + little_endian(1, 4) + text_message(std::to_string(i)));
    client.receive_op("advertise");
    client.send(subscribe(1, echo));
    for (int i = 0; i < 1000 && transport_->subscribers(echo) == 0; ++i)
        std::this_thread::sleep_for(milliseconds(5));
    const std::vector<ros2::Incoming> arrived = transport_->take(0);
    ASSERT_EQ(arrived.size(), 3u);
    EXPECT_EQ(arrived[2].bytes, text_message("99"));
}

TEST_F(FoxgloveServer, CallsOfServicesAreAnswered) {
    const auto& type = ros2::type_of_service<ros2::std_srvs::Trigger>();
    const ros2::EntityId service = transport_->add_service(node_, "/go", type).value();
    transport_->announce();
    TestClient client(port_);
    const Json shown = client.receive_op("advertiseServices")["services"][0];
    EXPECT_EQ(shown["name"], "/go");
    EXPECT_EQ(shown["type"], "std_srvs/srv/Trigger");
    EXPECT_EQ(shown["response"]["schemaName"], "std_srvs/srv/Trigger_Response");
    EXPECT_NE(shown["response"]["schema"].get<std::string>().find("string message"), std::string::npos);
    const auto call = [&](std::uint64_t id, std::uint64_t number) {
        client.send_bytes("\x02" + little_endian(id, 4) + little_endian(number, 4) + little_endian(3, 4) +
                          "cdr" + ros2::to_cdr(ros2::std_srvs::Trigger::Request{}));
    };
    call(service, 41);
    const std::vector<ros2::Incoming> arrived = transport_->take(10'000);
    ASSERT_EQ(arrived.size(), 1u);
    EXPECT_EQ(arrived[0].entity, service);
    transport_->reply(service, arrived[0].call, text_message("done"));
    transport_->reply(service, arrived[0].call, text_message("twice"));
    const std::string reply = client.receive_bytes(3);
    EXPECT_EQ(reply, "\x03" + little_endian(service, 4) + little_endian(41, 4) + little_endian(3, 4) + "cdr" +
                         text_message("done"));
    call(service + 1, 42);
    EXPECT_EQ(client.receive_op("serviceCallFailure")["callId"], 42);
    call(service, 43);
    ASSERT_EQ(transport_->take(10'000).size(), 1u);
    call(service, 43);
    EXPECT_EQ(client.receive_op("serviceCallFailure")["callId"], 43);
    transport_->remove(service);
    EXPECT_EQ(client.receive_op("serviceCallFailure")["callId"], 43);
    transport_->announce();
    EXPECT_EQ(client.receive_op("unadvertiseServices")["serviceIds"], Json::array({service}));
}

TEST_F(FoxgloveServer, GarbageIsAnsweredAndHarmsNobody) {
    const ros2::EntityId chatter = publisher("/chatter");
    TestClient client(port_);
    const std::string deep(100'000, '[');
    for (const std::string& text :
         {std::string("{"), std::string("[]"), std::string("{}"), deep, std::string("{\"op\":5}"),
          std::string("{\"op\":\"fly\"}"), std::string("{\"op\":\"subscribe\"}"),
          std::string("{\"op\":\"subscribe\",\"subscriptions\":7}"),
          std::string("{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":-1,\"channelId\":1}]}"),
          std::string("{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":1e99}]}"),
          std::string("{\"op\":\"advertise\",\"channels\":[{\"id\":1}]}"),
          std::string("{\"op\":\"getParameters\",\"parameterNames\":[]}")}) {
        client.send_text(text);
        EXPECT_FALSE(client.receive_op("status").is_null()) << text.substr(0, 80);
    }
    for (const std::string& bytes :
         {std::string("\x09"), std::string("\x01"), std::string("\x02") + little_endian(1, 4),
          std::string("\x02") + little_endian(1, 4) + little_endian(1, 4) + little_endian(0xFFFF'FFFF, 4),
          std::string("\x03") + std::string(18, '\0')}) {
        client.send_bytes(bytes);
        EXPECT_EQ(client.receive_op("status")["level"], 2);
    }
    client.send(subscribe(1, chatter));
    ASSERT_TRUE(has_subscribers(chatter, 1));
    client.send(subscribe(1, chatter));
    EXPECT_EQ(client.receive_op("status")["level"], 2);
    transport_->publish(chatter, text_message("still there"));
    EXPECT_EQ(client.receive_bytes(1).substr(13), text_message("still there"));
}

TEST_F(FoxgloveServer, ASlowClientLosesOldMessagesOnly) {
    const ros2::EntityId image = publisher("/image", {true, false, 4});
    TestClient slow(port_), quick(port_);
    slow.send(subscribe(1, image));
    ASSERT_TRUE(slow.receive_op("advertise").is_object());
    ASSERT_TRUE(has_subscribers(image, 1));
    quick.receive_op("advertise");
    quick.send(subscribe(1, image));
    ASSERT_TRUE(has_subscribers(image, 2));
    constexpr int kMessages = 100;
    for (int i = 0; i < kMessages; ++i) {
        transport_->publish(image, text_message(std::string(1 << 20, 'x') + std::to_string(i)));
        EXPECT_TRUE(quick.receive_bytes(1).ends_with(text_message(std::to_string(i)).substr(8)));
    }
    EXPECT_FALSE(transport_->await_confirmed(image, 10));
    int received = 0;
    std::string last;
    for (std::string bytes = slow.receive(); !bytes.empty(); bytes = slow.receive(milliseconds(300)))
        if (bytes[0] == 1) ++received, last = bytes;
    EXPECT_LT(received, kMessages / 2);
    EXPECT_TRUE(last.ends_with(text_message("99").substr(8)));
    EXPECT_TRUE(transport_->await_confirmed(image, 10'000));
}

TEST_F(FoxgloveServer, WhoNeverReadsAnswersIsDisconnected) {
    TestClient client(port_);
    EXPECT_ANY_THROW(for (int i = 0; i < 2'000'000; ++i) client.send_text("{}"));
    for (int i = 0; i < 1000 && transport_->clients() > 0; ++i) (void)transport_->take(5);
    EXPECT_EQ(transport_->clients(), 0u);
    EXPECT_FALSE(transport_->take_notices().empty());
}

TEST_F(FoxgloveServer, MoreClientsThanAllowedAreRefused) {
    std::vector<std::unique_ptr<TestClient>> clients;
    for (int i = 0; i < 4; ++i) {
        clients.push_back(std::make_unique<TestClient>(port_));
        EXPECT_FALSE(clients.back()->receive_op("serverInfo").is_null());
    }
    EXPECT_FALSE(TestClient(port_).is_open());
}

TEST_F(FoxgloveServer, TheGraphNamesNodes) {
    const ros2::EntityId chatter = publisher("/chatter");
    TestClient client(port_);
    client.send({{"op", "subscribeConnectionGraph"}});
    const Json published = client.receive_op("connectionGraphUpdate")["publishedTopics"][0];
    EXPECT_EQ(published, (Json{{"name", "/chatter"}, {"publisherIds", {"/roboss"}}}));
    transport_->remove(chatter);
    transport_->announce();
    EXPECT_EQ(client.receive_op("connectionGraphUpdate")["removedTopics"], Json::array({"/chatter"}));
}

TEST_F(FoxgloveServer, ATopicHasOneType) {
    publisher("/chatter");
    const auto other = transport_->add_publisher(node_, "/chatter", ros2::type_of<ros2::TwistMessage>(), {});
    ASSERT_FALSE(other.ok());
    EXPECT_EQ(other.error().code, "other-type");
    transport_->remove(node_);
    EXPECT_TRUE(transport_->add_publisher(node_, "/chatter", ros2::type_of<ros2::TwistMessage>(), {}).ok());
}

TEST_F(FoxgloveServer, ClientsHearThatTheServerEnds) {
    TestClient client(port_);
    client.receive_op("advertise");
    transport_.reset();
    EXPECT_TRUE(client.receive().empty());
    EXPECT_TRUE(client.is_closed());
}

TEST(FoxgloveTransport, ItListensBeyondThisComputerOnlyIfToldTo) {
    FoxgloveOptions options;
    options.port = 0, options.address = "0.0.0.0";
    EXPECT_EQ(FoxgloveTransport::listen(options).error().code, "not-encrypted");
    options.insecure = true;
    EXPECT_TRUE(FoxgloveTransport::listen(options).ok());
    options.address = "nowhere";
    EXPECT_EQ(FoxgloveTransport::listen(options).error().code, "bad-address");
    options.address = "127.0.0.1";
    const auto first = FoxgloveTransport::listen(options).value();
    const std::string url = first->url();
    options.port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
    EXPECT_EQ(FoxgloveTransport::listen(options).error().code, "cannot-listen");
}

}  // namespace
}  // namespace roboss::foxglove
