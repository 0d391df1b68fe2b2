// Recorder: what the Controller reports to a RunLog. A window's orders are in the log before the window is
// committed, so everything committed can be recomputed. It also knows how far the run follows an earlier log
// (a restart, a branch): what that log has is not written again. Without a log nothing is written, everything
// counts as safe, and no checkpoint is due.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "journal/run_log.h"

namespace roboss {

class Recorder {
  public:
    /// `log` outlives the Recorder; may be null. Checkpoints are due at multiples of `log_ticks`; 0: none.
    /// The run follows an earlier log up to `logged_until`; `answered` by ClientId: the last observation to
    /// which that log has the reply.
    Recorder(RunLog* log, Tick log_ticks, Tick logged_until, std::vector<Tick> answered);
    /// Writes to another log from now on. Forgets the checkpoint under way. Null: ends logging.
    void start(RunLog* log, Tick log_ticks);

    /// Up to here the run follows an earlier log.
    Tick logged_until() const { return logged_until_; }
    /// The earlier log has this reply: Clients get such observations again and reply again.
    bool has_reply(ClientId client, bool synchronous, Tick observed) const;

    // Entries.
    void joined(ClientId client, const std::string& name);
    void order(const Order& order, Tick given_at);
    void reply(ClientId client, Tick observed);
    /// Nobody waits for this Client's replies from now on.
    void gone(ClientId client) { reply(client, kGoneForGood); }
    /// Number of entries so far; safe(given()) once all of them survive this process.
    std::uint64_t given() const { return log_ != nullptr ? log_->given() : 0; }
    bool safe(std::uint64_t count) const { return log_ == nullptr || log_->safe(count); }

    // Windows.
    /// A window to `until` starts: its commit needs all entries so far.
    void planned(Tick until);
    std::uint64_t needed() const { return needed_; }
    bool may_commit() const { return safe(needed_); }
    void hurry();
    /// `hashes`: of the robots' states at `tick`, by RobotId.
    void committed(Tick tick, std::uint64_t model_hash, std::span<const std::uint64_t> hashes);

    // Checkpoints, one at a time: due -> begun -> complete -> taken.
    /// The next tick after `from` at which a window must end for a checkpoint.
    Tick next_checkpoint(Tick from) const;
    /// A checkpoint at `tick` should begin now. At most once per tick; not while another is under way or the
    /// log is still writing one.
    bool take_checkpoint_due(Tick tick);
    void checkpoint_begun(Tick tick);
    /// All states of `tick` are there. Nothing happens if the checkpoint under way is of another tick, or
    /// none is; the same below.
    void checkpoint_complete(Tick tick, std::shared_ptr<const std::vector<RobotState>> states);
    void checkpoint_lost(Tick tick);
    /// The tick of the checkpoint under way.
    std::optional<Tick> checkpoint_tick() const { return checkpoint_tick_; }
    /// That checkpoint once it is complete. It is handed out once.
    std::optional<RunCheckpoint> take_checkpoint();

  private:
    bool has_checkpoints() const { return log_ != nullptr && log_ticks_ > 0; }

    RunLog* log_;
    Tick log_ticks_;
    Tick logged_until_;
    std::vector<Tick> answered_;  // by ClientId
    std::uint64_t needed_ = 0;    // entries that must be safe before the window is committed
    Tick committed_ = 0;
    Tick tried_ = -1;  // tick at which a checkpoint was due last
    std::optional<Tick> checkpoint_tick_;
    std::optional<RunCheckpoint> checkpoint_;  // complete
};

}  // namespace roboss
