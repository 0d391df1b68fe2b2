// Addresses to inboxes and outboxes, messages to bytes and back.
#include "dds/dds_bus.h"

#include <fastdds/dds/log/Log.hpp>

#include <algorithm>
#include <cstring>
#include <deque>
#include <random>

#include "bus/flow_count.h"
#include "core/hash.h"
#include "dds/endpoints.h"
#include "dds/pulse.h"
#include "wire/codec.h"

namespace roboss {

namespace {

constexpr std::size_t kNoticesMax = 100;
constexpr std::int64_t kFound_ms = 400;    // within which two members mostly find each other
constexpr std::int64_t kIdle_ms = 30'000;  // an outbox that nobody reads so long is closed

TopicKind kind_of(const Message& message) {
    return std::holds_alternative<Heartbeat>(message) ? TopicKind::kHeartbeats : TopicKind::kReliable;
}

// Before each message: which run it is of, 8 bytes.
constexpr std::size_t kRunBytes = sizeof(std::uint64_t);

std::vector<std::uint8_t> with_run(std::uint64_t run, const std::vector<std::uint8_t>& message) {
    std::vector<std::uint8_t> bytes(kRunBytes + message.size());
    std::memcpy(bytes.data(), &run, kRunBytes);
    std::memcpy(bytes.data() + kRunBytes, message.data(), message.size());
    return bytes;
}

std::uint64_t take_run(std::span<const std::uint8_t> bytes) {
    std::uint64_t run = 0;
    if (bytes.size() >= kRunBytes) std::memcpy(&run, bytes.data(), kRunBytes);
    return run;
}

std::uint64_t new_run() {
    std::random_device device;
    return (static_cast<std::uint64_t>(device()) << 32 | device()) | 1;  // never 0
}

/// Errors that the DDS layer would print, until they are taken; bounded.
class NoticeBuffer {
  public:
    void add(std::string line) {
        const std::lock_guard lock(mutex_);
        if (lines_.size() < kNoticesMax) lines_.push_back(std::move(line));
    }
    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(lines_, {});
    }

  private:
    std::mutex mutex_;
    std::vector<std::string> lines_;
};

class DdsLogConsumer : public eprosima::fastdds::dds::LogConsumer {
  public:
    explicit DdsLogConsumer(std::shared_ptr<NoticeBuffer> notices) : notices_(std::move(notices)) {}
    void Consume(const eprosima::fastdds::dds::Log::Entry& entry) override {
        notices_->add("dds: " + entry.message);
    }

  private:
    std::shared_ptr<NoticeBuffer> notices_;
};

std::shared_ptr<NoticeBuffer> collect_dds_errors() {
    auto notices = std::make_shared<NoticeBuffer>();
    using eprosima::fastdds::dds::Log;
    Log::ClearConsumers();
    Log::SetVerbosity(Log::Kind::Error);
    Log::RegisterConsumer(std::make_unique<DdsLogConsumer>(notices));
    return notices;
}

}  // namespace

struct DdsBus::Network {
    /// An address of this process.
    struct Home {
        std::unique_ptr<Inbox> reliable, heartbeats;
        std::deque<Envelope> local;
        std::map<Inbox::Writer, Address> writers;  // known from their messages
        std::vector<Address> vanished;

        /// A writer of the Controller's process also carries messages that it relays for others.
        void note_writer(const Inbox::Writer& writer, const Address& from) {
            if (from == kControllerAddress)
                writers[writer] = from;
            else
                writers.try_emplace(writer, from);
        }
    };

    std::string topic(const Address& address, TopicKind kind) const {
        static constexpr const char* kRoles[] = {"controller", "simulator", "client"};
        return "roboss/" + options.simulation + "/" + kRoles[static_cast<int>(address.role)] + "/" +
               to_hex(address.instance) + (kind == TopicKind::kHeartbeats ? "/heartbeats" : "/reliable");
    }

    Home& home(const Address& address) {
        const auto [entry, is_new] = homes.try_emplace(address);
        if (is_new) open(address, entry->second);
        return entry->second;
    }

    void open(const Address& address, Home& home) {
        if (address.role == Role::kController && run == 0) run = new_run();
        home.reliable =
            Inbox::open(*participant, topic(address, TopicKind::kReliable), TopicKind::kReliable, bell);
        home.heartbeats =
            Inbox::open(*participant, topic(address, TopicKind::kHeartbeats), TopicKind::kHeartbeats, bell);
        ROBOSS_CHECK(home.reliable && home.heartbeats,
                     "DDS made no reader for " + topic(address, TopicKind::kReliable));
    }

