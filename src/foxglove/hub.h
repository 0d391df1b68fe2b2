// Hub: what the clients of a Foxglove server share with the publishers, subscriptions and services of this
// process. It knows the protocol and no network: a connection brings what its client sent, and fetches what
// goes to it. So its rules can be tested without sockets. Every function may be called by any thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "foxglove/keep_last.h"
#include "foxglove/protocol.h"
#include "ros2_types/transport.h"

namespace roboss::foxglove {

using ros2::EntityId;

/// Topics of a client's frames beside its subscriptions.
inline constexpr std::uint64_t kTimeTopic = std::uint64_t{1} << 32, kNoTopic = std::uint64_t{1} << 33;

/// A frame for a client: its head, and the rest, which frames for several clients share.
struct Frame {
    bool is_text = false;
    std::string head;
    std::shared_ptr<const std::string> body{};  ///< null: there is none
    std::uint64_t topic = kNoTopic;             ///< subscription of the client, or one of the above
    /// Limits of its memory.
    std::size_t size() const { return head.size() + (body ? body->size() : 0); }
};

/// Number of a client; never used again.
using ClientNumber = std::uint64_t;

/// See the top of the file.
class Hub {
  public:
    /// `session`: what serverInfo says of this server.
    explicit Hub(std::string session) : session_(std::move(session)) {}

    // --- the Transport; see there
    EntityId add_node(const std::string& space, const std::string& name);
    Result<EntityId> add_publisher(EntityId node, const std::string& topic, const ros2::MessageType& type,
                                   const ros2::Qos& qos);
    Result<EntityId> add_subscription(EntityId node, const std::string& topic, const ros2::MessageType& type,
                                      const ros2::Qos& qos);
    Result<EntityId> add_service(EntityId node, const std::string& service, const ros2::ServiceType& type);
    void remove(EntityId entity);
    void announce();
    void publish(EntityId publisher, std::string_view cdr);
    void reply(EntityId service, const ros2::CallId& call, std::string_view cdr);
    std::size_t subscribers(EntityId publisher) const;
    std::size_t publishers(EntityId subscription) const;
    std::uint64_t revision() const { return revision_; }
    bool await_sent(EntityId publisher, std::int64_t ms_max);
    std::vector<ros2::Incoming> take(std::int64_t wait_ms);
    void on_arrival(std::function<void()> ring);
    std::vector<std::string> take_notices();
    void notice(const std::string& line);

    // --- a connection
    /// `wake`: called when there is a frame again after next() had none. It must not call the Hub.
    ClientNumber enter(const std::string& name, std::function<void()> wake);
    void leave(ClientNumber client);
    void take_text(ClientNumber client, std::string_view frame);
    void take_binary(ClientNumber client, std::string_view frame);
    /// The next frame, if there is one. The one before has been written.
    std::optional<Frame> next(ClientNumber client);
    /// The client does not read what it must have; its connection ends.
    bool is_lost(ClientNumber client) const;
    std::size_t clients() const;

