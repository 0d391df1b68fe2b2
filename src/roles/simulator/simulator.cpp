// The Simulator: messages in, results out.
#include "roles/simulator/simulator.h"

#include <algorithm>
#include <tuple>

#include "core/thread_cpu.h"
#include "roles/send_views.h"

namespace roboss {

namespace {

constexpr double kLateFrom = 0.5;       // of an assignment's ticks; earlier estimates are too rough
constexpr double kLateShare = 0.04;     // beyond due_ns, relative to it
constexpr std::size_t kEarlyMost = 64;  // more would be a sender's error; dropped states are requested

template <class A, class B>
bool same_attempt(const A& a, const B& b) {
    return std::tie(a.epoch, a.window, a.attempt) == std::tie(b.epoch, b.window, b.attempt);
}

template <class A, class B>
bool is_newer(const A& a, const B& b) {
    return std::tie(a.epoch, a.window, a.attempt) > std::tie(b.epoch, b.window, b.attempt);
}

bool good_orders(const Model& model, const std::vector<Order>& orders) {
    return std::is_sorted(orders.begin(), orders.end(), comes_before) &&
           std::all_of(orders.begin(), orders.end(),
                       [&](const Order& o) { return check_order(model, o).ok(); });
}

/// Whether all robots exist, none occurs twice, robots ascend within islands, and islands by their first
/// robot.
bool good_islands(const Model& model, const Assignment& assignment) {
    std::vector<bool> seen(model.robots.size(), false);
    std::optional<RobotId> root;
    for (std::size_t i = 0; i + 1 < assignment.island_offsets.size(); ++i) {
        const std::size_t first = assignment.island_offsets[i];
        if (root && assignment.robots[first] <= *root) return false;
        root = assignment.robots[first];
        for (std::size_t k = first; k < assignment.island_offsets[i + 1]; ++k) {
            const RobotId robot = assignment.robots[k];
            if (robot.index() >= seen.size() || seen[robot.index()]) return false;
            if (k > first && robot < assignment.robots[k - 1]) return false;
            seen[robot.index()] = true;
        }
    }
    return true;
}

bool all_known(const Model& model, std::span<const RobotId> robots) {
    return std::all_of(robots.begin(), robots.end(),
                       [&](RobotId robot) { return robot.index() < model.robots.size(); });
}

}  // namespace

Simulator::Simulator(std::shared_ptr<const Model> model, const Address& self, const SimulatorOptions& options,
                     ThreadPool& pool)
    : model_(std::move(model)),
      self_(self),
      options_(options),
      store_(*model_),
      stepper_(model_, pool, stepping_options()) {}

SteppingOptions Simulator::stepping_options() const {
    SteppingOptions stepping{nullptr, nullptr, options_.lanes, options_.look_up, options_.now, nullptr};
    if (options_.measure_cpu)
        stepping.clock = options_.cpu_clock ? options_.cpu_clock : thread_cpu_ns;
    else
        stepping.counted = options_.counted;
    stepping.abandons = [this] { return unwanted_ || (options_.abandons && options_.abandons()); };
    return stepping;
}

void Simulator::advance(Bus& bus) {
    if (gone_) return;
    bus.drain(self_, inbox_);
    for (Envelope& envelope : inbox_) handle(bus, envelope);
    keep_in_touch(bus);
    if (gone_ || !assignment_) return;
    if (!pull_.complete()) return pull_.advance(bus, self_, options_.resend_ms);
    reported_late_ = cut_ = unwanted_ = false;
    std::optional<WindowResult> result =
        stepper_.step(*assignment_, store_,
                      [&](const StepProgress& progress) { return serve_while_stepping(bus, progress); });
    assignment_.reset();
    if (!result) return keep_wanted(), handle_later(bus);
    answer_ = std::move(result);
    bus.send(self_, kControllerAddress, *answer_);
    catch_up(bus);
}

/// Work that can wait until the result is sent: everybody waits for the result.
void Simulator::catch_up(Bus& bus) {
    keep_wanted();
    for (const RobotResult& robot : answer_->robots) store_.copy_ahead(robot.robot);
    handle_later(bus);
}

void Simulator::handle_later(Bus& bus) {
    for (Envelope& envelope : std::exchange(later_, {})) handle(bus, envelope);
}

/// The slots still have these states, since no other assignment has begun.
void Simulator::keep_wanted() {
    store_.keep(to_keep_.robots, to_keep_.tick);
    to_keep_.robots.clear();
}

void Simulator::handle(Bus& bus, Envelope& envelope) {
    if (auto* assignment = std::get_if<Assignment>(&envelope.message)) {
        take_assignment(bus, *assignment);
    } else if (auto* ahead = std::get_if<OrdersAhead>(&envelope.message)) {
        take_ahead(bus, *ahead);
    } else if (const auto* request = std::get_if<StateRequest>(&envelope.message)) {
        serve(bus, envelope.from, *request);
    } else if (const auto* due = std::get_if<ViewDue>(&envelope.message)) {
        show(bus, *due);
    } else if (auto* reply = std::get_if<StateReply>(&envelope.message)) {
        take_states(*reply);
    } else if (const auto* welcome = std::get_if<Welcome>(&envelope.message)) {
        if (!id_.valid()) take_seat(bus, welcome->simulator);
    } else if (const auto* expelled = std::get_if<Expelled>(&envelope.message)) {
        if (expelled->simulator == id_) reset(bus);
    } else if (const auto* goodbye = std::get_if<Goodbye>(&envelope.message)) {
        if (goodbye->simulator != id_) return;
        gone_ = true;
        dismissed_ = !leaving_;
    } else if (std::holds_alternative<ModelChanged>(envelope.message)) {
        if (!id_.valid()) gone_ = outdated_ = true;
    } else if (const auto* refused = std::get_if<Refused>(&envelope.message)) {
        refusal_ = refused->reason;
        gone_ = true;
    } else if (const auto* over = std::get_if<RunOver>(&envelope.message)) {
        over_ = over->reason;
        failed_ = over->failed;
        gone_ = true;
    }
    if (gone_) bus.end_keep_alive(self_);
}

/// If it is outdated, the Controller will expel it.
void Simulator::take_seat(Bus& bus, SimulatorId id) {
    id_ = id;
    bus.keep_alive(self_, kControllerAddress, Heartbeat{id_});
}

void Simulator::take_assignment(Bus& bus, Assignment& assignment) {
    if (assignment.simulator != id_) return;
    if (answer_ && same_attempt(assignment, *answer_)) return bus.send(self_, kControllerAddress, *answer_);
    if ((answer_ && !is_newer(assignment, *answer_)) || (assignment_ && !is_newer(assignment, *assignment_)))
        return;
    if (awaiting_orders_ && is_newer(*awaiting_orders_, assignment)) return;
    if (const std::string flaw = flaw_of(assignment); !flaw.empty())
        return note_dropped("Assignment", assignment.window, flaw);
    awaiting_orders_.reset();
    if (assignment.ahead != 0) {
        if (!ahead_ || ahead_->window != assignment.ahead)
            return void(awaiting_orders_ = std::move(assignment));
        add_ahead(assignment);
    }
    begin_assignment(bus, assignment);
}

/// Why this assignment cannot be stepped here; empty: it can.
std::string Simulator::flaw_of(const Assignment& assignment) const {
    if (!good_islands(*model_, assignment) || !all_known(*model_, assignment.keep))
        return "its robots are invalid";
    if (!good_orders(*model_, assignment.orders)) return "its orders are invalid";
    std::vector<bool> comes(model_->robots.size(), false);
    for (const Holding& holding : assignment.hand_offs) {
        if (!all_known(*model_, holding.robots)) return "its robots are invalid";
        for (const RobotId robot : holding.robots) comes[robot.index()] = true;
    }
    for (const RobotId robot : assignment.robots)
        if (!comes[robot.index()] && !store_.has(robot, assignment.from))
            return "robot " + std::to_string(robot.value) + " is not here at tick " +
                   std::to_string(assignment.from);
    return {};
}

void Simulator::note_dropped(const char* message, std::uint64_t window, const std::string& why) {
    constexpr std::size_t kMost = 100;  // until they are taken
    if (notices_.size() < kMost)
        notices_.push_back(std::string("dropped=") + message + " simulator=" + std::to_string(id_.value) +
                           " window=" + std::to_string(window) + " reason=\"" + why + "\"");
}

void Simulator::take_ahead(Bus& bus, OrdersAhead& ahead) {
    if (ahead.simulator != id_ || (ahead_ && ahead.window <= ahead_->window)) return;
    if (!good_orders(*model_, ahead.orders))
        return note_dropped("OrdersAhead", ahead.window, "its orders are invalid");
    ahead_ = std::move(ahead);
    if (std::optional<Assignment> assignment = std::exchange(awaiting_orders_, std::nullopt))
        take_assignment(bus, *assignment);
}

/// Orders for robots that are no longer here, and for ticks after the window, are left out.
void Simulator::add_ahead(Assignment& assignment) const {
    const auto earlier = [](const Order& order, Tick tick) { return order.apply_at < tick; };
    const auto first =
        std::lower_bound(ahead_->orders.begin(), ahead_->orders.end(), assignment.from, earlier);
    const auto last = std::lower_bound(first, ahead_->orders.end(), assignment.until, earlier);
    std::vector<Order> all;
    all.reserve(assignment.orders.size() + static_cast<std::size_t>(last - first));
    std::merge(first, last, assignment.orders.begin(), assignment.orders.end(), std::back_inserter(all),
               comes_before);
    assignment.orders = std::move(all);
    assignment.ahead = 0;
}

void Simulator::take_states(StateReply& reply) {
    const Tick tick = reply.states.tick;
    if (pull_.is_for(reply) && !pull_.complete())
        return pull_.accept(*model_, reply, [&](RobotId robot, RobotState&& state) {
            store_.put(robot, tick, std::move(state));
        });
    if (early_.size() < kEarlyMost) early_.push_back(std::move(reply));
}

/// The Controller will not take the result of the assignment in progress.
bool Simulator::ends_assignment(const Message& message) const {
    const auto* expelled = std::get_if<Expelled>(&message);
    return std::holds_alternative<RunOver>(message) || (expelled != nullptr && expelled->simulator == id_);
}

/// Called while stepping: sends heartbeats and the states of the window's start that others wait for.
WindowStepper::Next Simulator::serve_while_stepping(Bus& bus, const StepProgress& progress) {
    send_heartbeats(bus);
    bus.drain(self_, inbox_);
    for (Envelope& envelope : inbox_) {
        if (const auto* assignment = std::get_if<Assignment>(&envelope.message))
            if (assignment->simulator == id_ && same_attempt(*assignment, *assignment_))
                continue;  // it is in progress
        if (const auto* cut = std::get_if<Cut>(&envelope.message)) {
            cut_ = cut_ || (cut->simulator == id_ && same_attempt(*cut, *assignment_));
            continue;
        }
        if (ends_assignment(envelope.message)) unwanted_ = true;
        const auto* request = std::get_if<StateRequest>(&envelope.message);
        if (request != nullptr && request->tick <= assignment_->from)
            serve(bus, envelope.from, *request);
        else
            later_.push_back(std::move(envelope));
    }
    return check_lateness(bus, progress);
}

/// A Simulator that will be late reports it, and may then get a Cut.
WindowStepper::Next Simulator::check_lateness(Bus& bus, const StepProgress& progress) {
    using Next = WindowStepper::Next;
    if (progress.done < kLateFrom || assignment_->due_ns == 0) return Next::kContinue;
    if (reported_late_ && !cut_) return Next::kContinueAlert;
    const double spent_ns = progress.spent_ns(), needs_ns = spent_ns / progress.done;
    if (cut_) return needs_ns - spent_ns < options_.cut_least_ns ? Next::kContinue : Next::kStop;
    const auto due_ns = static_cast<double>(assignment_->due_ns);
    if (needs_ns < due_ns + std::max(options_.cut_least_ns, kLateShare * due_ns)) return Next::kContinue;
    reported_late_ = true;
    bus.send(self_, kControllerAddress,
             Late{assignment_->epoch, assignment_->window, assignment_->attempt,
                  static_cast<std::uint64_t>(needs_ns)});
    return Next::kContinueAlert;
}

void Simulator::send_transfers(Bus& bus, const Assignment& assignment) const {
    for (const HandOver& hand_over : assignment.transfers)
        serve(bus, hand_over.to, {assignment.from, hand_over.robots, assignment.mid_window()});
}

void Simulator::begin_assignment(Bus& bus, Assignment& assignment) {
    send_transfers(bus, assignment);
    keep_wanted();
    to_keep_ = {assignment.from, std::move(assignment.keep)};
    store_.release_before(assignment.release_before);
    store_.forget_aside_before(assignment.window_from);
    if (assignment.mid_window() != 0) store_.set_aside(assignment.robots, assignment.window_from);
    for (const RobotId robot : assignment.robots)
        (void)store_.start(robot, assignment.from);  // the others arrive
    const bool all_given = std::all_of(assignment.hand_offs.begin(), assignment.hand_offs.end(),
                                       [](const Holding& h) { return h.source.role == Role::kSimulator; });
    pull_.begin(*model_, assignment.from, assignment.hand_offs,
                all_given ? std::optional(bus.now_ms()) : std::nullopt, assignment.mid_window());
    assignment_ = std::move(assignment);
    for (StateReply& reply : std::exchange(early_, {}))
        if (reply.states.tick >= assignment_->from &&
            (reply.window == 0 || reply.window >= assignment_->window))
            take_states(reply);
}

void Simulator::serve(Bus& bus, const Address& from, const StateRequest& request) const {
    StateReply reply;
    reply.states.tick = request.tick;
    reply.window = request.window;
    for (const RobotId robot : request.robots) store_.copy_to(reply.states, robot, request.tick);
    if (!reply.states.robots.empty()) bus.send(self_, from, std::move(reply));
}

void Simulator::show(Bus& bus, const ViewDue& due) {
    if (!view_layout_) view_layout_.emplace(*model_);
    const auto state = [&](RobotId robot) { return store_.find(robot, due.tick); };
    send_views(*model_, *view_layout_, due, state, self_, bus);
}

void Simulator::keep_in_touch(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (id_.valid()) send_heartbeats(bus);
    if (now - asked_ms_ < options_.resend_ms) return;
    if (!id_.valid())
        bus.send(self_, kControllerAddress,
                 Hello{model_->hash, static_cast<std::uint32_t>(stepper_.threads()), options_.name});
    if (id_.valid() && leaving_) bus.send(self_, kControllerAddress, LeaveRequest{id_});
    asked_ms_ = now;
}

void Simulator::send_heartbeats(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (now - heartbeat_sent_ms_ < options_.heartbeat_ms) return;
    heartbeat_sent_ms_ = now;
    bus.send(self_, kControllerAddress, Heartbeat{id_});
}

void Simulator::reset(Bus& bus) {
    bus.end_keep_alive(self_);
    id_ = SimulatorId{};
    assignment_.reset();
    awaiting_orders_.reset();
    ahead_.reset();
    answer_.reset();
    pull_.cancel();
    early_.clear();
    to_keep_.robots.clear();
    store_.clear();
    asked_ms_ = kLongAgo;
}

}  // namespace roboss
