// ViewDesk: who wants to see the world, and who is due to see it. A viewer says so again each second and is
// forgotten soon after its last word. Costs nothing while nobody watches.
#pragma once

#include <optional>
#include <vector>

#include "wire/message.h"

namespace roboss {

class ViewDesk {
  public:
    void take(const Address& viewer, const ViewRequest& request, std::int64_t now_ms);
    bool empty() const { return watchers_.empty(); }

    struct Due {
        Address viewer;
        bool view = false;
        bool exact_all = false;
        std::vector<RobotId> exact;
    };
    /// What is to be sent of the world at `tick`. A tick is shown once, and again when the viewer asks again
    /// (something may have been lost).
    std::vector<Due> take_due(Tick tick, std::int64_t now_ms);

    /// At a boundary, before take_due(): how fast the world goes is measured.
    void note(Tick tick, std::int64_t now_ms);
    /// Windows should be no longer, so that who watches sees the world move; none: nobody watches, or it is
    /// not known yet how fast it goes.
    std::optional<Tick> window_max() const;

  private:
    /// Shown at most once in so long; each tick once.
    struct Pace {
        Tick shown = -1;
        std::int64_t shown_ms = 0;
        bool asked_again = true;
        bool due(std::uint32_t interval_ms, Tick tick, std::int64_t now_ms);
    };
    struct Watcher {
        Address viewer;
        ViewRequest request;
        std::int64_t heard_ms = 0;
        Pace view, exact;
    };
    std::vector<Watcher> watchers_;
    Tick from_ = 0;  // of the measurement under way
    std::optional<std::int64_t> from_ms_;
    double ms_per_tick_ = 0;  // 0: not known
};

}  // namespace roboss
