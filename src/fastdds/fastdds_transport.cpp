#include "fastdds/fastdds_transport.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "ros2_types/cdr.h"
#include "ros2_types/messages/discovery_messages.h"

namespace roboss::fastdds {

using ros2::EntityId;

namespace {

template <std::size_t size>
ros2::Gid<size> gid_of(const Guid& guid) {
    ros2::Gid<size> gid;
    std::copy(guid.begin(), guid.end(), gid.data.begin());
    return gid;
}

// The value of a key, of a map of pointers.
template <class Map>
auto* find(const Map& map, EntityId entity) {
    const auto at = map.find(entity);
    return at == map.end() ? nullptr : at->second.get();
}

}  // namespace

Result<std::unique_ptr<FastDdsTransport>> FastDdsTransport::open(const ros2::TransportOptions& options) {
    std::unique_ptr<FastDdsTransport> made(new FastDdsTransport(options.has_long_gids));
    auto participant = Participant::join(options, made->peers_);
    if (!participant) return participant.error();
    made->participant_ = std::move(participant).value();
    using Info = ros2::ParticipantEntitiesInfo<16>;
    const DdsTopic topic{"ros_discovery_info", message_topic("", Info::kName).type};
    auto writer = Writer::open(*made->participant_, topic, options.has_long_gids ? "" : Info::kHash,
                               {.is_reliable = true, .is_latched = true, .depth = 1});
    if (!writer) return writer.error();
    made->nodes_writer_ = std::move(writer).value();
    made->announce();
    return made;
}

FastDdsTransport::~FastDdsTransport() = default;

EntityId FastDdsTransport::add_node(const std::string& space, const std::string& name) {
    nodes_[++last_] = {space, name, {}};
    return last_;
}

Result<EntityId> FastDdsTransport::add_publisher(EntityId node, const std::string& topic,
                                                 const ros2::MessageType& type, const ros2::Qos& qos) {
    auto writer = Writer::open(*participant_, message_topic(topic, type.name), type.hash, qos);
    if (!writer) return writer.error();
    publishers_[++last_] = std::move(writer).value();
    nodes_[node].entities.insert(last_);
    return last_;
}

Result<EntityId> FastDdsTransport::add_subscription(EntityId node, const std::string& topic,
                                                    const ros2::MessageType& type, const ros2::Qos& qos) {
    const EntityId entity = ++last_;
    const auto keep = [this, entity, topic, depth = qos.depth](Sample sample) {
        ros2::Incoming message{entity,
                               {sample.writer, sample.number, 0},
                               std::move(sample.bytes),
                               peers_.of(sample.writer).hash};
        if (!inbox_.put(std::move(message), depth)) notices_.count_dropped(topic);
    };
    auto reader = Reader::open(*participant_, message_topic(topic, type.name), type.hash, qos, keep);
    if (!reader) return reader.error();
    subscriptions_[entity] = std::move(reader).value();
    nodes_[node].entities.insert(entity);
    return entity;
}

Result<EntityId> FastDdsTransport::add_service(EntityId node, const std::string& service,
                                               const ros2::ServiceType& type) {
    const EntityId entity = ++last_;
    auto end = ServiceEnd::open({*participant_, peers_, inbox_, notices_}, entity, service, type);
    if (!end) return end.error();
    services_[entity] = std::move(end).value();
    nodes_[node].entities.insert(entity);
    return entity;
}

void FastDdsTransport::remove(EntityId entity) {
    if (const auto node = nodes_.find(entity); node != nodes_.end()) {
        const std::set<EntityId> all = std::exchange(node->second.entities, {});
        nodes_.erase(node);
        for (const EntityId part : all) remove(part);
        return;
    }
    publishers_.erase(entity);
    subscriptions_.erase(entity);
    services_.erase(entity);
    inbox_.forget(entity);
    for (auto& [id, node] : nodes_) node.entities.erase(entity);
}

template <std::size_t size>
std::string FastDdsTransport::node_list() const {
    ros2::ParticipantEntitiesInfo<size> info{gid_of<size>(participant_->guid()), {}};
    for (const auto& [id, node] : nodes_) {
        auto& entry = info.node_entities_info_seq.emplace_back();
        entry.node_namespace = node.space;
        entry.node_name = node.name;
        const auto reads = [&](const Guid& guid) { entry.reader_gid_seq.push_back(gid_of<size>(guid)); };
        const auto writes = [&](const Guid& guid) { entry.writer_gid_seq.push_back(gid_of<size>(guid)); };
        for (const EntityId entity : node.entities) {
            if (const Writer* publisher = find(publishers_, entity)) writes(publisher->guid());
            if (const Reader* subscription = find(subscriptions_, entity)) reads(subscription->guid());
            if (const ServiceEnd* service = find(services_, entity))
                reads(service->reader()), writes(service->writer());
        }
    }
    return ros2::to_cdr(info);
}

void FastDdsTransport::announce() {
    nodes_writer_->send(has_long_gids_ ? node_list<24>() : node_list<16>());
}

void FastDdsTransport::publish(EntityId publisher, std::string_view cdr) {
    if (Writer* writer = find(publishers_, publisher)) writer->send(cdr);
}

void FastDdsTransport::reply(EntityId service, const ros2::CallId& call, std::string_view cdr) {
    if (ServiceEnd* end = find(services_, service)) end->reply(call, cdr);
}

std::size_t FastDdsTransport::subscribers(EntityId publisher) const {
    const Writer* writer = find(publishers_, publisher);
    return writer == nullptr ? 0 : writer->reader_count();
}

std::size_t FastDdsTransport::publishers(EntityId subscription) const {
    const Reader* reader = find(subscriptions_, subscription);
    return reader == nullptr ? 0 : reader->writer_count();
}

std::string FastDdsTransport::other_type(EntityId subscription) const {
    const Reader* reader = find(subscriptions_, subscription);
    return reader == nullptr ? std::string() : peers_.other_type(reader->topic());
}

bool FastDdsTransport::await_confirmed(EntityId publisher, std::int64_t ms_max) {
    Writer* writer = find(publishers_, publisher);
    return writer == nullptr || writer->await_confirmed(ms_max);
}

std::vector<ros2::Incoming> FastDdsTransport::take(std::int64_t wait_ms) {
    using namespace std::chrono;
    const auto end = steady_clock::now() + milliseconds(wait_ms);
    for (;;) {
        for (auto& [id, service] : services_) service->send_waiting();
        const auto rest = duration_cast<milliseconds>(end - steady_clock::now()).count();
        std::vector<ros2::Incoming> messages = inbox_.take(std::max<std::int64_t>(rest, 0));
        // Woken: a client has begun to read replies.
        if (!messages.empty() || steady_clock::now() >= end) return messages;
    }
}

}  // namespace roboss::fastdds

/// See ros2::OpenTransport.
extern "C" __attribute__((visibility("default"))) roboss::ros2::Transport* roboss_ros2_transport(
    int abi, const roboss::ros2::TransportOptions& options, roboss::Error& problem) {
    using roboss::Error;
    if (abi != roboss::ros2::kTransportAbi) {
        problem = Error{"libroboss_fastdds.so is of another version of RoBOSS", "install RoBOSS anew",
                        "other-version"};
        return nullptr;
    }
    try {
        auto made = roboss::fastdds::FastDdsTransport::open(options);
        if (made) return std::move(made).value().release();
        problem = made.error();
    } catch (const std::exception& error) {
        problem = Error{std::string("Fast DDS cannot start: ") + error.what(),
                        "is there memory left, and a network?", "no-domain"};
    }
    return nullptr;
}
