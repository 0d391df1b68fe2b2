// What every Client offers, in terms of the few things that its implementation provides.
#include "client/client.h"

#include <algorithm>
#include <cmath>

namespace roboss {

Transform Client::pose(RobotId robot, LinkId link) const {
    return link_pose(model().type_of(robot), state(robot), link);
}

Twist Client::twist(RobotId robot, LinkId link) const {
    return link_twist(model().type_of(robot), state(robot), link);
}

JointState Client::joint(RobotId robot, JointId joint, int axis) const {
    return joint_state(model().type_of(robot), state(robot), joint, axis);
}

Result<> Client::set_pose(RobotId robot, const Pose& X_WR) {
    return order(robot, SetPose{X_WR});
}

Result<> Client::set_velocity(RobotId robot, const Vec3& linear, const Vec3& angular) {
    return order(robot, SetVelocity{linear, angular});
}

Result<> Client::apply_wrench(RobotId robot, LinkId link, const Vec3& force, const Vec3& torque,
                              double duration_s) {
    if (!(duration_s > 0) || duration_s > 1e9)
        return Error{"a wrench for " + std::to_string(duration_s) + " s",
                     "give a duration between 0 and 1e9 s"};
    const auto ticks = static_cast<Tick>(std::floor(duration_s / model().dt_s + 0.5));
    return order(robot, ApplyWrench{link, force, torque, std::max<Tick>(ticks, 1)});
}

Result<> Client::set_joint(RobotId robot, JointId joint, MotorMode mode, double target, double max_effort,
                           int axis) {
    return order(robot, SetJoint{joint, axis, mode, target, max_effort});
}

LaserReading Client::laser(RobotId robot, std::size_t sensor) {
    return read_laser(model(), robot, sensor, state(robot), tick(), seed(), ray_scene());
}

OdometerReading Client::odometer(RobotId robot, std::size_t sensor) {
    return read_odometer(model(), robot, sensor, state(robot), tick(), seed());
}

GpsReading Client::gps(RobotId robot, std::size_t sensor) {
    return read_gps(model(), robot, sensor, state(robot), tick(), seed());
}

StepProbe& Client::probe() {
    if (!probe_) probe_ = std::make_unique<StepProbe>(model());
    if (probe_->tick() == tick()) return *probe_;
    std::vector<const RobotState*> states;
    for (std::size_t r = 0; r < model().robots.size(); ++r) states.push_back(&state(RobotId(r)));
    probe_->step(tick(), states);
    return *probe_;
}

std::span<const ContactReport> Client::contacts() {
    return probe().contacts();
}

std::vector<JointReaction> Client::joint_reactions(RobotId robot) {
    return probe().joint_reactions(robot);
}

CompassReading Client::compass(RobotId robot, std::size_t sensor) {
    return read_compass(model(), robot, sensor, state(robot), tick(), seed());
}

}  // namespace roboss
