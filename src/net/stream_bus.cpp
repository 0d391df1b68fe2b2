// Messages to bytes and back; mailboxes here, connections in switchboard.h.
#include "net/stream_bus.h"

#include <algorithm>

#include "net/frames.h"
#include "net/mailboxes.h"
#include "net/switchboard.h"
#include "wire/codec.h"

namespace roboss {

class StreamBus::Network {
  public:
    Mailboxes mailboxes;
    std::unique_ptr<Switchboard> switchboard;  // the last: its thread fills the mailboxes

    static Result<std::unique_ptr<Network>> open(const NetOptions& options,
                                                 std::optional<Switchboard::Member> member) {
        auto network = std::make_unique<Network>();
        Result<std::unique_ptr<Switchboard>> switchboard =
            Switchboard::open(options, std::move(member), network->mailboxes);
        if (!switchboard) return switchboard.error();
        network->switchboard = std::move(switchboard).value();
        return network;
    }
};

StreamBus::StreamBus(std::unique_ptr<Network> network) : network_(std::move(network)) {}
StreamBus::~StreamBus() = default;

Result<std::unique_ptr<StreamBus>> StreamBus::listen(const NetOptions& options) {
    Result<std::unique_ptr<Network>> network = Network::open(options, std::nullopt);
    if (!network) return network.error();
    return std::unique_ptr<StreamBus>(new StreamBus(std::move(network).value()));
}

Result<std::unique_ptr<StreamBus>> StreamBus::join(const NetOptions& options, const std::string& role,
                                                   const std::string& name) {
    Result<std::unique_ptr<Network>> network = Network::open(options, Switchboard::Member{role, name});
    if (!network) return network.error();
    return std::unique_ptr<StreamBus>(new StreamBus(std::move(network).value()));
}

void StreamBus::send(const Address& from, const Address& to, Message message) {
    Envelope envelope{from, to, std::move(message)};
    if (network_->mailboxes.put_local(envelope)) return;
    const bool urgent = std::holds_alternative<Heartbeat>(envelope.message);
    std::vector<std::uint8_t> bytes = encode(envelope);
    network_->mailboxes.count(from, to, bytes.size());
    network_->switchboard->beats().note_own(from, to);
    network_->switchboard->send(to, std::move(bytes), urgent);
}

void StreamBus::drain(const Address& self, std::vector<Envelope>& inbox) {
    network_->mailboxes.drain(self, inbox);
    if (!inbox.empty()) network_->switchboard->resume();
}

std::vector<Address> StreamBus::take_vanished(const Address& self) {
    return network_->mailboxes.take_vanished(self);
}

void StreamBus::wait(std::int64_t ms_max) {
    network_->mailboxes.wait(ms_max);
}

void StreamBus::ring() {
    network_->mailboxes.ring();
}

void StreamBus::keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) {
    if (network_->mailboxes.has(to)) return;  // in this process, so in the same thread
    network_->switchboard->beats().begin(from, to, encode(Envelope{from, to, heartbeat}));
}

void StreamBus::end_keep_alive(const Address& from) {
    network_->switchboard->beats().end(from);
}

std::vector<Flow> StreamBus::flows() const {
    return network_->mailboxes.flows();
}

bool StreamBus::present(const Address& address) const {
    return network_->mailboxes.has(address) || network_->switchboard->reaches(address);
}

std::optional<std::int64_t> StreamBus::heard_ms(const Address& address) const {
    return network_->mailboxes.heard_ms(address);
}

std::optional<Error> StreamBus::refusal() const {
    return network_->switchboard->refusal();
}

std::optional<RunOver> StreamBus::run_end() const {
    return network_->switchboard->farewell();
}

std::optional<RunOver> StreamBus::run_end_after_turn() {
    std::optional<RunOver> end = run_end();
    return std::exchange(end_seen_, end.has_value()) ? std::move(end) : std::nullopt;
}

void StreamBus::say_farewell(const RunOver& end) {
    network_->switchboard->say_farewell(end);
}

bool StreamBus::flush(std::int64_t ms_max) {
    const std::int64_t end = now_ms() + ms_max;
    while (!network_->switchboard->all_sent()) {
        if (now_ms() >= end) return false;
        network_->mailboxes.wait(2);
    }
    return true;
}

std::vector<std::string> StreamBus::take_notices() {
    return network_->switchboard->take_notices();
}

std::string StreamBus::where() const {
    return network_->switchboard->where();
}

std::string describe(const NetOptions& options) {
    return "simulation '" + options.simulation + "'" +
           (options.controller.empty() ? "" : " at " + options.controller);
}

}  // namespace roboss
