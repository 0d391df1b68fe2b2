// The part of Client that all implementations share.
#include "client/client.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <variant>

#include "client/measure.h"

namespace roboss {

namespace {

constexpr const char* kKindNames[] = {"a laser", "a GPS receiver", "a compass",
                                      "an odometer"};  // in the order of Sample
static_assert(std::size(kKindNames) == std::variant_size_v<Sample>);

[[noreturn]] void refuse(const std::string& message, const std::string& remedy) {
    throw std::invalid_argument(Error{message, remedy}.text());
}

std::string called(const Robot& robot) {
    return "robot '" + robot.name + "'";
}

/// "it has 0 'gps', 1 'scan'"
template <class Items, class Name>
std::string what_it_has(const Items& items, const Name& name_of) {
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i)
        text += (text.empty() ? "" : ", ") + std::to_string(i) + " '" + name_of(items[i]) + "'";
    return text.empty() ? "it has none" : "it has " + text;
}

}  // namespace

const Robot& Client::known(RobotId robot) const {
    const std::vector<Robot>& robots = model().robots;
    if (robot.index() < robots.size()) return robots[robot.index()];
    refuse("there is no robot number " + std::to_string(robot.value),
           "the world has " + std::to_string(robots.size()) + " robots, counted from 0");
}

const RobotType& Client::known_type(RobotId robot, LinkId link) const {
    const std::string name = called(known(robot));
    const RobotType& type = model().type_of(robot);
    if (link.index() < type.links.size()) return type;
    refuse(name + " has no link number " + std::to_string(link.value),
           what_it_has(type.links, [](const Link& l) { return l.name; }));
}

const SensorSpec& Client::known_sensor(RobotId robot, std::size_t sensor) const {
    const std::string name = called(known(robot));
    const std::vector<SensorInfo>& sensors = model().type_of(robot).sensors;
    if (sensor >= sensors.size())
        refuse(name + " has no sensor number " + std::to_string(sensor),
               what_it_has(sensors, [](const SensorInfo& s) { return s.spec.name; }));
    const SensorSpec& spec = sensors[sensor].spec;
    if (spec.kind == SensorKind::kUnsupported)
        refuse("sensor " + std::to_string(sensor) + " '" + spec.name + "' of " + name +
                   " is of a kind that measures nothing (" + spec.sdf_type + ")",
               "`roboss check` lists the sensors that measure");
    return spec;
}

Transform Client::pose(RobotId robot, LinkId link) const {
    return link_pose(known_type(robot, link), state(robot), link);
}

Twist Client::twist(RobotId robot, LinkId link) const {
    return link_twist(known_type(robot, link), state(robot), link);
}

JointState Client::joint(RobotId robot, JointId joint, int axis) const {
    const std::string name = called(known(robot));
    const RobotType& type = model().type_of(robot);
    if (joint.index() >= type.joints.size())
        refuse(name + " has no joint number " + std::to_string(joint.value),
               what_it_has(type.joints, [](const Joint& j) { return j.name; }));
    const Joint& known_joint = type.joints[joint.index()];
    if (axis < 0 || axis >= known_joint.nv)
        refuse("joint '" + known_joint.name + "' of " + name + " has no axis " + std::to_string(axis),
               "it has " + std::to_string(known_joint.nv) + " degrees of freedom, counted from 0");
    return joint_state(type, state(robot), joint, axis);
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
    return roboss::measure({model(), robot, sensor, state(robot), tick(), seed()},
                           [this]() -> RayScene& { return ray_scene(); });
}

/// The sample that the sensor holds, or a new one where it has no rate or holds none yet.
template <class Reading>
Reading Client::sampled(RobotId robot, std::size_t sensor) {
    const SensorSpec& spec = known_sensor(robot, sensor);
    const std::size_t asked = Sample(Reading{}).index(), is = static_cast<std::size_t>(spec.kind);
    if (is != asked)
        refuse("sensor " + std::to_string(sensor) + " '" + spec.name + "' of " + called(known(robot)) +
                   " is read as " + kKindNames[asked],
               std::string("it is ") + kKindNames[is]);
    const HeldSamples::Key key{robot.value, static_cast<std::uint32_t>(sensor)};
    const Sample* held = samples_.find(key);
    if (held != nullptr) return std::get<Reading>(*held);
    Sample fresh = measure(robot, sensor);
    return std::get<Reading>(spec.update_rate_hz > 0 ? samples_.put(key, std::move(fresh)) : fresh);
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
    (void)known(robot);
    return probe().joint_reactions(robot);
}

}  // namespace roboss
