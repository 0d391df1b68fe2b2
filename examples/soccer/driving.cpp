#include "driving.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace soccer {
namespace {

constexpr double kAcceleration = 4.5;  // m/s2, of a wheel: below what its tyre can do
constexpr double kSideways = 4.0;      // m/s2, in a curve
constexpr double kTurnGain = 10.0;     // 1/s, turn rate for an angle
constexpr double kTopTurn = 16.0;      // rad/s
constexpr double kReach =
    0.5 * kRobotSize + kBallRadius;  // m, from the middle of a robot to a ball before it

/// A step from `now` towards the wish, no larger than the tyres allow in one frame.
double eased(double now, double wish) {
    const double most = 2 * kAcceleration * kFrame;  // two frames, as orders take effect a frame later
    return std::clamp(wish, now - most, now + most);
}

WheelSpeeds wheels(const Mover& robot, double speed, double turn) {
    const double now = robot.vx * roboss::fixed_cos(robot.yaw) + robot.vy * roboss::fixed_sin(robot.yaw);
    const double forward = eased(now, speed), difference = kHalfTrack * turn;
    return {std::clamp(forward - difference, -kTopSpeed, kTopSpeed),
            std::clamp(forward + difference, -kTopSpeed, kTopSpeed)};
}

}  // namespace

double distance(const Mover& from, Point to) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    return std::sqrt(dx * dx + dy * dy);
}

WheelSpeeds drive_to(const Mover& robot, Point target, double top_speed, double end_speed) {
    const double far = distance(robot, target);
    if (far < 0.01 && end_speed == 0) return wheels(robot, 0, 0);
    double angle =
        roboss::wrap_angle(roboss::fixed_atan2(target.y - robot.y, target.x - robot.x) - robot.yaw);
    double direction = 1;  // a cube drives as well backwards
    if (std::fabs(angle) > roboss::kPi / 2) {
        direction = -1;
        angle = roboss::wrap_angle(angle + roboss::kPi);
    }
    const double turn = std::clamp(kTurnGain * angle, -kTopTurn, kTopTurn);
    const double braking = std::sqrt(end_speed * end_speed + 2 * 0.6 * kAcceleration * far);
    const double curve = kSideways / std::max(std::fabs(turn), 1e-3);
    const double ahead = std::max(0.0, roboss::fixed_cos(1.3 * angle));
    return wheels(robot, direction * std::min({top_speed, braking, curve}) * ahead, turn);
}

WheelSpeeds spin(double direction) {
    const double speed = direction > 0 ? 1.2 : -1.2;
    return {-speed, speed};
}

Point around_robots(const View& view, std::size_t number, Point target) {
    constexpr double kLook = 0.35, kClear = 1.35 * kRobotSize;  // m
    const Mover& robot = view.own[number];
    const double far = distance(robot, target);
    if (far < kRobotSize) return target;
    const double ux = (target.x - robot.x) / far, uy = (target.y - robot.y) / far;
    double nearest = std::min(kLook, far), shift = 0;
    const auto look = [&](const Mover& obstacle) {
        const double dx = obstacle.x - robot.x, dy = obstacle.y - robot.y;
        const double ahead = dx * ux + dy * uy, left = -dx * uy + dy * ux;
        if (ahead < 0.3 * kRobotSize || ahead > nearest || std::fabs(left) > kClear) return;
        nearest = ahead;
        shift = left > 0 ? left - kClear : left + kClear;
    };
    for (std::size_t i = 0; i < view.own.size(); ++i)
        if (i != number) look(view.own[i]);
    for (const Mover& obstacle : view.others) look(obstacle);
    if (shift == 0) return target;
    return {robot.x + nearest * ux - shift * uy, robot.y + nearest * uy + shift * ux};
}

WheelSpeeds strike(const View& view, std::size_t number, Point aim, double top_speed) {
    const Field& field = view.field;
    const Mover &robot = view.own[number], &ball = view.ball;
    const double length = field.half_length, width = field.half_width,
                 to_ball = distance(robot, {ball.x, ball.y});
    // Where the ball will be when the robot is there, within the walls.
    const double wait = std::min(0.4, to_ball / 2.0);
    const Point meet{std::clamp(ball.x + wait * ball.vx, kBallRadius - length, length - kBallRadius),
                     std::clamp(ball.y + wait * ball.vy, kBallRadius - width, width - kBallRadius)};
    const double outside = meet.y > 0 ? 1 : -1;
    const bool at_side = width - std::fabs(meet.y) < 0.06, at_own_end = length + meet.x < 0.06;
    if (at_side && meet.x < length - 0.15)
        aim = {meet.x + 1, meet.y};
    else if (at_own_end)
        aim = {0.15 - length, outside * width};
    // A ball that is held between robots or in a corner is struck by turning.
    const bool held = ball.vx * ball.vx + ball.vy * ball.vy < 0.01 && to_ball < kReach + 0.025;
    if (held && (at_side || at_own_end || length - meet.x < 0.06))
        return spin(meet.x > 0 ? -outside : outside);
    double ux = aim.x - meet.x, uy = aim.y - meet.y;
    const double away = std::max(std::sqrt(ux * ux + uy * uy), 1e-6);
    ux /= away, uy /= away;
    const double along = (meet.x - robot.x) * ux + (meet.y - robot.y) * uy;   // the ball is so far ahead
    const double aside = (meet.x - robot.x) * -uy + (meet.y - robot.y) * ux;  // and so far to the left
    if (along > 0 && std::fabs(aside) < 0.025 + 0.12 * along)
        return drive_to(robot, {meet.x + 0.3 * ux, meet.y + 0.3 * uy}, top_speed, top_speed);
    // Behind the ball; past it on the nearer side if it is in the way.
    const double beside = along < kReach ? (aside > 0 ? -1 : 1) * 1.8 * kReach : 0;
    const double behind = beside == 0 ? 2.0 * kReach : kReach;
    const double low_x = 0.6 * kRobotSize - length, low_y = 0.6 * kRobotSize - width;
    const Point place{std::clamp(meet.x - behind * ux - beside * uy, low_x, -low_x),
                      std::clamp(meet.y - behind * uy + beside * ux, low_y, -low_y)};
    return drive_to(robot, around_robots(view, number, place), top_speed, beside == 0 ? 0.5 : 1.0);
}

WheelSpeeds freed(const View& view, std::size_t number, WheelSpeeds wish) {
    constexpr double kPeriod = 0.8, kBack = 0.2;  // s
    const double phase = view.time_s / kPeriod + 0.37 * static_cast<double>(number) +
                         (view.own[0].x > view.others[0].x ? 0.5 : 0);
    if ((phase - std::floor(phase)) * kPeriod > kBack) return wish;
    const Mover& robot = view.own[number];
    if (robot.vx * robot.vx + robot.vy * robot.vy > 0.09) return wish;
    const auto touches = [&](const Mover& one) {
        return &one != &robot && distance(robot, {one.x, one.y}) < 1.45 * kRobotSize;
    };
    const bool touched = std::any_of(view.own.begin(), view.own.end(), touches) ||
                         std::any_of(view.others.begin(), view.others.end(), touches);
    if (!touched) return wish;
    const double back = wish.left + wish.right > 0 ? -0.5 : 0.5;
    return {back - 0.15, back + 0.15};
}

}  // namespace soccer
