// FoxgloveTransport: a Transport whose other side are Foxglove and Lichtblick, by Foxglove's WebSocket
// protocol: publishers are channels with CDR messages and definitions in the format ros2msg, clients publish
// to the topics that are subscribed to here, and call the services. Nothing of ROS 2 has to be installed.
//
// It listens on a thread of its own. A client that reads slowly loses old messages, and only it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "ros2_types/transport.h"

namespace roboss::foxglove {

class Hub;
class Server;

/// Where a FoxgloveTransport listens, and to whom.
struct FoxgloveOptions {
    std::string address = "127.0.0.1";  ///< of this computer
    std::uint16_t port = 8765;          ///< 0: any
    std::size_t clients_max = 16;       ///< at a time
    bool insecure = false;              ///< others than this computer may come in, unencrypted
    /// Web pages that may connect, as "https://viewer.example.org", besides those that Foxglove and this
    /// computer serve. Programs that are no pages always may.
    std::vector<std::string> origins;
};

/// See the top of the file.
class FoxgloveTransport final : public ros2::Transport {
  public:
    /// An Error: "bad-address", "cannot-listen", or "not-encrypted" for an address beyond loopback without
    /// `insecure`.
    static Result<std::unique_ptr<FoxgloveTransport>> listen(const FoxgloveOptions& options);
    ~FoxgloveTransport() override;

    /// The address that users open: "ws://localhost:8765".
    std::string url() const;
    /// Clients that are connected.
    std::size_t clients() const;

    ros2::EntityId add_node(const std::string& space, const std::string& name) override;
    Result<ros2::EntityId> add_publisher(ros2::EntityId node, const std::string& topic,
                                         const ros2::MessageType& type, const ros2::Qos& qos) override;
    Result<ros2::EntityId> add_subscription(ros2::EntityId node, const std::string& topic,
                                            const ros2::MessageType& type, const ros2::Qos& qos) override;
    Result<ros2::EntityId> add_service(ros2::EntityId node, const std::string& service,
                                       const ros2::ServiceType& type) override;
    void remove(ros2::EntityId entity) override;
    void announce() override;
    void publish(ros2::EntityId publisher, std::string_view cdr) override;
    void reply(ros2::EntityId service, const ros2::CallId& call, std::string_view cdr) override;
    std::size_t subscribers(ros2::EntityId publisher) const override;
    /// Waits until the messages have been given to the sockets; the protocol has no confirmations.
    std::size_t publishers(ros2::EntityId subscription) const override;
    /// Empty: a client that wants to publish another type is refused when it says so.
    std::string other_type(ros2::EntityId) const override { return {}; }
    std::uint64_t revision() const override;
    bool await_confirmed(ros2::EntityId publisher, std::int64_t ms_max) override;
    std::vector<ros2::Incoming> take(std::int64_t wait_ms) override;
    void on_arrival(std::function<void()> ring) override;
    std::vector<std::string> take_notices() override;

  private:
    FoxgloveTransport();
    std::unique_ptr<Hub> hub_;
    std::unique_ptr<Server> server_;  // its thread uses hub_
};

}  // namespace roboss::foxglove
