// Transport by Fast DDS: this process is one participant, whatever number of nodes it has.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "fastdds/endpoints.h"
#include "fastdds/inbox.h"
#include "fastdds/notices.h"
#include "fastdds/peers.h"
#include "fastdds/service_end.h"
#include "ros2_types/transport.h"

namespace roboss::fastdds {

/// See ros2::Transport.
class FastDdsTransport final : public ros2::Transport {
  public:
    /// Joins the domain.
    static Result<std::unique_ptr<FastDdsTransport>> open(const ros2::TransportOptions& options);
    ~FastDdsTransport() override;

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
    std::size_t publishers(ros2::EntityId subscription) const override;
    std::string other_type(ros2::EntityId subscription) const override;
    std::uint64_t revision() const override { return participant_->matches() + peers_.changes(); }
    bool await_confirmed(ros2::EntityId publisher, std::int64_t ms_max) override;
    std::vector<ros2::Incoming> take(std::int64_t wait_ms) override;
    void on_arrival(std::function<void()> ring) override { inbox_.on_arrival(std::move(ring)); }
    std::vector<std::string> take_notices() override { return notices_.take(); }

  private:
    struct Node {
        std::string space, name;
        std::set<ros2::EntityId> entities;
    };

    explicit FastDdsTransport(bool has_long_gids) : has_long_gids_(has_long_gids) {}
    // The bytes that tell others of the nodes here; `size`: of a gid.
    template <std::size_t size>
    std::string node_list() const;

    // Threads of Fast DDS use the first three until the participant is gone.
    Notices notices_;
    Peers peers_{notices_};
    Inbox inbox_;
    std::unique_ptr<Participant> participant_;
    bool has_long_gids_;
    std::unique_ptr<Writer> nodes_writer_;
    std::map<ros2::EntityId, Node> nodes_;
    std::map<ros2::EntityId, std::unique_ptr<Writer>> publishers_;
    std::map<ros2::EntityId, std::unique_ptr<Reader>> subscriptions_;
    std::map<ros2::EntityId, std::unique_ptr<ServiceEnd>> services_;
    ros2::EntityId last_ = 0;
};

}  // namespace roboss::fastdds
