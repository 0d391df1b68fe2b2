// Replies in, observations out.
#include "roles/controller/client_service.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error_text.h"
#include "wire/orders_only.h"

namespace roboss {

namespace {

constexpr std::size_t kRefusalsKept = 1'000;

bool looks_only(const Rights* rights) {
    return rights != nullptr && rights->look_only();
}

/// The first multiple of `period` that is not before `tick`.
Tick next_multiple(Tick tick, Tick period) {
    return (tick + period - 1) / period * period;
}

}  // namespace

ClientService::ClientService(std::shared_ptr<const Model> model, const ClientServiceOptions& options,
                             const ModelServer& model_server, OrderLog& order_log, Recorder& recorder,
                             StateDirectory& directory, RunNotices& notices)
    : model_(std::move(model)),
      options_(options),
      model_server_(model_server),
      order_log_(order_log),
      recorder_(recorder),
      directory_(directory),
      notices_(notices) {
    for (const std::string& name : options_.expected) seats_.emplace_back().name = name;
}

void ClientService::take_hello(Bus& bus, const Address& from, const ClientHello& asked, Tick scheduled_until,
                               const Rights* rights) {
    ClientHello hello = asked;
    hello.observer = hello.observer || looks_only(rights);
    const Tick tick = directory_.tick();
    if (from.role != Role::kClient)
        return notices_.dropped("ClientHello", tick, "its sender is not a Client");
    if (model_server_.is_earlier(hello.model_hash))
        return bus.send(kControllerAddress, from, ModelChanged{model_->hash});
    if (const std::optional<Error> objection = objection_to(from, hello, rights)) {
        notices_.add("client '" + hello.name + "' refused: " + objection->message + " [" + objection->code +
                     "]");
        return bus.send(kControllerAddress, from, Refused{objection->text()});
    }
    const auto here = std::ranges::find_if(
        seats_, [&](const ClientSeat& seat) { return seat.joined && seat.address == from; });
    const bool is_new = here == seats_.end();
    ClientSeat& seat = is_new ? seat_for(hello) : *here;
    const ClientId id(static_cast<std::size_t>(&seat - seats_.data()));
    const bool succeeds = is_new && seat.joined;
    if (is_new) {
        if (options_.went_back) {  // its replies were for a discarded history
            hello.expected = -1;
            hello.acknowledged = hello.last_reply;
        }
        // The run follows a log, which has its replies so far.
        const bool follows_log = scheduled_until < recorder_.logged_until();
        sit_down(seat, from, hello, follows_log ? tick : scheduled_until);
    }
    seat.vanished_ms.reset();
    bus.send(kControllerAddress, from, ClientWelcome{id, seat.first, options_.seed});
    if (!is_new) return;
    seat.heard_ms = bus.now_ms();
    seat.sent_ms = 0;
    due_ = due_ || !seat.unanswered.empty();
    notices_.add("client '" + seat.name + "' joined at tick " + std::to_string(tick) +
                 (succeeds ? ", in the place of one that had vanished" : ""));
    if (!succeeds) recorder_.joined(id, seat.name);
    if (seat.observer) recorder_.gone(id);
    const bool is_stepping = scheduled_until > tick;
    if (!is_stepping && seat.unanswered.empty() && observes(seat, tick)) queue_observation(id);
}

/// The Client of this name for which the run waits, or would.
ClientSeat* ClientService::seat_named(const std::string& name) {
    const auto seat = std::ranges::find_if(
        seats_, [&](const ClientSeat& s) { return s.serves() && !s.observer && s.name == name; });
    return seat == seats_.end() ? nullptr : &*seat;
}

std::optional<Error> ClientService::objection_to(const Address& from, const ClientHello& hello,
                                                 const Rights* rights) {
    if (hello.model_hash != model_->hash)
        return Error{"its world is not this run's", "start it again: it gets the world from the Controller",
                     "other-world"};
    if (looks_only(rights) && hello.synchronous)
        return Error{"the key '" + rights->key + "' lets it look only, and the world would wait for it",
                     "make it free-running (ControlOptions::synchronous), or look on with `roboss view`",
                     "not-permitted"};
    const ClientSeat* seat = hello.observer ? nullptr : seat_named(hello.name);
    if (seat == nullptr || seat->address == from) return {};
    if (!seat->vanished_ms)
        return Error{"a Client of this name takes part already",
                     "give this one another name; if the other one has just died, start it again in a second",
                     "name-taken"};
    const bool same_times = seat->period == hello.period && seat->latency == hello.latency &&
                            seat->synchronous == hello.synchronous;
    if (same_times || !seat->synchronous) return {};
    return Error{"its predecessor observed every " + std::to_string(seat->period) +
                     " ticks, with a latency of " + std::to_string(seat->latency) + "; this one asks for " +
                     std::to_string(hello.period) + " and " + std::to_string(hello.latency),
                 "start it with the same times, or end the run and begin a branch with the new program: "
                 "--from JOURNAL --journal JOURNAL",
                 "other-times"};
}

/// That of its predecessor, which has vanished; or one that waits for it; or a new one, always so for an
/// observer.
ClientSeat& ClientService::seat_for(const ClientHello& hello) {
    if (hello.observer) return seats_.emplace_back();
    if (ClientSeat* before = seat_named(hello.name)) return *before;
    const auto waits =
        std::ranges::find_if(seats_, [&](const ClientSeat& s) { return !s.joined && s.name == hello.name; });
    return waits == seats_.end() ? seats_.emplace_back() : *waits;
}

/// A successor is asked again what its predecessor did not answer.
void ClientService::sit_down(ClientSeat& seat, const Address& address, const ClientHello& hello,
                             Tick earliest) {
    seat.name = hello.name;
    seat.address = address;
    seat.period = hello.period;
    seat.latency = hello.latency;
    seat.synchronous = hello.synchronous;
    seat.observer = hello.observer;
    seat.joined = true;
    seat.first = seat.unanswered.empty()
                     ? next_multiple(std::max({earliest, hello.expected, seat.answered + 1}), hello.period)
                     : seat.unanswered.front();
    seat.last_reply = seat.acknowledged = hello.acknowledged;
    seat.reply_awaited = hello.last_reply;
    seat.acknowledge_at.reset();
    seat.refused.clear();
    seat.sequence_before = seat.sequence;
}

ClientSeat* ClientService::joined_at(Bus& bus, const Address& from, ClientId id) {
    ClientSeat* seat = id.index() < seats_.size() ? &seats_[id.index()] : nullptr;
    if (seat != nullptr && seat->joined && seat->address == from) return seat;
    // A seat of an earlier Controller: its holder has to join again.
    bus.send(kControllerAddress, from, ClientUnknown{id});
    return nullptr;
}

std::size_t ClientService::take_reply(Bus& bus, const Address& from, const ClientReply& reply,
                                      Tick scheduled_until, const Rights* rights) {
    ClientSeat* seat = joined_at(bus, from, reply.client);
    if (seat == nullptr || !seat->serves()) return 0;
    seat->heard_ms = bus.now_ms();
    seat->vanished_ms.reset();
    std::size_t refused = 0;
    while (!seat->refused.empty() && seat->refused.front().reply <= reply.acknowledged)
        seat->refused.pop_front();
    if (reply.number == seat->last_reply + 1) {
        seat->last_reply = reply.number;
        seat->answered = std::max(seat->answered, reply.observed);
        if (!recorder_.has_reply(reply.client, seat->synchronous, reply.observed))
            refused = take_orders(*seat, reply, scheduled_until, rights);
        std::erase_if(seat->unanswered, [&](Tick tick) { return tick == reply.observed; });
        directory_.forget(reply.client, reply.observed);
    }
    // An acknowledged reply is never lost: with a log, it is logged first.
    seat->acknowledge_at = recorder_.given();
    return refused;
}

Tick ClientService::stampable(Tick scheduled_until) const {
    return std::max(scheduled_until, recorder_.logged_until());
}

std::size_t ClientService::take_orders(ClientSeat& seat, const ClientReply& reply, Tick scheduled_until,
                                       const Rights* rights) {
    std::size_t refused = 0;
    const Tick earliest = stampable(scheduled_until);
    const Tick apply_at = seat.synchronous ? std::max(reply.observed + seat.latency, earliest) : earliest;
    for (const ClientOrder& given : reply.orders) {
        const std::uint64_t sequence = seat.sequence_before + given.sequence;
        seat.sequence = std::max(seat.sequence, sequence);
        const Order order{apply_at, reply.client, sequence, given.robot, given.action};
        Result<> checked = check_order(*model_, order);
        if (checked) checked = permit(rights, *model_, order);
        if (!checked) {
            ++refused;
            seat.refused.push_back(
                {reply.number, {given.sequence, checked.error().text(), checked.error().code}});
            if (seat.refused.size() > kRefusalsKept) seat.refused.pop_front();
            notices_.add_refusal("orders of client '" + seat.name + "'", checked.error());
            continue;
        }
        order_log_.add(order, reply.observed);
        recorder_.order(order, reply.observed);
    }
    recorder_.reply(reply.client, reply.observed);
    return refused;
}

void ClientService::acknowledge(Bus& bus) {
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        ClientSeat& seat = seats_[i];
        if (!seat.acknowledge_at || !recorder_.safe(*seat.acknowledge_at)) continue;
        seat.acknowledge_at.reset();
        seat.acknowledged = seat.last_reply;
        ReplyAck ack{ClientId(i), seat.last_reply, {}};
        for (const ClientSeat::Refusal& refusal : seat.refused) ack.refused.push_back(refusal.order);
        bus.send(kControllerAddress, seat.address, std::move(ack));
    }
}

