// Frames that the Hub sends to a client, in this order: those it must have, topics that are new to it,
// messages, the oldest first.
#include <chrono>
#include <utility>

#include "foxglove/hub.h"

namespace roboss::foxglove {

namespace {

constexpr std::size_t kMessageBytesMost = 64u << 20;  // that wait for one client
constexpr std::size_t kOrderBytesMost = 64u << 20;
constexpr std::size_t kOrdersMost = 10'000;
constexpr std::size_t kIntroductionBytes = 256u << 10;  // of one frame
constexpr std::int64_t kReportEvery_ms = 5'000;

std::int64_t steady_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

void Hub::wake(Client& client) {
    if (!std::exchange(client.is_woken, true)) client.wake();
}

void Hub::send(Client& client, std::string text) {
    send(client, Frame{true, std::move(text)});
}

void Hub::send(Client& client, Frame frame) {
    if (client.is_lost) return;
    client.order_bytes += frame.size();
    client.orders.push_back(std::move(frame));
    if (client.order_bytes > kOrderBytesMost || client.orders.size() > kOrdersMost) client.is_lost = true;
    wake(client);
}

void Hub::send_message(Client& client, std::uint32_t subscription, const Publisher& publisher,
                       const Message& message) {
    client.messages.push(
        subscription, publisher.qos.depth,
        Frame{false, message_head(subscription, message.time_ns), message.bytes, subscription});
    while (client.messages.bytes() > kMessageBytesMost) client.messages.drop_oldest();
    wake(client);
}

void Hub::send_latched(Client& client, std::uint32_t subscription, const Publisher& publisher) {
    for (const Message& message : publisher.latched) send_message(client, subscription, publisher, message);
}

/// Where it goes back, viewers forget all messages, also those that are sent once.
void Hub::set_time(std::uint64_t time_ns) {
    const bool is_back = time_ns < time_ns_;
    time_ns_ = time_ns;
    send_time();
    if (!is_back) return;
    for (auto& [number, client] : clients_)
        for (const auto& [subscription, entity] : client.publisher_of)
            send_latched(client, subscription, std::get<Publisher>(entities_[entity]));
}

void Hub::send_time() {
    for (auto& [number, client] : clients_) {
        client.messages.forget(kTimeTopic);
        client.messages.push(kTimeTopic, 1, Frame{false, time_frame(time_ns_), nullptr, kTimeTopic});
        wake(client);
    }
}

void Hub::send_gone(Client& client) {
    if (!client.gone_channels.empty()) send(client, unadvertise(client.gone_channels));
    if (!client.gone_services.empty()) send(client, unadvertise_services(client.gone_services));
    client.gone_channels.clear(), client.gone_services.clear();
}

/// Some of the channels and services that the client does not know yet.
void Hub::introduce(Client& client) {
    std::vector<Channel> channels;
    std::vector<Service> services;
    std::size_t bytes = 0;
    while (client.told < announced_ && bytes < kIntroductionBytes) {
        const EntityId entity = ++client.told;
        if (const auto* publisher = std::get_if<Publisher>(&entities_[entity])) {
            channels.push_back({entity, &publisher->topic, &publisher->type});
            bytes += publisher->topic.size() + publisher->type.definition.size();
        } else if (const auto* service = std::get_if<ServiceEnd>(&entities_[entity])) {
            services.push_back({entity, &service->name, &service->type});
            bytes += 2 * (service->type.request_definition.size() + service->type.reply_definition.size());
        }
    }
    if (!channels.empty()) send(client, advertise(channels));
    if (!services.empty()) send(client, advertise_services(services));
}

Graph Hub::graph() const {
    std::map<std::string, std::vector<std::string>> publishers, subscribers, providers;
    const auto node_name = [&](EntityId node) {
        const auto* found = node < entities_.size() ? std::get_if<Node>(&entities_[node]) : nullptr;
        return found == nullptr ? std::string() : found->name;
    };
    for (EntityId entity = 1; entity <= announced_; ++entity) {
        if (const auto* publisher = std::get_if<Publisher>(&entities_[entity]))
            publishers[publisher->topic].push_back(node_name(publisher->node));
        else if (const auto* subscription = std::get_if<Subscription>(&entities_[entity]))
            subscribers[subscription->topic].push_back(node_name(subscription->node));
        else if (const auto* service = std::get_if<ServiceEnd>(&entities_[entity]))
            providers[service->name].push_back(node_name(service->node));
    }
    const auto list = [](auto& edges) { return Graph::Edges(edges.begin(), edges.end()); };
    return {list(publishers), list(subscribers), list(providers)};
}

void Hub::send_graph(Client& client) {
    const Graph now = graph();
    std::set<std::string> topics, services;
    for (const auto& [name, nodes] : now.publishers) topics.insert(name);
    for (const auto& [name, nodes] : now.subscribers) topics.insert(name);
    for (const auto& [name, nodes] : now.providers) services.insert(name);
    const auto gone = [](const std::set<std::string>& before, const std::set<std::string>& after) {
        std::vector<std::string> names;
        for (const std::string& name : before)
            if (!after.contains(name)) names.push_back(name);
        return names;
    };
    send(client, graph_update(now, gone(client.graph_topics, topics), gone(client.graph_services, services)));
    client.graph_topics = std::move(topics), client.graph_services = std::move(services);
}

/// A viewer shows this text; it takes the place of the one before.
void Hub::report_dropped(Client& client) {
    const std::uint64_t dropped = client.messages.dropped();
    const std::int64_t now = steady_ms();
    if (dropped == client.dropped || now - client.reported_ms < kReportEvery_ms) return;
    send(client, status(Level::kWarning,
                        std::to_string(dropped) + " messages were left out, since this connection or viewer "
                                                  "is too slow for them; subscribe to fewer topics",
                        "slow"));
    client.dropped = dropped, client.reported_ms = now;
}

std::optional<Frame> Hub::next(ClientNumber number) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(number);
    if (found == clients_.end()) return std::nullopt;
    Client& client = found->second;
    if (std::exchange(client.sending, kNoTopic) != kNoTopic) sent_.notify_all();
    client.is_woken = true;
    report_dropped(client);
    while (client.orders.empty() && client.told < announced_) introduce(client);
    if (!client.orders.empty()) {
        Frame frame = std::move(client.orders.front());
        client.orders.pop_front();
        client.order_bytes -= frame.size();
        return frame;
    }
    if (std::optional<Frame> frame = client.messages.take()) {
        client.sending = frame->topic;
        return frame;
    }
    client.is_woken = false;
    return std::nullopt;
}

}  // namespace roboss::foxglove
