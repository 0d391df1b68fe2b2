// The Transport's half of the Hub: nodes and what they have.
#include "foxglove/hub.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/check.h"
#include "core/printable.h"

namespace roboss::foxglove {

namespace {

constexpr const char* kClock = "rosgraph_msgs/msg/Clock";
constexpr std::size_t kNoticesMost = 200;
constexpr std::size_t kLatchedBytesMost = 64u << 20;  // of one publisher

/// The stamp of a Header or Clock follows the four bytes that begin each message; that of the first of a
/// TFMessage's transforms their number.
std::size_t stamp_place(const ros2::MessageType& type) {
    if (type.name == "tf2_msgs/msg/TFMessage") return 8;
    const bool has_header = type.definition.starts_with("std_msgs/Header ") ||
                            type.definition.starts_with("std_msgs/msg/Header ");
    return has_header || type.name == kClock ? 4 : 0;
}

template <class Map, class Key>
auto* find_in(Map& map, const Key& key) {
    const auto found = map.find(key);
    return found == map.end() ? nullptr : &found->second;
}

}  // namespace

template <class T>
T* Hub::find(EntityId entity) {
    return entity < entities_.size() ? std::get_if<T>(&entities_[entity]) : nullptr;
}
template <class T>
const T* Hub::find(EntityId entity) const {
    return entity < entities_.size() ? std::get_if<T>(&entities_[entity]) : nullptr;
}

EntityId Hub::add(Entity entity) {
    entities_.push_back(std::move(entity));
    return static_cast<EntityId>(entities_.size() - 1);
}

Result<Hub::TopicUse*> Hub::use_topic(const std::string& topic, const std::string& type) {
    TopicUse& use = topics_.try_emplace(topic, TopicUse{type}).first->second;
    if (use.type == type) return &use;
    return Error{topic + " is a topic of " + use.type + ", not of " + type, "give it another name",
                 "other-type"};
}

EntityId Hub::add_node(const std::string& space, const std::string& name) {
    const std::lock_guard lock(mutex_);
    return add(Node{(space == "/" ? "" : space) + "/" + name});
}

Result<EntityId> Hub::add_publisher(EntityId node, const std::string& topic, const ros2::MessageType& type,
                                    const ros2::Qos& qos) {
    const std::lock_guard lock(mutex_);
    Result<TopicUse*> use = use_topic(topic, type.name);
    if (!use) return use.error();
    ++use.value()->publishers;
    return add(Publisher{node, topic, type, qos, stamp_place(type)});
}

Result<EntityId> Hub::add_subscription(EntityId node, const std::string& topic, const ros2::MessageType& type,
                                       const ros2::Qos& qos) {
    const std::lock_guard lock(mutex_);
    Result<TopicUse*> use = use_topic(topic, type.name);
    if (!use) return use.error();
    const EntityId entity = add(Subscription{node, topic, type, qos});
    use.value()->subscriptions.push_back(entity);
    return entity;
}

Result<EntityId> Hub::add_service(EntityId node, const std::string& service, const ros2::ServiceType& type) {
    const std::lock_guard lock(mutex_);
    return add(ServiceEnd{node, service, type});
}

void Hub::remove(EntityId entity) {
    const std::lock_guard lock(mutex_);
    if (find<Node>(entity) != nullptr)
        for (EntityId each = 1; each < entities_.size(); ++each) {
            const auto* publisher = find<Publisher>(each);
            const auto* subscription = find<Subscription>(each);
            const auto* service = find<ServiceEnd>(each);
            if ((publisher && publisher->node == entity) || (subscription && subscription->node == entity) ||
                (service && service->node == entity))
                remove_one(each);
        }
    remove_one(entity);
}

void Hub::remove_one(EntityId entity) {
    if (const auto* publisher = find<Publisher>(entity)) {
        remove_publisher(entity);
        --topics_[publisher->topic].publishers;
        forget_topic(publisher->topic);
    } else if (const auto* subscription = find<Subscription>(entity)) {
        std::erase(topics_[subscription->topic].subscriptions, entity);
        inbox_.forget(entity);
        forget_topic(subscription->topic);
    } else if (find<ServiceEnd>(entity) != nullptr) {
        remove_service(entity);
        inbox_.forget(entity);
    }
    entities_[entity] = std::monostate{};
}

void Hub::forget_topic(const std::string& topic) {
    const auto found = topics_.find(topic);
    if (found->second.publishers == 0 && found->second.subscriptions.empty()) topics_.erase(found);
}

void Hub::remove_publisher(EntityId entity) {
    for (auto& [number, client] : clients_) {
        if (const auto* subscription = find_in(client.subscription_of, entity))
            unsubscribe(client, std::uint32_t{*subscription});
        if (client.told >= entity) client.gone_channels.push_back(entity);
    }
}

void Hub::remove_service(EntityId entity) {
    for (auto& numbered : clients_) {
        Client& client = numbered.second;
        std::erase_if(client.calls, [&](const auto& call) {
            if (call.first == entity) send(client, call_failure(entity, call.second, "the service has gone"));
            return call.first == entity;
        });
        if (client.told >= entity) client.gone_services.push_back(entity);
    }
}

void Hub::announce() {
    const std::lock_guard lock(mutex_);
    announced_ = static_cast<EntityId>(entities_.size() - 1);
    for (auto& [number, client] : clients_) {
        send_gone(client);
        if (client.watches_graph) send_graph(client);
        wake(client);
    }
}

std::uint64_t Hub::time_of(const Publisher& publisher, std::string_view cdr) const {
    const std::size_t at = publisher.stamp_at;
    if (at == 0 || cdr.size() < at + 8) return time_ns_;
    const auto word = [&](std::size_t place) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(cdr[place + i])) << (8 * i);
        return value;
    };
    return std::uint64_t{word(at)} * 1'000'000'000 + word(at + 4);
}

