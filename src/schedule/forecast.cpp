// Forecast boxes: the robot's own box, moved along its velocity, with a margin for what may accelerate it.
#include "schedule/forecast.h"

#include <algorithm>
#include <cmath>

namespace roboss {

namespace {

constexpr double kTurn = 0.15;          // share of the displacement by which a turn may deviate sideways
constexpr double kAcceleration = 15.0;  // m/s^2: a fall, a hard start or stop

std::array<float, 3> to_floats(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A setpoint can change, a motor can start: how far a robot may deviate from its expected displacement.
double margin(double speed, double span_s) {
    return kTurn * speed * span_s + 0.5 * kAcceleration * span_s * span_s;
}

Box32 predicted(const RobotMotion& m, double span_s, double reach_scale) {
    double speed = 0;
    for (const float v : m.velocity) speed += static_cast<double>(v) * v;
    speed = std::sqrt(speed);
    Box32 box;
    for (std::size_t k = 0; k < 3; ++k) {
        // the last swept box minus the displacement in it is the robot's own size
        const double way_before = std::fabs(static_cast<double>(m.velocity[k])) * m.span_s;
        const double size = static_cast<double>(m.swept.max[k]) - m.swept.min[k];
        const double half = 0.5 * std::max(size - way_before, 0.0) + reach_scale * margin(speed, span_s);
        const double way = reach_scale * m.velocity[k] * span_s;
        box.min[k] = round_down(m.centre[k] - half + std::min(way, 0.0));
        box.max[k] = round_up(m.centre[k] + half + std::max(way, 0.0));
    }
    return box;
}

}  // namespace

RobotMotion motion_of(const Model& model, RobotId robot, const RobotState& state) {
    return motion_of(model, robot, state, interaction_bound(model, robot, state));
}

RobotMotion motion_of(const Model& model, RobotId robot, const RobotState& state, const Aabb& bound) {
    RobotMotion motion;
    motion.swept = outward(bound);
    motion.centre = to_floats(bound.centre());
    if (model.type_of(robot).free_base) motion.velocity = to_floats({state.v[3], state.v[4], state.v[5]});
    return motion;
}

bool leaps(const Order& order) {
    return std::holds_alternative<SetPose>(order.action) ||
           std::holds_alternative<SetVelocity>(order.action) || std::holds_alternative<Attach>(order.action);
}

void Forecast::predict(std::span<const RobotMotion> motions, double span_s, double reach_scale) {
    boxes_.clear();
    for (std::uint32_t robot = 0; robot < motions.size(); ++robot)
        boxes_.push_back({predicted(motions[robot], span_s, reach_scale), robot});
}

void Forecast::predict_orders(std::span<const Order> orders, double span_s) {
    for (const Order& order : orders) {
        const double reach = model_->type_of(order.robot).reach;
        if (const auto* pose = std::get_if<SetPose>(&order.action)) {
            Aabb box;
            box.include(pose->X_WR.p);
            boxes_.push_back({outward(box.inflated(2 * reach + margin(0, span_s))), order.robot.value});
            continue;
        }
        const Box32 own = boxes_[order.robot.index()].box;
        Aabb box{{own.min[0], own.min[1], own.min[2]}, {own.max[0], own.max[1], own.max[2]}};
        if (const auto* velocity = std::get_if<SetVelocity>(&order.action)) {
            const Vec3 way = velocity->linear * span_s;
            box.include(Aabb{box.min + way, box.max + way});
        } else if (const auto* attach = std::get_if<Attach>(&order.action)) {
            box = box.inflated(attach->reach);
        } else {
            continue;
        }
        boxes_.push_back({outward(box), order.robot.value});
    }
}

void Forecast::islands(std::span<const RobotMotion> motions, std::span<const Order> orders, Tick ticks,
                       const ForecastOptions& options, Islands& out) {
    if (was_ahead(orders, ticks)) return collect_islands(sets_, out);
    sets_.reset(motions.size());
    if (options.merge_all) {
        for (std::uint32_t robot = 1; robot < motions.size(); ++robot) sets_.unite(0, robot);
    } else if (!options.blind) {
        const double span_s = static_cast<double>(ticks) * model_->dt_s;
        predict(motions, span_s, options.reach_scale);
        predict_orders(orders, span_s);
        sweep_.unite_overlapping(boxes_, sets_);
    }
    collect_islands(sets_, out);
}

void Forecast::expect(std::size_t robots, Tick ticks, const ForecastOptions& options) {
    forget();
    if (options.merge_all || options.blind) return;
    grid_.reset(boxes_);
    sets_.reset(robots);
    boxes_.resize(robots);
    expected_ticks_ = ticks;
    missing_ = robots;
    reach_scale_ = options.reach_scale;
}

void Forecast::add(RobotId robot, const RobotMotion& motion) {
    if (expected_ticks_ == 0) return;
    const double span_s = static_cast<double>(expected_ticks_) * model_->dt_s;
    OwnedBox& box = boxes_[robot.index()];
    box = {predicted(motion, span_s, reach_scale_), robot.value};
    grid_.add(box, sets_);
    --missing_;
}

/// Whether all motions were added in advance; then sets_ is complete, orders included. Sets are the same in
/// whichever order they grew.
bool Forecast::was_ahead(std::span<const Order> orders, Tick ticks) {
    if (expected_ticks_ == 0 || expected_ticks_ != ticks || missing_ > 0) return false;
    const std::size_t robots = boxes_.size();
    predict_orders(orders, static_cast<double>(ticks) * model_->dt_s);
    for (std::size_t i = robots; i < boxes_.size(); ++i) grid_.add(boxes_[i], sets_);
    forget();
    return !grid_.overwhelmed();
}

}  // namespace roboss
