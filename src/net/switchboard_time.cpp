// Work by the clock: silence is noticed, heartbeats are sent, calls are repeated, keys are checked again.
#include <algorithm>
#include <chrono>

#include "net/connection.h"
#include "net/key_folder.h"
#include "net/mailboxes.h"
#include "net/switchboard_thread.h"

namespace roboss {
namespace {

constexpr std::int64_t kTurn_ms = 50;
constexpr std::int64_t kGreet_ms = 10'000;  // for handshake and first frame
constexpr std::int64_t kAnswer_ms = 8'000;  // for a member that waits for both
constexpr std::int64_t kFarewell_ms = 500;  // of a connection that is closing
constexpr std::int64_t kConnect_ms = 3'000;
constexpr std::int64_t kJudge_ms = 1'000;

}  // namespace

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
    for (auto& [to, bytes] : beats_.due(now)) send(to, std::move(bytes), true);
    judge_again(now);
    if (member_ && t.calling && t.caller.is_open() && now - t.called_ms > kConnect_ms) {
        boost::system::error_code ignored;
        t.caller.close(ignored);  // its handler reports it
    }
    if (member_ && !t.calling && now >= t.next_call_ms && !refusal()) call();
    t.turn.expires_after(std::chrono::milliseconds(kTurn_ms));
    t.turn.async_wait([this](const auto&) { tick(); });
}

void Switchboard::look_after(const Peer& peer, std::int64_t now_ms) {
    const auto lease = static_cast<std::int64_t>(options_.liveliness_ms);
    const std::int64_t silent_ms = now_ms - peer->heard_ms();
    if (peer->closing_ms() != 0) {
        if (now_ms - peer->closing_ms() > kFarewell_ms) peer->close("refused");
    } else if (peer->deaf) {
        return;
    } else if (!peer->accepted) {
        const std::int64_t most_ms = member_ ? kAnswer_ms : kGreet_ms;
        if (now_ms - peer->opened_ms() > most_ms)
            peer->close("it has not said who it is for " + std::to_string(most_ms / 1'000) + " s");
    } else if (!peer->paused() && silent_ms > lease) {
        if (member_)
            peer->close("nothing was heard for " + std::to_string(silent_ms) + " ms");
        else
            lose(peer);
    } else if (now_ms - peer->sent_ms() > lease / 5) {
        peer->send_frame(FrameKind::kPing, {});
    }
}

/// Its addresses are gone. The connection stays: a process that was stopped finds the farewell in it. One
/// that speaks again is hung up on, and connects again.
void Switchboard::lose(const Peer& peer) {
    peer->turn_deaf();
    peer->had = routes_.forget(peer);
    mailboxes_.vanish(peer->had);
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

}  // namespace roboss
