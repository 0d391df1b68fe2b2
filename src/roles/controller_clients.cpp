// The Controller and its Clients: replies in, observations out.
#include <algorithm>
#include <utility>

#include "roles/controller.h"

namespace roboss {

void Controller::take_client_hello(Bus& bus, const Address& from, const ClientHello& hello) {
    if (from.role != Role::kClient)
        return notices_.dropped("ClientHello", tick(), "its sender is not a Client");
    if (model_server_.is_earlier(hello.model_hash))
        return bus.send(kControllerAddress, from, ModelChanged{model_->hash});
    if (hello.model_hash != model_->hash)
        return bus.send(kControllerAddress, from, Refused{"its world is not this run's"});
    bool is_new = false;
    const bool goes_on =
        scheduled_until() < recorder_.logged_until();  // follows a log that has its replies so far
    ClientHello new_hello = hello;
    if (options_.before.went_back) {  // its replies were for a discarded history
        new_hello.expected = -1;
        new_hello.acknowledged = new_hello.last_reply;
    }
    const ClientId id = clients_.welcome(from, new_hello, goes_on ? tick() : scheduled_until(), is_new);
    ClientSeat& seat = clients_.seats()[id.index()];
    seat.vanished_ms.reset();
    bus.send(kControllerAddress, from, ClientWelcome{id, seat.first, options_.seed});
    if (!is_new) return;
    notices_.add("client '" + seat.name + "' joined at tick " + std::to_string(tick()));
    recorder_.joined(id, seat.name);
    if (seat.observer) recorder_.gone(id);
    const bool at_rest = !round_ || round_->span().recovery;
    if (at_rest && ClientService::observes(seat, tick())) queue_observation(id, tick());
}

void Controller::take_reply(Bus& bus, const Address& from, const ClientReply& reply) {
    ClientSeat* seat = clients_.find(reply.client);
    // A seat of an earlier Controller: its holder has to join again.
    if (seat == nullptr || !seat->joined || seat->address != from)
        return bus.send(kControllerAddress, from, ClientUnknown{reply.client});
    if (!seat->serves()) return;
    seat->heard_ms = bus.now_ms();
    seat->vanished_ms.reset();
    if (reply.number == seat->last_reply + 1) {
        seat->last_reply = reply.number;
        if (!recorder_.has_reply(reply.client, seat->synchronous, reply.observed)) take_orders(*seat, reply);
        std::erase_if(seat->unanswered, [&](Tick tick) { return tick == reply.observed; });
        directory_.forget(reply.client, reply.observed);
    }
    // An acknowledged reply is never lost: with a log, it is logged first.
    seat->acknowledge_at = recorder_.given();
}

void Controller::acknowledge(Bus& bus) {
    for (std::size_t i = 0; i < clients_.seats().size(); ++i) {
        ClientSeat& seat = clients_.seats()[i];
        if (!seat.acknowledge_at) continue;
        if (!recorder_.safe(*seat.acknowledge_at)) continue;
        seat.acknowledge_at.reset();
        seat.acknowledged = seat.last_reply;
        bus.send(kControllerAddress, seat.address, ReplyAck{ClientId(i), seat.last_reply, seat.refused});
    }
}

void Controller::take_orders(ClientSeat& seat, const ClientReply& reply) {
    seat.refused.clear();
    const Tick apply_at =
        seat.synchronous ? std::max(reply.observed + seat.latency, stampable()) : stampable();
    for (const ClientOrder& given : reply.orders) {
        const Order order{apply_at, reply.client, given.sequence, given.robot, given.action};
        if (Result<> checked = check_order(*model_, order); !checked) {
            seat.refused.push_back({given.sequence, checked.error().text()});
            ++counters_.orders_refused;
            notices_.add("order " + std::to_string(given.sequence) + " of client '" + seat.name +
                         "' refused: " + checked.error().message);
            continue;
        }
        order_log_.add(order, reply.observed);
        recorder_.order(order, reply.observed);
    }
    recorder_.reply(reply.client, reply.observed);
}

void Controller::take_bye(Bus& bus, const Address& from, const ClientBye& bye) {
    ClientSeat* seat = clients_.find(bye.client);
    if (seat == nullptr || !seat->joined || seat->address != from)
        return bus.send(kControllerAddress, from, ClientUnknown{bye.client});
    if (bye.number > seat->last_reply + 1) return;
    const bool is_news = !seat->gone && bye.number > seat->last_reply;
    if (is_news) {
        seat->last_reply = bye.number;
        drop_client(bye.client);
    }
    seat->acknowledge_at = recorder_.given();
    if (!is_news) return;
    if (bye.failed)
        notices_.fail(
            {"client '" + seat->name + "' failed at tick " + std::to_string(tick()) + ": " + bye.reason,
             "fix the control program; the world up to this tick is intact and can be saved",
             "client-failed"});
    else
        notices_.add("client '" + seat->name + "' left");
}

void Controller::drop_client(ClientId id) {
    ClientSeat& seat = clients_.seats()[id.index()];
    seat.gone = true;
    recorder_.gone(id);
    for (const Tick tick : std::exchange(seat.unanswered, {})) directory_.forget(id, tick);
}

bool Controller::stays_away(const ClientSeat& seat, std::int64_t now_ms) const {
    const auto beyond = [](std::int64_t for_ms, std::int64_t limit_ms) {
        return limit_ms > 0 && for_ms > limit_ms;
    };
    return beyond(now_ms - seat.heard_ms, options_.client_loss_ms) ||
           (seat.vanished_ms && beyond(now_ms - *seat.vanished_ms, options_.client_gone_ms));
}

void Controller::notice_client_losses(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    for (std::size_t i = 0; i < clients_.seats().size(); ++i) {
        ClientSeat& seat = clients_.seats()[i];
        if (seat.unanswered.empty()) seat.heard_ms = now;
        if (!seat.serves() || !stays_away(seat, now)) continue;
        drop_client(ClientId(i));
        const std::string what = "client '" + seat.name + "' " +
                                 (seat.vanished_ms ? "has vanished, " : "has not answered for ") +
                                 std::to_string(now - seat.vanished_ms.value_or(seat.heard_ms)) + " ms" +
                                 (seat.vanished_ms ? " ago" : "");
        if (seat.synchronous)
            notices_.fail({what + " at tick " + std::to_string(tick()),
                           "see why it hangs; the world up to this tick is intact and can be saved",
                           "client-lost"});
        else
            notices_.add(what + " and is given up");
    }
}

std::vector<std::string> Controller::client_names() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : clients_.seats()) names.push_back(seat.name);
    return names;
}

