// ViewService: which viewers subscribe to views of the world, and which views are due; it asks the holders of
// robots to send them. A viewer repeats its request each second and is dropped soon after its last one.
// Nothing of this is kept, awaited or sent again. Costs nothing without viewers.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bus/bus.h"
#include "roles/controller/state_directory.h"
#include "wire/view_state.h"

namespace roboss {

class ViewService {
  public:
    explicit ViewService(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// Subscribes the viewer. One with another Model gets ModelChanged.
    void take(Bus& bus, const Address& viewer, const ViewRequest& request);
    bool empty() const { return watchers_.empty(); }

    /// The committed world between two windows.
    struct Source {
        std::uint32_t epoch = 0;
        const StateDirectory& directory;
        const Roster& roster;
        const std::vector<RobotState>* here =
            nullptr;  // states that the Controller has; null: of another tick
    };
    /// Makes the holders of robots send the views that are due.
    void serve(Bus& bus, const Source& source);

    struct Due {
        Address viewer;
        bool view = false;
        bool exact_all = false;
        std::vector<RobotId> exact;
    };
    /// The views to send of the world at `tick`. A viewer gets each tick once, and again when it repeats its
    /// request (views may get lost).
    std::vector<Due> take_due(Tick tick, std::int64_t now_ms);

    /// Measures the speed of the run. To be called between windows, before take_due().
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
    void show(Bus& bus, const Source& source, const Due& due);
    std::vector<ViewDue> parts_of(const Source& source, const Due& due) const;

    std::shared_ptr<const Model> model_;
    std::uint64_t serial_ = 0;          // of the views sent
    std::optional<ViewLayout> layout_;  // made with the first view that the Controller sends itself
    std::vector<Watcher> watchers_;
    Tick from_ = 0;  // start of the current measurement
    std::optional<std::int64_t> from_ms_;
    double ms_per_tick_ = 0;  // 0: not known
};

}  // namespace roboss
