// RunLog: where the Controller logs a run. Nothing here waits but wait_safe(): entries are handed over, and
// become safe (they survive this process) a little later.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "journal/log_entries.h"

namespace roboss {

/// All states at a committed tick, never changed once it is handed over.
struct RunCheckpoint {
    Tick tick = 0;
    std::shared_ptr<const std::vector<RobotState>> states;  // by RobotId
    ClientMemory memory;
};

class RunLog {
  public:
    virtual ~RunLog() = default;
    virtual void joined(ClientId client, const std::string& name) = 0;
    virtual void order(const Order& order, Tick given_at) = 0;
    virtual void reply(ClientId client, Tick observed) = 0;
    virtual void note(Tick tick, const std::string& text) = 0;
    /// No order will ever be given an earlier tick than this.
    virtual void planned(Tick until) = 0;
    virtual void committed(Tick tick, std::uint64_t world_hash) = 0;
    /// False while an earlier checkpoint is still on its way to the disk.
    virtual bool takes_checkpoint() const = 0;
    virtual void checkpoint(RunCheckpoint checkpoint) = 0;

    /// Number of orders and replies handed over so far.
    virtual std::uint64_t given() const = 0;
    /// Whether the first `count` of them are safe. True if the log cannot be written, so that nobody waits
    /// forever; the log reports this to its owner.
    virtual bool safe(std::uint64_t count) const = 0;
    /// Asks to write soon, since somebody waits for safe().
    virtual void hurry() = 0;
    /// Waits until safe(count), at most so long.
    virtual void wait_safe(std::uint64_t count, std::int64_t ms_max) = 0;
};

}  // namespace roboss
