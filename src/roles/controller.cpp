// The Controller's main loop and its messages.
#include "roles/controller.h"

#include <algorithm>

#include "core/float_env.h"
#include "roles/work_stealing.h"
#include "wire/state_block.h"

namespace roboss {

namespace {
constexpr float kGuessed_ns = 400;  // per tick and degree of freedom, until it is measured
}

StartingPoint beginning_of(const Model& model) {
    StartingPoint start;
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        start.states.push_back(initial_state(model, RobotId(i)));
    return start;
}

Controller::Controller(std::shared_ptr<const Model> model, const ControllerOptions& options,
                       StartingPoint start)
    : model_(std::move(model)),
      options_(options),
      model_server_(model_, options.scene, options.before.models),
      control_(options.before.control),
      roster_(options.before.seats, options.before.first_id),
      clients_(options.clients),
      recorder_(options.log, options.log_ticks, std::max(start.tick, start.logged_until),
                std::move(start.answered)),
      directory_(model_->robots.size(), start.tick),
      target_(start.tick),
      costs_(*model_),
      checkpoints_(model_, start.tick, std::move(start.states)),
      recovery_(roster_, costs_, order_log_, checkpoints_, directory_),
      forecast_(model_),
      length_(options.window),
      views_(model_) {
    epoch_ = options_.before.epoch;
    window_ = options_.before.window;
    const ExactFloatScope exact;
    const std::vector<RobotState>& states = *checkpoints_.states();
    for (std::size_t i = 0; i < states.size(); ++i) {
        hashes_.push_back(state_hash(RobotId(i), tick(), states[i]));
        motions_.push_back(motion_of(*model_, RobotId(i), states[i]));
    }
    next_hashes_ = hashes_;
    for (const LoggedOrder& o : start.orders) order_log_.add(o.order, o.given_at);
}

void Controller::advance(Bus& bus) {
    bus.drain(kControllerAddress, inbox_);
    for (Envelope& envelope : inbox_) handle(bus, envelope);
    if (round_) steal_work(bus, *round_, roster_);
    notice_losses(bus);
    notice_client_losses(bus);
    if (round_ && round_->all_answered()) finish_round();
    if (!round_) views_.serve(bus, {epoch_, directory_, roster_, checkpoint_here()});
    if (!round_) at_boundary(bus);
    if (round_) send_assignments(bus);
    advance_checkpoint(bus);
    acknowledge(bus);
    send_observations(bus, std::exchange(observations_due_, false));
    send_heartbeats(bus);
}

void Controller::send_heartbeats(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (now - heartbeat_sent_ms_ < options_.heartbeat_ms) return;
    heartbeat_sent_ms_ = now;
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id)
        if (roster_.alive(seat_id))
            bus.send(kControllerAddress, roster_.address_of(seat_id), Heartbeat{roster_.id_of(seat_id)});
    for (const ClientSeat& seat : clients_.seats())
        if (seat.serves()) bus.send(kControllerAddress, seat.address, Heartbeat{});
}

