// See onboard_kinds/ackermann_steering.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/speed_limiter.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

constexpr double kStraight = 1e9;        // m: a radius that is none
constexpr double kLeastTurn = 1e-3;      // rad/s: slower is straight, as in Gazebo
constexpr double kSteeringStill = 1e-7;  // rad/s: so slow a steering stands, that the robot may sleep

/// Angles of the left and right steering joints, rad.
struct SteeringAngles {
    double left = 0, right = 0;
};

/// atan(a / b)
double slope(double a, double b) {
    return b < 0 ? fixed_atan2(-a, -b) : fixed_atan2(a, b);
}

/// Where the joints of each kind begin in the context's.
struct Joints {
    explicit Joints(const AckermannSteeringSpec& spec)
        : right(spec.left.size()),
          left_steering(right + spec.right.size()),
          right_steering(left_steering + spec.left_steering.size()) {}
    std::size_t right, left_steering, right_steering;
};

void steer(const AckermannSteeringSpec& spec, const SteeringAngles& wanted, OnboardContext& c) {
    const Joints at(spec);
    const auto speed = [&](double angle, std::size_t first) {
        const double rate = spec.speed_gain * (angle - c.position(first));
        return std::fabs(rate) < kSteeringStill ? 0.0 : rate;
    };
    const double left = speed(wanted.left, at.left_steering), right = speed(wanted.right, at.right_steering);
    for (std::size_t joint = at.left_steering; joint < c.joint_count(); ++joint)
        c.drive(joint, MotorMode::kVelocity, joint < at.right_steering ? left : right);
}

/// Radius of the circle on which the middle between the kingpins drives, m; positive: to the left. It is
/// never smaller than the steering allows; then the speed is kept and the turn is slower.
double radius_for(const AckermannSteeringSpec& spec, double speed, double turn) {
    if (std::fabs(turn) < kLeastTurn) return kStraight;
    const double least = spec.wheel_base / fixed_sin(spec.steering_limit);
    if (speed == 0) return turn > 0 ? least : -least;
    const double radius = speed / turn;
    return std::fabs(radius) < least ? std::copysign(least, radius) : radius;
}

/// Curvature of the way, 1/m, from the measured steering angles. Each says where the centre of the circle is:
/// base / tan(angle) to the side of its kingpin; the mean of both is the radius of the middle between them.
double curvature(const AckermannSteeringSpec& spec, const SteeringAngles& angles) {
    const SinCos l = fixed_sincos(angles.left), r = fixed_sincos(angles.right);
    if (angles.left * angles.right <= 0) {
        const SinCos mean = fixed_sincos(0.5 * (angles.left + angles.right));
        return mean.sin / (mean.cos * spec.wheel_base);
    }
    return 2.0 * l.sin * r.sin / (spec.wheel_base * (l.cos * r.sin + r.cos * l.sin));
}

void count_wheels(const AckermannSteeringSpec& spec, OnboardContext& c, std::span<double> memory) {
    const Joints at(spec);
    const double left = c.position(0), right = c.position(at.right);
    if (memory[AckermannSteeringSpec::kStarted] != 0) {
        const double moved = 0.5 * spec.wheel_radius *
                             ((left - memory[AckermannSteeringSpec::kLeftAngle]) +
                              (right - memory[AckermannSteeringSpec::kRightAngle]));
        const double turn =
            moved * curvature(spec, {c.position(at.left_steering), c.position(at.right_steering)});
        move_odometry(memory.first<5>(), {moved, 0, turn}, c.dt());
    }
    memory[AckermannSteeringSpec::kStarted] = 1, memory[AckermannSteeringSpec::kLeftAngle] = left,
    memory[AckermannSteeringSpec::kRightAngle] = right;
}

void run_drive(const AckermannSteeringSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    count_wheels(spec, c, memory);
    const std::span<const double> twist = c.command(0);
    const double speed =
        limit_speed(spec.linear, twist[Twist6::kLinearX], c.dt(), memory[AckermannSteeringSpec::kSpeed],
                    memory[AckermannSteeringSpec::kSpeed + 1]);
    const double turn =
        limit_speed(spec.angular, twist[Twist6::kAngularZ], c.dt(), memory[AckermannSteeringSpec::kTurnRate],
                    memory[AckermannSteeringSpec::kTurnRate + 1]);
    const double radius = radius_for(spec, speed, turn), half = 0.5 * spec.kingpin_width;
    steer(spec, {slope(spec.wheel_base, radius - half), slope(spec.wheel_base, radius + half)}, c);
    const double across = 0.5 * spec.wheel_separation / radius;
    const double left = speed * (1.0 - across) / spec.wheel_radius,
                 right = speed * (1.0 + across) / spec.wheel_radius;
    const Joints at(spec);
    for (std::size_t joint = 0; joint < at.left_steering; ++joint)
        c.drive(joint, MotorMode::kVelocity, joint < at.right ? left : right);
}

/// The command is the angle of a wheel in the middle.
void run_steering_only(const AckermannSteeringSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    const double limited =
        limit_speed(spec.angular, c.command(0)[0], c.dt(), memory[AckermannSteeringSpec::kTurnRate],
                    memory[AckermannSteeringSpec::kTurnRate + 1]);
    const double angle = fixed_max(fixed_min(limited, spec.steering_limit), -spec.steering_limit);
    if (angle != limited) memory[AckermannSteeringSpec::kTurnRate] = angle;
    const SinCos middle = fixed_sincos(angle);
    const double along = 2.0 * spec.wheel_base * middle.cos, across = spec.wheel_separation * middle.sin,
                 side = 2.0 * spec.wheel_base * middle.sin;
    steer(spec, {slope(side, along - across), slope(side, along + across)}, c);
}

}  // namespace

void run(const AckermannSteeringSpec& spec, OnboardContext& c) {
    if (spec.only_steers())
        run_steering_only(spec, c);
    else
        run_drive(spec, c);
}

}  // namespace roboss
