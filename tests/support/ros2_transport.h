// TestTransport: a Transport without a middleware. A test calls services and reads what was published.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros2_types/cdr.h"
#include "ros2_types/transport.h"

namespace roboss::test {

class TestTransport : public ros2::Transport {
  public:
    ros2::EntityId add_node(const std::string& space, const std::string& name) override {
        names[++last_] = (space == "/" ? "/" : space + "/") + name;
        return last_;
    }
    Result<ros2::EntityId> add_publisher(ros2::EntityId node, const std::string& topic,
                                         const ros2::MessageType& type, const ros2::Qos&) override {
        names[++last_] = topic, types[topic] = type.name, node_of[last_] = node;
        return last_;
    }
    Result<ros2::EntityId> add_subscription(ros2::EntityId node, const std::string& topic,
                                            const ros2::MessageType& type, const ros2::Qos&) override {
        names[++last_] = topic, types[topic] = type.name, node_of[last_] = node;
        return last_;
    }
    Result<ros2::EntityId> add_service(ros2::EntityId node, const std::string& service,
                                       const ros2::ServiceType& type) override {
        names[++last_] = service, types[service] = type.name, services[service] = last_,
        node_of[last_] = node;
        return last_;
    }
    void remove(ros2::EntityId entity) override {
        services.erase(names[entity]);
        names.erase(entity);
        std::erase_if(names, [&](const auto& each) {
            const auto node = node_of.find(each.first);
            return node != node_of.end() && node->second == entity;
        });
    }
    void announce() override {}
    void on_arrival(std::function<void()>) override {}
    void publish(ros2::EntityId publisher, std::string_view cdr) override {
        published[names.at(publisher)].emplace_back(cdr);
    }
    void reply(ros2::EntityId, const ros2::CallId& call, std::string_view cdr) override {
        replies[call.number].emplace_back(cdr);
    }
    std::size_t subscribers(ros2::EntityId publisher) const override {
        return has_listeners || subscribed.contains(names.at(publisher)) ? 1 : 0;
    }
    std::size_t publishers(ros2::EntityId subscription) const override {
        return driven.contains(names.at(subscription)) ? 1 : 0;
    }
    std::string other_type(ros2::EntityId subscription) const override {
        const auto other = other_types.find(names.at(subscription));
        return other == other_types.end() || other->second == types.at(other->first) ? "" : other->second;
    }
    std::uint64_t revision() const override { return ++revision_; }  // tests change what it says at any time
    bool await_confirmed(ros2::EntityId, std::int64_t) override { return true; }
    std::vector<ros2::Incoming> take(std::int64_t) override { return std::exchange(arrived, {}); }
    std::vector<std::string> take_notices() override { return {}; }

    /// Calls a service; returns the number of the call.
    std::int64_t call(const std::string& service, std::string bytes, const std::string& peer_type = "") {
        ros2::CallId id;
        id.number = ++calls_;
        arrived.push_back({services.at(service), id, std::move(bytes), peer_type});
        return calls_;
    }

    /// The entity of this name; 0: there is none.
    ros2::EntityId find(const std::string& name) const {
        for (const auto& [entity, its_name] : names)
            if (its_name == name) return entity;
        return 0;
    }
    /// A node elsewhere sends a message.
    template <ros2::Message M>
    void send(const std::string& topic, const M& message) {
        send_bytes(topic, ros2::to_cdr(message));
    }
    void send_bytes(const std::string& topic, std::string bytes) {
        arrived.push_back({find(topic), {}, std::move(bytes), ""});
    }
    /// How many messages of a topic were published since the last call.
    std::size_t take_published(const std::string& topic) {
        return std::exchange(published[topic], {}).size();
    }

    std::map<ros2::EntityId, std::string> names;  // of nodes: full names
    std::map<ros2::EntityId, ros2::EntityId> node_of;
    std::map<std::string, std::string> types;  // by name
    std::map<std::string, ros2::EntityId> services;
    std::map<std::string, std::vector<std::string>> published;  // by topic
    std::map<std::int64_t, std::vector<std::string>> replies;   // by number of the call
    std::vector<ros2::Incoming> arrived;
    bool has_listeners = true;                       // to all topics
    std::set<std::string> subscribed,                // topics that nodes elsewhere subscribe to
        driven;                                      // topics that they publish
    std::map<std::string, std::string> other_types;  // the types that they have, by topic

  private:
    mutable std::uint64_t revision_ = 0;
    ros2::EntityId last_ = 0;
    std::int64_t calls_ = 0;
};

}  // namespace roboss::test
