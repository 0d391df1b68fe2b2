// ViewDesk: who wants to see the world, and who is due to see it. A viewer says so again each second and is
// forgotten soon after its last word. Costs nothing while nobody watches.
#pragma once

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
};

}  // namespace roboss
