// See protocol.h.
#include "foxglove/protocol.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

namespace roboss::foxglove {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kQuoted = 60;  // bytes of a client's text in our answers
enum ServerOpcode : char { kMessageData = 1, kTime = 2, kServiceReply = 3 };
enum ClientOpcode : std::uint8_t { kClientMessage = 1, kServiceCall = 2, kPlaybackControl = 3 };

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Error bad(const std::string& why) {
    return {why, "send messages of Foxglove's WebSocket protocol", "bad-message"};
}

void put(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// The number at the front of `bytes`, which it takes off; nothing if they are too few.
std::optional<std::uint32_t> take_u32(std::string_view& bytes) {
    if (bytes.size() < 4) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
    bytes.remove_prefix(4);
    return value;
}

// --- reading; exceptions of the JSON library end in read_text()

std::uint32_t number(const Json& json) {
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xFFFF'FFFF)
        throw std::runtime_error("an id must be a whole number from 0 to 4294967295");
    return json.get<std::uint32_t>();
}

std::vector<std::uint32_t> numbers(const Json& json) {
    if (!json.is_array()) throw std::runtime_error("ids must be an array");
    std::vector<std::uint32_t> result;
    for (const Json& each : json) result.push_back(number(each));
    return result;
}

TextRequest read_subscribe(const Json& json) {
    Subscribe request;
    for (const Json& each : json.at("subscriptions"))
        request.channels.emplace_back(number(each.at("id")), number(each.at("channelId")));
    return request;
}

TextRequest read_advertise(const Json& json) {
    ClientAdvertise request;
    for (const Json& each : json.at("channels"))
        request.channels.push_back({number(each.at("id")), each.at("topic").get<std::string>(),
                                    each.at("encoding").get<std::string>(),
                                    each.at("schemaName").get<std::string>()});
    return request;
}

/// An array of objects that each have an id and a list of names.
Json edges(const Graph::Edges& edges, const char* ids) {
    Json result = Json::array();
    for (const auto& [name, nodes] : edges) result.push_back({{"name", name}, {ids, nodes}});
    return result;
}

Json schema(const std::string& name, const std::string& definition) {
    return {{"encoding", kCdr}, {"schemaName", name}, {"schemaEncoding", "ros2msg"}, {"schema", definition}};
}

Result<TextRequest> read_object(const Json& json) {
    const auto op = json.find("op");
    if (op == json.end() || !op->is_string()) return bad("the text has no \"op\"");
    const std::string& name = op->get_ref<const std::string&>();
    if (name == "subscribe") return read_subscribe(json);
    if (name == "unsubscribe") return TextRequest{Unsubscribe{numbers(json.at("subscriptionIds"))}};
    if (name == "advertise") return read_advertise(json);
    if (name == "unadvertise") return TextRequest{ClientUnadvertise{numbers(json.at("channelIds"))}};
    if (name == "subscribeConnectionGraph") return TextRequest{WatchGraph{true}};
    if (name == "unsubscribeConnectionGraph") return TextRequest{WatchGraph{false}};
    return Error{"'" + name.substr(0, kQuoted) + "' is not supported",
                 "use only the capabilities that serverInfo names", "not-supported"};
}

}  // namespace

Result<TextRequest> read_text(std::string_view frame) {
    const Json json = Json::parse(frame, nullptr, false);
    if (!json.is_object()) return bad("the text is no JSON object");
    try {
        return read_object(json);
    } catch (const std::exception& why) {
        return bad(why.what());
    }
}

Result<BinaryRequest> read_binary(std::string_view frame) {
    if (frame.empty()) return bad("the binary message is empty");
    const auto opcode = static_cast<std::uint8_t>(frame[0]);
    frame.remove_prefix(1);
    if (opcode == kClientMessage) {
        const auto channel = take_u32(frame);
        if (!channel) return bad("the message ends before its channel");
        return BinaryRequest{ClientMessage{*channel, frame}};
    }
    if (opcode == kServiceCall) {
        const auto service = take_u32(frame), call = take_u32(frame), length = take_u32(frame);
        if (!length || frame.size() < *length) return bad("the service call ends before its request");
        return BinaryRequest{ServiceCall{*service, *call, frame.substr(0, *length), frame.substr(*length)}};
    }
    if (opcode == kPlaybackControl)
        return Error{"playback control is not supported", "use only the capabilities that serverInfo names",
                     "not-supported"};
    return bad("no binary message has the opcode " + std::to_string(opcode));
}

std::string server_info(const std::string& session) {
    return dump(
        {{"op", "serverInfo"},
         {"name", "RoBOSS"},
         {"capabilities", Json::array({"clientPublish", "services", "time", "connectionGraph"})},
         {"supportedEncodings", Json::array({kCdr})},
         {"metadata", Json::object({{"ROS_DISTRO", "jazzy"}})},  // viewers then know the types of ROS 2
         {"sessionId", session}});
}

std::string status(Level level, const std::string& message, const std::string& id) {
    Json json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}};
    if (!id.empty()) json["id"] = id;
    return dump(json);
}

std::string advertise(const std::vector<Channel>& channels) {
    Json list = Json::array();
    for (const Channel& channel : channels) {
        Json one = schema(channel.type->name, channel.type->definition);
        one["id"] = channel.id, one["topic"] = *channel.topic;
        list.push_back(std::move(one));
    }
    return dump({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string unadvertise(const std::vector<std::uint32_t>& channels) {
    return dump({{"op", "unadvertise"}, {"channelIds", channels}});
}

std::string advertise_services(const std::vector<Service>& services) {
    Json list = Json::array();
    for (const Service& service : services) {
        const ros2::ServiceType& type = *service.type;
        list.push_back({{"id", service.id},
                        {"name", *service.name},
                        {"type", type.name},
                        {"request", schema(type.name + "_Request", type.request_definition)},
                        {"response", schema(type.name + "_Response", type.reply_definition)},
                        {"requestSchema", type.request_definition},  // for clients of before 2024
                        {"responseSchema", type.reply_definition}});
    }
    return dump({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string unadvertise_services(const std::vector<std::uint32_t>& services) {
    return dump({{"op", "unadvertiseServices"}, {"serviceIds", services}});
}

std::string call_failure(std::uint32_t service, std::uint32_t call, const std::string& message) {
    return dump(
        {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", message}});
}

std::string graph_update(const Graph& graph, const std::vector<std::string>& gone_topics,
                         const std::vector<std::string>& gone_services) {
    return dump({{"op", "connectionGraphUpdate"},
                 {"publishedTopics", edges(graph.publishers, "publisherIds")},
                 {"subscribedTopics", edges(graph.subscribers, "subscriberIds")},
                 {"advertisedServices", edges(graph.providers, "providerIds")},
                 {"removedTopics", gone_topics},
                 {"removedServices", gone_services}});
}

std::string message_head(std::uint32_t subscription, std::uint64_t time_ns) {
    std::string head(1, kMessageData);
    put(head, subscription, 4);
    put(head, time_ns, 8);
    return head;
}

std::string time_frame(std::uint64_t time_ns) {
    std::string frame(1, kTime);
    put(frame, time_ns, 8);
    return frame;
}

std::string reply_head(std::uint32_t service, std::uint32_t call) {
    const std::string encoding = kCdr;
    std::string head(1, kServiceReply);
    put(head, service, 4);
    put(head, call, 4);
    put(head, encoding.size(), 4);
    return head + encoding;
}

}  // namespace roboss::foxglove