  private:
    struct Node {
        std::string name;  // with its namespace
    };
    struct Message {
        std::uint64_t time_ns = 0;
        std::shared_ptr<const std::string> bytes;
    };
    struct Publisher {
        EntityId node = 0;
        std::string topic;
        ros2::MessageType type;
        ros2::Qos qos;
        std::size_t stamp_at = 0;     // where a message has its stamp; 0: nowhere
        std::size_t subscribers = 0;  // clients
        std::deque<Message> latched{};
    };
    struct Subscription {
        EntityId node = 0;
        std::string topic;
        ros2::MessageType type;
        ros2::Qos qos;
    };
    struct ServiceEnd {
        EntityId node = 0;
        std::string name;
        ros2::ServiceType type;
    };
    using Entity = std::variant<std::monostate, Node, Publisher, Subscription, ServiceEnd>;
    struct Arrival {
        ros2::Incoming incoming;
        std::size_t size() const { return incoming.bytes.size() + sizeof(Arrival); }
    };
    struct TopicUse {
        std::string type;
        std::size_t publishers = 0;
        std::vector<EntityId> subscriptions{};
    };
    struct PublishedChannel {
        ClientChannel channel;
        std::string told;  // why its messages do not arrive, as it was told
    };
    struct Client {
        std::string name;
        std::function<void()> wake;
        bool is_woken = false, is_lost = false, watches_graph = false;
        std::deque<Frame> orders{};  // frames that it must have
        std::size_t order_bytes = 0;
        KeepLast<Frame> messages{};
        std::uint64_t sending = kNoTopic;  // topic of the frame under way
        std::uint64_t dropped = 0;         // messages that were reported as lost
        std::int64_t reported_ms = 0;
        EntityId told = 0;  // entities up to this one are known to it
        std::vector<std::uint32_t> gone_channels{}, gone_services{};  // of these, since the last announcement
        std::map<std::uint32_t, EntityId> publisher_of{};             // by subscription
        std::map<EntityId, std::uint32_t> subscription_of{};
        std::map<std::uint32_t, PublishedChannel> channels{};
        std::set<std::pair<EntityId, std::uint32_t>> calls{};  // that have no reply yet
        std::set<std::string> graph_topics{}, graph_services{};
        std::int64_t received = 0;  // messages and calls
    };

    template <class T>
    T* find(EntityId entity);
    template <class T>
    const T* find(EntityId entity) const;
    EntityId add(Entity entity);
    Result<TopicUse*> use_topic(const std::string& topic, const std::string& type);
    void forget_topic(const std::string& topic);
    void remove_one(EntityId entity);
    void remove_publisher(EntityId entity);
    void remove_service(EntityId entity);

    void wake(Client& client);
    void send(Client& client, std::string text);
    void send(Client& client, Frame frame);
    void send_message(Client& client, std::uint32_t subscription, const Publisher& publisher,
                      const Message& message);
    void send_latched(Client& client, std::uint32_t subscription, const Publisher& publisher);
    void set_time(std::uint64_t time_ns);
    void send_time();
    void send_graph(Client& client);
    void send_gone(Client& client);
    void introduce(Client& client);
    void report_dropped(Client& client);
    Graph graph() const;
    std::uint64_t time_of(const Publisher& publisher, std::string_view cdr) const;
    bool is_waiting(const Client& client, EntityId publisher) const;
    void add_notice(const std::string& line);

    void obey(Client& client, const Subscribe& request);
    void obey(Client& client, const Unsubscribe& request);
    void obey(Client& client, const ClientAdvertise& request);
    void obey(Client& client, const ClientUnadvertise& request);
    void obey(Client& client, const WatchGraph& request);
    void unsubscribe(Client& client, std::uint32_t subscription);
    std::string refusal(const Client& client, const ClientChannel& channel) const;
    std::string problem_of(const ClientChannel& channel) const;
    void report(Client& client, std::uint32_t channel, Level level, const std::string& problem);
    bool take_message(ClientNumber number, Client& client, const ClientMessage& message);
    bool take_call(ClientNumber number, Client& client, const ServiceCall& call);
    std::string problem_of(const Client& client, const ServiceCall& call) const;

    mutable std::mutex mutex_;
    std::condition_variable arrived_, sent_;
    std::string session_;
    std::deque<Entity> entities_{std::monostate{}};  // by EntityId
    EntityId announced_ = 0;                         // entities up to this one are known to clients
    std::map<std::string, TopicUse> topics_;
    std::map<ClientNumber, Client> clients_;
    std::atomic<std::uint64_t> revision_{0};  // another one after each request that may change who reads what
    ClientNumber last_client_ = 0;
    std::uint64_t time_ns_ = 0;  // of the last Clock
    KeepLast<Arrival> inbox_;
    std::function<void()> ring_;
    std::vector<std::string> notices_;
};

}  // namespace roboss::foxglove