void Hub::publish(EntityId entity, std::string_view cdr) {
    const std::lock_guard lock(mutex_);
    auto* publisher = find<Publisher>(entity);
    if (publisher == nullptr) return;
    const std::uint64_t time = time_of(*publisher, cdr);
    const bool is_clock = publisher->type.name == kClock;
    if (is_clock) set_time(time);
    if (publisher->subscribers == 0 && !publisher->qos.is_latched) return;
    // Viewers show a message at the time that they heard last, and the clock is the last message of a tick.
    if (!is_clock && time > time_ns_) set_time(time);
    const Message message{time, std::make_shared<const std::string>(cdr)};
    for (auto& [number, client] : clients_)
        if (const auto* subscription = find_in(client.subscription_of, entity))
            send_message(client, *subscription, *publisher, message);
    if (!publisher->qos.is_latched) return;
    std::deque<Message>& latched = publisher->latched;
    latched.push_back(message);
    std::size_t bytes = 0;
    for (const Message& each : latched) bytes += each.bytes->size();
    while (latched.size() > 1 && (latched.size() > publisher->qos.depth || bytes > kLatchedBytesMost)) {
        bytes -= latched.front().bytes->size();
        latched.pop_front();
    }
}

void Hub::reply(EntityId service, const ros2::CallId& call, std::string_view cdr) {
    const std::lock_guard lock(mutex_);
    ClientNumber number = 0;
    for (std::size_t i = 0; i < 8; ++i) number |= ClientNumber{call.client[i]} << (8 * i);
    auto* client = find_in(clients_, number);
    const auto id = static_cast<std::uint32_t>(call.number);
    if (client == nullptr || client->calls.erase({service, id}) == 0) return;
    send(*client, Frame{false, reply_head(service, id), std::make_shared<const std::string>(cdr)});
}

std::size_t Hub::subscribers(EntityId entity) const {
    const std::lock_guard lock(mutex_);
    const auto* publisher = find<Publisher>(entity);
    if (publisher == nullptr) return 0;
    // All clients get the time.
    const bool is_clock = publisher->type.name == kClock;
    return publisher->subscribers + (is_clock ? clients_.size() : 0);
}

std::size_t Hub::publishers(EntityId entity) const {
    const std::lock_guard lock(mutex_);
    const auto* subscription = find<Subscription>(entity);
    if (subscription == nullptr) return 0;
    std::size_t count = 0;
    for (const auto& [number, client] : clients_)
        for (const auto& [id, channel] : client.channels)
            count += channel.channel.topic == subscription->topic;
    return count;
}

bool Hub::is_waiting(const Client& client, EntityId publisher) const {
    const auto* subscription = find_in(client.subscription_of, publisher);
    return subscription != nullptr && !client.is_lost &&
           (client.sending == *subscription || client.messages.waiting(*subscription) > 0);
}

bool Hub::await_sent(EntityId publisher, std::int64_t ms_max) {
    std::unique_lock lock(mutex_);
    return sent_.wait_for(lock, std::chrono::milliseconds(ms_max), [&] {
        return std::ranges::none_of(clients_, [&](const auto& c) { return is_waiting(c.second, publisher); });
    });
}

std::vector<ros2::Incoming> Hub::take(std::int64_t wait_ms) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, std::chrono::milliseconds(wait_ms), [&] { return !inbox_.empty(); });
    std::vector<ros2::Incoming> result;
    while (auto arrival = inbox_.take()) result.push_back(std::move(arrival->incoming));
    return result;
}

void Hub::on_arrival(std::function<void()> ring) {
    const std::lock_guard lock(mutex_);
    ring_ = std::move(ring);
}

std::vector<std::string> Hub::take_notices() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notices_, {});
}

void Hub::notice(const std::string& line) {
    const std::lock_guard lock(mutex_);
    add_notice(line);
}

void Hub::add_notice(const std::string& line) {
    if (notices_.size() < kNoticesMost) notices_.push_back(printable_line(line));
}

}  // namespace roboss::foxglove
