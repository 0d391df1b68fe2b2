// FakeTransport: nodes of ROS 2 that a test plays itself, without a network.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros2_types/cdr.h"
#include "ros2_types/transport.h"

namespace roboss::test {

class FakeTransport : public ros2::Transport {
  public:
    struct Entity {
        enum class Kind { kNode, kPublisher, kSubscription, kService } kind{};
        std::string name, type;  // of a node: its full name
        ros2::Qos qos{};
        ros2::EntityId node = 0;
    };

    ros2::EntityId add_node(const std::string& space, const std::string& name) override {
        return add({Entity::Kind::kNode, (space == "/" ? "/" : space + "/") + name, "", {}, 0});
    }
    Result<ros2::EntityId> add_publisher(ros2::EntityId node, const std::string& topic,
                                         const ros2::MessageType& type, const ros2::Qos& qos) override {
        return add({Entity::Kind::kPublisher, topic, type.name, qos, node});
    }
    Result<ros2::EntityId> add_subscription(ros2::EntityId node, const std::string& topic,
                                            const ros2::MessageType& type, const ros2::Qos& qos) override {
        return add({Entity::Kind::kSubscription, topic, type.name, qos, node});
    }
    Result<ros2::EntityId> add_service(ros2::EntityId node, const std::string& service,
                                       const ros2::ServiceType& type) override {
        return add({Entity::Kind::kService, service, type.name, {}, node});
    }
    void remove(ros2::EntityId entity) override {
        entities.erase(entity);
        std::erase_if(entities, [&](const auto& each) { return each.second.node == entity; });
    }
    void announce() override {}

    void publish(ros2::EntityId publisher, std::string_view cdr) override {
        published.emplace_back(entities.at(publisher).name, std::string(cdr));
    }
    void reply(ros2::EntityId service, const ros2::CallId& call, std::string_view cdr) override {
        replies.push_back({service, call, std::string(cdr), ""});
    }
    std::size_t subscribers(ros2::EntityId publisher) const override {
        return subscribed.contains(entities.at(publisher).name) ? 1 : 0;
    }
    bool await_confirmed(ros2::EntityId, std::int64_t) override { return true; }
    std::vector<ros2::Incoming> take(std::int64_t) override { return std::exchange(arrived, {}); }
    void on_arrival(std::function<void()>) override {}
    std::vector<std::string> take_notices() override { return {}; }

    /// The entity of this kind and name; 0: there is none.
    ros2::EntityId find(Entity::Kind kind, const std::string& name) const {
        for (const auto& [id, entity] : entities)
            if (entity.kind == kind && entity.name == name) return id;
        return 0;
    }
    /// A node elsewhere sends a message.
    template <ros2::Message M>
    void send(const std::string& topic, const M& message) {
        send_bytes(topic, ros2::to_cdr(message));
    }
    void send_bytes(const std::string& topic, std::string bytes) {
        arrived.push_back({find(Entity::Kind::kSubscription, topic), {}, std::move(bytes), ""});
    }
    /// The messages of a topic since the last call.
    std::vector<std::string> take_published(const std::string& topic) {
        std::vector<std::string> found;
        for (auto& [name, bytes] : published)
            if (name == topic) found.push_back(bytes);
        std::erase_if(published, [&](const auto& each) { return each.first == topic; });
        return found;
    }

    std::map<ros2::EntityId, Entity> entities;
    std::set<std::string> subscribed;  // topics that nodes elsewhere subscribe to
    std::vector<std::pair<std::string, std::string>> published;
    std::vector<ros2::Incoming> replies, arrived;

  private:
    ros2::EntityId add(Entity entity) {
        entities[++last_] = std::move(entity);
        return last_;
    }
    ros2::EntityId last_ = 0;
};

}  // namespace roboss::test
