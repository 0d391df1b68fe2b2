// See face.h. This half shows and obeys; the other, face_topics.cpp, keeps the entities of the transport.
#include "ros2/face.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "ros2/robot_names.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

namespace {

constexpr std::int64_t kTellWaiting_ms = 3'000;
constexpr std::int64_t kSettle_ms = 500;   // without a new subscription, before lockstep begins
constexpr std::int64_t kConfirm_ms = 200;  // a subscriber that takes longer is stopped or gone
constexpr std::int64_t kReportLockstep_ms = 5'000;
constexpr std::size_t kNoticesMost = 200;  // different texts
constexpr double kUsualPeriod_s = 0.02;

/// The stamp of a stamped message, ns; none: it has no stamp, or 0.
std::optional<std::int64_t> stamp_ns(CommandTopic::Kind kind, std::string_view cdr) {
    if (kind != CommandTopic::Kind::kTwistStamped) return {};
    const Result<TwistStamped> message = from_cdr<TwistStamped>(cdr);
    if (!message) return {};
    const std::int64_t ns = nanoseconds(message.value().header.stamp);
    return ns == 0 ? std::nullopt : std::optional(ns);
}

std::vector<bool> wanted_of(const std::vector<std::size_t>& subscribers) {
    std::vector<bool> wanted(subscribers.size());
    for (std::size_t t = 0; t < wanted.size(); ++t) wanted[t] = subscribers[t] > 0;
    return wanted;
}

}  // namespace

Tick usual_period(const Model& model) {
    double period_s = kUsualPeriod_s;
    for (const RobotType& type : model.types)
        for (const SensorInfo& sensor : type.sensors)
            if (sensor.spec.update_rate_hz > 0) period_s = std::min(period_s, 1 / sensor.spec.update_rate_hz);
    return std::max<Tick>(1, static_cast<Tick>(std::floor(period_s / model.dt_s + 1e-9)));
}

Face::Face(Transport& transport, FaceOptions options)
    : transport_(transport),
      options_(std::move(options)),
      world_node_(transport_.add_node("/", "roboss")),
      services_(transport_, world_node_, options_.services) {}

Face::~Face() {
    for (const auto& [name, node] : nodes_) transport_.remove(node);
    transport_.remove(world_node_);
    transport_.announce();
}

Result<> Face::show(std::shared_ptr<const Model> model, const Address& self) {
    model_ = std::move(model);
    BusClientOptions times;
    times.name = options_.name;
    times.period = options_.period_s > 0
                       ? std::max<Tick>(1, static_cast<Tick>(std::llround(options_.period_s / model_->dt_s)))
                       : usual_period(*model_);
    times.latency = times.period;
    times.synchronous = !options_.lockstep.empty();
    times.observer = options_.lockstep.empty();
    client_ = std::make_unique<BusClient>(model_, self, times);
    const std::string& root = options_.topics.root;
    if (!root.empty() && !model_->find_robot(root))
        return Error{"there is no robot '" + root + "' that could have no namespace",
                     "`roboss check WORLD` prints the names of robots", "no-robot"};
    topics_ = std::make_unique<RobotTopics>(model_, options_.topics);
    commands_ = std::make_unique<RobotCommands>(model_, options_.topics);
    for (const std::string& line : topics_->bridge_notices()) notice(line);
    lockstep_.reset();
    if (times.synchronous) {
        Result<Lockstep> lockstep = Lockstep::of(options_.lockstep, *commands_);
        if (!lockstep) return lockstep.error();
        lockstep_ = std::move(lockstep).value();
    }
    shown_ = -1, welcomes_ = 0, ready_ = false, misplaced_ = 0;
    subscribers_.clear(), broken_.clear();
    open_nodes();
    use_services();
    services_.put("period", static_cast<double>(times.period) * model_->dt_s,
                  "simulated time between two looks at the world, s");
    open_topics();
    open_commands();
    transport_.announce();
    return Ok{};
}

void Face::use_services() {
    const std::vector<std::string> names = robot_names(*model_, options_.topics.root);
    const std::shared_ptr<const Controllers>& controllers = options_.topics.controllers;
    services_.use(*client_, robot_nodes_, names, controllers);
    if (!controllers) return;
    for (const std::string& line : controller_notices(*controllers, *model_, names)) notice(line);
}

