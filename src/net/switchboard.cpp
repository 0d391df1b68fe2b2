// Calls, answers, routes, and silence.
#include "net/switchboard.h"

#include <fcntl.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <filesystem>
#include <thread>

#include "net/connection.h"
#include "net/key_folder.h"
#include "net/mailboxes.h"
#include "net/meeting_place.h"
#include "net/network.h"
#include "wire/codec.h"

namespace roboss {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

constexpr std::int64_t kTurn_ms = 50;
constexpr std::int64_t kGreet_ms = 10'000;  // for handshake and first frame
constexpr std::int64_t kFarewell_ms = 500;  // of a connection that is closing
constexpr std::int64_t kBeat_ms = 200;      // between two heartbeats, and from the role's last message
constexpr std::int64_t kBusyMost_ms =
    60'000;  // a role that is silent for longer hangs: the beat ends with it
constexpr std::int64_t kRetry_ms = 50, kRetryLongest_ms = 2'000, kConnect_ms = 3'000;
constexpr std::int64_t kJudge_ms = 1'000;
constexpr std::size_t kStrangersMost = 512;    // connections that have not been accepted yet
constexpr std::size_t kAddressesMost = 1'000;  // of one peer
constexpr std::size_t kNoticesMost = 100;
constexpr int kRunKeys_days = 3'650;  // keys of a run end with it

/// Keys of a run whose Controller was given none: its own, and one for all members of this computer and user.
struct RunKeys {
    Credentials controller, member;
};

Result<RunKeys> new_run_keys(const std::string& simulation) {
    const Result<KeyPair> authority = new_authority("roboss", kRunKeys_days);
    if (!authority) return authority.error();
    RunKeys keys;
    for (auto& [credentials, seat] :
         {std::pair{&keys.controller, Seat::kController}, std::pair{&keys.member, Seat::kMember}}) {
        Result<KeyPair> own =
            new_certificate(authority.value(), {simulation.substr(0, 60), seat}, kRunKeys_days);
        if (!own) return own.error();
        *credentials = {authority.value().certificate, std::move(own).value(), {}};
    }
    return keys;
}

const char* remedy_for(const std::string& code) {
    if (code == "bad-certificate") return "give this process a key of the run: see `roboss keys` and --keys";
    if (code == "other-version") return "run the same version of RoBOSS everywhere";
    if (code == "other-simulation") return "give the name of that run with --simulation";
    return "see the log of the Controller";
}

bool may_be(Seat seat, Role role) {
    switch (role) {
        case Role::kController:
            return false;
        case Role::kSimulator:
            return seat == Seat::kSimulator || seat == Seat::kMember;
        case Role::kClient:
            return seat == Seat::kClient || seat == Seat::kMember;
    }
    return false;
}

}  // namespace

struct Switchboard::Thread {
    asio::io_context context{1};
    asio::executor_work_guard<asio::io_context::executor_type> work{context.get_executor()};
    Tcp::acceptor acceptor{context};
    Tcp::socket caller{context};
    asio::steady_timer turn{context}, rest{context};
    std::shared_ptr<const TlsContext> tls;  // of a listener
    std::optional<MeetingPlace> meeting;
    std::int64_t judged_ms = 0;  // since when the list of revoked keys was looked at
    std::filesystem::file_time_type revoked_changed{};
    std::int64_t turned_ms = 0, called_ms = 0, retry_ms = kRetry_ms, next_call_ms = 0;
    bool calling = false, was_connected = false;
    std::shared_ptr<const TlsContext> calling_with;
    std::thread thread;
};

Switchboard::Switchboard(const NetOptions& options, std::optional<Member> member, Mailboxes& mailboxes)
    : options_(options),
      member_(std::move(member)),
      mailboxes_(mailboxes),
      thread_(std::make_unique<Thread>()) {}