std::vector<std::string> Controller::clients_serving() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : clients_.seats())
        if (seat.serves() && !seat.observer) names.push_back(seat.name);
    return names;
}

void Controller::queue_observations() {
    for (std::size_t i = 0; i < clients_.seats().size(); ++i)
        if (ClientService::observes(clients_.seats()[i], tick())) queue_observation(ClientId(i), tick());
}

void Controller::queue_observation(ClientId id, Tick tick) {
    ClientSeat& seat = clients_.seats()[id.index()];
    if (!seat.synchronous && !seat.unanswered.empty())
        return;  // it is busy with an earlier observation; the world does not wait
    seat.unanswered.push_back(tick);
    seat.sent_ms = 0;
    directory_.want(id);
    observations_due_ = true;
}

void Controller::send_observations(Bus& bus, bool again_now) {
    const std::int64_t now = bus.now_ms();
    for (std::size_t i = 0; i < clients_.seats().size(); ++i) {
        ClientSeat& seat = clients_.seats()[i];
        if (seat.unanswered.empty() || (!again_now && now - seat.sent_ms < options_.resend_ms)) continue;
        seat.sent_ms = now;
        for (const WantedTick& want : directory_.wanted()) {
            if (std::find(want.clients.begin(), want.clients.end(), ClientId(i)) == want.clients.end())
                continue;
            Observation observation{want.tick, seat.acknowledged, {}};
            std::vector<SeatId> seats;
            for (std::size_t r = 0; r < want.holders.size(); ++r) {
                if (roster_.lost(want.holders[r])) continue;  // sent again once it is recovered
                auto seat_id = std::find(seats.begin(), seats.end(), want.holders[r]);
                if (seat_id == seats.end()) {
                    seat_id = seats.insert(seats.end(), want.holders[r]);
                    observation.holders.push_back({roster_.address_of(want.holders[r]), {}});
                }
                observation.holders[static_cast<std::size_t>(seat_id - seats.begin())].robots.emplace_back(r);
            }
            bus.send(kControllerAddress, seat.address, std::move(observation));
        }
    }
}

}  // namespace roboss
