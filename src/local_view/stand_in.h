// StandIn: answers, for a LocalRun, what a Gateway asks a Controller. The Bus is in this process: nothing is
// lost, late or out of order.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "bus/in_process_bus.h"
#include "local/local_run.h"
#include "roles/controller/control_service.h"
#include "roles/controller/model_server.h"
#include "roles/controller/view_service.h"

namespace roboss {

class StandIn {
  public:
    using SceneOf = ModelServer::SceneOf;

    /// Of this Model only; make another for another one. `scene` and `visuals` make their bytes, at the
    /// first request.
    StandIn(std::shared_ptr<const Model> model, SceneOf scene, SceneOf visuals)
        : model_(model),
          model_server_(model, std::move(scene), std::move(visuals), {}),
          views_(model),
          layout_(*model) {}

    const Model& model() const { return *model_; }
    /// Who has asked for views.
    std::vector<Address> viewers() const { return {viewers_.begin(), viewers_.end()}; }
    /// Answers the messages that have come, and sends the views that are due.
    void advance(InProcessBus& bus, LocalRun& run);

  private:
    /// A Client that gives orders and observes nothing.
    struct Seat {
        ClientId client;
        std::uint64_t last_reply = 0;
    };

    void take(InProcessBus& bus, LocalRun& run, const Envelope& envelope);
    void welcome(InProcessBus& bus, const LocalRun& run, const Address& from);
    void take_reply(InProcessBus& bus, LocalRun& run, const Address& from, const ClientReply& reply);
    ControlOutcome outcome_of(const ControlAction& action, const LocalRun& run, std::int64_t now_ms);
    RunStatus status_of(const LocalRun& run, bool robots, std::int64_t now_ms);
    void send_due_views(InProcessBus& bus, const LocalRun& run);

    std::shared_ptr<const Model> model_;
    ModelServer model_server_;
    ControlService control_;
    ViewService views_;
    ViewLayout layout_;
    std::uint64_t serial_ = 0;  // of the views sent
    std::set<Address> viewers_;
    std::map<Address, Seat> seats_;
    std::uint32_t clients_ = 0;
    Tick moved_to_ = 0;  // tick of the last status
    std::int64_t moved_ms_ = 0;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
