// The Controller towards Clients: words in, observations out.
#include <algorithm>
#include <utility>

#include "roles/controller.h"

namespace roboss {

void Controller::take_client_hello(Bus& bus, const Address& from, const ClientHello& hello) {
    if (from.role != Role::kClient) return note_dropped("ClientHello", "who sends it is not a Client");
    if (is_earlier_model(hello.model_hash))
        return bus.send(kControllerAddress, from, ModelChanged{model_->hash});
    if (hello.model_hash != model_->hash)
        return bus.send(kControllerAddress, from, Refused{"its world is not this run's"});
    bool is_new = false;
    const bool goes_on = plannable() < logged_until_;  // by a log, in which its words so far are
    ClientHello new_hello = hello;
    if (options_.before.went_back) {  // what it said was for a time that is no more
        new_hello.expected = -1;
        new_hello.acknowledged = new_hello.said;
    }
    const ClientId id = desk_.welcome(from, new_hello, goes_on ? tick_ : plannable(), is_new);
    ClientSeat& seat = desk_.seats()[id.index()];
    seat.vanished_ms.reset();
    bus.send(kControllerAddress, from, ClientWelcome{id, seat.first, options_.seed});
    if (!is_new) return;
    notice("client '" + seat.name + "' joined at tick " + std::to_string(tick_));
    if (options_.log != nullptr) options_.log->joined(id, seat.name);
    if (options_.log != nullptr && seat.guest) options_.log->word(id, kGoneForGood);  // not to be awaited
    const bool at_rest = !round_ || round_->span().recovery;
    if (at_rest && ClientDesk::observes(seat, tick_)) tell_observer(id, tick_);
}

void Controller::take_word(Bus& bus, const Address& from, const ClientWord& word) {
    ClientSeat* seat = desk_.find(word.client);
    // A seat of an earlier Controller's run: who held it is to join afresh.
    if (seat == nullptr || !seat->joined || seat->address != from)
        return bus.send(kControllerAddress, from, ClientUnknown{word.client});
    if (!seat->serves()) return;
    seat->heard_ms = bus.now_ms();
    seat->vanished_ms.reset();
    if (word.word == seat->last_word + 1) {
        seat->last_word = word.word;
        if (!is_in_log(*seat, word)) take_orders(*seat, word);
        std::erase_if(seat->unanswered, [&](Tick tick) { return tick == word.observed; });
        forget(word.client, word.observed);
    }
    // What is acknowledged is never lost: with a log, it is there first.
    seat->acknowledge_at = options_.log != nullptr ? options_.log->given() : 0;
}

void Controller::acknowledge(Bus& bus) {
    for (std::size_t i = 0; i < desk_.seats().size(); ++i) {
        ClientSeat& seat = desk_.seats()[i];
        if (!seat.acknowledge_at) continue;
        if (options_.log != nullptr && !options_.log->safe(*seat.acknowledge_at)) continue;
        seat.acknowledge_at.reset();
        seat.acknowledged = seat.last_word;
        bus.send(kControllerAddress, seat.address, WordAck{ClientId(i), seat.last_word, seat.refused});
    }
}

/// A run that goes on from a log asks Clients again what they have answered there.
bool Controller::is_in_log(const ClientSeat& seat, const ClientWord& word) const {
    const auto i = static_cast<std::size_t>(&seat - desk_.seats().data());
    const Tick answered = i < answered_.size() ? answered_[i] : logged_until_ - 1;
    return word.observed <= answered || (!seat.synchronous && word.observed < logged_until_);
}

void Controller::take_orders(ClientSeat& seat, const ClientWord& word) {
    seat.refused.clear();
    const Tick apply_at =
        seat.synchronous ? std::max(word.observed + seat.latency, stampable()) : stampable();
    for (const ClientOrder& given : word.orders) {
        const Order order{apply_at, word.client, given.sequence, given.robot, given.action};
        if (Result<> checked = check_order(*model_, order); !checked) {
            seat.refused.push_back({given.sequence, checked.error().text()});
            ++counters_.orders_refused;
            notice("order " + std::to_string(given.sequence) + " of client '" + seat.name +
                   "' refused: " + checked.error().message);
            continue;
        }
        book_.add(order, word.observed);
        if (options_.log != nullptr) options_.log->order(order, word.observed);
    }
    if (options_.log != nullptr) options_.log->word(word.client, word.observed);
}

void Controller::take_bye(Bus& bus, const Address& from, const ClientBye& bye) {
    ClientSeat* seat = desk_.find(bye.client);
    if (seat == nullptr || !seat->joined || seat->address != from)
        return bus.send(kControllerAddress, from, ClientUnknown{bye.client});
    if (bye.word > seat->last_word + 1) return;
    const bool is_news = !seat->gone && bye.word > seat->last_word;
    if (is_news) {
        seat->last_word = bye.word;
        drop_client(bye.client);
    }
    seat->acknowledge_at = options_.log != nullptr ? options_.log->given() : 0;
    if (!is_news) return;
    if (bye.failed)
        fail({"client '" + seat->name + "' failed at tick " + std::to_string(tick_) + ": " + bye.reason,
              "mend the control program; the world up to this tick is intact and can be saved"});
    else
        notice("client '" + seat->name + "' left");
}

void Controller::drop_client(ClientId id) {
    ClientSeat& seat = desk_.seats()[id.index()];
    seat.gone = true;
    if (options_.log != nullptr) options_.log->word(id, kGoneForGood);
    for (const Tick tick : std::exchange(seat.unanswered, {})) forget(id, tick);
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
    for (std::size_t i = 0; i < desk_.seats().size(); ++i) {
        ClientSeat& seat = desk_.seats()[i];
        if (seat.unanswered.empty()) seat.heard_ms = now;
        if (!seat.serves() || !stays_away(seat, now)) continue;
        drop_client(ClientId(i));
        const std::string what = "client '" + seat.name + "' " +
                                 (seat.vanished_ms ? "has vanished, " : "has not answered for ") +
                                 std::to_string(now - seat.vanished_ms.value_or(seat.heard_ms)) + " ms" +
                                 (seat.vanished_ms ? " ago" : "");
        if (seat.synchronous)
            fail({what + " at tick " + std::to_string(tick_),
                  "see why it hangs; the world up to this tick is intact and can be saved"});
        else
            notice(what + " and is given up");
    }
}

WantedTick& Controller::want_at_this_tick() {
    if (wants_.empty() || wants_.back().tick != tick_) {
        wants_.push_back({});
        wants_.back().tick = tick_;
        wants_.back().holder = holder_;
    }
    return wants_.back();
}

void Controller::tell_observers() {
    for (std::size_t i = 0; i < desk_.seats().size(); ++i)
        if (ClientDesk::observes(desk_.seats()[i], tick_)) tell_observer(ClientId(i), tick_);
}

void Controller::tell_observer(ClientId id, Tick tick) {
    ClientSeat& seat = desk_.seats()[id.index()];
    if (!seat.synchronous && !seat.unanswered.empty())
        return;  // it is busy with an earlier one; the world does not wait
    seat.unanswered.push_back(tick);
    seat.told_ms = 0;
    want_at_this_tick().clients.push_back(id);
    tell_again_ = true;
}

void Controller::forget(ClientId id, Tick tick) {
    for (WantedTick& want : wants_)
        if (want.tick == tick) std::erase(want.clients, id);
    std::erase_if(wants_, [](const WantedTick& want) { return !want.open(); });
}

void Controller::send_observations(Bus& bus, bool again_now) {
    const std::int64_t now = bus.now_ms();
    for (std::size_t i = 0; i < desk_.seats().size(); ++i) {
        ClientSeat& seat = desk_.seats()[i];
        if (seat.unanswered.empty() || (!again_now && now - seat.told_ms < options_.resend_ms)) continue;
        seat.told_ms = now;
        for (const WantedTick& want : wants_) {
            if (std::find(want.clients.begin(), want.clients.end(), ClientId(i)) == want.clients.end())
                continue;
            Observation observation{want.tick, seat.acknowledged, {}};
            std::vector<std::uint32_t> places;
            for (std::size_t r = 0; r < want.holder.size(); ++r) {
                if (is_lost(want.holder[r])) continue;  // told again when it is back
                auto place = std::find(places.begin(), places.end(), want.holder[r]);
                if (place == places.end()) {
                    place = places.insert(places.end(), want.holder[r]);
                    observation.holders.push_back({roster_.address_of(want.holder[r]), {}});
                }
                observation.holders[static_cast<std::size_t>(place - places.begin())].robots.emplace_back(r);
            }
            bus.send(kControllerAddress, seat.address, std::move(observation));
        }
    }
}

}  // namespace roboss
