// Start and end of the Switchboard, frames, messages and their routes, and its state for others.
#include "net/switchboard.h"

#include <fcntl.h>

#include <algorithm>
#include <boost/asio/post.hpp>

#include "bus/bus.h"
#include "net/connection.h"
#include "net/key_folder.h"
#include "net/mailboxes.h"
#include "net/network.h"
#include "net/remedies.h"
#include "net/run_keys.h"
#include "net/switchboard_thread.h"
#include "wire/codec.h"

namespace roboss {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kNoticesMost = 100;

}  // namespace

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
    const asio::ip::address_v4 at = asio::ip::make_address_v4(address.value());
    const std::uint16_t port = options_.port == 0 && !at.is_loopback() ? kDefaultPort : options_.port;
    const Thread::Tcp::endpoint end(at, port);
    boost::system::error_code error;
    Thread::Tcp::acceptor& acceptor = thread_->acceptor;
    acceptor.open(end.protocol(), error);
    // Programs that this process starts shall not hold the port.
    if (!error) ::fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    if (!error) acceptor.set_option(Thread::Tcp::acceptor::reuse_address(true), error);
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

// --- frames and messages

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
    return peer;
}

void Switchboard::take_frame(Connection& peer, const Frame& frame) {
    if (peer.deaf) return peer.close("it was silent for too long");
    if (frame.kind == FrameKind::kPing) return;
    if (frame.kind == FrameKind::kHello && !member_ && !peer.accepted) return take_hello(peer, frame);
    if (frame.kind == FrameKind::kAccept && member_ && !peer.accepted) return take_accept(peer);
    if (frame.kind == FrameKind::kOver && peer.accepted) return take_farewell(peer, frame);
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

void Switchboard::take_message(Connection& peer, std::vector<std::uint8_t> bytes) {
    if (peer.deaf) return peer.close("it was silent for too long");
    if (!peer.accepted) return refuse(peer, "misbehaves", "it sent a message before its name");
    const Result<EnvelopeEnds> ends = decode_ends(bytes);
    if (!ends) return refuse(peer, "misbehaves", ends.error().message);
    const auto& [from, to, of_clients] = ends.value();
    if (!member_ && !owns(peer, from)) return;
    if (!member_ && from.role == Role::kClient && !of_clients)
        return refuse(peer, "misbehaves", "it sent a message that no Client sends");
    if (mailboxes_.has(to)) {
        Result<Envelope> envelope = decode_envelope(bytes);
        if (!envelope) return refuse(peer, "misbehaves", envelope.error().message);
        envelope.value().rights = peer.rights;
        mailboxes_.put(std::move(envelope).value(), bytes.size());
        if (mailboxes_.full()) peer.pause();
    } else if (!member_) {
        send(to, std::move(bytes), false);
    }
}

bool Switchboard::owns(Connection& peer, const Address& from) {
    bool is_new = false;
    if (const char* fault = routes_.claim(peer.shared_from_this(), from, is_new))
        return refuse(peer, "misbehaves", fault), false;
    if (!is_new) return true;
    const std::lock_guard lock(mutex_);
    for (const Peer& other : peers_)  // its own connection of before
        if (other->deaf && other->had.contains(from)) other->close("its process has connected again");
    return true;
}

void Switchboard::send(const Address& to, std::vector<std::uint8_t> bytes, bool urgent) {
    if (const Peer peer = routes_.way_to(to)) peer->send_message(std::move(bytes), urgent);
}

void Switchboard::resume() {
    const std::lock_guard lock(mutex_);
    for (const Peer& peer : peers_)
        if (peer->paused()) peer->resume();
}

// --- for others

std::optional<Error> Switchboard::refusal() const {
    const std::lock_guard lock(mutex_);
    return refusal_;
}

std::optional<RunOver> Switchboard::farewell() const {
    const std::lock_guard lock(mutex_);
    return farewell_;
}

void Switchboard::say_farewell(const RunOver& farewell) {
    const std::vector<std::uint8_t> bytes = encode_farewell(farewell);
    const std::lock_guard lock(mutex_);
    for (const Peer& peer : peers_)
        if (peer->accepted) peer->send_frame(FrameKind::kOver, bytes, false);
}

bool Switchboard::all_sent() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::all_of(
        peers_, [](const Peer& peer) { return !peer->accepted || peer->deaf || peer->all_sent(); });
}

void Switchboard::notice(std::string line) {
    const std::lock_guard lock(mutex_);
    if (notices_.size() < kNoticesMost && notice_rate_.take(monotonic_ms()))
        return notices_.push_back(std::move(line));
    ++left_out_;
}

std::vector<std::string> Switchboard::take_notices() {
    const std::lock_guard lock(mutex_);
    if (left_out_ > 0 && notice_rate_.take(monotonic_ms()))
        notices_.push_back(std::to_string(std::exchange(left_out_, 0)) +
                           " more such messages are left out [rate-limited]");
    return std::exchange(notices_, {});
}

std::string Switchboard::where() const {
    const std::lock_guard lock(mutex_);
    return where_;
}

}  // namespace roboss
