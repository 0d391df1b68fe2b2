// The Controller's main loop and its messages.
#include "roles/controller/controller.h"

#include <algorithm>

#include "core/check.h"
#include "core/float_env.h"
#include "roles/controller/work_stealing.h"

namespace roboss {

namespace {

ClientServiceOptions client_options(const ControllerOptions& options) {
    return {options.clients,        options.seed,           options.resend_ms,
            options.client_loss_ms, options.client_gone_ms, options.before.went_back};
}

PlannerOptions planner_options(const ControllerOptions& options) {
    return {options.window, options.window_max, options.forecast, options.ahead_least,
            options.stealing_least_ns};
}

}  // namespace

StartingPoint beginning_of(const Model& model) {
    StartingPoint start;
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        start.states.push_back(initial_state(model, RobotId(i)));
    return start;
}

const char* name_of(Phase phase) {
    switch (phase) {
        case Phase::kWaiting:
            return "waiting";
        case Phase::kIdle:
            return "idle";
        case Phase::kStepping:
            return "stepping";
        case Phase::kRecovering:
            return "recovering";
        case Phase::kReleasing:
            return "releasing";
        case Phase::kFailed:
            return "failed";
    }
    return "";
}

Controller::Controller(std::shared_ptr<const Model> model, const ControllerOptions& options,
                       StartingPoint start)
    : model_(std::move(model)),
      options_(options),
      model_server_(model_, options.scene, options.visuals, options.before.models),
      control_(options.before.control),
      roster_(options.before.first_id),
      recorder_(options.log, options.log_ticks, std::max(start.tick, start.logged_until),
                std::move(start.answered)),
      directory_(model_->robots.size(), start.tick),
      clients_(model_, client_options(options), model_server_, order_log_, recorder_, directory_, notices_),
      views_(model_),
      costs_(*model_),
      checkpoints_(model_, start.tick, std::move(start.states)),
      recovery_(roster_, costs_, order_log_, checkpoints_, directory_),
      planner_(model_, planner_options(options), *checkpoints_.states(), roster_, costs_, order_log_),
      target_(start.tick),
      epoch_(options.before.epoch),
      window_(options.before.window) {
    const ExactFloatScope exact;
    const std::vector<RobotState>& states = *checkpoints_.states();
    for (std::size_t i = 0; i < states.size(); ++i)
        hashes_.push_back(state_hash(RobotId(i), tick(), states[i]));
    next_hashes_ = hashes_;
    for (const LoggedOrder& o : start.orders) order_log_.add(o.order, o.given_at);
}

void Controller::advance(Bus& bus) {
    bus.drain(kControllerAddress, inbox_);
    for (Envelope& envelope : inbox_) handle(bus, envelope);
    if (round_) steal_work(bus, *round_, roster_);
    notice_losses(bus);
    clients_.notice_losses(bus.now_ms());
    if (round_ && round_->all_answered()) finish_round();
    if (!round_) {
        const bool has_states = checkpoints_.tick() == tick();
        views_.serve(bus, {epoch_, directory_, roster_, has_states ? checkpoints_.states().get() : nullptr});
        at_boundary(bus);
    }
    if (round_) send_assignments(bus);
    advance_checkpoint(bus);
    clients_.acknowledge(bus);
    if (rests_for_long(bus.now_ms())) clients_.show_rest();
    clients_.send_observations(bus, roster_);
    send_heartbeats(bus);
    check_phase();
}

/// A paused run; not one that waits for its next window in real time.
bool Controller::rests_for_long(std::int64_t now_ms) {
    constexpr std::int64_t kLong_ms = 50;
    if (!resting() || rest_tick_ != tick()) rest_tick_ = resting() ? tick() : -1, rest_since_ms_ = now_ms;
    return rest_tick_ >= 0 && now_ms - rest_since_ms_ >= kLong_ms;
}

void Controller::enter(Phase phase) {
    const bool allowed = phase == Phase::kIdle ? phase_ != Phase::kIdle && phase_ != Phase::kFailed
                                               : phase_ == Phase::kIdle && phase != Phase::kWaiting;
    ROBOSS_CHECK(allowed, std::string("from phase ") + name_of(phase_) + " to " + name_of(phase) +
                              " at tick " + std::to_string(tick()));
    phase_ = phase;
}

void Controller::check_phase() const {
    const bool steps = phase_ == Phase::kStepping || phase_ == Phase::kRecovering;
    ROBOSS_CHECK(round_.has_value() == steps, std::string(round_ ? "a window" : "no window") +
                                                  " is in progress in phase " + name_of(phase_));
    ROBOSS_CHECK(!round_ || round_->span().recovery == (phase_ == Phase::kRecovering),
                 std::string("another kind of window is in progress in phase ") + name_of(phase_));
}

void Controller::handle(Bus& bus, Envelope& envelope) {
    const Address& from = envelope.from;
    const Rights* rights = envelope.rights.get();
    if (const auto* result = std::get_if<WindowResult>(&envelope.message)) {
        if (const auto seat_id = roster_.heard_from(bus, from)) take_result(*seat_id, *result);
    } else if (const auto* late = std::get_if<Late>(&envelope.message)) {
        if (const auto seat_id = roster_.heard_from(bus, from); seat_id && round_)
            round_->take_late(*seat_id, *late);
    } else if (const auto* alive = std::get_if<Heartbeat>(&envelope.message)) {
        roster_.heard_from(bus, from, alive->simulator);
    } else if (const auto* request = std::get_if<StateRequest>(&envelope.message)) {
        checkpoints_.serve(bus, from, *request);
    } else if (const auto* reply = std::get_if<StateReply>(&envelope.message)) {
        checkpoints_.accept(*reply);
    } else if (const auto* client_reply = std::get_if<ClientReply>(&envelope.message)) {
        counters_.orders_refused += clients_.take_reply(bus, from, *client_reply, scheduled_until(), rights);
    } else if (const auto* hello = std::get_if<Hello>(&envelope.message)) {
        take_hello(bus, from, *hello);
    } else if (const auto* client_hello = std::get_if<ClientHello>(&envelope.message)) {
        clients_.take_hello(bus, from, *client_hello, scheduled_until(), rights);
    } else if (const auto* leave = std::get_if<LeaveRequest>(&envelope.message)) {
        take_leave(bus, from, *leave);
    } else if (const auto* bye = std::get_if<ClientBye>(&envelope.message)) {
        clients_.take_bye(bus, from, *bye, rights);
    } else if (const auto* asked = std::get_if<ControlRequest>(&envelope.message)) {
        take_request(bus, from, *asked, rights);
    } else if (const auto* wanted = std::get_if<ModelRequest>(&envelope.message)) {
        bus.send(kControllerAddress, from, model_server_.part(*wanted));
    } else if (const auto* view = std::get_if<ViewRequest>(&envelope.message)) {
        views_.take(bus, from, *view);
    }
}

void Controller::take_hello(Bus& bus, const Address& from, const Hello& hello) {
    if (from.role != Role::kSimulator)
        return notices_.dropped("Hello", tick(), "its sender is not a Simulator");
    if (model_server_.is_earlier(hello.model_hash))
        return bus.send(kControllerAddress, from, ModelChanged{model_->hash});
    if (hello.model_hash != model_->hash)
        return bus.send(kControllerAddress, from,
                        Refused{"its world (model hash " + to_hex(hello.model_hash) +
                                ") is not this run's (" + to_hex(model_->hash) + ")"});
    bool is_new = false;
    const auto seat_id = roster_.seat_for(from, hello, bus.now_ms(), is_new);
    if (!seat_id) return;
    if (is_new)
        notices_.add("simulator " + std::to_string(*seat_id) +
                     (hello.name.empty() ? "" : " (" + hello.name + ")") + " joined at tick " +
                     std::to_string(tick()));
    counters_.simulators = roster_.alive_count();
    bus.send(kControllerAddress, from, Welcome{roster_.id_of(*seat_id)});
}

void Controller::take_request(Bus& bus, const Address& from, const ControlRequest& request,
                              const Rights* rights) {
    const Result<> permitted = permit(rights, request.action);
    if (permitted) return control_.take(bus, from, request);
    notices_.add_refusal("requests of '" + rights->key + "'", permitted.error());
    bus.send(kControllerAddress, from, ControlReply{request.number, ControlRefused(permitted.error())});
}

ControllerOptions::Before Controller::hand_over() {
    ControllerOptions::Before before = options_.before;
    before.first_id += static_cast<std::uint32_t>(roster_.size());  // its ids are never given again
    before.epoch = epoch_ + 1;
    before.window = window_;
    before.models = model_server_.hashes();
    before.control = control_;
    return before;
}

void Controller::start_log(RunLog* log, Tick log_ticks) {
    recorder_.start(log, log_ticks);
    // Also those that are still to join: a run killed before that continues with the same Clients.
    for (std::size_t i = 0; i < clients_.seats().size(); ++i)
        recorder_.joined(ClientId(i), clients_.seats()[i].name);
    for (const LoggedOrder& o : order_log_.pending(tick())) recorder_.order(o.order, o.given_at);
}

bool Controller::waits_for_log() const {
    return phase_ == Phase::kStepping && round_->all_answered() && !recorder_.may_commit();
}

std::string Controller::waits_for() const {
    std::vector<std::string> whom;
    if (phase_ == Phase::kStepping || phase_ == Phase::kRecovering) {
        if (waits_for_log()) whom.emplace_back("the disk of the journal");
        for (const SeatId seat_id : round_->unanswered())
            whom.push_back("simulator " + std::to_string(seat_id) + " (" + roster_.seat(seat_id).name + ")");
    } else if (phase_ == Phase::kReleasing) {
        whom.emplace_back("the states of Simulators that leave");
    } else {
        const std::size_t here = roster_.workers().size(), wanted = started() ? 1 : options_.simulators;
        if (here < wanted) whom.push_back(std::to_string(wanted - here) + " Simulators to join");
        for (const std::string& name : clients_.awaited(tick())) whom.push_back("client '" + name + "'");
    }
    constexpr std::size_t kMost = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(whom.size(), kMost); ++i) text += (i == 0 ? "" : ", ") + whom[i];
    return whom.size() <= kMost ? text : text + " and " + std::to_string(whom.size() - kMost) + " more";
}