    /// Recreates everything that belongs to the participant; messages between addresses of this process stay.
    Result<> reconnect() {
        if (Result<> possible = Participant::possible(options); !possible) return possible.error();
        lose_controller();
        outboxes.clear();
        for (auto& [address, home] : homes) {
            home.reliable.reset();
            home.heartbeats.reset();
            home.writers.clear();
        }
        for (auto& [address, beat] : beats) beat.pulse.reset();
        participant.reset();
        Result<std::unique_ptr<Participant>> again = Participant::create(options);
        ROBOSS_CHECK(again.ok(), again.error().text());
        participant = std::move(again).value();
        for (auto& [address, home] : homes) open(address, home);
        for (auto& [address, beat] : beats) begin(beat);
        return Ok{};
    }

    /// Heartbeats of an address of this process that go out while it is busy.
    struct Beat {
        Address to;
        std::vector<std::uint8_t> message;
        std::unique_ptr<Pulse> pulse;
    };

    void begin(Beat& beat) {
        const std::string name = topic(beat.to, TopicKind::kHeartbeats);
        // Its own, since an Outbox belongs to one thread.
        const std::shared_ptr<Outbox> outbox = Outbox::open(*participant, name, TopicKind::kHeartbeats, bell);
        ROBOSS_CHECK(outbox != nullptr, "DDS made no writer for " + name);
        beat.pulse = std::make_unique<Pulse>(
            [outbox, message = beat.message](std::int64_t now) { outbox->send(message, now); },
            Pulse::Limits{});
    }

    /// A member without a Controller may join the next one that appears.
    void lose_controller() {
        if (!homes.contains(kControllerAddress)) run = 0;
    }

    Outbox& outbox(const Address& to, TopicKind kind) {
        std::unique_ptr<Outbox>& outbox = outboxes[{to, kind}];
        if (!outbox) outbox = Outbox::open(*participant, topic(to, kind), kind, bell);
        ROBOSS_CHECK(outbox != nullptr, "DDS made no writer for " + topic(to, kind));
        return *outbox;
    }

    /// The outbox for a message: mostly the direct one; through the Controller if the options say so, or if
    /// two members see it and not each other (peers that name the Controller only, a firewall).
    Outbox& way_to(const Address& from, const Address& to, TopicKind kind) {
        const bool may_relay = from.role != Role::kController && to.role != Role::kController;
        if (may_relay && options.through_controller) return outbox(kControllerAddress, TopicKind::kReliable);
        Outbox& direct = outbox(to, kind);
        if (direct.connected() || !may_relay || monotonic_ms() - direct.opened_ms() < kFound_ms)
            return direct;
        Outbox& relay = outbox(kControllerAddress, TopicKind::kReliable);
        return relay.connected() ? relay : direct;
    }

    /// A message to relay: for an address of this process, or for one that only the Controller sees.
    void relay(const Address& self, Envelope envelope, std::span<const std::uint8_t> bytes) {
        if (self != kControllerAddress || envelope.to.role == Role::kController) return;
        const auto home = homes.find(envelope.to);
        if (home == homes.end()) {
            outbox(envelope.to, TopicKind::kReliable).send(bytes, monotonic_ms());
        } else {
            heard_ms[envelope.from] = monotonic_ms();
            count.add(envelope.from, envelope.to, bytes.size());
            home->second.local.push_back(std::move(envelope));
        }
    }

    /// False: some pieces wait until others have taken those in flight.
    bool pump() {
        const std::int64_t now = monotonic_ms();
        bool done = true;
        for (auto& [key, outbox] : outboxes) done = outbox->pump(now) && done;
        std::erase_if(outboxes, [&](const auto& entry) { return entry.second->idle_since(now - kIdle_ms); });
        return done;
    }

    /// Whether a message is of this run. Two Controllers may carry one name (they need not see each other): a
    /// member belongs to the first from which it hears, as long as that one is there.
    bool belongs_here(std::uint64_t its_run, const Address& from) {
        if (run == 0 && from.role == Role::kController) run = its_run;
        return its_run == run || its_run == 0;
    }

    void receive(Home& home, const Address& self, Inbox& from, std::vector<Envelope>& inbox) {
        from.drain([&](const Inbox::Writer& writer, std::vector<std::uint8_t> bytes) {
            const std::uint64_t its_run = take_run(bytes);
            Result<Envelope> envelope =
                decode_envelope(std::span(bytes).subspan(std::min(kRunBytes, bytes.size())));
            if (!envelope) return notices->add(envelope.error().message);
            if (!belongs_here(its_run, envelope.value().from)) return;
            if (envelope.value().to != self) return relay(self, std::move(envelope).value(), bytes);
            heard_ms[envelope.value().from] = monotonic_ms();
            count.add(envelope.value().from, self, bytes.size());
            if (&from == home.reliable.get()) home.note_writer(writer, envelope.value().from);
            inbox.push_back(std::move(envelope).value());
        });
    }

