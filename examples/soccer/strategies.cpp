#include "strategies.h"

#include <algorithm>
#include <cmath>

namespace soccer {
namespace {

bool is_at_own_goal(const View& view) {
    return view.ball.x < 0 && in_goal_area(view.field, view.ball.x, view.ball.y);
}

/// On the goal line, where a ball that comes would cross it.
WheelSpeeds keep_goal(const View& view, double top_speed) {
    const Field& field = view.field;
    const Mover &keeper = view.own[0], &ball = view.ball;
    const double line = -field.half_length + 0.6 * kRobotSize;
    double y = ball.y * field.half_goal / field.half_width;
    if (ball.vx < -0.2) y = ball.y + (line - ball.x) / ball.vx * ball.vy;
    y = std::clamp(y, 0.02 - field.half_goal, field.half_goal - 0.02);
    // It clears a slow ball before its goal.
    const bool slow = ball.vx * ball.vx + ball.vy * ball.vy < 0.25;
    if (is_at_own_goal(view) && slow && ball.x > keeper.x)
        return drive_to(keeper, {ball.x + 0.1, ball.y + 0.3 * ball.y}, top_speed, 1.0);
    return drive_to(keeper, {line, y}, top_speed);
}

/// A robot in front of the ball has a longer way to strike it.
double time_to_ball(const Mover& robot, const Mover& ball) {
    const double detour = robot.x > ball.x - 0.03 ? 0.3 : 0.0;
    return distance(robot, {ball.x + 0.2 * ball.vx, ball.y + 0.2 * ball.vy}) + detour;
}

/// The numbers of the field players, the one that is first at the ball first.
std::vector<std::size_t> by_time_to_ball(const View& view) {
    std::vector<std::size_t> order;
    for (std::size_t i = 1; i < view.own.size(); ++i) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return time_to_ball(view.own[a], view.ball) < time_to_ball(view.own[b], view.ball);
    });
    return order;
}

/// The same point, but outside of the own goal area, where only the goalkeeper may be.
Point off_goal_area(const Field& field, Point wish) {
    const double limit = -field.half_length + field.goal_area_depth + kRobotSize;
    if (std::fabs(wish.y) < field.goal_area_half + kRobotSize) wish.x = std::max(wish.x, limit);
    return wish;
}

}  // namespace

std::vector<WheelSpeeds> play_zones(const View& view) {
    const Field& field = view.field;
    std::vector<WheelSpeeds> speeds(view.own.size());
    speeds[0] = keep_goal(view, 1.5);
    const std::vector<std::size_t> order = by_time_to_ball(view);
    const double length = field.half_length, width = field.half_width;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const std::size_t number = order[rank];
        const Mover& robot = view.own[number];
        if (rank == 0 && !is_at_own_goal(view)) {
            speeds[number] = strike(view, number, {length + 0.05, 0}, 2.0);
            continue;
        }
        // The second one covers the way to the own goal; the next ones are spread over the width.
        const double share =
            order.size() > 2
                ? 2.0 * static_cast<double>(rank - 1) / static_cast<double>(order.size() - 2) - 1.0
                : 0.0;
        Point place{0.5 * (view.ball.x - length), 0.4 * view.ball.y};
        if (rank >= 2)
            place = {std::clamp(view.ball.x - 0.35 * length * (rank % 2 == 0 ? 1.0 : 1.8), -0.7 * length,
                                0.6 * length),
                     0.7 * width * share};
        speeds[number] = drive_to(robot, around_robots(view, number, off_goal_area(field, place)), 1.5);
    }
    for (std::size_t i = 1; i < speeds.size(); ++i) speeds[i] = freed(view, i, speeds[i]);
    return speeds;
}

std::vector<WheelSpeeds> play_pack(const View& view) {
    const Field& field = view.field;
    std::vector<WheelSpeeds> speeds(view.own.size());
    speeds[0] = keep_goal(view, 1.2);
    const std::vector<std::size_t> order = by_time_to_ball(view);
    const double corner = view.others[0].y > 0 ? -0.7 * field.half_goal : 0.7 * field.half_goal;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const std::size_t number = order[rank];
        const Mover& robot = view.own[number];
        if (rank == 0) {
            speeds[number] = strike(view, number, {field.half_length + 0.05, corner}, 2.6);
        } else if (rank == 1) {
            // Follows on the other side, for the rebound.
            const double side = robot.y > view.ball.y ? 1 : -1;
            speeds[number] =
                drive_to(robot,
                         around_robots(view, number,
                                       off_goal_area(field, {view.ball.x - 0.2, view.ball.y + 0.18 * side})),
                         2.0);
        } else {
            const double share =
                2.0 * (static_cast<double>(rank) - 1.0) / static_cast<double>(order.size() - 1) - 1.0;
            const Point place{-0.55 * field.half_length, 0.6 * field.half_width * share + 0.2 * view.ball.y};
            speeds[number] = drive_to(robot, around_robots(view, number, off_goal_area(field, place)), 1.5);
        }
    }
    for (std::size_t i = 1; i < speeds.size(); ++i) speeds[i] = freed(view, i, speeds[i]);
    return speeds;
}

}  // namespace soccer
