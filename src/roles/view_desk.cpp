// Watchers by address.
#include "roles/view_desk.h"

#include <algorithm>

namespace roboss {
namespace {

constexpr std::int64_t kForgottenAfter_ms = 3'000;
constexpr std::size_t kWatchersMax = 16;

}  // namespace

bool ViewDesk::Pace::due(std::uint32_t interval_ms, Tick tick, std::int64_t now_ms) {
    if (interval_ms == 0 || (tick == shown && !asked_again)) return false;
    if (shown >= 0 && now_ms - shown_ms < interval_ms) return false;
    // Views keep their rate in the mean, though a tick is committed a little late each time.
    const bool steady = shown >= 0 && now_ms - shown_ms < 2 * static_cast<std::int64_t>(interval_ms);
    shown_ms = steady ? shown_ms + interval_ms : now_ms;
    shown = tick;
    asked_again = false;
    return true;
}

void ViewDesk::take(const Address& viewer, const ViewRequest& request, std::int64_t now_ms) {
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

std::vector<ViewDesk::Due> ViewDesk::take_due(Tick tick, std::int64_t now_ms) {
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
