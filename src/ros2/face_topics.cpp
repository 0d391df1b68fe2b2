// The nodes, publishers and subscriptions of a Face. When the world changes, those that it still has stay.
#include <set>
#include <utility>

#include "ros2/face.h"
#include "ros2/robot_names.h"

namespace roboss::ros2 {

namespace {

constexpr std::int64_t kFollowTypes_ms = 250;

}  // namespace

void Face::open_nodes() {
    std::map<std::string, EntityId> now;
    robot_nodes_.clear();
    for (const std::string& name : robot_names(*model_, options_.topics.root)) {
        const auto before = nodes_.extract(name);
        robot_nodes_.push_back(before.empty() ? transport_.add_node("/" + name, "robot") : before.mapped());
        now[name] = robot_nodes_.back();
    }
    std::set<EntityId> gone;
    for (const auto& [name, node] : std::exchange(nodes_, std::move(now))) {
        transport_.remove(node);
        gone.insert(node);
    }
    // Their entities are gone with them.
    for (Endpoints* endpoints : {&publishers_, &subscriptions_})
        std::erase_if(*endpoints, [&](const auto& entry) { return gone.contains(entry.second.node); });
}

EntityId Face::node_of(RobotId robot) const {
    return robot.valid() ? robot_nodes_[robot.index()] : world_node_;
}

/// Takes an endpoint over from the world before, if it had it at the same node with the same type.
bool Face::take_over(Endpoints& before, Endpoints& now, const std::string& topic, const std::string& type,
                     EntityId node) {
    const auto known = before.find(topic);
    if (known == before.end() || known->second.type != type || known->second.node != node) return false;
    now.insert(before.extract(known));
    return true;
}

void Face::close(const Endpoints& endpoints) {
    for (const auto& [topic, endpoint] : endpoints) transport_.remove(endpoint.id);
}

void Face::open_topics() {
    Endpoints now;
    for (const Topic& topic : topics_->topics())
        (void)take_over(publishers_, now, topic.name, topic.type->name, node_of(topic.robot));
    close(std::exchange(publishers_, std::move(now)));  // first, for a topic may have another type now
    publisher_of_.clear(), counted_at_.reset();
    for (const Topic& topic : topics_->topics()) {
        Endpoint& endpoint = publishers_[topic.name];
        if (endpoint.id == 0) {
            const Qos qos{true, topic.is_latched, topic.is_latched || topic.name == "/clock" ? 1u : 10u};
            const EntityId node = node_of(topic.robot);
            const Result<EntityId> made = transport_.add_publisher(node, topic.name, *topic.type, qos);
            if (!made) notice(made.error().text());
            endpoint = {made ? made.value() : 0, node, topic.type->name};
        }
        publisher_of_.push_back(endpoint.id);
    }
}

void Face::open_commands() {
    Endpoints now;
    for (const CommandTopic& topic : commands_->topics())
        (void)take_over(subscriptions_, now, topic.name, topic.type->name, node_of(topic.robot));
    close(std::exchange(subscriptions_, std::move(now)));
    command_of_.clear(), types_followed_at_.reset();
    for (std::size_t c = 0; c < commands_->topics().size(); ++c) {
        const CommandTopic& topic = commands_->topics()[c];
        Endpoint& endpoint = subscriptions_[topic.name];
        if (endpoint.id == 0) {
            const EntityId node = node_of(topic.robot);
            const Result<EntityId> made = transport_.add_subscription(node, topic.name, *topic.type, Qos{});
            if (!made) notice(made.error().text());
            endpoint = {made ? made.value() : 0, node, topic.type->name};
        }
        if (endpoint.id != 0) command_of_.emplace(endpoint.id, c);
    }
}

/// A topic has one type in a process. Velocities take the one that nodes publish.
void Face::follow_types(std::int64_t now_ms) {
    if (now_ms - types_followed_ms_ < kFollowTypes_ms) return;
    types_followed_ms_ = now_ms;
    const std::uint64_t revision = transport_.revision();
    if (types_followed_at_ == revision) return;
    types_followed_at_ = revision;
    bool changed = false;
    for (std::size_t c = 0; c < commands_->topics().size(); ++c) {
        const CommandTopic& topic = commands_->topics()[c];
        if (!commands_->takes(c, topic.type->name)) continue;
        const auto endpoint = subscriptions_.find(topic.name);
        if (endpoint == subscriptions_.end() || endpoint->second.id == 0) continue;
        const std::string other = transport_.other_type(endpoint->second.id);
        if (!commands_->takes(c, other)) continue;
        commands_->change_type(c);
        notices_.push_back(topic.name + " takes " + other + " from now on, for a node publishes that");
        changed = true;
    }
    if (!changed) return;
    open_commands();
    transport_.announce();
}

}  // namespace roboss::ros2
