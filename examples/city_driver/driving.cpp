// "Follow the gap": among directions ahead, take the one that is free for long, near to straight on, and
// towards the goal (in the spirit of the dynamic window of Fox, Burgard, Thrun 1997). Only fixed functions,
// no libm: the loop is closed, so a last bit that differs between processors would grow into another drive.
#include "driving.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/fixed_math.h"
#include "core/noise.h"

namespace city_driver {
namespace {

constexpr double kTopSpeed = 1.55;       // m/s
constexpr double kBackSpeed = -0.6;      // m/s
constexpr double kTopTurn = 2.2;         // rad/s
constexpr double kHalfWidth = 0.30;      // m, of the lane that the car wants for itself
constexpr double kBodyHalfWidth = 0.19;  // m, of the lane that it needs
constexpr double kStop = 0.25;           // m, free way ahead at which it stands
constexpr double kLookAhead = 4.0;       // m, more free way than this is not better
// A skid-steered car turns by dragging its wheels sideways: its sides must differ by more than the track
// says.
constexpr double kEffectiveHalfTrack = 0.30;  // m
constexpr double kGain = 2.6;                 // 1/s, turn rate for an angle
constexpr double kSpeedStep = 0.22;           // m/s, most that a wheel gains in a control period
constexpr double kGoalPeriod = 25.0;          // s

double seen(double range, double range_max) {
    return std::clamp(range, 0.0, range_max);
}

struct Choice {
    double angle = 0;
    double way = 0;
};

Choice best_direction(const DriverView& view) {
    Choice best;
    double best_score = -1e9;
    const double goal_weight = std::min(0.3, 0.06 * view.goal_distance);
    for (int i = -17; i <= 17; ++i) {
        const double angle = i * (roboss::kPi / 36.0);
        const double way = free_way(view, angle, kHalfWidth);
        const double score = std::min(way, kLookAhead) / kLookAhead + 0.35 * roboss::fixed_cos(angle) +
                             goal_weight * roboss::fixed_cos(angle - view.goal_angle) -
                             0.02 * (angle > 0 ? angle : 0.0);
        if (score > best_score) best_score = score, best = {angle, way};
    }
    return best;
}

/// The side with more room: +1 left, -1 right.
double open_side(const DriverView& view) {
    double balance = 0;
    const std::size_t half = view.ranges.size() / 2;
    for (std::size_t i = 0; i < half; ++i)
        balance += seen(view.ranges[view.ranges.size() - 1 - i], view.range_max) -
                   seen(view.ranges[i], view.range_max);
    return balance >= 0 ? 1.0 : -1.0;
}

WheelSpeeds wheels(double speed, double turn) {
    const double difference = std::clamp(turn, -kTopTurn, kTopTurn) * kEffectiveHalfTrack;
    return {speed - difference, speed + difference};
}

/// Moves the last order towards the wish: gently when the wheel gains speed, twice as fast when it loses
/// some.
double eased(double ordered, double wish) {
    const double up = ordered < 0 ? 2.0 * kSpeedStep : kSpeedStep;
    const double down = ordered > 0 ? 2.0 * kSpeedStep : kSpeedStep;
    return ordered + std::clamp(wish - ordered, -down, up);
}

WheelSpeeds wish(const DriverView& view) {
    const double ordered = 0.5 * (view.ordered_left + view.ordered_right);
    const double ordered_turn = 0.5 * (view.ordered_right - view.ordered_left);
    const double ahead = free_way(view, 0.0, kBodyHalfWidth);
    const Choice choice = best_direction(view);

    // Contact is felt by wheels that turn in vain. Behind itself the car is blind, so it backs a little and
    // only then.
    const bool on_the_spot = std::fabs(ordered) < 0.2;
    const bool pushes = ordered > 0.5 && view.speed < 0.1;
    const bool turns_in_vain =
        on_the_spot && std::fabs(ordered_turn) > 0.4 && std::fabs(view.turn_rate) < 0.1;
    const bool still_backs = ordered < -0.15 && ahead < 0.5;
    const bool backs_in_vain = ordered < -0.3 && view.speed > -0.05;
    if ((pushes || turns_in_vain || still_backs) && !backs_in_vain) return wheels(kBackSpeed, 0.0);

    // Nowhere to go: turn on the spot, always the same way, until there is.
    const bool turns = on_the_spot && std::fabs(ordered_turn) > 0.2;
    const double room = std::max(choice.way, ahead);
    if (room < 0.5 || (turns && room < 0.8)) {
        const double side = turns ? (ordered_turn > 0 ? 1.0 : -1.0) : open_side(view);
        return wheels(0.0, 1.8 * side);
    }

    const double turn = kGain * choice.angle;
    const double bend = std::max(0.25, 1.0 - 0.75 * std::fabs(choice.angle));
    const double speed = std::min(kTopSpeed * bend, 1.3 * (ahead - kStop));
    return wheels(std::max(speed, 0.0), turn);
}

}  // namespace

double free_way(const DriverView& view, double angle, double half_width) {
    const auto beams = view.ranges.size();
    if (beams == 0) return 0.0;
    const double step = beams > 1 ? (view.max_angle - view.min_angle) / static_cast<double>(beams - 1) : 1.0;
    double way = view.range_max;
    for (std::size_t i = 0; i < beams; ++i) {
        const double range = seen(view.ranges[i], view.range_max);
        if (range >= view.range_max) continue;
        const roboss::SinCos off =
            roboss::fixed_sincos(view.min_angle + step * static_cast<double>(i) - angle);
        const double along = range * off.cos, aside = std::fabs(range * off.sin);
        if (off.cos <= 0.0 || aside >= half_width) continue;
        way = std::min(way, std::max(0.0, along - std::sqrt(half_width * half_width - aside * aside)));
    }
    // Between two beams that both end, there is most likely a wall from one end to the other.
    const double position = std::clamp((angle - view.min_angle) / step, 0.0, static_cast<double>(beams - 1));
    const auto right = static_cast<std::size_t>(position);
    const std::size_t left = std::min(right + 1, beams - 1);
    return std::min(
        way, std::max(seen(view.ranges[right], view.range_max), seen(view.ranges[left], view.range_max)));
}

WheelSpeeds drive(const DriverView& view) {
    const WheelSpeeds target = wish(view);
    return {eased(view.ordered_left, target.left), eased(view.ordered_right, target.right)};
}

Place goal_of(std::uint64_t seed, std::uint32_t car, double time_s, const Rectangle& city) {
    const roboss::NoiseStream once{seed, car, 0xC17Du, roboss::kOncePerRun};
    const double shifted = time_s / kGoalPeriod + roboss::random_uniform(once, 0);
    const roboss::NoiseStream stream{seed, car, 0xC17Du, static_cast<roboss::Tick>(std::floor(shifted))};
    return {city.min_x + (city.max_x - city.min_x) * roboss::random_uniform(stream, 0),
            city.min_y + (city.max_y - city.min_y) * roboss::random_uniform(stream, 1)};
}

}  // namespace city_driver
