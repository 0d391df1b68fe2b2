// See stand_in.h.
#include "local_view/stand_in.h"

#include "roles/send_views.h"

namespace roboss {

namespace {

constexpr std::int64_t kRestsAfter_ms = 1'000;  // without a step: pages show that the world rests

Error not_here(const ControlAction& action) {
    return {std::string("'") + control_verb(action) + "' is for runs of `roboss run`",
            "here a program steps the world: step, reset, spawn and save there", "program-steps"};
}

}  // namespace

void StandIn::advance(InProcessBus& bus, LocalRun& run) {
    ROBOSS_CHECK(run.model().hash == model_->hash, "a StandIn is for one Model");
    bus.drain(kControllerAddress, inbox_);
    for (const Envelope& envelope : inbox_) take(bus, run, envelope);
    for (const ControlCall& call : control_.take_calls())
        control_.answer(bus, call, outcome_of(call.request.action, run, bus.now_ms()));
    send_due_views(bus, run);
}

void StandIn::take(InProcessBus& bus, LocalRun& run, const Envelope& envelope) {
    const Address& from = envelope.from;
    if (const auto* whole = std::get_if<ModelRequest>(&envelope.message)) {
        bus.send(kControllerAddress, from, model_server_.part(*whole));
    } else if (const auto* view = std::get_if<ViewRequest>(&envelope.message)) {
        viewers_.insert(from);
        views_.take(bus, from, *view);
    } else if (const auto* request = std::get_if<ControlRequest>(&envelope.message)) {
        control_.take(bus, from, *request);
    } else if (std::holds_alternative<ClientHello>(envelope.message)) {
        welcome(bus, run, from);
    } else if (const auto* reply = std::get_if<ClientReply>(&envelope.message)) {
        take_reply(bus, run, from, *reply);
    } else if (const auto* bye = std::get_if<ClientBye>(&envelope.message)) {
        seats_.erase(from);
        bus.send(kControllerAddress, from, ReplyAck{bye->client, bye->number, {}});
    }
}

void StandIn::welcome(InProcessBus& bus, const LocalRun& run, const Address& from) {
    const auto [seat, is_new] = seats_.try_emplace(from);
    if (is_new) seat->second.client = ClientId(clients_++);
    bus.send(kControllerAddress, from, ClientWelcome{seat->second.client, run.tick() + 1, run.seed()});
}

/// Replies are numbered; one that is sent again is acknowledged again.
void StandIn::take_reply(InProcessBus& bus, LocalRun& run, const Address& from, const ClientReply& reply) {
    const auto seat = seats_.find(from);
    if (seat == seats_.end() || seat->second.client != reply.client)
        return bus.send(kControllerAddress, from, ClientUnknown{reply.client});
    ReplyAck ack{reply.client, seat->second.last_reply, {}};
    if (reply.number == seat->second.last_reply + 1) {
        ack.number = seat->second.last_reply = reply.number;
        for (const ClientOrder& order : reply.orders)
            if (const Result<> given = run.order(order.robot, order.action); !given)
                ack.refused.push_back({order.sequence, given.error().text(), given.error().code});
    }
    bus.send(kControllerAddress, from, std::move(ack));
}

ControlOutcome StandIn::outcome_of(const ControlAction& action, const LocalRun& run, std::int64_t now_ms) {
    if (const auto* status = std::get_if<GetStatus>(&action)) return status_of(run, status->robots, now_ms);
    if (std::holds_alternative<GetGroups>(action)) {
        const std::size_t robots = model_->robots.size();
        return RobotGroups{model_->hash, std::vector<std::int32_t>(robots, 0),
                           std::vector<std::int32_t>(robots, -1)};
    }
    return ControlRefused(not_here(action));
}

RunStatus StandIn::status_of(const LocalRun& run, bool robots, std::int64_t now_ms) {
    if (run.tick() != moved_to_) moved_to_ = run.tick(), moved_ms_ = now_ms;
    RunStatus status;
    status.world = model_->name;
    status.tick = run.tick();
    status.time_s = run.time_s();
    status.paused = now_ms - moved_ms_ > kRestsAfter_ms;
    status.model_hash = model_->hash;
    status.state_hash = run.hash();
    status.robot_count = model_->robots.size();
    MemberStatus here;  // pages wait for a run without Simulators
    here.name = "this program";
    here.threads = static_cast<std::uint32_t>(run.threads());
    here.robots = model_->robots.size();
    here.load = 1;
    status.members.push_back(std::move(here));
    if (robots)
        for (const Robot& robot : model_->robots) status.robots.push_back(robot.name);
    return status;
}

void StandIn::send_due_views(InProcessBus& bus, const LocalRun& run) {
    if (views_.empty()) return;
    const std::vector<ViewService::Due> all = views_.take_due(run.tick(), bus.now_ms());
    if (all.empty()) return;
    std::vector<RobotId> everybody;
    for (std::size_t r = 0; r < model_->robots.size(); ++r) everybody.emplace_back(r);
    ++serial_;
    for (const ViewService::Due& due : all) {
        const ViewDue part{0,
                           serial_,
                           run.tick(),
                           due.viewer,
                           due.view ? everybody : std::vector<RobotId>{},
                           due.exact_all ? everybody : due.exact};
        const auto state = [&](RobotId robot) { return &run.state(robot); };
        send_views(*model_, layout_, part, state, kControllerAddress, bus);
    }
}

}  // namespace roboss