bool Controller::dismiss_simulator() {
    const std::vector<SeatId> workers = roster_.workers();
    if (workers.size() < 2) return false;
    roster_.seat(workers.back()).leaving = true;
    return true;
}

void Controller::take_leave(Bus& bus, const Address& from, const LeaveRequest& request) {
    const auto seat_id = roster_.heard_from(bus, from, request.simulator);
    if (!seat_id) return;
    SimulatorSeat& seat = roster_.seat(*seat_id);
    if (!seat.leaving) notices_.add("simulator " + std::to_string(*seat_id) + " wants to leave");
    seat.leaving = true;
}

void Controller::dismiss(Bus& bus, const RunOver& over) {
    roster_.dismiss(bus, over);
    clients_.dismiss(bus, over);
}

bool Controller::settled() const {
    return (resting() || !started()) && clients_.all_replied(tick());
}

Result<> Controller::submit(const Order& order) {
    if (Result<> checked = check_order(*model_, order); !checked) return checked;
    const Tick earliest = clients_.stampable(scheduled_until());
    if (order.apply_at < earliest)
        return Error{"an order for tick " + std::to_string(order.apply_at) +
                         " comes too late, the world is at tick " + std::to_string(earliest),
                     "give a later time", "too-late"};
    // given before this tick is observed: a save or a branch at this tick includes it
    const Tick given_at = std::max(tick(), recorder_.logged_until()) - 1;
    if (order_log_.add(order, given_at)) recorder_.order(order, given_at);
    return Ok{};
}

std::vector<MemberReport> Controller::members() const {
    std::vector<MemberReport> members(roster_.size());
    double busiest_ns = 0;
    for (const SeatId seat_id : roster_.workers())
        busiest_ns = std::max(busiest_ns, roster_.seat(seat_id).spent_ns);
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id) {
        const SimulatorSeat& seat = roster_.seat(seat_id);
        MemberReport& member = members[seat_id];
        member = {seat_id, seat.name, seat.threads, seat.alive, seat.leaving, 0, 0, 0, 0, seat.address};
        if (!seat.alive) continue;
        member.step_us = 1e-3 * seat.spent_ns;
        member.load = busiest_ns > 0 ? seat.spent_ns / busiest_ns : 0;
    }
    for (const SeatId seat_id : directory_.holders())
        if (seat_id < members.size()) ++members[seat_id].robots;
    for (std::size_t i = 0; i < islands_.count(); ++i)
        if (const SeatId seat_id = directory_.holder_of(islands_.of(i).front()); seat_id < members.size())
            ++members[seat_id].islands;
    return members;
}

}  // namespace roboss