void Controller::handle(Bus& bus, Envelope& envelope) {
    const Address& from = envelope.from;
    if (const auto* result = std::get_if<WindowResult>(&envelope.message)) {
        if (const auto seat_id = heard_from(bus, from)) take_result(*seat_id, *result);
    } else if (const auto* late = std::get_if<Late>(&envelope.message)) {
        if (const auto seat_id = heard_from(bus, from); seat_id && round_) round_->take_late(*seat_id, *late);
    } else if (const auto* alive = std::get_if<Heartbeat>(&envelope.message)) {
        heard_from(bus, from, alive->simulator);
    } else if (const auto* request = std::get_if<StateRequest>(&envelope.message)) {
        checkpoints_.serve(bus, from, *request);
    } else if (const auto* reply = std::get_if<StateReply>(&envelope.message)) {
        checkpoints_.accept(*reply);
    } else if (const auto* client_reply = std::get_if<ClientReply>(&envelope.message)) {
        take_reply(bus, from, *client_reply);
    } else if (const auto* hello = std::get_if<Hello>(&envelope.message)) {
        take_hello(bus, from, *hello);
    } else if (const auto* client_hello = std::get_if<ClientHello>(&envelope.message)) {
        take_client_hello(bus, from, *client_hello);
    } else if (const auto* leave = std::get_if<LeaveRequest>(&envelope.message)) {
        take_leave(bus, from, *leave);
    } else if (const auto* bye = std::get_if<ClientBye>(&envelope.message)) {
        take_bye(bus, from, *bye);
    } else if (const auto* asked = std::get_if<ControlRequest>(&envelope.message)) {
        control_.take(bus, from, *asked);
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

ControllerOptions::Before Controller::hand_over() {
    ControllerOptions::Before before = options_.before;
    before.seats = roster_.size();
    before.epoch = epoch_ + 1;
    before.window = window_;
    before.models = model_server_.hashes();
    before.control = control_;
    return before;
}

void Controller::start_log(RunLog* log, Tick log_ticks) {
    recorder_.start(log, log_ticks);
    for (std::size_t i = 0; i < clients_.seats().size(); ++i)
        if (clients_.seats()[i].joined) recorder_.joined(ClientId(i), clients_.seats()[i].name);
    for (const LoggedOrder& o : order_log_.pending(tick())) recorder_.order(o.order, o.given_at);
}

bool Controller::waits_for_log() const {
    return round_ && !round_->span().recovery && round_->all_answered() && !recorder_.may_commit();
}

void Controller::set_window(Tick ticks) {
    length_ = WindowLength(ticks);
}

bool Controller::dismiss_simulator() {
    const std::vector<SeatId> workers = roster_.workers();
    if (workers.size() < 2) return false;
    roster_.seat(workers.back()).leaving = true;
    return true;
}

std::optional<SeatId> Controller::heard_from(Bus& bus, const Address& from) {
    const auto seat_id = roster_.seat_at(from);
    if (seat_id) roster_.seat(*seat_id).heard_ms = bus.now_ms();
    return seat_id;
}

std::optional<SeatId> Controller::heard_from(Bus& bus, const Address& from, SimulatorId id) {
    // Seats of an earlier Controller: their holders have to join again.
    const auto seat_id = roster_.seat_of(id);
    if (!seat_id || roster_.seat(*seat_id).address != from) {
        bus.send(kControllerAddress, from, Expelled{id});
        return std::nullopt;
    }
    SimulatorSeat& seat = roster_.seat(*seat_id);
    if (seat.alive) {
        seat.heard_ms = bus.now_ms();
    } else if (seat.leaving) {
        bus.send(kControllerAddress, from, Goodbye{id});
    } else {
        bus.send(kControllerAddress, from, Expelled{id});
    }
    return seat.alive ? seat_id : std::nullopt;
}

void Controller::take_leave(Bus& bus, const Address& from, const LeaveRequest& request) {
    const auto seat_id = heard_from(bus, from, request.simulator);
    if (!seat_id) return;
    SimulatorSeat& seat = roster_.seat(*seat_id);
    if (!seat.leaving) notices_.add("simulator " + std::to_string(*seat_id) + " wants to leave");
    seat.leaving = true;
}

void Controller::dismiss(Bus& bus, const std::string& reason) {
    for (SeatId seat_id = 0; seat_id < roster_.size(); ++seat_id)
        if (roster_.alive(seat_id))
            bus.send(kControllerAddress, roster_.seat(seat_id).address, RunOver{reason});
    for (const ClientSeat& seat : clients_.seats())
        if (seat.joined) bus.send(kControllerAddress, seat.address, RunOver{reason});
}

bool Controller::settled() const {
    return (resting() || !started_) &&
           std::all_of(clients_.seats().begin(), clients_.seats().end(), [this](const ClientSeat& seat) {
               return !seat.synchronous || seat.unanswered.empty() || seat.unanswered.front() >= tick();
           });
}

Result<> Controller::submit(const Order& order) {
    if (Result<> checked = check_order(*model_, order); !checked) return checked;
    if (order.apply_at < stampable())
        return Error{"an order for tick " + std::to_string(order.apply_at) +
                         " comes too late, the world is at tick " + std::to_string(stampable()),
                     "give a later time", "too-late"};
    // given before this tick is observed: a save or a branch at this tick includes it
    const Tick given_at = std::max(tick(), recorder_.logged_until()) - 1;
    if (order_log_.add(order, given_at)) recorder_.order(order, given_at);
    return Ok{};
}

}  // namespace roboss
