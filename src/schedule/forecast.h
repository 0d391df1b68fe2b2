// Forecast: where each robot will probably be during the next window, and so which islands to step together.
// After a wrong forecast the islands that touched are stepped again; it never changes a result.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "model/order.h"
#include "physics/step.h"
#include "schedule/box_grid.h"
#include "schedule/sweep.h"

namespace roboss {

/// What is known of a robot's motion from its last window.
struct RobotMotion {
    Box32 swept;                      // of the last window
    std::array<float, 3> centre{};    // of the last interaction bound, m
    std::array<float, 3> velocity{};  // of the base, m/s
    float span_s = 0;                 // length of the last window
};

/// Motion as of a state, for the first window.
RobotMotion motion_of(const Model& model, RobotId robot, const RobotState& state);
/// The same, if the state's interaction bound is known.
RobotMotion motion_of(const Model& model, RobotId robot, const RobotState& state, const Aabb& bound);

/// Whether a forecast depends on this order, since it moves its robot at once, or makes it reach out.
bool leaps(const Order& order);

struct ForecastOptions {
    bool merge_all = false;  // one island of all robots
    double reach_scale = 1;  // of the displacement expected in the window; 0 is a fault for tests
    bool blind = false;      // a fault for tests: every robot an island of its own
};

class Forecast {
  public:
    explicit Forecast(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// Islands for a window of `ticks`; `orders` are those of the window.
    void islands(std::span<const RobotMotion> motions, std::span<const Order> orders, Tick ticks,
                 const ForecastOptions& options, Islands& out);

    /// Prepares islands(), which then has less to do: motions arrive one by one, for a window of probably
    /// `ticks`. Drops earlier motions.
    void expect(std::size_t robots, Tick ticks, const ForecastOptions& options);
    void add(RobotId robot, const RobotMotion& motion);
    void forget() { expected_ticks_ = 0; }

  private:
    void predict(std::span<const RobotMotion> motions, double span_s, double reach_scale);
    void predict_orders(std::span<const Order> orders, double span_s);
    bool was_ahead(std::span<const Order> orders, Tick ticks);

    std::shared_ptr<const Model> model_;
    std::vector<OwnedBox> boxes_;
    UnionFind sets_;
    Sweep sweep_;
    // ahead of islands()
    BoxGrid grid_;
    Tick expected_ticks_ = 0;  // 0: none
    std::size_t missing_ = 0;  // robots
    double reach_scale_ = 1;
};

}  // namespace roboss