Result<std::unique_ptr<Switchboard>> Switchboard::open(const NetOptions& options,
                                                       std::optional<Member> member, Mailboxes& mailboxes) {
    if (Result<> named = check_simulation_name(options.simulation); !named) return named.error();
    std::unique_ptr<Switchboard> switchboard(new Switchboard(options, std::move(member), mailboxes));
    if (Result<> keys = switchboard->check_keys(); !keys) return keys.error();
    if (!switchboard->member_)
        if (Result<> listening = switchboard->listen(); !listening) return listening.error();
    switchboard->run();
    return switchboard;
}

Result<> Switchboard::check_keys() const {
    if (options_.keys.empty()) return Ok{};
    if (options_.insecure)
        return Error{"--insecure and --keys contradict each other", "give one of them", "bad-keys"};
    const Result<Credentials> keys = read_keys(options_.keys);
    if (!keys) return keys.error();
    const Result<std::shared_ptr<const TlsContext>> context = TlsContext::make(keys.value());
    if (!context) return context.error();
    const Result<Holder> holder = holder_of(keys.value().own.certificate);
    if (!holder) return holder.error();
    if ((holder.value().seat == Seat::kController) == !member_) return Ok{};
    return Error{"the key in " + options_.keys + " is that of a " + seat_name(holder.value().seat),
                 member_ ? "give the folder of a member's key" : "give the folder of the Controller's key",
                 "bad-keys"};
}

