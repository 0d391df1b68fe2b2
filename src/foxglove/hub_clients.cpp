// The clients' half of the Hub: what they ask for.
#include <algorithm>
#include <utility>

#include "foxglove/hub.h"

namespace roboss::foxglove {

namespace {

constexpr std::size_t kInboxBytesMost = 64u << 20;
constexpr std::size_t kCallsMost = 64;  // of one client that have no reply yet
constexpr std::size_t kClientChannelsMost = 4'096;
constexpr std::size_t kNameBytesMost = 512;
constexpr std::size_t kEncapsulation = 4;  // bytes in front of each message in CDR

ros2::CallId call_id(ClientNumber client, std::int64_t number) {
    ros2::CallId id;
    for (std::size_t i = 0; i < 8; ++i) id.client[i] = static_cast<std::uint8_t>(client >> (8 * i));
    id.number = number;
    return id;
}

}  // namespace

ClientNumber Hub::enter(const std::string& name, std::function<void()> wake_client) {
    const std::lock_guard lock(mutex_);
    ++revision_;
    Client& client = clients_[++last_client_];
    client.name = name, client.wake = std::move(wake_client);
    send(client, server_info(session_));
    introduce(client);
    if (client.orders.size() == 1) send(client, advertise({}));  // a client gets at least one
    return last_client_;
}

void Hub::leave(ClientNumber number) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(number);
    if (found == clients_.end()) return;
    while (!found->second.publisher_of.empty())
        unsubscribe(found->second, found->second.publisher_of.begin()->first);
    clients_.erase(found);
    ++revision_;
    sent_.notify_all();
}

bool Hub::is_lost(ClientNumber number) const {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(number);
    return found != clients_.end() && found->second.is_lost;
}

std::size_t Hub::clients() const {
    const std::lock_guard lock(mutex_);
    return clients_.size();
}

void Hub::take_text(ClientNumber number, std::string_view frame) {
    const Result<TextRequest> request = read_text(frame);
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(number);
    if (found == clients_.end()) return;
    if (!request)
        return send(found->second,
                    status(Level::kError, request.error().message + " [" + request.error().code + "]"));
    std::visit([&](const auto& what) { obey(found->second, what); }, request.value());
    ++revision_;
}

void Hub::take_binary(ClientNumber number, std::string_view frame) {
    const Result<BinaryRequest> request = read_binary(frame);
    std::unique_lock lock(mutex_);
    const auto found = clients_.find(number);
    if (found == clients_.end()) return;
    if (!request)
        return send(found->second,
                    status(Level::kError, request.error().message + " [" + request.error().code + "]"));
    const auto* message = std::get_if<ClientMessage>(&request.value());
    const bool has_arrived = message != nullptr
                                 ? take_message(number, found->second, *message)
                                 : take_call(number, found->second, std::get<ServiceCall>(request.value()));
    if (!has_arrived) return;
    arrived_.notify_all();
    const std::function<void()> ring = ring_;
    lock.unlock();
    if (ring) ring();
}

void Hub::obey(Client& client, const Subscribe& request) {
    for (const auto& [subscription, channel] : request.channels) {
        auto* publisher = channel <= client.told ? std::get_if<Publisher>(&entities_[channel]) : nullptr;
        if (publisher == nullptr) {
            send(client, status(Level::kWarning, "there is no channel " + std::to_string(channel)));
        } else if (client.publisher_of.contains(subscription)) {
            send(client, status(Level::kError,
                                "the subscription " + std::to_string(subscription) + " exists already"));
        } else if (client.subscription_of.contains(channel)) {
            send(client, status(Level::kError, publisher->topic + " is subscribed to already"));
        } else {
            client.publisher_of[subscription] = channel;
            client.subscription_of[channel] = subscription;
            ++publisher->subscribers;
            send_latched(client, subscription, *publisher);
        }
    }
}

void Hub::obey(Client& client, const Unsubscribe& request) {
    for (const std::uint32_t subscription : request.subscriptions)
        if (client.publisher_of.contains(subscription))  // else its channel has gone
            unsubscribe(client, subscription);
}

void Hub::unsubscribe(Client& client, std::uint32_t subscription) {
    const EntityId entity = client.publisher_of.at(subscription);
    client.publisher_of.erase(subscription);
    client.subscription_of.erase(entity);
    client.messages.forget(subscription);
    --std::get<Publisher>(entities_[entity]).subscribers;
    sent_.notify_all();
}

