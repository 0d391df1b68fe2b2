// See foxglove_transport.h.
#include "foxglove/foxglove_transport.h"

#include <chrono>

#include "foxglove/hub.h"
#include "foxglove/server_session.h"

namespace roboss::foxglove {

using ros2::EntityId;

FoxgloveTransport::FoxgloveTransport() {
    // Clients tell by it whether they are connected to the same server again.
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    hub_ = std::make_unique<Hub>(std::to_string(now.count()));
}

FoxgloveTransport::~FoxgloveTransport() = default;

Result<std::unique_ptr<FoxgloveTransport>> FoxgloveTransport::listen(const FoxgloveOptions& options) {
    std::unique_ptr<FoxgloveTransport> transport(new FoxgloveTransport());
    transport->server_ = std::make_unique<Server>(*transport->hub_, options);
    if (Result<> listening = transport->server_->listen(); !listening) return listening.error();
    transport->server_->start();
    return transport;
}

std::string FoxgloveTransport::url() const {
    return server_->url();
}

std::size_t FoxgloveTransport::clients() const {
    return hub_->clients();
}

EntityId FoxgloveTransport::add_node(const std::string& space, const std::string& name) {
    return hub_->add_node(space, name);
}

Result<EntityId> FoxgloveTransport::add_publisher(EntityId node, const std::string& topic,
                                                  const ros2::MessageType& type, const ros2::Qos& qos) {
    return hub_->add_publisher(node, topic, type, qos);
}

Result<EntityId> FoxgloveTransport::add_subscription(EntityId node, const std::string& topic,
                                                     const ros2::MessageType& type, const ros2::Qos& qos) {
    return hub_->add_subscription(node, topic, type, qos);
}

Result<EntityId> FoxgloveTransport::add_service(EntityId node, const std::string& service,
                                                const ros2::ServiceType& type) {
    return hub_->add_service(node, service, type);
}

void FoxgloveTransport::remove(EntityId entity) {
    hub_->remove(entity);
}

void FoxgloveTransport::announce() {
    hub_->announce();
}

void FoxgloveTransport::publish(EntityId publisher, std::string_view cdr) {
    hub_->publish(publisher, cdr);
}

void FoxgloveTransport::reply(EntityId service, const ros2::CallId& call, std::string_view cdr) {
    hub_->reply(service, call, cdr);
}

std::size_t FoxgloveTransport::subscribers(EntityId publisher) const {
    return hub_->subscribers(publisher);
}

std::uint64_t FoxgloveTransport::revision() const {
    return hub_->revision();
}

std::size_t FoxgloveTransport::publishers(EntityId subscription) const {
    return hub_->publishers(subscription);
}

bool FoxgloveTransport::await_confirmed(EntityId publisher, std::int64_t ms_max) {
    return hub_->await_sent(publisher, ms_max);
}

std::vector<ros2::Incoming> FoxgloveTransport::take(std::int64_t wait_ms) {
    return hub_->take(wait_ms);
}

void FoxgloveTransport::on_arrival(std::function<void()> ring) {
    hub_->on_arrival(std::move(ring));
}

std::vector<std::string> FoxgloveTransport::take_notices() {
    return hub_->take_notices();
}

}  // namespace roboss::foxglove
