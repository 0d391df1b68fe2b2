// Joins, observes and replies over a Bus.
#include "client/bus_client.h"

#include <algorithm>
#include <utility>

#include "core/error_text.h"

namespace roboss {
namespace {

constexpr std::int64_t kSoon_ms = 20;  // to the first repetition of what cannot wait

}  // namespace

BusClient::BusClient(std::shared_ptr<const Model> model, const Address& self, BusClientOptions options)
    : model_(std::move(model)), self_(self), options_(std::move(options)) {
    states_.resize(model_->robots.size());
    coming_.resize(model_->robots.size());
}

Result<> BusClient::order(RobotId robot, const Action& action) {
    Order order;
    order.apply_at = std::max<Tick>(tick_, 0);
    order.robot = robot;
    order.action = action;
    if (Result<> checked = check_order(*model_, order); !checked) return report_refusal(checked.error());
    orders_.push_back({++sequence_, robot, action});
    return Ok{};
}

Error BusClient::report_refusal(Error error) {
    refusals_.add_order(error);
    return error;
}

void BusClient::advance(Bus& bus) {
    bus.drain(self_, inbox_);
    for (Envelope& envelope : inbox_) handle(envelope);
    if (!observing_) {
        pull_next();
        if (pull_.complete()) show();
    }
    pull_.advance(bus, self_, options_.resend_ms);
    resend(bus);
}

void BusClient::handle(Envelope& envelope) {
    if (auto* observation = std::get_if<Observation>(&envelope.message)) {
        take_observation(*observation);
    } else if (const auto* reply = std::get_if<StateReply>(&envelope.message)) {
        pull_.accept(*model_, *reply,
                     [&](RobotId robot, RobotState&& s) { coming_[robot.index()] = std::move(s); });
    } else if (const auto* ack = std::get_if<ReplyAck>(&envelope.message)) {
        if (ack->client != id_) return;
        take_ack(*ack);
    } else if (const auto* welcome = std::get_if<ClientWelcome>(&envelope.message)) {
        take_welcome(*welcome);
    } else if (const auto* unknown = std::get_if<ClientUnknown>(&envelope.message)) {
        if (unknown->client == id_) join_again();
    } else if (const auto* refused = std::get_if<Refused>(&envelope.message)) {
        if (!id_.valid()) refusal_ = refused->reason;
    } else if (auto* answer = std::get_if<ControlReply>(&envelope.message)) {
        if (requests_.empty() || requests_.front().number != answer->number) return;
        answers_.push_back({std::move(requests_.front().action), std::move(answer->outcome)});
        requests_.pop_front();
        requested_ms_ = kLongAgo;  // the next one at once
    } else if (std::holds_alternative<ModelChanged>(envelope.message)) {
        outdated_ = outdated_ || !id_.valid();
    } else if (const auto* over = std::get_if<RunOver>(&envelope.message)) {
        over_ = over->reason;
        failed_ = over->failed;
    }
}

void BusClient::take_ack(const ReplyAck& ack) {
    for (const RefusedOrder& r : ack.refused) {
        if (r.sequence <= refused_up_to_) continue;
        refused_up_to_ = r.sequence;
        refused_orders_.push_back(r);
    }
    heard_up_to(ack.number);
}

/// What was given before goes out at once, by resend().
void BusClient::take_welcome(const ClientWelcome& welcome) {
    if (id_.valid()) return;
    ++welcomes_;
    id_ = welcome.client;
    seed_ = welcome.seed;
    if (was_here_ && welcome.first < expected_) {  // a rewind
        replies_.clear();
        orders_.clear();
        observing_ = false;
        tick_ = -1;
        scene_tick_ = cameras_tick_ = -1;
        forget_measured();
    }
    expected_ = welcome.first;
    for (OpenReply& open : replies_) open.reply.client = id_, open.resent = {};
    if (bye_) bye_->client = id_, bye_resent_ = {};
}

std::vector<std::string> BusClient::take_refusals() {
    for (const RefusedOrder& r : take_refused_orders())
        refusals_.add_order(error_of_text("", r.reason, {}, {}));
    return refusals_.take();
}

/// The Controller was restarted: resends the replies that it has not acknowledged, and waits for the
/// observations not shown yet.
void BusClient::join_again() {
    id_ = ClientId();
    hello_resent_ = {};
    was_here_ = true;
    offers_.clear();
    pull_.cancel();
}

void BusClient::heard_up_to(std::uint64_t number) {
    acknowledged_ = std::max(acknowledged_, std::min(number, reply_number_));
    while (!replies_.empty() && replies_.front().reply.number <= number) replies_.pop_front();
    if (bye_ && bye_->number <= number) bye_.reset();
}

void BusClient::take_observation(Observation& observation) {
    heard_up_to(observation.last_reply);
    if (!id_.valid() || bye_) return;
    if (observation.tick <= tick_) return;  // shown already; the reply to it is sent again
    if (options_.synchronous && observation.tick < expected_) return;
    offers_[observation.tick] = std::move(observation.holders);
}

/// A synchronous Client sees every observation in turn; a free-running one those that are sent, one at a
/// time.
void BusClient::pull_next() {
    if (offers_.empty()) return;
    auto next = options_.synchronous ? offers_.find(expected_) : std::prev(offers_.end());
    if (next == offers_.end()) return;
    if (!pull_.active() || pull_.tick() != next->first) pull_.begin_all(*model_, next->first);
    pull_.redirect(next->second);
}

void BusClient::show() {
    const Tick usual = options_.synchronous ? pull_.tick() - options_.period : pull_.tick();
    before_ = tick_ < 0 ? usual : tick_;
    tick_ = pull_.tick();
    expected_ = tick_ + options_.period;
    states_.swap(coming_);
    offers_.erase(offers_.begin(), offers_.upper_bound(tick_));
    pull_.cancel();
    observing_ = true;
    renew_samples();
}

void BusClient::answer(Bus& bus) {
    ROBOSS_CHECK(observing_, "an answer without an observation");
    observing_ = false;
    replies_.push_back({{id_, ++reply_number_, tick_, std::exchange(orders_, {}), acknowledged_}, {}});
    if (id_.valid()) send_open_replies(bus, bus.now_ms());
}

void BusClient::send(Bus& bus, Tick observed) {
    ROBOSS_CHECK(!options_.synchronous, "only a free-running Client sends without an observation");
    replies_.push_back({{id_, ++reply_number_, observed, std::exchange(orders_, {}), acknowledged_}, {}});
    if (id_.valid()) send_open_replies(bus, bus.now_ms());  // else once it has joined
}

void BusClient::leave(Bus& bus, const std::string& failure) {
    bye_ = ClientBye{id_, ++reply_number_, !failure.empty(), failure};
    observing_ = false;
    offers_.clear();
    pull_.cancel();
    bye_resent_ = {};
    bus.send(self_, kControllerAddress, *bye_);
}

bool BusClient::Resent::due(std::int64_t now_ms, std::int64_t first_ms, std::int64_t most_ms) {
    if (now_ms - sent_ms < wait_ms) return false;
    constexpr int kQuick = 4;  // times, before the intervals grow
    wait_ms = ++times <= kQuick ? first_ms : std::min(2 * wait_ms, most_ms);
    sent_ms = now_ms;
    return true;
}

/// From sending to the first repetition. What a free-running Client sends often follows a user's hand, and
/// must not be late. A synchronous Client is not in a hurry, and must not have two hellos under way: a late
/// one would give a Controller that was restarted meanwhile the numbers of earlier replies.
std::int64_t BusClient::first_resend_ms() const {
    return options_.synchronous ? options_.resend_ms : std::min(kSoon_ms, options_.resend_ms);
}

/// Each reply has its own timer: with one for all, each new reply would delay the repetition of a lost one.
void BusClient::send_open_replies(Bus& bus, std::int64_t now_ms) {
    for (OpenReply& open : replies_) {
        if (!open.resent.due(now_ms, first_resend_ms(), options_.resend_ms)) continue;
        open.reply.acknowledged = acknowledged_;
        bus.send(self_, kControllerAddress, open.reply);
        sent_ms_ = now_ms;
    }
}

ClientHello BusClient::hello() const {
    ClientHello hello{options_.name,    model_->hash,         options_.period,
                      options_.latency, options_.synchronous, options_.observer};
    const std::uint64_t last = reply_number_ - (bye_ ? 1 : 0);
    constexpr Tick kFarthest = Tick{1} << 60;  // beyond it a message is refused
    if (was_here_) hello.expected = std::min(expected_, kFarthest);
    hello.last_reply = last;
    hello.acknowledged = last - replies_.size();
    return hello;
}

void BusClient::resend(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (!requests_.empty() && now - requested_ms_ >= options_.resend_ms) {
        requested_ms_ = now;
        bus.send(self_, kControllerAddress, requests_.front());
    }
    if (!id_.valid()) {
        if (refusal_.empty() && hello_resent_.due(now, first_resend_ms(), options_.resend_ms))
            bus.send(self_, kControllerAddress, hello());
        return;
    }
    send_open_replies(bus, now);
    // Nothing to send: repeats its last reply now and then to find out whether the Controller still knows it.
    if (replies_.empty() && !bye_ && now - sent_ms_ >= kAskEvery * options_.resend_ms) {
        bus.send(self_, kControllerAddress, ClientReply{id_, reply_number_, tick_, {}, acknowledged_});
        sent_ms_ = now;
    }
    if (bye_ && bye_resent_.due(now, options_.resend_ms, options_.resend_ms))
        bus.send(self_, kControllerAddress, *bye_);
}

void BusClient::control(ControlAction request) {
    if (requests_.empty()) requested_ms_ = kLongAgo;
    requests_.push_back({++request_, std::move(request)});
}

RayScene& BusClient::ray_scene() {
    if (!scene_) scene_ = std::make_unique<RayScene>(model_);
    if (scene_tick_ != tick_) {
        std::vector<const RobotState*> states;
        for (const RobotState& state : states_) states.push_back(&state);
        scene_->update(states);
        scene_tick_ = tick_;
    }
    return *scene_;
}

Result<const CameraScene*> BusClient::camera_scene() {
    if (!visuals_) return Client::camera_scene();
    if (!cameras_) {
        auto made = make_camera_scene(visuals_, model_, 1);
        if (!made) {
            outdated_ = outdated_ || made.error().code == "changed-world";
            return made.error();
        }
        cameras_ = std::move(made).value();
    }
    if (cameras_tick_ != tick_) {
        std::vector<const RobotState*> states;
        for (const RobotState& state : states_) states.push_back(&state);
        cameras_->update(states);
        cameras_tick_ = tick_;
    }
    return cameras_.get();
}

}  // namespace roboss
