// TestTransport: a Transport without a middleware. A test calls services and reads what was published.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros2_types/cdr.h"
#include "ros2_types/transport.h"

namespace roboss::test {

class TestTransport : public ros2::Transport {
  public:
    ros2::EntityId add_node(const std::string&, const std::string&) override { return ++last_; }
    Result<ros2::EntityId> add_publisher(ros2::EntityId, const std::string& topic,
                                         const ros2::MessageType& type, const ros2::Qos&) override {
        names[++last_] = topic, types[topic] = type.name;
        return last_;
    }
    Result<ros2::EntityId> add_subscription(ros2::EntityId, const std::string& topic,
                                            const ros2::MessageType& type, const ros2::Qos&) override {
        names[++last_] = topic, types[topic] = type.name;
        return last_;
    }
    Result<ros2::EntityId> add_service(ros2::EntityId, const std::string& service,
                                       const ros2::ServiceType& type) override {
        names[++last_] = service, types[service] = type.name, services[service] = last_;
        return last_;
    }
    void remove(ros2::EntityId entity) override {
        services.erase(names[entity]);
        names.erase(entity);
    }
    void announce() override {}
    void on_arrival(std::function<void()>) {}
    void publish(ros2::EntityId publisher, std::string_view cdr) override {
        published[names.at(publisher)].emplace_back(cdr);
    }
    void reply(ros2::EntityId, const ros2::CallId& call, std::string_view cdr) override {
        replies[call.number].emplace_back(cdr);
    }
    std::size_t subscribers(ros2::EntityId) const override { return has_listeners ? 1 : 0; }
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

    std::map<ros2::EntityId, std::string> names;
    std::map<std::string, std::string> types;  // by name
    std::map<std::string, ros2::EntityId> services;
    std::map<std::string, std::vector<std::string>> published;  // by topic
    std::map<std::int64_t, std::vector<std::string>> replies;   // by number of the call
    std::vector<ros2::Incoming> arrived;
    bool has_listeners = true;

  private:
    ros2::EntityId last_ = 0;
    std::int64_t calls_ = 0;
};

}  // namespace roboss::test
