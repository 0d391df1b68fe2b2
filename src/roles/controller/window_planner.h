// WindowPlanner: plans windows. It forecasts where robots will be, so which islands to step together and for
// how many ticks; it finds robots of different islands that touched, whose islands must be stepped again; and
// it prepares the next window while Simulators step this one. Its plans never change a result of the run.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "roles/controller/cost_model.h"
#include "roles/controller/order_feed.h"
#include "roles/controller/state_directory.h"
#include "schedule/forecast.h"
#include "schedule/touch_watch.h"
#include "schedule/window_length.h"

namespace roboss {

struct PlannerOptions {
    Tick window = 0;      // ticks; 0: adaptive
    Tick window_max = 0;  // limit of the adaptive length; 0: by the robots per worker (longest_window)
    ForecastOptions forecast;
    std::size_t ahead_least = 500;  // orders of the next window that are worth sending ahead of it
    /// Work stealing only in windows with at least this much work per Simulator.
    double stealing_least_ns = 500'000;
};

/// What limits a window, apart from the planner itself.
struct WindowLimits {
    Tick stop_at = 0;               // it ends here at the latest
    std::optional<Tick> ticks_max;  // it should have no more ticks
};

class WindowPlanner {
  public:
    /// `states` are those of the first window's start. The others outlive the planner.
    WindowPlanner(std::shared_ptr<const Model> model, const PlannerOptions& options,
                  std::span<const RobotState> states, const Roster& roster, const CostModel& costs,
                  OrderLog& order_log);

    /// The window that starts at the committed tick, with its assignments.
    Round plan(std::uint32_t epoch, std::uint64_t window, const WindowLimits& limits,
               const StateDirectory& directory);
    /// Once per window, while it is stepped: prepares for its results and sends orders of the next window,
    /// of which `limits` are what they will be. Returns how many were sent.
    std::size_t look_ahead(Bus& bus, const Round& round, const WindowLimits& limits);
    bool looked_ahead(const Round& round) const { return feed_.sent_in(round.span().window); }

    /// Results of an assignment of the window.
    void take_result(const Round& round, const Assignment& assignment, const WindowResult& result);
    /// All results are here: whether robots of different islands touched.
    bool some_touched(const Round& round);
    /// Merges the islands that touched and assigns them again. Returns how many robots these have.
    std::size_t repeat(Round& round);
    void committed(const Round& round);
    /// The window is discarded; it is stepped again from its start, if at all.
    void discard();
    /// Windows end at this tick, after which a state becomes non-finite.
    void end_at(Tick tick) { ends_at_ = tick; }

    /// Length of the next windows; 0: adaptive.
    void set_length(Tick ticks) { length_ = WindowLength(ticks); }
    Tick length() const { return length_.ticks(); }
    /// Each robot's motion in the last window, by RobotId.
    std::span<const RobotMotion> motions() const { return motions_; }

  private:
    Tick end_of(Tick from, Tick length, const WindowLimits& limits) const;
    Tick longest() const;
    double largest_share(const Round& round) const;
    void keep_wanted(Round& round, const StateDirectory& directory) const;

    std::shared_ptr<const Model> model_;
    PlannerOptions options_;
    const Roster& roster_;
    const CostModel& costs_;
    OrderLog& order_log_;

    OrderFeed feed_;
    Forecast forecast_;
    TouchWatch watch_;
    WindowLength length_;
    std::optional<Tick> ends_at_;
    std::vector<RobotMotion> motions_;  // by RobotId
    std::vector<OwnedBox> boxes_;
    UnionFind sets_;  // of robots that were stepped together or touched
    Sweep sweep_;
};

}  // namespace roboss
