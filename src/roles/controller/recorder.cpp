// Forwards to the log, if there is one.
#include "roles/controller/recorder.h"

#include <limits>
#include <utility>

#include "core/check.h"

namespace roboss {

Recorder::Recorder(RunLog* log, Tick log_ticks, Tick logged_until, std::vector<Tick> answered)
    : log_(log), log_ticks_(log_ticks), logged_until_(logged_until), answered_(std::move(answered)) {}

void Recorder::start(RunLog* log, Tick log_ticks) {
    log_ = log;
    log_ticks_ = log_ticks;
    checkpoint_tick_.reset();
    checkpoint_.reset();
}

bool Recorder::has_reply(ClientId client, bool synchronous, Tick observed) const {
    const std::size_t i = client.index();
    const Tick answered = i < answered_.size() ? answered_[i] : logged_until_ - 1;
    return observed <= answered || (!synchronous && observed < logged_until_);
}

void Recorder::joined(ClientId client, const std::string& name) {
    if (log_ != nullptr) log_->joined(client, name);
}

void Recorder::order(const Order& order, Tick given_at) {
    if (log_ != nullptr) log_->order(order, given_at);
}

void Recorder::reply(ClientId client, Tick observed) {
    if (log_ != nullptr) log_->reply(client, observed);
}

void Recorder::planned(Tick until) {
    if (log_ == nullptr) return;
    ROBOSS_CHECK(until >= committed_, "a window to tick " + std::to_string(until) + " after the commit of " +
                                          std::to_string(committed_));
    log_->planned(until);
    needed_ = log_->given();
}

void Recorder::hurry() {
    if (log_ != nullptr) log_->hurry();
}

void Recorder::committed(Tick tick, std::uint64_t model_hash, std::span<const std::uint64_t> hashes) {
    ROBOSS_CHECK(tick > committed_,
                 "tick " + std::to_string(tick) + " is committed after tick " + std::to_string(committed_));
    committed_ = tick;
    if (log_ != nullptr && tick > logged_until_) log_->committed(tick, world_hash(model_hash, hashes));
}

/// Windows end at multiples of log_ticks, so that every run of a world has its checkpoints at the same ticks.
Tick Recorder::next_checkpoint(Tick from) const {
    if (!has_checkpoints()) return std::numeric_limits<Tick>::max();
    return (from / log_ticks_ + 1) * log_ticks_;
}

bool Recorder::take_checkpoint_due(Tick tick) {
    if (!has_checkpoints() || tick % log_ticks_ != 0) return false;
    if (tick <= logged_until_ || tried_ == tick) return false;
    tried_ = tick;
    return !checkpoint_tick_ && log_->takes_checkpoint();
}

void Recorder::checkpoint_begun(Tick tick) {
    ROBOSS_CHECK(!checkpoint_tick_, "a checkpoint at tick " + std::to_string(tick) +
                                        " begins while that of tick " + std::to_string(*checkpoint_tick_) +
                                        " is under way");
    checkpoint_tick_ = tick;
}

void Recorder::checkpoint_complete(Tick tick, std::shared_ptr<const std::vector<RobotState>> states) {
    ROBOSS_CHECK(states != nullptr,
                 "a complete checkpoint at tick " + std::to_string(tick) + " without states");
    if (checkpoint_tick_ == tick) checkpoint_ = RunCheckpoint{tick, std::move(states), {}};
}

void Recorder::checkpoint_lost(Tick tick) {
    if (checkpoint_tick_ == tick) checkpoint_tick_.reset();
}

std::optional<RunCheckpoint> Recorder::take_checkpoint() {
    if (checkpoint_) checkpoint_tick_.reset();
    return std::exchange(checkpoint_, std::nullopt);
}

}  // namespace roboss