/// Why messages of this channel can never arrive; empty: they can.
std::string Hub::refusal(const Client& client, const ClientChannel& channel) const {
    if (client.channels.contains(channel.id))
        return "the channel " + std::to_string(channel.id) + " exists already";
    if (client.channels.size() >= kClientChannelsMost) return "this client has too many channels";
    if (channel.topic.size() > kNameBytesMost || channel.schema_name.size() > kNameBytesMost)
        return "the name of a topic or type is too long";
    if (channel.encoding != kCdr)
        return channel.topic + ": messages must be in CDR, not in " +
               channel.encoding.substr(0, kNameBytesMost);
    return {};
}

/// Why messages of this channel do not arrive for the time being; empty: they do.
std::string Hub::problem_of(const ClientChannel& channel) const {
    const auto use = topics_.find(channel.topic);
    if (use == topics_.end() || use->second.subscriptions.empty())
        return "nothing here subscribes to " + channel.topic;
    if (ros2::full_type_name(channel.schema_name) != use->second.type)
        return channel.topic + " is a topic of " + use->second.type + ", not of " + channel.schema_name;
    return {};
}

/// Says it once: viewers publish many times a second.
void Hub::report(Client& client, std::uint32_t channel, Level level, const std::string& problem) {
    if (std::exchange(client.channels.at(channel).told, problem) == problem || problem.empty()) return;
    send(client, status(level, problem, "channel-" + std::to_string(channel)));
}

/// A channel that nothing subscribes to is kept: its robot may come later.
void Hub::obey(Client& client, const ClientAdvertise& request) {
    for (const ClientChannel& channel : request.channels) {
        if (const std::string why = refusal(client, channel); !why.empty()) {
            send(client, status(Level::kError, why));
            continue;
        }
        client.channels[channel.id] = {channel, {}};
        report(client, channel.id, Level::kWarning, problem_of(channel));
    }
}

void Hub::obey(Client& client, const ClientUnadvertise& request) {
    for (const std::uint32_t channel : request.channels) client.channels.erase(channel);
}

void Hub::obey(Client& client, const WatchGraph& request) {
    client.watches_graph = request.wanted;
    client.graph_topics.clear(), client.graph_services.clear();
    if (request.wanted) send_graph(client);
}

bool Hub::take_message(ClientNumber number, Client& client, const ClientMessage& message) {
    const auto channel = client.channels.find(message.channel);
    if (channel == client.channels.end()) {
        send(client, status(Level::kError, "this client has no channel " + std::to_string(message.channel)));
        return false;
    }
    const ClientChannel& about = channel->second.channel;
    const bool is_short = message.payload.size() < kEncapsulation;
    const std::string problem = is_short ? about.topic + ": the message is too short" : problem_of(about);
    report(client, message.channel, Level::kError, problem);
    if (!problem.empty()) return false;
    const ros2::CallId id = call_id(number, ++client.received);
    for (const EntityId entity : topics_.at(about.topic).subscriptions) {
        if (inbox_.bytes() + message.payload.size() > kInboxBytesMost) {
            add_notice("messages of " + client.name + " are lost: they arrive too fast [too-fast]");
            return true;
        }
        inbox_.push(entity, std::get<Subscription>(entities_[entity]).qos.depth,
                    {{entity, id, std::string(message.payload), {}}});
    }
    return true;
}

/// Why a call gets no reply; empty: it will get one.
std::string Hub::problem_of(const Client& client, const ServiceCall& call) const {
    const bool is_service =
        call.service < entities_.size() && std::holds_alternative<ServiceEnd>(entities_[call.service]);
    if (!is_service) return "there is no service " + std::to_string(call.service);
    if (call.encoding != kCdr) return "requests must be in CDR";
    if (call.payload.size() < kEncapsulation) return "the request is too short";
    if (client.calls.contains({call.service, call.call})) return "a call of this number waits for its reply";
    if (client.calls.size() >= kCallsMost) return "too many calls wait for their replies";
    if (inbox_.bytes() + call.payload.size() > kInboxBytesMost) return "too much waits to be read";
    return {};
}

bool Hub::take_call(ClientNumber number, Client& client, const ServiceCall& call) {
    if (const std::string problem = problem_of(client, call); !problem.empty()) {
        send(client, call_failure(call.service, call.call, problem));
        return false;
    }
    client.calls.insert({call.service, call.call});
    inbox_.push(call.service, SIZE_MAX,
                {{call.service, call_id(number, call.call), std::string(call.payload), {}}});
    return true;
}

}  // namespace roboss::foxglove