Result<> Switchboard::listen() {
    raise_connection_limit();
    if (MeetingPlace::find(options_.simulation)) return MeetingPlace::taken(options_.simulation);
    const Result<std::string> address = interface_address(options_.interface);
    if (!address) return address.error();
    MeetingPlace::Note note;
    note.insecure = options_.insecure;
    if (!options_.keys.empty()) {
        const Result<Credentials> keys = read_keys(options_.keys);
        if (!keys) return keys.error();
        thread_->tls = TlsContext::make(keys.value()).value();
    } else if (!options_.insecure) {
        Result<RunKeys> keys = new_run_keys(options_.simulation);
        if (!keys) return keys.error();
        thread_->tls = TlsContext::make(keys.value().controller).value();
        note.keys = std::move(keys.value().member);
    }
    const std::uint16_t port =
        options_.port == 0 && !is_loopback(address.value()) ? kDefaultPort : options_.port;
    const Tcp::endpoint end(asio::ip::make_address_v4(address.value()), port);
    boost::system::error_code error;
    Tcp::acceptor& acceptor = thread_->acceptor;
    acceptor.open(end.protocol(), error);
    // Programs that this process starts shall not hold the port.
    if (!error) ::fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    if (!error) acceptor.set_option(Tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(end, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        return Error{
            "cannot listen at " + address.value() + ":" + std::to_string(port) + ": " + error.message(),
            "end what uses this port, or give another one with --port", "port-taken"};
    const std::string bound = std::to_string(acceptor.local_endpoint().port());
    where_ = address.value() + ":" + bound;
    note.address = (address.value() == "0.0.0.0" ? "127.0.0.1" : address.value()) + ":" + bound;
    Result<MeetingPlace> meeting = MeetingPlace::open(options_.simulation, note);
    if (!meeting) return meeting.error();
    thread_->meeting.emplace(std::move(meeting).value());
    return Ok{};
}

void Switchboard::run() {
    asio::post(thread_->context, [this] {
        if (member_)
            call();
        else
            accept();
        tick();
    });
    thread_->thread = std::thread([this] { thread_->context.run(); });
}

Switchboard::~Switchboard() {
    if (!thread_->thread.joinable()) return;
    thread_->context.stop();
    thread_->thread.join();
}

// --- connections

void Switchboard::accept() {
    thread_->acceptor.async_accept([this](const auto& error, Tcp::socket socket) {
        if (error) {  // no descriptor is left: others may give some back
            notice("a call cannot be taken: " + error.message() + " [accept]");
            thread_->rest.expires_after(std::chrono::milliseconds(200));
            thread_->rest.async_wait([this](const auto&) { accept(); });
            return;
        }
        connect(socket.release(), thread_->tls);
        accept();
    });
}

Switchboard::Peer Switchboard::connect(int socket, std::shared_ptr<const TlsContext> tls) {
    Connection::Events events;
    events.ready = [this](Connection& peer) { ready(peer); };
    events.frame = [this](Connection& peer, const Frame& frame) { take_frame(peer, frame); };
    events.message = [this](Connection& peer, std::vector<std::uint8_t> bytes) {
        take_message(peer, std::move(bytes));
    };
    events.closed = [this](Connection& peer, const std::string& reason) { closed(peer, reason); };
    auto session = tls ? std::make_unique<TlsSession>(tls, !member_) : nullptr;
    const Peer peer = Connection::open(thread_->context, socket, std::move(session), std::move(events));
    const std::lock_guard lock(mutex_);
    peers_.insert(peer);
    const auto strangers = std::ranges::count_if(peers_, [](const Peer& p) { return !p->accepted; });
    if (strangers > static_cast<std::ptrdiff_t>(kStrangersMost)) {
        Peer oldest = peer;
        for (const Peer& p : peers_)
            if (!p->accepted && p->opened_ms() < oldest->opened_ms()) oldest = p;
        oldest->close("too many calls at a time");
    }
    return peer;
}

void Switchboard::call() {
    Thread& t = *thread_;
    std::string at = options_.controller;
    std::optional<Credentials> keys;
    bool insecure = options_.insecure;
    const std::optional<MeetingPlace::Note> note = MeetingPlace::find(options_.simulation);
    if (at.empty()) {
        if (!note) return report_trouble("");
        at = note->address;
        insecure = note->insecure;
    }
    if (note) keys = note->keys;
    if (!options_.keys.empty()) {
        Result<Credentials> read = read_keys(options_.keys);
        if (!read) return report_trouble(read.error().text());
        keys = std::move(read).value();
    }
    if (!insecure && !keys)
        return report_trouble("this process has no key for the Controller at " + at +
                              ": give it with --keys, see `roboss keys` [no-keys]");
    const Result<HostPort> end = host_port(at);
    if (!end) return report_trouble(end.error().message);
    t.calling_with = nullptr;
    if (!insecure) {
        Result<std::shared_ptr<const TlsContext>> tls = TlsContext::make(*keys);
        if (!tls) return report_trouble(tls.error().text());
        t.calling_with = std::move(tls).value();
    }
    const std::uint16_t port = end.value().port == 0 ? kDefaultPort : end.value().port;
    {
        const std::lock_guard lock(mutex_);
        where_ = end.value().address + ":" + std::to_string(port);
    }
    t.calling = true;
    t.called_ms = monotonic_ms();
    t.caller = Tcp::socket(t.context);
    t.caller.async_connect({asio::ip::make_address_v4(end.value().address), port},
                           [this, at](const auto& error) {
                               if (!error) {
                                   connect(thread_->caller.release(), thread_->calling_with);
                                   return;
                               }
                               thread_->calling = false;
                               report_trouble("no Controller answers at " + at + ": " + error.message());
                           });
}

void Switchboard::ready(Connection& peer) {
    const TlsSession* session = peer.session();
    const std::string objection = session == nullptr ? "" : session->objection();
    if (!member_) {
        if (!objection.empty()) return refuse(peer, "bad-certificate", objection);
        if (session != nullptr && session->peer().seat == Seat::kController)
            return refuse(peer, "bad-certificate",
                          "the key of '" + session->peer().name + "' is a Controller's");
        return;
    }
    if (!objection.empty())
        return give_up(peer, {"the Controller at " + where() + " cannot be trusted: " + objection,
                              remedy_for("bad-certificate"), "bad-certificate"});
    if (session != nullptr && session->peer().seat != Seat::kController)
        return give_up(peer,
                       {"'" + session->peer().name + "' answers at " + where() + ", and is no Controller",
                        "check the address", "bad-certificate"});
    peer.send_frame(FrameKind::kHello,
                    encode_hello({kWireVersion, options_.simulation, member_->role, member_->name}));
}

void Switchboard::take_frame(Connection& peer, const Frame& frame) {
    if (frame.kind == FrameKind::kPing) return;
    if (frame.kind == FrameKind::kHello && !member_ && !peer.accepted) return take_hello(peer, frame);
    if (frame.kind == FrameKind::kAccept && member_ && !peer.accepted) {
        peer.accepted = true;
        std::string line;
        {
            const std::lock_guard lock(mutex_);
            controller_ = peer.shared_from_this();
            if (thread_->was_connected)
                line = "connected to the Controller at " + where_ + " again [reconnected]";
            trouble_.clear();
        }
        if (!line.empty()) notice(std::move(line));
        thread_->was_connected = true;
        thread_->retry_ms = kRetry_ms;
        for (const Address& own : mailboxes_.addresses())
            peer.send_frame(FrameKind::kOwn, encode_address(own));
        return mailboxes_.ring();
    }
    if (frame.kind == FrameKind::kOwn && !member_ && peer.accepted) {
        const Result<Address> own = decode_address(frame.content);
        if (!own) return refuse(peer, "misbehaves", own.error().message);
        return static_cast<void>(owns(peer, own.value()));
    }
    if (frame.kind == FrameKind::kRefuse && member_) {
        const Refusal refusal = decode_refusal(frame.content);
        return give_up(peer, {"the Controller at " + where() + " refuses this process: " + refusal.reason,
                              remedy_for(refusal.code), refusal.code});
    }
    refuse(peer, "misbehaves",
           "it sent a frame of kind " + std::to_string(static_cast<int>(frame.kind)) +
               " where none is expected");
}

void Switchboard::take_hello(Connection& peer, const Frame& frame) {
    Result<Caller> hello = decode_hello(frame.content);
    if (!hello) return refuse(peer, "misbehaves", hello.error().message);
    peer.hello = std::move(hello).value();
    if (peer.hello.version != kWireVersion)
        return refuse(peer, "other-version",
                      "it speaks wire version " + std::to_string(peer.hello.version) + ", this Controller " +
                          std::to_string(kWireVersion));
    if (peer.hello.simulation != options_.simulation)
        return refuse(peer, "other-simulation",
                      "it looks for simulation '" + peer.hello.simulation + "', this one is '" +
                          options_.simulation + "'");
    peer.accepted = true;
    peer.send_frame(FrameKind::kAccept, {});
}

/// Names the peer in the log, sends it the reason, and closes the connection.
void Switchboard::refuse(Connection& peer, const std::string& code, const std::string& reason) {
    const std::string name = peer.session() != nullptr && !peer.session()->peer().name.empty()
                                 ? "'" + peer.session()->peer().name + "' "
                                 : "";
    notice((peer.accepted ? "cut off " : "refused ") + name +
           (peer.hello.name.empty() ? "" : peer.hello.name + " ") + "at " + peer.where() + ": " + reason +
           " [" + code + "]");
    peer.send_frame(FrameKind::kRefuse, encode_refusal({code, reason}));
    peer.close_after_sending();
}

void Switchboard::give_up(Connection& peer, Error error) {
    {
        const std::lock_guard lock(mutex_);
        if (!refusal_) refusal_ = std::move(error);
    }
    peer.close("refused");
    mailboxes_.ring();
}

void Switchboard::closed(Connection& peer, const std::string& reason) {
    std::set<Address> gone;
    bool lost = false;
    {
        const std::lock_guard lock(mutex_);
        const Peer self = peer.shared_from_this();
        peers_.erase(self);
        std::erase_if(routes_, [&](const auto& route) {
            return route.second == self && gone.insert(route.first).second;
        });
        lost = controller_ == self;
        if (lost) controller_.reset(), gone.insert(kControllerAddress);
    }
    if (!gone.empty()) mailboxes_.vanish(gone);
    if (!member_) {
        if (peer.accepted || peer.closing_ms() != 0) return;
        return notice("a caller at " + peer.where() + " has gone before it was accepted: " + reason +
                      " [caller]");
    }
    thread_->calling = false;
    if (lost)
        notice("the connection to the Controller at " + where() + " is lost (" + reason +
               "); connecting again [reconnecting]");
    else
        report_trouble("the Controller at " + where() +
                       " ends the connection before it accepts this process (" + reason +
                       "); is one of both started with --insecure?");
    thread_->next_call_ms = monotonic_ms() + (lost ? 0 : thread_->retry_ms);
}

/// Says why there is no connection, once for each reason, and tries again later.
void Switchboard::report_trouble(const std::string& what) {
    thread_->calling = false;
    thread_->next_call_ms = monotonic_ms() + thread_->retry_ms;
    thread_->retry_ms = std::min(2 * thread_->retry_ms, kRetryLongest_ms);
    {
        const std::lock_guard lock(mutex_);
        if (what.empty() || what == trouble_) return;
        trouble_ = what;
    }
    notice(what);
}

// --- messages

void Switchboard::take_message(Connection& peer, std::vector<std::uint8_t> bytes) {
    if (!peer.accepted) return refuse(peer, "misbehaves", "it sent a message before its name");
    const Result<EnvelopeEnds> ends = decode_ends(bytes);
    if (!ends) return refuse(peer, "misbehaves", ends.error().message);
    const auto& [from, to] = ends.value();
    if (!member_ && !owns(peer, from)) return;
    if (mailboxes_.has(to)) {
        Result<Envelope> envelope = decode_envelope(bytes);
        if (!envelope) return refuse(peer, "misbehaves", envelope.error().message);
        mailboxes_.put(std::move(envelope).value(), bytes.size());
        if (mailboxes_.full()) peer.pause();
    } else if (!member_) {
        send(to, std::move(bytes), false);
    }
}

/// The first peer that uses an address owns it, as long as it is connected; its certificate says for which
/// roles.
bool Switchboard::owns(Connection& peer, const Address& from) {
    const Seat seat = peer.session() == nullptr ? Seat::kMember : peer.session()->peer().seat;
    const char* fault = nullptr;
    {
        const std::lock_guard lock(mutex_);
        const Peer self = peer.shared_from_this();
        const auto [route, is_new] = routes_.try_emplace(from, self);
        if (route->second != self)
            fault = "it sent a message in the name of another one";
        else if (is_new && !may_be(seat, from.role))
            fault = "its key does not permit the role in which it sent a message";
        else if (is_new && std::ranges::count_if(routes_, [&](const auto& r) { return r.second == self; }) >
                               static_cast<std::ptrdiff_t>(kAddressesMost))
            fault = "it uses too many addresses";
        if (fault != nullptr && is_new) routes_.erase(route);
    }
    if (fault != nullptr) refuse(peer, "misbehaves", fault);
    return fault == nullptr;
}

Switchboard::Peer Switchboard::way_to(const Address& address) const {
    const auto route = routes_.find(address);
    return route == routes_.end() ? controller_ : route->second;
}

void Switchboard::send(const Address& to, std::vector<std::uint8_t> bytes, bool urgent) {
    Peer peer;
    {
        const std::lock_guard lock(mutex_);
        peer = way_to(to);
    }
    if (peer) peer->send_message(std::move(bytes), urgent);
}

void Switchboard::resume() {
    const std::lock_guard lock(mutex_);
    for (const Peer& peer : peers_)
        if (peer->paused()) peer->resume();
}

// --- time

void Switchboard::tick() {
    Thread& t = *thread_;
    const std::int64_t now = monotonic_ms();
    std::vector<Peer> peers;
    {
        const std::lock_guard lock(mutex_);
        peers.assign(peers_.begin(), peers_.end());
    }
    // A process that was stopped reads first what has arrived meanwhile.
    const bool on_time =
        t.turned_ms == 0 || now - t.turned_ms < static_cast<std::int64_t>(options_.liveliness_ms) / 2;
    t.turned_ms = now;
    if (on_time)
        for (const Peer& peer : peers) look_after(peer, now);
    send_beats(now);
    judge_again(now);
    if (member_ && t.calling && t.caller.is_open() && now - t.called_ms > kConnect_ms) {
        boost::system::error_code ignored;
        t.caller.close(ignored);  // its handler reports it
    }
    if (member_ && !t.calling && now >= t.next_call_ms && !refusal()) call();
    t.turn.expires_after(std::chrono::milliseconds(kTurn_ms));
    t.turn.async_wait([this](const auto&) { tick(); });
}

/// Keys may be revoked during a run: the list is read again when its file changes.
void Switchboard::judge_again(std::int64_t now_ms) {
    Thread& t = *thread_;
    if (member_ || options_.keys.empty() || now_ms - t.judged_ms < kJudge_ms) return;
    t.judged_ms = now_ms;
    std::error_code error;
    const auto changed =
        std::filesystem::last_write_time(std::filesystem::path(options_.keys) / "revoked", error);
    if (error || changed == t.revoked_changed) return;
    t.revoked_changed = changed;
    const Result<Credentials> keys = read_keys(options_.keys);
    Result<std::shared_ptr<const TlsContext>> tls =
        keys ? TlsContext::make(keys.value()) : Result<std::shared_ptr<const TlsContext>>(keys.error());
    if (!tls) return notice(tls.error().text());
    t.tls = std::move(tls).value();
    std::vector<Peer> revoked;
    {
        const std::lock_guard lock(mutex_);
        for (const Peer& peer : peers_)
            if (peer->accepted && peer->session() != nullptr &&
                keys.value().revoked.contains(peer->session()->peer().serial))
                revoked.push_back(peer);
    }
    for (const Peer& peer : revoked)
        refuse(*peer, "bad-certificate",
               "the certificate of '" + peer->session()->peer().name + "' has been revoked");
}

void Switchboard::look_after(const Peer& peer, std::int64_t now_ms) {
    const auto lease = static_cast<std::int64_t>(options_.liveliness_ms);
    if (peer->closing_ms() != 0) {
        if (now_ms - peer->closing_ms() > kFarewell_ms) peer->close("refused");
    } else if (!peer->accepted) {
        if (now_ms - peer->opened_ms() > kGreet_ms) peer->close("it has not said who it is for 10 s");
    } else if (!peer->paused() && now_ms - peer->heard_ms() > lease) {
        peer->close("nothing was heard for " + std::to_string(now_ms - peer->heard_ms()) + " ms");
    } else if (now_ms - peer->sent_ms() > lease / 5) {
        peer->send_frame(FrameKind::kPing, {});
    }
}

void Switchboard::begin_beat(const Address& from, const Address& to, std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    beats_[from] = {to, std::move(bytes), monotonic_ms()};
}

void Switchboard::end_beat(const Address& from) {
    const std::lock_guard lock(mutex_);
    beats_.erase(from);
}

void Switchboard::note_own(const Address& from, const Address& to) {
    const std::lock_guard lock(mutex_);
    if (const auto beat = beats_.find(from); beat != beats_.end() && beat->second.to == to)
        beat->second.own_ms = monotonic_ms();
}

void Switchboard::send_beats(std::int64_t now_ms) {
    std::vector<std::pair<Address, std::vector<std::uint8_t>>> due;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [from, beat] : beats_)
            if (now_ms - beat.own_ms >= kBeat_ms && now_ms - beat.own_ms < kBusyMost_ms)
                due.emplace_back(beat.to, beat.bytes);
    }
    for (auto& [to, bytes] : due) send(to, std::move(bytes), true);
}

// --- state for others

bool Switchboard::reaches(const Address& address) const {
    const std::lock_guard lock(mutex_);
    return routes_.contains(address) || (address == kControllerAddress && controller_);
}

std::optional<Error> Switchboard::refusal() const {
    const std::lock_guard lock(mutex_);
    return refusal_;
}

bool Switchboard::all_sent() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::all_of(peers_, [](const Peer& peer) { return !peer->accepted || peer->all_sent(); });
}

void Switchboard::notice(std::string line) {
    const std::lock_guard lock(mutex_);
    if (notices_.size() < kNoticesMost) notices_.push_back(std::move(line));
}

std::vector<std::string> Switchboard::take_notices() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notices_, {});
}

std::string Switchboard::where() const {
    const std::lock_guard lock(mutex_);
    return where_;
}

}  // namespace roboss