void ClientService::take_bye(Bus& bus, const Address& from, const ClientBye& bye, const Rights* rights) {
    ClientSeat* seat = joined_at(bus, from, bye.client);
    if (seat == nullptr || bye.number > seat->last_reply + 1) return;
    const bool is_news = !seat->gone && bye.number > seat->last_reply;
    const bool ends_run = bye.failed && !looks_only(rights);
    if (is_news) {
        seat->last_reply = bye.number;
        drop(bye.client, !ends_run);
    }
    seat->acknowledge_at = recorder_.given();
    if (!is_news) return;
    if (ends_run)
        notices_.fail(error_of_text(
            "client '" + seat->name + "' failed at tick " + std::to_string(directory_.tick()) + ": ",
            bye.reason, "fix the control program; the world up to this tick is intact and can be saved",
            "client-failed"));
    else
        notices_.add("client '" + seat->name + "' left" + (bye.failed ? ": " + bye.reason : ""));
}

void ClientService::drop(ClientId id, bool for_good) {
    ClientSeat& seat = seats_[id.index()];
    seat.gone = true;
    if (for_good) recorder_.gone(id);
    for (const Tick tick : std::exchange(seat.unanswered, {})) directory_.forget(id, tick);
}

void ClientService::take_vanished(const Address& address, std::int64_t now_ms) {
    for (ClientSeat& seat : seats_) {
        if (!seat.serves() || seat.address != address || seat.vanished_ms) continue;
        seat.vanished_ms = now_ms;
        if (seat.synchronous && !seat.observer && options_.gone_ms > 0)
            notices_.add("client '" + seat.name + "' has vanished; the run waits " +
                         std::to_string(options_.gone_ms) +
                         " ms for it, or for another of its name [client-vanished]");
    }
}

