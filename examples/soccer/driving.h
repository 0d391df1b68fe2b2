// How a robot with two wheels gets somewhere: pure functions, in the team's frame.
#pragma once

#include "pitch.h"

namespace soccer {

struct WheelSpeeds {
    double left = 0, right = 0;  // m/s
};

struct Point {
    double x = 0, y = 0;
};

/// Drives to the point, forwards or backwards, and passes it with `end_speed` (m/s) in a straight line.
WheelSpeeds drive_to(const Mover& robot, Point target, double top_speed, double end_speed = 0);
/// Turns on the spot, to the left if `direction` is positive: strikes a ball that lies beside the robot.
WheelSpeeds spin(double direction);

double distance(const Mover& from, Point to);

/// The target, or a point beside the nearest robot that stands in the way to it.
Point around_robots(const View& view, std::size_t number, Point target);

/// Drives round the ball to a place behind it, seen from `aim`, and through the ball towards `aim`; along a
/// wall where the ball lies at one.
WheelSpeeds strike(const View& view, std::size_t number, Point aim, double top_speed);

/// Robots that push each other do not move: for a part of each second they back off. Others keep `wish`.
WheelSpeeds freed(const View& view, std::size_t number, WheelSpeeds wish);

}  // namespace soccer
