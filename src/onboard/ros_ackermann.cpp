// See onboard_kinds/ros_ackermann.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

/// Joints in the order of the parameters; the steering wheel, if there is one, is last.
enum Joint : std::size_t { kFrontLeft, kFrontRight, kRearLeft, kRearRight, kLeft, kRight, kSteeringWheel };

/// What the plugin measures of the car as it is built: all joints at zero.
struct Car {
    double radius = 0, separation = 0, base = 0;  // m: rear wheel, front wheels, axles
};

/// Pose of a body in the robot's base with all joints at zero.
Transform zero_pose(const RobotType& type, int body) {
    Transform X;
    for (int b = body; b >= 0; b = type.bodies[static_cast<std::size_t>(b)].parent)
        if (b > 0 || !type.free_base) X = type.bodies[static_cast<std::size_t>(b)].X_PJ * X;
    return X;
}

/// Centre of the first shape of the wheel that the joint carries, in the base, m; its radius.
Vec3 wheel_centre(const OnboardContext& c, std::size_t joint, double& radius) {
    const int body = c.dof(joint).body;
    const Transform X = zero_pose(c.type(), body);
    for (const BodyShape& shape : c.type().shapes) {
        if (shape.body != body) continue;
        radius = shape.shape.radius;
        return X * shape.X_BS.p;
    }
    return X.p;
}

Car measure(const OnboardContext& c) {
    Car car;
    double unused = 0;
    const Vec3 front_left = wheel_centre(c, kFrontLeft, unused),
               front_right = wheel_centre(c, kFrontRight, unused),
               rear_left = wheel_centre(c, kRearLeft, unused),
               rear_right = wheel_centre(c, kRearRight, car.radius);
    car.separation = norm(front_left - front_right);
    car.base = norm((front_left + front_right) * 0.5 - (rear_left + rear_right) * 0.5);
    return car;
}

/// One step of a PID of Gazebo (error: measured minus wanted). `error`: integral and last error, remembered.
double pid(const std::vector<double>& gain, const std::vector<double>& range, double now, double dt,
           std::span<double> error) {
    if (gain.size() != 3) return 0;
    error[0] += dt * now;
    double integral = gain[1] * error[0];
    const double low = range.size() == 2 ? range[0] : 0, high = range.size() == 2 ? range[1] : 0;
    if (gain[1] != 0 && (integral > high || integral < low)) {
        integral = fixed_max(fixed_min(integral, high), low);
        error[0] = integral / gain[1];
    }
    const double rate = (now - error[1]) / dt;
    error[1] = now;
    return -(gain[0] * now + integral + gain[2] * rate);
}

/// Drives the joints for the tick; `period`: since the PIDs acted last, s.
void act(const RosAckermannSpec& spec, OnboardContext& c, const Car& car, double period) {
    const std::span<const double> twist = c.command(0);
    const std::span<double> memory = c.memory();
    const double speed = fixed_max(fixed_min(twist[Twist6::kLinearX], spec.max_speed), -spec.max_speed);
    const double way = twist[Twist6::kLinearX] < 0 ? -1.0 : 1.0;
    const double angle =
        fixed_max(fixed_min(twist[Twist6::kAngularZ] * way, spec.max_steer), -spec.max_steer);
    const SinCos middle = fixed_sincos(angle);
    const double slope = middle.sin / middle.cos, across = 0.5 * car.separation / car.base * slope;
    const double left = fixed_atan2(slope, 1.0 - across), right = fixed_atan2(slope, 1.0 + across);
    const double drive = pid(spec.speed_gain, spec.speed_range, c.velocity(kRearRight) - speed / car.radius,
                             period, memory.subspan(RosAckermannSpec::kSpeedError, 2));
    c.drive(kRearLeft, MotorMode::kEffort, drive), c.drive(kRearRight, MotorMode::kEffort, drive);
    c.drive(kLeft, MotorMode::kEffort,
            pid(spec.left_gain, spec.left_range, c.position(kLeft) - left, period,
                memory.subspan(RosAckermannSpec::kLeftError, 2)));
    c.drive(kRight, MotorMode::kEffort,
            pid(spec.right_gain, spec.right_range, c.position(kRight) - right, period,
                memory.subspan(RosAckermannSpec::kRightError, 2)));
}

}  // namespace

void run(const RosAckermannSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    set_true_odometry(memory.first<5>(), c.type(), c.state());
    for (const std::size_t joint : {kRearLeft, kRearRight, kLeft, kRight})
        c.drive(joint, MotorMode::kEffort, 0);
    const Car car = measure(c);
    if (!(car.radius > 0) || !(car.base > 0)) return;
    if (c.joint_count() > kSteeringWheel) {
        const double mean = 0.5 * (c.position(kLeft) + c.position(kRight));
        c.drive(kSteeringWheel, MotorMode::kPosition, mean * spec.max_steering_angle / spec.max_steer);
    }
    // The original's forces last for one step after each update, and so do these.
    const double period = spec.ros.update_rate > 0 ? fixed_max(1.0 / spec.ros.update_rate, c.dt()) : c.dt();
    if (c.time() < memory[RosAckermannSpec::kNextUpdate] - 1e-9) return;
    memory[RosAckermannSpec::kNextUpdate] = c.time() + period;
    act(spec, c, car, period);
}

}  // namespace roboss
