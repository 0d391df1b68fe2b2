// Watchers by address.
#include "roles/view_service.h"

#include <algorithm>

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

void ViewService::take(const Address& viewer, const ViewRequest& request, std::int64_t now_ms) {
    auto found = std::find_if(watchers_.begin(), watchers_.end(),
                              [&](const Watcher& w) { return w.viewer == viewer; });
    if (found == watchers_.end()) {
        if (watchers_.size() >= kWatchersMax) return;
        found = watchers_.insert(found, Watcher{});
        found->viewer = viewer;
    }
    found->request = request;
    found->heard_ms = now_ms;
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
        Due d{w.viewer, w.view.due(w.request.interval_ms, tick, now_ms), false, {}};
        if (w.exact.due(w.request.exact_interval_ms, tick, now_ms)) {
            d.exact_all = w.request.exact_all;
            d.exact = w.request.exact;
        }
        if (d.view || d.exact_all || !d.exact.empty()) due.push_back(std::move(d));
    }
    return due;
}

}  // namespace roboss
