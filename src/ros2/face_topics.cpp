// The nodes, publishers and subscriptions of a Face. When the world changes, those that it still has stay.
#include <set>
#include <utility>

#include "ros2/face.h"
#include "ros2/robot_names.h"

namespace roboss::ros2 {

void Face::open_nodes() {
    std::map<std::string, EntityId> now;
    for (const std::string& name : robot_names(*model_)) {
        const auto before = nodes_.extract(name);
        now[name] = before.empty() ? transport_.add_node("/" + name, "robot") : before.mapped();
    }
    for (const auto& [name, node] : std::exchange(nodes_, std::move(now))) transport_.remove(node);
    // The entities of removed nodes are gone with them.
    for (Endpoints* endpoints : {&publishers_, &subscriptions_})
        std::erase_if(*endpoints, [&](const auto& entry) { return node_of(entry.first) == 0; });
}

std::vector<EntityId> Face::nodes_of_robots() const {
    std::vector<EntityId> nodes;
    for (const std::string& name : robot_names(*model_)) nodes.push_back(nodes_.at(name));
    return nodes;
}

/// The node of a topic's robot, or of the world; 0: the robot is none of this world.
EntityId Face::node_of(const std::string& topic) const {
    // Names of robots may have slashes: the longest that fits.
    for (std::size_t end = topic.rfind('/'); end != std::string::npos && end > 0;
         end = topic.rfind('/', end - 1))
        if (const auto node = nodes_.find(topic.substr(1, end - 1)); node != nodes_.end())
            return node->second;
    return topic.find('/', 1) == std::string::npos ? world_node_ : 0;
}

/// Takes an endpoint over from the world before, or makes it.
Result<> Face::open(Endpoints& before, Endpoints& now, const std::string& topic, const MessageType& type,
                    const std::function<Result<EntityId>(EntityId node)>& add) {
    if (const auto known = before.find(topic); known != before.end()) {
        if (known->second.type == type.name) {
            now.insert(before.extract(known));
            return Ok{};
        }
        transport_.remove(known->second.id);
        before.erase(known);
    }
    const Result<EntityId> made = add(node_of(topic));
    if (!made) return made.error();
    now[topic] = {made.value(), type.name};
    return Ok{};
}

void Face::close(const Endpoints& endpoints) {
    for (const auto& [topic, endpoint] : endpoints) transport_.remove(endpoint.id);
}

void Face::open_topics() {
    Endpoints now;
    publisher_of_.clear();
    for (const Topic& topic : topics_->topics()) {
        const Qos qos{true, topic.is_latched, topic.is_latched || topic.name == "/clock" ? 1u : 10u};
        const Result<> opened = open(publishers_, now, topic.name, *topic.type, [&](EntityId node) {
            return transport_.add_publisher(node, topic.name, *topic.type, qos);
        });
        if (!opened) notice(opened.error().text());
        publisher_of_.push_back(opened ? now[topic.name].id : 0);
    }
    close(std::exchange(publishers_, std::move(now)));
}

void Face::open_commands() {
    Endpoints now;
    command_of_.clear();
    for (std::size_t c = 0; c < commands_->topics().size(); ++c) {
        const CommandTopic& topic = commands_->topics()[c];
        const Result<> opened = open(subscriptions_, now, topic.name, *topic.type, [&](EntityId node) {
            return transport_.add_subscription(node, topic.name, *topic.type, Qos{});
        });
        if (!opened)
            notice(opened.error().text());
        else
            command_of_[now[topic.name].id] = c;
    }
    close(std::exchange(subscriptions_, std::move(now)));
}

}  // namespace roboss::ros2