bool ClientService::stays_away(const ClientSeat& seat, std::int64_t now_ms) const {
    const auto beyond = [](std::int64_t for_ms, std::int64_t limit_ms) {
        return limit_ms > 0 && for_ms > limit_ms;
    };
    return beyond(now_ms - seat.heard_ms, options_.loss_ms) ||
           (seat.vanished_ms && beyond(now_ms - *seat.vanished_ms, options_.gone_ms));
}

void ClientService::notice_losses(std::int64_t now_ms) {
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        ClientSeat& seat = seats_[i];
        if (seat.unanswered.empty()) seat.heard_ms = now_ms;
        if (!seat.serves() || !stays_away(seat, now_ms)) continue;
        drop(ClientId(i), !seat.synchronous);
        const std::string what = "client '" + seat.name + "' " +
                                 (seat.vanished_ms ? "has vanished, " : "has not answered for ") +
                                 std::to_string(now_ms - seat.vanished_ms.value_or(seat.heard_ms)) + " ms" +
                                 (seat.vanished_ms ? " ago" : "");
        if (seat.synchronous)
            notices_.fail({what + " at tick " + std::to_string(directory_.tick()),
                           "see why it hangs; the world up to this tick is intact and can be saved",
                           "client-lost"});
        else
            notices_.add(what + " and is given up");
    }
}

void ClientService::queue_observations() {
    for (std::size_t i = 0; i < seats_.size(); ++i)
        if (observes(seats_[i], directory_.tick())) queue_observation(ClientId(i));
}

