// Watchers by address.
#include "roles/controller/view_service.h"

#include <algorithm>

#include "roles/send_views.h"

namespace roboss {
namespace {

constexpr std::int64_t kForgottenAfter_ms = 3'000;
constexpr std::size_t kWatchersMax = 16;
constexpr std::int64_t kMeasured_ms = 20;
constexpr Tick kFirstWindow = 8;  // while the speed of the run is not known

}  // namespace

bool ViewService::Pace::due(std::uint32_t interval_ms, Tick tick, std::int64_t now_ms) {
    if (interval_ms == 0 || (tick == shown && !asked_again)) return false;
    if (shown >= 0 && now_ms - shown_ms < interval_ms) return false;
    // Views keep their rate in the mean, though a tick is committed a little late each time.
    const bool steady = shown >= 0 && now_ms - shown_ms < 2 * static_cast<std::int64_t>(interval_ms);
    shown_ms = steady ? shown_ms + interval_ms : now_ms;
    shown = tick;
    asked_again = false;
    return true;
}

void ViewService::take(Bus& bus, const Address& viewer, const ViewRequest& request) {
    if (request.model_hash != model_->hash)
        return bus.send(kControllerAddress, viewer, ModelChanged{model_->hash});
    auto found = std::find_if(watchers_.begin(), watchers_.end(),
                              [&](const Watcher& w) { return w.viewer == viewer; });
    if (found == watchers_.end()) {
        if (watchers_.size() >= kWatchersMax) return;
        found = watchers_.insert(found, Watcher{});
        found->viewer = viewer;
    }
    found->request = request;
    found->heard_ms = bus.now_ms();
    found->view.asked_again = found->exact.asked_again = true;
}

void ViewService::note(Tick tick, std::int64_t now_ms) {
    if (!from_ms_ || tick <= from_) {  // the run begins, rests, or was rewound
        from_ = tick;
        from_ms_ = now_ms;
        return;
    }
    if (now_ms - *from_ms_ < kMeasured_ms) return;
    const double measured = static_cast<double>(now_ms - *from_ms_) / static_cast<double>(tick - from_);
    ms_per_tick_ = ms_per_tick_ > 0 ? 0.5 * (ms_per_tick_ + measured) : measured;
    from_ = tick;
    from_ms_ = now_ms;
}

std::optional<Tick> ViewService::window_max() const {
    std::uint32_t interval_ms = 0;  // of the most demanding viewer
    for (const Watcher& w : watchers_)
        if (w.request.interval_ms > 0 && (interval_ms == 0 || w.request.interval_ms < interval_ms))
            interval_ms = w.request.interval_ms;
    if (interval_ms == 0) return std::nullopt;
    if (!(ms_per_tick_ > 0)) return kFirstWindow;
    return std::max<Tick>(1, static_cast<Tick>(std::min(interval_ms / ms_per_tick_, 1e6)));
}

std::vector<ViewService::Due> ViewService::take_due(Tick tick, std::int64_t now_ms) {
    std::erase_if(watchers_, [&](const Watcher& w) { return now_ms - w.heard_ms > kForgottenAfter_ms; });
    std::vector<Due> due;
    for (Watcher& w : watchers_) {
        const bool view = w.view.due(w.request.interval_ms, tick, now_ms);
        const bool exact = w.exact.due(w.request.exact_interval_ms, tick, now_ms) &&
                           (w.request.exact_all || !w.request.exact.empty());
        if (!view && !exact) continue;
        Due& d = due.emplace_back();
        d.viewer = w.viewer, d.view = view;
        if (exact) d.exact_all = w.request.exact_all, d.exact = w.request.exact;
    }
    return due;
}

void ViewService::serve(Bus& bus, const Source& source) {
    if (empty()) return;
    const Tick tick = source.directory.tick();
    note(tick, bus.now_ms());
    const std::vector<Due> due = take_due(tick, bus.now_ms());
    if (due.empty()) return;
    ++serial_;
    for (const Due& d : due) show(bus, source, d);
}

/// By seat; the last part is what the Controller has: at the beginning, and when a Simulator has left.
std::vector<ViewDue> ViewService::parts_of(const Source& source, const Due& due) const {
    const std::span<const SeatId> holders = source.directory.holders();
    std::vector<ViewDue> parts(source.roster.size() + 1);
    const auto part_of = [&](std::size_t r) -> ViewDue* {
        if (holders[r] == kAtController) return source.here != nullptr ? &parts.back() : nullptr;
        return source.roster.lost(holders[r]) ? nullptr : &parts[holders[r]];
    };
    for (std::size_t r = 0; r < holders.size(); ++r) {
        ViewDue* part = part_of(r);
        if (part == nullptr) continue;
        if (due.view) part->robots.emplace_back(r);
        if (due.exact_all) part->exact.emplace_back(r);
    }
    for (const RobotId robot : due.exact)
        if (!due.exact_all && robot.index() < holders.size())
            if (ViewDue* part = part_of(robot.index())) part->exact.push_back(robot);
    return parts;
}

void ViewService::show(Bus& bus, const Source& source, const Due& due) {
    std::vector<ViewDue> parts = parts_of(source, due);
    for (SeatId seat_id = 0; seat_id < parts.size(); ++seat_id) {
        ViewDue& part = parts[seat_id];
        if (part.robots.empty() && part.exact.empty()) continue;
        part.epoch = source.epoch;
        part.serial = serial_;
        part.tick = source.directory.tick();
        part.viewer = due.viewer;
        if (seat_id < source.roster.size()) {
            bus.send(kControllerAddress, source.roster.address_of(seat_id), std::move(part));
            continue;
        }
        if (!layout_) layout_.emplace(*model_);
        const auto state = [&](RobotId robot) { return &(*source.here)[robot.index()]; };
        send_views(*model_, *layout_, part, state, kControllerAddress, bus);
    }
}

}  // namespace roboss