    DdsOptions options;
    std::uint64_t run = 0;  // of this process' Controller or of the one it belongs to; 0: of none
    Bell bell;
    std::shared_ptr<NoticeBuffer> notices;
    std::unique_ptr<Participant> participant;  // outlives what follows
    std::map<Address, Home> homes;
    std::map<std::pair<Address, TopicKind>, std::unique_ptr<Outbox>> outboxes;
    std::map<Address, std::int64_t> heard_ms;
    std::map<Address, Beat> beats;
    FlowCount count;
};

Result<std::unique_ptr<DdsBus>> DdsBus::create(const DdsOptions& options) {
    auto network = std::make_unique<Network>();
    network->options = options;
    network->notices = collect_dds_errors();
    Result<std::unique_ptr<Participant>> participant = Participant::create(options);
    if (!participant) return participant.error();
    network->participant = std::move(participant).value();
    return std::unique_ptr<DdsBus>(new DdsBus(std::move(network)));
}

DdsBus::DdsBus(std::unique_ptr<Network> network) : network_(std::move(network)) {}
DdsBus::~DdsBus() = default;

void DdsBus::send(const Address& from, const Address& to, Message message) {
    if (const auto home = network_->homes.find(to); home != network_->homes.end()) {
        network_->count.add(from, to, 0);
        home->second.local.push_back({from, to, std::move(message)});
        return;
    }
    const TopicKind kind = kind_of(message);
    if (const auto beat = network_->beats.find(from); beat != network_->beats.end() && to == beat->second.to)
        beat->second.pulse->note_own(now_ms());
    const std::vector<std::uint8_t> bytes =
        with_run(network_->run, encode(Envelope{from, to, std::move(message)}));
    network_->count.add(from, to, bytes.size());
    if (!network_->way_to(from, to, kind).send(bytes, now_ms()))
        network_->notices->add("a message of " + std::to_string(bytes.size()) +
                               " bytes is too long to be sent");
}

void DdsBus::drain(const Address& self, std::vector<Envelope>& inbox) {
    inbox.clear();
    Network::Home& home = network_->home(self);
    network_->receive(home, self, *home.heartbeats, inbox);
    network_->receive(home, self, *home.reliable, inbox);
    for (Envelope& envelope : home.local) inbox.push_back(std::move(envelope));
    home.local.clear();
    home.heartbeats->take_vanished();
    for (const Inbox::Writer& writer : home.reliable->take_vanished()) {
        const auto known = home.writers.find(writer);
        if (known == home.writers.end()) continue;
        if (known->second == kControllerAddress) network_->lose_controller();
        home.vanished.push_back(known->second);
    }
    network_->pump();
}

std::vector<Address> DdsBus::take_vanished(const Address& self) {
    return std::exchange(network_->home(self).vanished, {});
}

void DdsBus::wait(std::int64_t ms_max) {
    const bool local = std::any_of(network_->homes.begin(), network_->homes.end(),
                                   [](const auto& home) { return !home.second.local.empty(); });
    if (local) return;
    const bool done = network_->pump();
    network_->bell.wait(done ? ms_max : std::min<std::int64_t>(ms_max, 1));
}

void DdsBus::keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) {
    if (network_->homes.contains(to)) return;  // in this process, so in the same thread
    Network::Beat& beat = network_->beats[from];
    beat.pulse.reset();
    beat.to = to;
    beat.message = with_run(network_->run, encode(Envelope{from, to, heartbeat}));
    network_->begin(beat);
}

void DdsBus::end_keep_alive(const Address& from) {
    network_->beats.erase(from);
}

std::vector<Flow> DdsBus::flows() const {
    return network_->count.all();
}

bool DdsBus::present(const Address& address) {
    return network_->homes.contains(address) || network_->outbox(address, TopicKind::kReliable).connected();
}

std::optional<std::int64_t> DdsBus::heard_ms(const Address& address) const {
    const auto found = network_->heard_ms.find(address);
    return found == network_->heard_ms.end() ? std::nullopt : std::optional(found->second);
}

Result<> DdsBus::reconnect() {
    return network_->reconnect();
}

bool DdsBus::taken_elsewhere(const Address& address) const {
    return network_->participant->read_elsewhere(network_->topic(address, TopicKind::kReliable));
}

bool DdsBus::flush(std::int64_t ms_max) {
    const std::int64_t end = now_ms() + ms_max;
    while (!network_->pump() && now_ms() < end) network_->bell.wait(1);
    bool all = true;
    for (auto& [key, outbox] : network_->outboxes)
        if (outbox->connected()) all = outbox->acknowledged(std::max<std::int64_t>(end - now_ms(), 0)) && all;
    return all;
}

std::vector<std::string> DdsBus::take_notices() {
    return network_->notices->take();
}

}  // namespace roboss