void ClientService::show_rest() {
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        const ClientSeat& seat = seats_[i];
        const bool looks = seat.serves() && seat.observer && seat.period < kOrdersOnly;
        if (looks && seat.shown != directory_.tick()) queue_observation(ClientId(i));
    }
}

void ClientService::queue_observation(ClientId id) {
    ClientSeat& seat = seats_[id.index()];
    if (!seat.synchronous && !seat.unanswered.empty())
        return;  // it is busy with an earlier observation; the world does not wait
    seat.shown = directory_.tick();
    seat.unanswered.push_back(directory_.tick());
    seat.sent_ms = 0;
    directory_.want(id);
    due_ = true;
}

void ClientService::send_observations(Bus& bus, const Roster& roster) {
    const bool at_once = std::exchange(due_, false);
    const std::int64_t now = bus.now_ms();
    for (std::size_t i = 0; i < seats_.size(); ++i) {
        ClientSeat& seat = seats_[i];
        if (seat.unanswered.empty() || (!at_once && now - seat.sent_ms < options_.resend_ms)) continue;
        seat.sent_ms = now;
        for (const WantedTick& want : directory_.wanted()) {
            if (std::find(want.clients.begin(), want.clients.end(), ClientId(i)) == want.clients.end())
                continue;
            Observation observation = observation_of(want, roster);
            observation.last_reply = seat.acknowledged;
            bus.send(kControllerAddress, seat.address, std::move(observation));
        }
    }
}

/// Robots whose states are lost are left out until they are recovered; then the observation is sent again.
Observation ClientService::observation_of(const WantedTick& want, const Roster& roster) const {
    Observation observation{want.tick, 0, {}};
    std::vector<SeatId> seats;
    for (std::size_t r = 0; r < want.holders.size(); ++r) {
        if (roster.lost(want.holders[r])) continue;
        auto seat_id = std::find(seats.begin(), seats.end(), want.holders[r]);
        if (seat_id == seats.end()) {
            seat_id = seats.insert(seats.end(), want.holders[r]);
            observation.holders.push_back({roster.address_of(want.holders[r]), {}});
        }
        observation.holders[static_cast<std::size_t>(seat_id - seats.begin())].robots.emplace_back(r);
    }
    return observation;
}

void ClientService::send_heartbeats(Bus& bus) const {
    for (const ClientSeat& seat : seats_)
        if (seat.serves()) bus.send(kControllerAddress, seat.address, Heartbeat{});
}

void ClientService::dismiss(Bus& bus, const RunOver& over) const {
    for (const ClientSeat& seat : seats_)
        if (seat.joined) bus.send(kControllerAddress, seat.address, over);
}

bool ClientService::all_joined() const {
    return std::all_of(seats_.begin(), seats_.end(), [](const ClientSeat& s) { return s.joined; });
}

bool ClientService::all_replied(Tick tick) const {
    return std::all_of(seats_.begin(), seats_.end(), [tick](const ClientSeat& seat) {
        return !seat.synchronous || seat.unanswered.empty() || seat.unanswered.front() >= tick;
    });
}

Tick ClientService::limit(Tick tick, bool all_answered) const {
    Tick limit = std::numeric_limits<Tick>::max();
    for (const ClientSeat& seat : seats_) {
        if (!seat.serves()) continue;
        if (!all_answered && seat.synchronous && seat.last_reply < seat.reply_awaited) return tick;
        const Tick next = std::max(next_multiple(tick + 1, seat.period), seat.first);
        if (next > tick) limit = std::min(limit, next);
        if (!seat.synchronous) continue;
        Tick open = seat.unanswered.empty() ? next : seat.unanswered.front();
        if (all_answered) open = observes(seat, tick) ? tick : next;
        limit = std::min(limit, open + seat.latency);
    }
    return limit;
}

std::vector<std::string> ClientService::awaited(Tick tick) const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : seats_) {
        const bool behind =
            seat.synchronous && (seat.last_reply < seat.reply_awaited ||
                                 (!seat.unanswered.empty() && seat.unanswered.front() <= tick));
        if (!seat.joined || (seat.serves() && behind)) names.push_back(seat.name);
    }
    return names;
}

std::vector<std::string> ClientService::names() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : seats_) names.push_back(seat.name);
    return names;
}

std::vector<std::string> ClientService::names_serving() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : seats_)
        if (!seat.gone && !seat.observer) names.push_back(seat.name);
    return names;
}

}  // namespace roboss
