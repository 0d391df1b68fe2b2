// See twin.h.
#include "device/twin.h"

#include <algorithm>
#include <cmath>

namespace roboss {

BusClientOptions twin_options(const Model& model, const std::string& name, double period_s) {
    BusClientOptions options;
    options.name = name;
    options.period = std::max<Tick>(1, std::llround(period_s / model.dt_s));
    options.latency = 0;
    options.synchronous = false;
    return options;
}

void Twin::advance(Bus& bus) {
    client_.advance(bus);
    if (!client_.observing()) return;
    shown_ = true;
    for (const Device& device : devices_)
        if (device.robot.valid()) place(device);
    client_.answer(bus);
}

const RobotState* Twin::state(RobotId robot) const {
    return shown_ ? &client_.state(robot) : nullptr;
}

/// A camera's pose comes before one by counting wheel turns.
const PoseReading* Twin::pose_of(RobotId robot) const {
    const PoseReading* best = nullptr;
    for (const Device& device : devices_) {
        const auto& poses = device.adapter->readings().poses;
        const auto found = poses.find(robot);
        if (found != poses.end() && (best == nullptr || best->estimated)) best = &found->second;
    }
    return best;
}

/// The run reports orders that it refuses: the velocity of a fixed base, for instance, is never sent.
void Twin::place(const Device& device) {
    const DeviceReadings& readings = device.adapter->readings();
    if (readings.fresh_s == kNever) return;
    const RobotId robot = device.robot;
    const double moves = stopped_ ? 0.0 : 1.0;
    if (const PoseReading* pose = pose_of(robot); pose != nullptr && client_.type(robot).free_base) {
        client_.set_pose(robot, pose->X_WR);
        client_.set_velocity(robot, pose->linear * moves, pose->angular * moves);
    }
    for (const auto& [joint, reading] : readings.joints)
        client_.set_joint_state(robot, joint, {reading.position}, {reading.velocity * moves});
    ++placed_;
}

}  // namespace roboss
