// The control program of the city: every robot that has a laser, a GPS receiver, a gyrocompass and the four
// wheels of the city's car is driven by it. An ordinary Client: `roboss run worlds/city.sdf --client
// roboss_city_driver.so`.
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <roboss/client/control_program.h>
#include "core/fixed_math.h"
#include "driving.h"

namespace city_driver {
namespace {

constexpr double kWheelRadius = 0.05;  // m
constexpr std::array<const char*, 4> kWheelNames{"front_left", "rear_left", "front_right", "rear_right"};

/// Which parts of a type of robot the driver uses.
struct Controls {
    std::size_t laser = 0, gps = 0, compass = 0;
    std::array<roboss::JointId, 4> wheels;        // left, left, right, right
    std::size_t left_motor = 0, right_motor = 0;  // in RobotState::motors
};

template <class Kind>
std::optional<std::size_t> sensor_of_kind(const roboss::RobotType& type) {
    for (std::size_t i = 0; i < type.sensors.size(); ++i)
        if (type.sensors[i].spec.as<Kind>() != nullptr) return i;
    return std::nullopt;
}

std::optional<Controls> controls_of(const roboss::RobotType& type) {
    const auto laser = sensor_of_kind<roboss::LaserSpec>(type);
    const auto gps = sensor_of_kind<roboss::GpsSpec>(type);
    const auto compass = sensor_of_kind<roboss::CompassSpec>(type);
    if (!laser || !gps || !compass) return std::nullopt;
    Controls controls{*laser, *gps, *compass, {}, 0, 0};
    for (std::size_t i = 0; i < kWheelNames.size(); ++i) {
        const auto joint = type.find_joint(kWheelNames[i]);
        if (!joint || type.joints[joint->index()].nv != 1) return std::nullopt;
        controls.wheels[i] = *joint;
    }
    const auto motor = [&](std::size_t wheel) {
        const int v = type.joints[controls.wheels[wheel].index()].v_index;
        return static_cast<std::size_t>(v - type.base_nv());
    };
    controls.left_motor = motor(0);
    controls.right_motor = motor(2);
    return controls;
}

/// The rectangle of all that stands in the world: where the goals lie.
Rectangle extent_of(const roboss::Model& model) {
    roboss::Aabb all;
    for (const roboss::StaticShape& fixed : model.statics)
        if (fixed.shape.kind != roboss::ShapeKind::kPlane)
            all.include(roboss::bounds(fixed.shape, fixed.X_WS));
    if (all.empty()) return {-10, -10, 10, 10};
    return {all.min.x, all.min.y, all.max.x, all.max.y};
}

class CityDriver final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {0.05, -1, true}; }

    void start(roboss::Client& client) override {
        const roboss::Model& model = client.model();
        for (const roboss::RobotType& type : model.types) controls_.push_back(controls_of(type));
        city_ = extent_of(model);
    }

    void control(roboss::Client& client) override {
        const roboss::Model& model = client.model();
        for (std::size_t i = 0; i < model.robots.size(); ++i)
            if (const auto& controls = controls_[model.robots[i].type.index()])
                drive_robot(client, roboss::RobotId(i), *controls);
    }

  private:
    void drive_robot(roboss::Client& client, roboss::RobotId car, const Controls& controls) const;

    std::vector<std::optional<Controls>> controls_;  // one a type; none: not a car
    Rectangle city_;
};

void CityDriver::drive_robot(roboss::Client& client, roboss::RobotId car, const Controls& controls) const {
    const roboss::LaserReading laser = client.laser(car, controls.laser);
    const roboss::GpsReading gps = client.gps(car, controls.gps);
    const roboss::CompassReading compass = client.compass(car, controls.compass);
    const roboss::LaserSpec& spec =
        *client.model().type_of(car).sensors[controls.laser].spec.as<roboss::LaserSpec>();
    const roboss::RobotState& state = client.state(car);

    const roboss::Vec3 ahead = roboss::rotate(compass.q_WS, roboss::Vec3{1, 0, 0});
    const Place goal = goal_of(client.seed(), car.value, client.time_s(), city_);
    const double dx = goal.x - gps.p_W.x, dy = goal.y - gps.p_W.y;
    DriverView view;
    view.ranges = laser.ranges;
    view.min_angle = spec.min_angle, view.max_angle = spec.max_angle, view.range_max = spec.range_max;
    view.goal_angle = roboss::fixed_atan2(ahead.x * dy - ahead.y * dx, ahead.x * dx + ahead.y * dy);
    view.goal_distance = std::sqrt(dx * dx + dy * dy);
    view.speed = dot(gps.v_W, ahead);
    view.turn_rate = compass.angular_velocity_S.z;
    view.ordered_left = kWheelRadius * state.motors[controls.left_motor].target;
    view.ordered_right = kWheelRadius * state.motors[controls.right_motor].target;

    const WheelSpeeds speeds = drive(view);
    for (std::size_t i = 0; i < 4; ++i) {
        const double rate = (i < 2 ? speeds.left : speeds.right) / kWheelRadius;
        // Refused only if the Model changed under us; the next period tries again.
        (void)client.set_joint(car, controls.wheels[i], roboss::MotorMode::kVelocity, rate);
    }
}

}  // namespace
}  // namespace city_driver

ROBOSS_CONTROL_PROGRAM(city_driver::CityDriver)
