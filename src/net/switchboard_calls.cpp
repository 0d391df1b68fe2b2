// Calls that are made and taken, what both ends answer, and how connections end.
#include <algorithm>
#include <boost/asio/error.hpp>
#include <chrono>

#include "net/connection.h"
#include "net/key_folder.h"
#include "net/mailboxes.h"
#include "net/network.h"
#include "net/remedies.h"
#include "net/switchboard_thread.h"
#include "wire/codec.h"

namespace roboss {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kStrangersMost = 512;  // connections that have not been accepted yet

}  // namespace

// --- of the Controller

void Switchboard::accept() {
    thread_->acceptor.async_accept([this](const auto& error, Thread::Tcp::socket socket) {
        if (error)
            return accept_has_failed(error.message(),
                                     error == asio::error::no_descriptors ||
                                         error.value() == boost::system::errc::too_many_files_open_in_system);
        take_call(socket.release());
        accept();
    });
}

void Switchboard::take_call(int socket) {
    const Peer peer = connect(socket, thread_->tls);
    peer->no_room = !thread_->spare.is_there();
    const std::lock_guard lock(mutex_);
    const auto strangers = std::ranges::count_if(peers_, [](const Peer& p) { return !p->accepted; });
    if (strangers <= static_cast<std::ptrdiff_t>(kStrangersMost)) return;
    Peer oldest = peer;
    for (const Peer& p : peers_)
        if (!p->accepted && p->opened_ms() < oldest->opened_ms()) oldest = p;
    oldest->close("too many calls at a time");
}

/// If no descriptor is left, the caller takes the spare one and hears the reason. Others have to wait.
void Switchboard::accept_has_failed(const std::string& why, bool for_want_of_files) {
    if (for_want_of_files && thread_->spare.give_back()) return accept();
    if (why != std::exchange(thread_->accept_trouble, why))
        notice("a call cannot be taken: " + why + " [accept]");
    thread_->rest.expires_after(std::chrono::milliseconds(200));
    thread_->rest.async_wait([this](const auto&) { accept(); });
}

void Switchboard::take_hello(Connection& peer, const Frame& frame) {
    Result<Caller> hello = decode_hello(frame.content);
    if (!hello) return refuse(peer, "misbehaves", hello.error().message);
    peer.hello = std::move(hello).value();
    if (peer.no_room)
        return refuse(peer, "no-room",
                      "the Controller has as many connections as its limit of open files permits");
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
    notice((peer.accepted ? "cut off " : "refused ") + peer.who() + ": " + reason + " [" + code + "]");
    peer.send_frame(FrameKind::kRefuse, encode_refusal({code, reason}));
    peer.close_after_sending();
}

// --- of a member

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
    t.found_key = keys && options_.keys.empty() ? keys->own.certificate : "";
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
    t.caller = Thread::Tcp::socket(t.context);
    t.caller.async_connect({asio::ip::make_address_v4(end.value().address), port},
                           [this, at](const auto& error) {
                               if (!error) {
                                   connect(thread_->caller.release(), thread_->calling_with);
                                   return;
                               }
                               report_trouble("no Controller answers at " + at + ": " + error.message());
                           });
}

void Switchboard::take_accept(Connection& peer) {
    peer.accepted = true;
    routes_.set_controller(peer.shared_from_this());
    {
        const std::lock_guard lock(mutex_);
        trouble_.clear();
        farewell_.reset();
    }
    if (std::exchange(thread_->was_connected, true))
        notice("connected to the Controller at " + where() + " again [reconnected]");
    thread_->retry_ms = Thread::kRetry_ms;
    for (const Address& own : mailboxes_.addresses()) peer.send_frame(FrameKind::kOwn, encode_address(own));
    mailboxes_.ring();
}

/// A Controller that starts again makes new keys, and leaves them before it takes calls.
bool Switchboard::found_key_is_replaced() const {
    if (thread_->found_key.empty()) return false;
    const std::optional<MeetingPlace::Note> note = MeetingPlace::find(options_.simulation);
    return !note || !note->keys || note->keys->own.certificate != thread_->found_key;
}

void Switchboard::give_up(Connection& peer, Error error) {
    if (error.code == "bad-certificate" && found_key_is_replaced()) {
        thread_->outdated = true;  // the next call finds the new ones
        return peer.close("its key is that of an earlier Controller");
    }
    {
        const std::lock_guard lock(mutex_);
        if (!refusal_) refusal_ = std::move(error);
    }
    peer.close("refused");
    mailboxes_.ring();
}

/// Says why there is no connection, once for each reason, and tries again later.
void Switchboard::report_trouble(const std::string& what) {
    thread_->calling = false;
    thread_->next_call_ms = monotonic_ms() + thread_->retry_ms;
    thread_->retry_ms = std::min(2 * thread_->retry_ms, Thread::kRetryLongest_ms);
    {
        const std::lock_guard lock(mutex_);
        if (what.empty() || what == trouble_) return;
        trouble_ = what;
    }
    notice(what);
}

// --- of both

void Switchboard::ready(Connection& peer) {
    const TlsSession* session = peer.session();
    const std::string objection = session == nullptr ? "" : session->objection();
    if (!member_) {
        if (!objection.empty()) return refuse(peer, "bad-certificate", objection);
        if (session != nullptr && session->peer().seat == Seat::kController)
            return refuse(peer, "bad-certificate",
                          "the key of '" + session->peer().name + "' is a Controller's");
        if (session != nullptr && !session->peer().rights.everything())
            peer.rights = std::make_shared<const Rights>(session->peer().rights);
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

void Switchboard::take_farewell(Connection& peer, const Frame& frame) {
    RunOver farewell = decode_farewell(frame.content);
    if (!member_) {
        notice(peer.who() + " ends: " + farewell.reason + " [left]");
        return peer.close("it has ended");
    }
    {
        const std::lock_guard lock(mutex_);
        farewell_ = std::move(farewell);
    }
    mailboxes_.ring();
}

void Switchboard::closed(Connection& peer, const std::string& reason) {
    const Peer self = peer.shared_from_this();
    const bool outdated = std::exchange(thread_->outdated, false);
    bool expected = false;  // it has been reported
    {
        const std::lock_guard lock(mutex_);
        peers_.erase(self);
        expected = refusal_ || farewell_ || outdated;
    }
    const std::set<Address> gone = routes_.forget(self);
    if (!gone.empty()) mailboxes_.vanish(gone);
    if (!member_) {
        thread_->spare.take();
        if (peer.accepted || peer.closing_ms() != 0) return;
        return notice("a caller at " + peer.where() + " has gone before it was accepted: " + reason +
                      " [caller]");
    }
    const bool lost = gone.contains(kControllerAddress);
    thread_->calling = false;
    thread_->next_call_ms = monotonic_ms() + (lost ? 0 : thread_->retry_ms);
    if (expected) return;
    if (lost)
        return notice("the connection to the Controller at " + where() + " is lost (" + reason +
                      "); connecting again [reconnecting]");
    report_trouble("the Controller at " + where() + " ends the connection before it accepts this process (" +
                   reason + "); is one of both started with --insecure?");
}

}  // namespace roboss
