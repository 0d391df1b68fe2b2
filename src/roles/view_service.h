// ViewService: which viewers subscribe to views of the world, and which views are due. A viewer repeats its
// request each second and is dropped soon after its last one. Costs nothing without viewers.
#pragma once

#include <optional>
#include <vector>

#include "wire/message.h"

namespace roboss {

class ViewService {
  public:
    void take(const Address& viewer, const ViewRequest& request, std::int64_t now_ms);
    bool empty() const { return watchers_.empty(); }

    struct Due {
        Address viewer;
        bool view = false;
        bool exact_all = false;
        std::vector<RobotId> exact;
    };
    /// The views to send of the world at `tick`. A viewer gets each tick once, and again when it repeats its
    /// request (views may get lost).
    std::vector<Due> take_due(Tick tick, std::int64_t now_ms);

    /// To be called between windows, before take_due(): measures the speed of the run.
    void note(Tick tick, std::int64_t now_ms);
    /// Windows should be no longer than this, so that viewers see the world move. None: no viewers, or the
    /// speed is not known yet.
    std::optional<Tick> window_max() const;

  private:
    /// Limits the rate: each tick at most once, and not more often than the interval.
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
    Tick from_ = 0;  // start of the current measurement
    std::optional<std::int64_t> from_ms_;
    double ms_per_tick_ = 0;  // 0: not known
};

}  // namespace roboss
