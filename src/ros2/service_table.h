// ServiceTable: the services of a node, and who serves them. A call is decoded and handed over with its
// Reply, which is given at once or in a later turn.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros2_types/cdr.h"
#include "ros2_types/transport.h"

namespace roboss::ros2 {

/// The reply to one call of a service; to be given once. It outlives neither transport nor service.
template <Service S>
class Reply {
  public:
    /// To this call.
    Reply(Transport& transport, EntityId service, const CallId& call)
        : transport_(&transport), service_(service), call_(call) {}
    /// Gives it.
    void operator()(const typename S::Response& response) const { give(to_cdr(response)); }
    /// Gives it as bytes: of a response with another layout.
    void give(const std::string& cdr) const { transport_->reply(service_, call_, cdr); }

  private:
    Transport* transport_;
    EntityId service_;
    CallId call_;
};

/// See the top of the file.
class ServiceTable {
  public:
    /// Serves this node. `transport` outlives it.
    ServiceTable(Transport& transport, EntityId node) : transport_(transport), node_(node) {}
    ~ServiceTable() {
        for (const auto& [service, serve] : serves_) transport_.remove(service);
    }
    ServiceTable(const ServiceTable&) = delete;
    ServiceTable& operator=(const ServiceTable&) = delete;

    /// Adds a service; `serve(request, reply)` is called for each call. A service that cannot be added is
    /// named in take_notices().
    template <Service S, class Serve>
    void add(const std::string& name, Serve serve) {
        add_raw<S>(name, type_of_service<S>(),
                   [this, name, serve = std::move(serve)](const Incoming& call, const Reply<S>& reply) {
                       const Result<typename S::Request> request = from_cdr<typename S::Request>(call.bytes);
                       if (!request) return notice(name + ": " + request.error().message);
                       serve(request.value(), reply);
                   });
    }
    /// The same with the call as it came, `serve(incoming, reply)`, under the type that is given.
    template <Service S, class Serve>
    void add_raw(const std::string& name, const ServiceType& type, Serve serve) {
        const Result<EntityId> service = transport_.add_service(node_, name, type);
        if (!service) return notice(service.error().text());
        serves_[service.value()] = [this, serve = std::move(serve)](const Incoming& call) {
            serve(call, Reply<S>(transport_, call.entity, call.call));
        };
    }
    /// Serves a call. False: it is of none of these services.
    bool take(const Incoming& call) {
        const auto serve = serves_.find(call.entity);
        if (serve == serves_.end()) return false;
        serve->second(call);
        return true;
    }
    /// Says something for the log; of many lines, the first are kept.
    void notice(std::string line) {
        constexpr std::size_t kMost = 20;
        if (notices_.size() < kMost) notices_.push_back(std::move(line));
    }
    /// Calls that could not be read, and services that could not be added, since the last call.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

  private:
    Transport& transport_;
    EntityId node_;
    std::map<EntityId, std::function<void(const Incoming&)>> serves_;
    std::vector<std::string> notices_;
};

}  // namespace roboss::ros2