void Face::advance(Bus& bus) {
    client_->advance(bus);
    follow_types(bus.now_ms());
    take_messages(bus);
    if (services_.advance(bus.now_ms()) && !lockstep_ && client_->tick() >= 0)
        client_->send(bus, client_->tick());
    if (client_->observing()) observe(bus);
    for (const std::string& line : transport_.take_notices()) notice(line);
    for (const std::string& line : client_->take_refusals()) notice(line);
    for (const std::string& line : services_.take_notices()) notice(line);
}

void Face::take_messages(Bus& bus) {
    bool ordered = false;
    for (Incoming& message : transport_.take(0)) {
        const auto [begin, end] = command_of_.equal_range(message.entity);
        if (begin == end) (void)services_.take(message);  // else it is of a topic that was closed
        for (auto command = begin; command != end; ++command)
            ordered |= take_command(command->second, message.bytes);
    }
    if (ordered && client_->tick() >= 0) client_->send(bus, client_->tick());
}

/// True if it was obeyed; in lockstep it waits for its period.
bool Face::take_command(std::size_t topic, const std::string& cdr) {
    if (!lockstep_) return obey(topic, cdr), true;
    const CommandTopic& command = commands_->topics()[topic];
    if (!lockstep_->take(topic, cdr, stamp_ns(command.kind, cdr)))
        notice(command.name + ": its messages have no effect, for the world is in lockstep without it");
    return false;
}

void Face::obey(std::size_t topic, std::string_view cdr) {
    const Result<std::vector<RobotOrder>> orders = commands_->orders(topic, cdr);
    if (!orders) return notice(orders.error().text());
    for (const RobotOrder& order : orders.value())
        (void)client_->order(order.robot, order.action);  // take_refusals() has its Error
}

void Face::observe(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    const bool is_new = client_->tick() != shown_ || client_->welcomes() != welcomes_;
    if (is_new) {
        if (client_->tick() < shown_ || shown_ < 0) {  // the beginning, or the run went back
            topics_->forget();
            if (lockstep_ && shown_ >= 0) lockstep_->forget();
            publish_latched();
        }
        shown_ = client_->tick(), welcomes_ = client_->welcomes();
        if (lockstep_) {
            lockstep_->begin(nanoseconds(stamp_of(*model_, shown_)));
            report_lockstep(now);
        }
        waiting_since_ms_ = now, waiting_told_ = false;
    }
    if (!lockstep_) {
        publish_observed(wanted_of(count_subscribers()));
        return client_->answer(bus);
    }
    if (!ready_) {
        if (!is_ready(now)) return;
    } else if (!is_new) {
        publish_to_late(now);
        return answer_when_complete(bus);
    }
    subscribers_ = count_subscribers();
    publish_observed(wanted_of(subscribers_));
}

/// Lockstep begins once a node is there for each of its topics and no subscription has come for a while: a
/// node that is not yet connected would miss the first messages, and the world would wait for its answer.
bool Face::is_ready(std::int64_t now_ms) {
    if (const std::vector<std::size_t>& count = count_subscribers(); count != subscribers_)
        subscribers_ = count, settled_ms_ = now_ms;
    std::vector<std::size_t> absent;
    for (const std::size_t topic : lockstep_->topics()) {
        const auto id = subscriptions_.find(commands_->topics()[topic].name);
        if (id == subscriptions_.end() || transport_.publishers(id->second.id) == 0) absent.push_back(topic);
    }
    if (!absent.empty()) {
        settled_ms_ = now_ms;
        report_waiting(now_ms, absent, "a node that publishes ");
    }
    ready_ = now_ms - settled_ms_ >= kSettle_ms;
    if (ready_) waiting_since_ms_ = now_ms, waiting_told_ = false;
    return ready_;
}

/// Subscriptions that come while the world waits, as those of a node that was started again, get the messages
/// that they missed. Other subscriptions to such a topic get them twice; so at first only topics without
/// subscriptions.
void Face::publish_to_late(std::int64_t now_ms) {
    const std::vector<std::size_t>& count = count_subscribers();
    std::vector<bool> late(count.size());
    for (std::size_t t = 0; t < count.size(); ++t)
        late[t] = count[t] > subscribers_[t] &&
                  (subscribers_[t] == 0 || now_ms - waiting_since_ms_ > kTellWaiting_ms);
    if (std::ranges::find(late, true) == late.end()) return;
    for (std::size_t t = 0; t < count.size(); ++t)
        if (late[t]) subscribers_[t] = count[t];
    topics_->repeat();
    publish_observed(late);
}

