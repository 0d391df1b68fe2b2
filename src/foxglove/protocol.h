// The messages of Foxglove's WebSocket protocol as text and bytes. Source: the specification in the
// repository foxglove/ws-protocol (its last version is that before commit 8e2a044), and
// foxglove/foxglove-sdk, whose subprotocol has another name and the same messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/result.h"
#include "ros2_types/transport.h"

namespace roboss::foxglove {

/// Names under which clients ask for the protocol.
inline constexpr const char* kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
/// The encoding of all messages, as the protocol names it.
inline constexpr const char* kCdr = "cdr";

// --- what clients send

/// Wants messages of channels.
struct Subscribe {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> channels;  ///< number of the subscription, channel
};
/// Wants them no more.
struct Unsubscribe {
    std::vector<std::uint32_t> subscriptions;
};
/// A channel on which a client sends messages.
struct ClientChannel {
    std::uint32_t id = 0;
    std::string topic, encoding, schema_name;
};
/// A client will send messages.
struct ClientAdvertise {
    std::vector<ClientChannel> channels;
};
/// It will send no more.
struct ClientUnadvertise {
    std::vector<std::uint32_t> channels;
};
/// True if it wants to know who publishes and who subscribes.
struct WatchGraph {
    bool wanted = false;
};
/// A message on a channel of the client. The text lives in the frame.
struct ClientMessage {
    std::uint32_t channel = 0;
    std::string_view payload;
};
/// A call of a service. The texts live in the frame.
struct ServiceCall {
    std::uint32_t service = 0, call = 0;
    std::string_view encoding, payload;
};
/// The request of a text frame.
using TextRequest = std::variant<Subscribe, Unsubscribe, ClientAdvertise, ClientUnadvertise, WatchGraph>;
/// The request of a binary frame.
using BinaryRequest = std::variant<ClientMessage, ServiceCall>;

/// An Error, "bad-message": it is none of the protocol; "not-supported": of a capability that is not offered.
Result<TextRequest> read_text(std::string_view frame);
/// The same of a binary frame.
Result<BinaryRequest> read_binary(std::string_view frame);

// --- what the server sends

/// `session`: another one in each server.
std::string server_info(const std::string& session);
/// Levels of a status.
enum class Level { kInfo = 0, kWarning = 1, kError = 2 };
/// `id`: a status with the same one replaces it; empty: none.
std::string status(Level level, const std::string& message, const std::string& id = {});

/// A topic that clients can subscribe to.
struct Channel {
    std::uint32_t id = 0;
    const std::string* topic = nullptr;
    const ros2::MessageType* type = nullptr;
};
/// A service that clients can call.
struct Service {
    std::uint32_t id = 0;
    const std::string* name = nullptr;
    const ros2::ServiceType* type = nullptr;
};
/// New channels.
std::string advertise(const std::vector<Channel>& channels);
/// Channels that are gone.
std::string unadvertise(const std::vector<std::uint32_t>& channels);
/// New services.
std::string advertise_services(const std::vector<Service>& services);
/// Services that are gone.
std::string unadvertise_services(const std::vector<std::uint32_t>& services);
/// Why a call has no reply.
std::string call_failure(std::uint32_t service, std::uint32_t call, const std::string& message);

/// The publishers, subscribers and servers: name of the topic or service, names of nodes.
struct Graph {
    using Edges = std::vector<std::pair<std::string, std::vector<std::string>>>;
    Edges publishers, subscribers, providers;
};
/// The whole graph, and which topics and services are gone.
std::string graph_update(const Graph& graph, const std::vector<std::string>& gone_topics,
                         const std::vector<std::string>& gone_services);

/// In front of a message.
std::string message_head(std::uint32_t subscription, std::uint64_t time_ns);
/// A whole frame.
std::string time_frame(std::uint64_t time_ns);
/// In front of the reply to a call.
std::string reply_head(std::uint32_t service, std::uint32_t call);

}  // namespace roboss::foxglove
