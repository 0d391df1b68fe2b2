// The Simulator: messages in, frames out.
#include "roles/simulator.h"

#include <algorithm>
#include <tuple>

#include "core/thread_cpu.h"
#include "roles/send_views.h"

namespace roboss {

namespace {

constexpr double kLateFrom = 0.5;       // of a plan's ticks: before, it is hard to say
constexpr double kLateShare = 0.04;     // of what was due, beyond it
constexpr std::size_t kEarlyMost = 64;  // more would be another's mistake; what is dropped is asked for

template <class A, class B>
bool same_attempt(const A& a, const B& b) {
    return std::tie(a.epoch, a.window, a.attempt) == std::tie(b.epoch, b.window, b.attempt);
}

template <class A, class B>
bool is_newer(const A& a, const B& b) {
    return std::tie(a.epoch, a.window, a.attempt) > std::tie(b.epoch, b.window, b.attempt);
}

SteppingOptions stepping(const SimulatorOptions& options) {
    SteppingOptions stepping{nullptr, nullptr, options.lanes, options.look_up};
    if (options.measure_cpu)
        stepping.clock = options.cpu_clock ? options.cpu_clock : thread_cpu_ns;
    else
        stepping.counted = options.counted;
    return stepping;
}

bool good_orders(const Model& model, const std::vector<Order>& orders) {
    return std::is_sorted(orders.begin(), orders.end(), comes_before) &&
           std::all_of(orders.begin(), orders.end(),
                       [&](const Order& o) { return check_order(model, o).ok(); });
}

/// Whether robots exist, none twice, ascending in their islands, as islands are by their first.
bool good_islands(const Model& model, const Plan& plan) {
    std::vector<bool> seen(model.robots.size(), false);
    std::optional<RobotId> root;
    for (std::size_t i = 0; i + 1 < plan.island_offsets.size(); ++i) {
        const std::size_t first = plan.island_offsets[i];
        if (root && plan.robots[first] <= *root) return false;
        root = plan.robots[first];
        for (std::size_t k = first; k < plan.island_offsets[i + 1]; ++k) {
            const RobotId robot = plan.robots[k];
            if (robot.index() >= seen.size() || seen[robot.index()]) return false;
            if (k > first && robot < plan.robots[k - 1]) return false;
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
      stepper_(model_, pool, stepping(options)) {}

void Simulator::advance(Bus& bus) {
    if (gone_) return;
    bus.drain(self_, inbox_);
    for (Envelope& envelope : inbox_) handle(bus, envelope);
    keep_in_touch(bus);
    if (gone_ || !plan_) return;
    if (!pull_.complete()) return pull_.advance(bus, self_, options_.resend_ms);
    said_late_ = cut_ = false;
    answer_ =
        stepper_.step(*plan_, store_, [&](const StepProgress& progress) { return attend(bus, progress); });
    plan_.reset();
    bus.send(self_, kControllerAddress, *answer_);
    catch_up(bus);
}

/// What could wait until the frame was on its way, for which everybody waits.
void Simulator::catch_up(Bus& bus) {
    keep_wanted();
    for (const RobotFrame& robot : answer_->robots) store_.copy_ahead(robot.robot);
    for (Envelope& envelope : std::exchange(later_, {})) handle(bus, envelope);
}

/// The slots still have these states: no other plan was adopted since.
void Simulator::keep_wanted() {
    store_.keep(to_keep_.robots, to_keep_.tick);
    to_keep_.robots.clear();
}

void Simulator::handle(Bus& bus, Envelope& envelope) {
    if (auto* plan = std::get_if<Plan>(&envelope.message)) {
        take_plan(bus, *plan);
    } else if (auto* ahead = std::get_if<OrdersAhead>(&envelope.message)) {
        take_ahead(bus, *ahead);
    } else if (const auto* request = std::get_if<StateRequest>(&envelope.message)) {
        serve(bus, envelope.from, *request);
    } else if (const auto* due = std::get_if<ViewDue>(&envelope.message)) {
        show(bus, *due);
    } else if (auto* reply = std::get_if<StateReply>(&envelope.message)) {
        take_states(*reply);
    } else if (const auto* welcome = std::get_if<Welcome>(&envelope.message)) {
        if (!id_.valid()) id_ = welcome->simulator;  // if it is an old one, it will be expelled
    } else if (const auto* expelled = std::get_if<Expelled>(&envelope.message)) {
        if (expelled->simulator == id_) start_over();
    } else if (const auto* goodbye = std::get_if<Goodbye>(&envelope.message)) {
        if (goodbye->simulator != id_) return;
        gone_ = true;
        sent_home_ = !leaving_;
    } else if (std::holds_alternative<ModelChanged>(envelope.message)) {
        if (!id_.valid()) gone_ = outdated_ = true;
    } else if (const auto* refused = std::get_if<Refused>(&envelope.message)) {
        refusal_ = refused->reason;
        gone_ = true;
    } else if (const auto* over = std::get_if<RunOver>(&envelope.message)) {
        over_ = over->reason;
        gone_ = true;
    }
}

void Simulator::take_plan(Bus& bus, Plan& plan) {
    if (plan.simulator != id_) return;
    if (answer_ && same_attempt(plan, *answer_)) return bus.send(self_, kControllerAddress, *answer_);
    if ((answer_ && !is_newer(plan, *answer_)) || (plan_ && !is_newer(plan, *plan_))) return;
    if (unfed_ && is_newer(*unfed_, plan)) return;
    if (const std::string flaw = flaw_of(plan); !flaw.empty()) return note_dropped("Plan", plan.window, flaw);
    unfed_.reset();
    if (plan.ahead != 0) {
        if (!ahead_ || ahead_->window != plan.ahead) return void(unfed_ = std::move(plan));
        add_ahead(plan);
    }
    adopt(bus, plan);
}

/// What makes it a plan that cannot be stepped here; empty: nothing.
std::string Simulator::flaw_of(const Plan& plan) const {
    if (!good_islands(*model_, plan) || !all_known(*model_, plan.keep)) return "its robots make no sense";
    if (!good_orders(*model_, plan.orders)) return "its orders make no sense";
    std::vector<bool> comes(model_->robots.size(), false);
    for (const Holding& holding : plan.hand_offs) {
        if (!all_known(*model_, holding.robots)) return "its robots make no sense";
        for (const RobotId robot : holding.robots) comes[robot.index()] = true;
    }
    for (const RobotId robot : plan.robots)
        if (!comes[robot.index()] && !store_.has(robot, plan.from))
            return "robot " + std::to_string(robot.value) + " is not here at tick " +
                   std::to_string(plan.from);
    return {};
}

void Simulator::note_dropped(const char* message, std::uint64_t window, const std::string& why) {
    constexpr std::size_t kMost = 100;  // until somebody reads them
    if (notices_.size() < kMost)
        notices_.push_back(std::string("dropped=") + message + " simulator=" + std::to_string(id_.value) +
                           " window=" + std::to_string(window) + " reason=\"" + why + "\"");
}

void Simulator::take_ahead(Bus& bus, OrdersAhead& ahead) {
    if (ahead.simulator != id_ || (ahead_ && ahead.window <= ahead_->window)) return;
    if (!good_orders(*model_, ahead.orders))
        return note_dropped("OrdersAhead", ahead.window, "its orders make no sense");
    ahead_ = std::move(ahead);
    if (std::optional<Plan> plan = std::exchange(unfed_, std::nullopt)) take_plan(bus, *plan);
}

/// Robots that are no longer here, and ticks after the window, do not matter.
void Simulator::add_ahead(Plan& plan) const {
    const auto earlier = [](const Order& order, Tick tick) { return order.apply_at < tick; };
    const auto first = std::lower_bound(ahead_->orders.begin(), ahead_->orders.end(), plan.from, earlier);
    const auto last = std::lower_bound(first, ahead_->orders.end(), plan.until, earlier);
    std::vector<Order> all;
    all.reserve(plan.orders.size() + static_cast<std::size_t>(last - first));
    std::merge(first, last, plan.orders.begin(), plan.orders.end(), std::back_inserter(all), comes_before);
    plan.orders = std::move(all);
    plan.ahead = 0;
}

void Simulator::take_states(StateReply& reply) {
    const Tick tick = reply.states.tick;
    if (pull_.is_for(reply) && !pull_.complete())
        return pull_.accept(*model_, reply, [&](RobotId robot, RobotState&& state) {
            store_.put(robot, tick, std::move(state));
        });
    if (early_.size() < kEarlyMost) early_.push_back(std::move(reply));
}

/// In the midst of stepping: others wait for states of the window's start, and want to know that it lives.
WindowStepper::Next Simulator::attend(Bus& bus, const StepProgress& progress) {
    say_alive(bus);
    bus.drain(self_, inbox_);
    for (Envelope& envelope : inbox_) {
        if (const auto* plan = std::get_if<Plan>(&envelope.message))
            if (plan->simulator == id_ && same_attempt(*plan, *plan_)) continue;  // it is being worked on
        if (const auto* cut = std::get_if<Cut>(&envelope.message)) {
            cut_ = cut_ || (cut->simulator == id_ && same_attempt(*cut, *plan_));
            continue;
        }
        const auto* request = std::get_if<StateRequest>(&envelope.message);
        if (request != nullptr && request->tick <= plan_->from)
            serve(bus, envelope.from, *request);
        else
            later_.push_back(std::move(envelope));
    }
    return whether_late(bus, progress);
}

/// Who is late says so, and then may be cut short.
WindowStepper::Next Simulator::whether_late(Bus& bus, const StepProgress& progress) {
    using Next = WindowStepper::Next;
    if (progress.done < kLateFrom || plan_->due_ns == 0) return Next::kGoOn;
    if (said_late_ && !cut_) return Next::kGoOnAlert;
    const double spent_ns = progress.spent_ns(), needs_ns = spent_ns / progress.done;
    if (cut_) return needs_ns - spent_ns < options_.cut_least_ns ? Next::kGoOn : Next::kStop;
    const auto due_ns = static_cast<double>(plan_->due_ns);
    if (needs_ns < due_ns + std::max(options_.cut_least_ns, kLateShare * due_ns)) return Next::kGoOn;
    said_late_ = true;
    bus.send(self_, kControllerAddress,
             Late{plan_->epoch, plan_->window, plan_->attempt, static_cast<std::uint64_t>(needs_ns)});
    return Next::kGoOnAlert;
}

void Simulator::give(Bus& bus, const Plan& plan) const {
    for (const HandOver& hand_over : plan.gives)
        serve(bus, hand_over.to, {plan.from, hand_over.robots, plan.midst()});
}

void Simulator::adopt(Bus& bus, Plan& plan) {
    give(bus, plan);
    keep_wanted();
    to_keep_ = {plan.from, std::move(plan.keep)};
    store_.release_before(plan.release_before);
    store_.forget_aside_before(plan.window_from);
    if (plan.midst() != 0) store_.set_aside(plan.robots, plan.window_from);
    for (const RobotId robot : plan.robots) (void)store_.start(robot, plan.from);  // or it comes
    const bool all_given = std::all_of(plan.hand_offs.begin(), plan.hand_offs.end(),
                                       [](const Holding& h) { return h.source.role == Role::kSimulator; });
    pull_.begin(*model_, plan.from, plan.hand_offs, all_given ? std::optional(bus.now_ms()) : std::nullopt,
                plan.midst());
    plan_ = std::move(plan);
    for (StateReply& reply : std::exchange(early_, {}))
        if (reply.states.tick >= plan_->from && (reply.window == 0 || reply.window >= plan_->window))
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
    if (id_.valid()) say_alive(bus);
    if (now - asked_ms_ < options_.resend_ms) return;
    if (!id_.valid())
        bus.send(self_, kControllerAddress,
                 Hello{model_->hash, static_cast<std::uint32_t>(stepper_.threads()), options_.name});
    if (id_.valid() && leaving_) bus.send(self_, kControllerAddress, LeaveRequest{id_});
    asked_ms_ = now;
}

void Simulator::say_alive(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (now - alive_ms_ < options_.alive_ms) return;
    alive_ms_ = now;
    bus.send(self_, kControllerAddress, Alive{id_});
}

void Simulator::start_over() {
    id_ = SimulatorId{};
    plan_.reset();
    unfed_.reset();
    ahead_.reset();
    answer_.reset();
    pull_.cancel();
    early_.clear();
    to_keep_.robots.clear();
    store_.clear();
    asked_ms_ = kLongAgo;
}

}  // namespace roboss
