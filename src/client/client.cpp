// What every Client offers, in terms of the few things that its implementation provides.
#include "client/client.h"

#include <algorithm>
#include <cmath>

#include "client/measure.h"
#include "core/check.h"

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

Sample Client::measure(RobotId robot, std::size_t sensor) {
    const RobotType& type = model().type_of(robot);
    ROBOSS_CHECK(sensor < type.sensors.size(), type.name + " has no sensor number " + std::to_string(sensor));
    return roboss::measure({model(), robot, sensor, state(robot), tick(), seed()},
                           [this]() -> RayScene& { return ray_scene(); });
}

/// The sample that the sensor holds, or a new one where it has no rate or holds none yet.
template <class Reading>
Reading Client::sampled(RobotId robot, std::size_t sensor) {
    const HeldSamples::Key key{robot.value, static_cast<std::uint32_t>(sensor)};
    const Sample* held = samples_.find(key);
    Sample fresh;
    if (held == nullptr) {
        fresh = measure(robot, sensor);
        const bool rated = model().type_of(robot).sensors[sensor].spec.update_rate_hz > 0;
        held = rated ? &samples_.put(key, std::move(fresh)) : &fresh;
    }
    const Reading* reading = std::get_if<Reading>(held);
    ROBOSS_CHECK(reading != nullptr, "sensor number " + std::to_string(sensor) + " of a " +
                                         model().type_of(robot).name + " is of another kind");
    return *reading;
}

void Client::renew_samples() {
    for (auto& [key, held] : samples_.all()) {
        const RobotId robot(key.first);
        const double rate = model().type_of(robot).sensors[key.second].spec.update_rate_hz;
        if (!sample_is_due(rate, model().dt_s, taken_at(held.sample), tick())) continue;
        held.before = std::move(held.sample);
        held.sample = measure(robot, key.second);
    }
}

Result<> Client::restore_samples(const std::string& bytes) {
    HeldSamples samples;
    if (Result<> read = samples.restore(bytes); !read) return read;
    for (const auto& [key, held] : samples.all()) {
        const bool known = key.first < model().robots.size() &&
                           key.second < model().type_of(RobotId(key.first)).sensors.size();
        const SensorKind kind = known ? model().type_of(RobotId(key.first)).sensors[key.second].spec.kind
                                      : SensorKind::kUnsupported;
        if (kind == SensorKind::kUnsupported || static_cast<std::size_t>(kind) != held.sample.index())
            return Error{"a saved run holds a sample of a sensor that this world does not have",
                         "continue it with the world that it was saved with"};
    }
    samples_ = std::move(samples);
    renew_samples();
    return Ok{};
}

LaserReading Client::laser(RobotId robot, std::size_t sensor) {
    return sampled<LaserReading>(robot, sensor);
}

OdometerReading Client::odometer(RobotId robot, std::size_t sensor) {
    return sampled<OdometerReading>(robot, sensor);
}

GpsReading Client::gps(RobotId robot, std::size_t sensor) {
    return sampled<GpsReading>(robot, sensor);
}

CompassReading Client::compass(RobotId robot, std::size_t sensor) {
    return sampled<CompassReading>(robot, sensor);
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

}  // namespace roboss
