// The Controller and its log. A window's orders are in the log before the window is committed, so everything
// committed can be recomputed.
#include <utility>

#include "roles/controller.h"

namespace roboss {

void Controller::start_log(RunLog* log, Tick log_ticks) {
    options_.log = log;
    options_.log_ticks = log_ticks;
    log_tick_.reset();
    log_checkpoint_.reset();
    if (log == nullptr) return;
    for (std::size_t i = 0; i < clients_.seats().size(); ++i)
        if (clients_.seats()[i].joined) log->joined(ClientId(i), clients_.seats()[i].name);
    for (const LoggedOrder& o : order_log_.pending(tick_)) log->order(o.order, o.given_at);
}

std::vector<std::string> Controller::client_names() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : clients_.seats()) names.push_back(seat.name);
    return names;
}

std::vector<std::string> Controller::clients_serving() const {
    std::vector<std::string> names;
    for (const ClientSeat& seat : clients_.seats())
        if (seat.serves() && !seat.observer) names.push_back(seat.name);
    return names;
}

bool Controller::waits_for_log() const {
    return options_.log != nullptr && round_ && !round_->span().recovery && round_->all_answered() &&
           !options_.log->safe(log_needed_);
}

/// Windows end at multiples of log_ticks, so that every run of a world has its checkpoints at the same ticks.
Tick Controller::next_log_tick(Tick from) const {
    if (options_.log == nullptr || options_.log_ticks <= 0) return std::numeric_limits<Tick>::max();
    return (from / options_.log_ticks + 1) * options_.log_ticks;
}

/// Begins a checkpoint for the log at a multiple of log_ticks; skipped while the log is still writing the
/// last one.
void Controller::begin_log_checkpoint() {
    if (options_.log == nullptr || options_.log_ticks <= 0 || tick_ % options_.log_ticks != 0) return;
    if (tick_ <= logged_until_ || log_tried_ == tick_) return;
    log_tried_ = tick_;
    if (log_tick_ || !options_.log->takes_checkpoint()) return;
    begin_checkpoint();
    const bool here = base_.tick == tick_;
    if (!here && !(next_base_ && next_base_->tick == tick_)) return;
    log_tick_ = tick_;
    if (here) log_checkpoint_ = RunCheckpoint{tick_, base_.states, {}};
}

std::optional<RunCheckpoint> Controller::take_log_checkpoint() {
    if (log_checkpoint_) log_tick_.reset();
    return std::exchange(log_checkpoint_, std::nullopt);
}

void Controller::log_window(Tick until) {
    if (options_.log == nullptr) return;
    options_.log->planned(until);
    log_needed_ = options_.log->given();
}

void Controller::log_commit() {
    if (options_.log != nullptr && tick_ > logged_until_) options_.log->committed(tick_, hash());
}

}  // namespace roboss