void Face::answer_when_complete(Bus& bus) {
    if (!lockstep_->is_complete()) return report_waiting(bus.now_ms(), lockstep_->missing(), "a message on ");
    for (const Lockstep::Accepted& message : lockstep_->accepted()) obey(message.topic, message.bytes);
    client_->answer(bus);
}

void Face::report_waiting(std::int64_t now_ms, const std::vector<std::size_t>& topics, const char* what) {
    if (now_ms - waiting_since_ms_ < kTellWaiting_ms || std::exchange(waiting_told_, true)) return;
    std::string text = std::string("the world waits for ") + what + commands_->topics()[topics.front()].name;
    if (topics.size() > 1) text += " and " + std::to_string(topics.size() - 1) + " more topics";
    notices_.push_back(text + " [lockstep]");
}

void Face::publish_latched() {
    topics_->select(std::vector<bool>(publisher_of_.size(), true));
    for (const RobotTopics::Message& message : topics_->latched(std::max<Tick>(client_->tick(), 0)))
        if (publisher_of_[message.topic] != 0)
            transport_.publish(publisher_of_[message.topic], message.bytes);
}

/// By topic of topics_->topics(). Of thousands of topics it is counted only when somebody came or went.
const std::vector<std::size_t>& Face::count_subscribers() {
    const std::uint64_t revision = transport_.revision();
    if (counted_at_ == revision) return counted_;
    counted_at_ = revision;
    counted_.resize(publisher_of_.size());
    for (std::size_t t = 0; t < counted_.size(); ++t)
        counted_[t] = publisher_of_[t] == 0 ? 0 : transport_.subscribers(publisher_of_[t]);
    return counted_;
}

void Face::publish_observed(const std::vector<bool>& wanted) {
    topics_->select(wanted);
    const Result<std::vector<RobotTopics::Message>> messages =
        topics_->messages(client_->tick(), client_->states(),
                          [this](RobotId robot, std::size_t sensor) { return measure(robot, sensor); });
    std::vector<EntityId> sent;
    for (const RobotTopics::Message& message : messages.value()) {
        if (message.topic == RobotTopics::kClock)
            continue;  // the last, for it says that the others are there
        transport_.publish(publisher_of_[message.topic], message.bytes);
        sent.push_back(publisher_of_[message.topic]);
    }
    if (lockstep_) confirm(sent);
    for (const RobotTopics::Message& message : messages.value())
        if (message.topic == RobotTopics::kClock)
            transport_.publish(publisher_of_[message.topic], message.bytes);
}

/// Waits until subscribers have what was sent, so that a node that hears the clock has heard its sensors.
void Face::confirm(const std::vector<EntityId>& sent) {
    for (const EntityId publisher : sent)
        if (!transport_.await_confirmed(publisher, kConfirm_ms))
            return notice(
                "a subscriber does not confirm messages; /clock is published nevertheless [lockstep]");
}

/// Nothing where the sensor cannot measure, which is reported once.
Result<std::optional<Sample>> Face::measure(RobotId robot, std::size_t sensor) {
    const std::pair key{robot.index(), sensor};
    if (broken_.contains(key)) return std::optional<Sample>{};
    try {
        return std::optional(client_->measure_afresh(robot, sensor));
    } catch (const std::exception& why) {
        broken_.insert(key);
        const RobotType& type = model_->type_of(robot);
        notice(model_->robots[robot.index()].name + "." + type.sensors[sensor].spec.name + ": " + why.what());
        return std::optional<Sample>{};
    }
}

void Face::report_lockstep(std::int64_t now_ms) {
    const std::uint64_t early = lockstep_->early(), dropped = lockstep_->dropped();
    if (early + dropped == misplaced_ || now_ms < report_lockstep_ms_) return;
    misplaced_ = early + dropped, report_lockstep_ms_ = now_ms + kReportLockstep_ms;
    notices_.push_back("so far " + std::to_string(early) +
                       " messages more than one in a period, which count for the next ones, and " +
                       std::to_string(dropped) +
                       " that were dropped, for they came too late or twice [lockstep]");
}

void Face::notice(const std::string& line) {
    if (told_.size() < kNoticesMost && told_.insert(line).second) notices_.push_back(line);
}

std::vector<std::string> Face::take_notices() {
    return std::exchange(notices_, {});
}

}  // namespace roboss::ros2
