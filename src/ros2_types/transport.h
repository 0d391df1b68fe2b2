// Transport: carries messages of ROS 2 between this process and other nodes. Names and types are those of
// ROS 2; how a middleware names and sends them is the implementation's affair. There is one, of Fast DDS
// (src/fastdds); it is loaded when it is needed, so that no other process depends on its library.
//
// One thread calls it. Implementations may have threads of their own; what arrives waits until take().
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "ros2_types/message_type.h"
#include "ros2_types/service_type.h"

namespace roboss::ros2 {

/// Delivery of the messages of a topic.
struct Qos {
    bool is_reliable = true;   ///< lost messages are sent again
    bool is_latched = false;   ///< who comes later gets the last messages, too (transient local)
    std::uint32_t depth = 10;  ///< how many messages wait for a slow reader; of older ones the oldest go
};

/// Where other nodes may be.
struct TransportOptions {
    /// The reach of discovery (ROS_AUTOMATIC_DISCOVERY_RANGE).
    enum class Reach { kOff, kLocalhost, kSubnet };
    std::uint32_t domain = 0;         ///< ROS_DOMAIN_ID, 0 to 232
    Reach reach = Reach::kLocalhost;  ///< of automatic discovery
    std::vector<std::string> peers;   ///< hosts to look at besides (ROS_STATIC_PEERS)
    std::string discovery_server;     ///< "HOST:PORT;HOST:PORT" (ROS_DISCOVERY_SERVER); empty: none
    bool has_long_gids = false;       ///< 24 bytes instead of 16 in ros_discovery_info, as Humble
};

/// A node, publisher, subscription or service of this process; never used again.
using EntityId = std::uint32_t;

/// A call of a service by a client elsewhere. Its reply bears the same.
struct CallId {
    std::array<std::uint8_t, 16> client{};  ///< GUID of the client's writer
    std::int64_t number = 0;                ///< sequence number
    std::uint8_t dialect = 0;               ///< how the middleware carries it; known to the implementation

    /// Compares all members.
    friend bool operator==(const CallId&, const CallId&) = default;
};

/// A message of a subscription, or the request of a call of a service.
struct Incoming {
    EntityId entity = 0;    ///< the subscription or service
    CallId call;            ///< of a request; of a message: its writer, and its number there
    std::string bytes;      ///< CDR
    std::string peer_type;  ///< hash of the type that the sender has; empty: it says none
};

/// See the top of the file.
class Transport {
  public:
    virtual ~Transport() = default;

    /// A node, as others list it. `space`: its namespace, "/" or "/car_3".
    virtual EntityId add_node(const std::string& space, const std::string& name) = 0;
    /// A publisher of a node. An Error if the topic already has another type here.
    virtual Result<EntityId> add_publisher(EntityId node, const std::string& topic, const MessageType& type,
                                           const Qos& qos) = 0;
    /// A subscription of a node. An Error if the topic already has another type here.
    virtual Result<EntityId> add_subscription(EntityId node, const std::string& topic,
                                              const MessageType& type, const Qos& qos) = 0;
    /// A service of a node; its requests and replies are reliable.
    virtual Result<EntityId> add_service(EntityId node, const std::string& service,
                                         const ServiceType& type) = 0;
    /// Removes it; of a node all that it has, too. Others see it go.
    virtual void remove(EntityId entity) = 0;
    /// Makes what was added and removed known to others. Called once after a number of changes.
    virtual void announce() = 0;

    /// Sends a message to all who subscribe. Never waits for a slow one.
    virtual void publish(EntityId publisher, std::string_view cdr) = 0;
    /// Sends the reply to a call. Who has asked and gone does not matter.
    virtual void reply(EntityId service, const CallId& call, std::string_view cdr) = 0;
    /// How many subscriptions elsewhere get the messages of a publisher.
    virtual std::size_t subscribers(EntityId publisher) const = 0;
    /// How many publishers elsewhere send to a subscription.
    virtual std::size_t publishers(EntityId subscription) const = 0;
    /// The type that publishers elsewhere have on the topic of a subscription, if none has the subscription's
    /// own: "geometry_msgs/msg/TwistStamped". Empty: there are no such publishers.
    virtual std::string other_type(EntityId subscription) const = 0;
    /// Another number whenever others may have changed what subscribers(), publishers() and other_type() say:
    /// asked thousands of times in a second, these cost more than all the rest.
    virtual std::uint64_t revision() const = 0;
    /// Waits until all reliable subscriptions have confirmed all messages. False: not within this time.
    virtual bool await_confirmed(EntityId publisher, std::int64_t ms_max) = 0;

    /// Everything that has arrived, in the order of its arrival; waits for the first at most so long.
    virtual std::vector<Incoming> take(std::int64_t wait_ms) = 0;
    /// Calls `ring` from any thread when something has arrived; `ring` must not call the Transport.
    virtual void on_arrival(std::function<void()> ring) = 0;
    /// Warnings about others, one line each, since the last call: a peer whose type has another hash, a
    /// request that cannot be read, messages that were dropped since nobody took them.
    virtual std::vector<std::string> take_notices() = 0;
};

/// `roboss_ros2_transport` of the shared library returns a Transport, or null and why in `problem`.
using OpenTransport = Transport* (*)(int abi, const TransportOptions& options, Error& problem);
/// Version of this interface; a library of another one is refused.
inline constexpr int kTransportAbi = 4;

}  // namespace roboss::ros2
