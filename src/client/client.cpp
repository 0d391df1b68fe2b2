// The part of Client that all implementations share.
#include "client/client.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/topics.h"

namespace roboss {

namespace {

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

Result<Tick> Client::ticks_of(double duration_s) const {
    if (!(duration_s > 0) || duration_s > 1e9)
        return Error{"a force for " + std::to_string(duration_s) + " s",
                     "give a duration between 0 and 1e9 s", "bad-duration"};
    return std::max<Tick>(static_cast<Tick>(std::floor(duration_s / model().dt_s + 0.5)), 1);
}

Result<> Client::apply_wrench(RobotId robot, LinkId link, const Vec3& force, const Vec3& torque,
                              double duration_s) {
    const Result<Tick> ticks = ticks_of(duration_s);
    if (!ticks) return ticks.error();
    return order(robot, ApplyWrench{link, force, torque, ticks.value()});
}

Result<> Client::pull(RobotId robot, LinkId link, const Vec3& p_L, const Vec3& target_W, double max_force,
                      double duration_s, double rate) {
    const Result<Tick> ticks = ticks_of(duration_s);
    if (!ticks) return ticks.error();
    return order(robot, Pull{link, p_L, target_W, rate, max_force, ticks.value()});
}

Result<> Client::set_joint(RobotId robot, JointId joint, MotorMode mode, double target, double max_effort,
                           int axis) {
    return order(robot, SetJoint{joint, axis, mode, target, max_effort});
}

Result<> Client::command(RobotId robot, const std::string& name, std::vector<double> values) {
    const std::vector<ChannelInfo>& channels = model().types[known(robot).type.index()].channels;
    const auto found = model().type_of(robot).find_channel(name);
    if (!found)
        refuse(called(known(robot)) + " has no command '" + name + "'",
               what_it_has(channels, [](const ChannelInfo& c) { return c.channel.name; }));
    return order(robot, Command{static_cast<std::uint32_t>(*found), std::move(values)});
}

Result<> Client::publish(const std::string& topic, const std::vector<double>& values) {
    const std::vector<TopicPlace> places = find_topic(model(), topic);
    if (places.empty())
        return Error{"no robot of the world takes messages at '" + topic + "'",
                     "`roboss check` lists the topics of all commands"};
    for (const TopicPlace& place : places)
        if (Result<> given = order(place.robot, Command{place.channel, values}); !given) return given;
    return Ok{};
}

std::vector<RobotEvent> Client::events() const {
    std::vector<RobotEvent> all;
    for (std::size_t r = 0; r < model().robots.size(); ++r) {
        if (board_of(model().type_of(RobotId(r))) == nullptr) continue;
        for (RobotEvent& event :
             events_on_board(model(), RobotId(r), state(RobotId(r)), observed_before(), tick()))
            all.push_back(std::move(event));
    }
    return all;
}

Result<> Client::attach(RobotId robot, LinkId link, RobotId other, LinkId other_link) {
    return order(robot, Attach{.link = link, .other = other, .other_link = other_link});
}

Result<> Client::detach(RobotId robot, RobotId other) {
    return order(robot, Detach{other});
}

Sample Client::measure(RobotId robot, std::size_t sensor) {
    Result<Sample> measured = roboss::measure({model(), robot, sensor, state(robot), tick(), seed(), *this});
    if (!measured) refuse(measured.error().message, measured.error().remedy);
    return std::move(measured).value();
}

/// The sample that the sensor holds, or a new one where it has no rate or holds none yet.
Sample Client::sample(RobotId robot, std::size_t sensor, const SensorKind& asked) {
    const std::string name = called(known(robot));
    const std::vector<SensorInfo>& sensors = model().type_of(robot).sensors;
    if (sensor >= sensors.size())
        refuse(name + " has no sensor number " + std::to_string(sensor),
               what_it_has(sensors, [](const SensorInfo& s) { return s.spec.name; }));
    const SensorSpec& spec = sensors[sensor].spec;
    if (spec.measures() && spec.kind().number != asked.number)
        refuse("sensor " + std::to_string(sensor) + " '" + spec.name + "' of " + name + " is read as " +
                   asked.phrase,
               std::string("it is ") + spec.kind().phrase);
    const HeldSamples::Key key{robot.value, static_cast<std::uint32_t>(sensor)};
    if (const Sample* held = samples_.find(key)) return *held;
    Sample fresh = measure(robot, sensor);
    return spec.update_rate_hz > 0 ? samples_.put(key, std::move(fresh)) : fresh;
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

void Client::forget_measured() {
    samples_ = {};
    probe_.reset();
}

Result<> Client::restore_samples(const std::string& bytes) {
    HeldSamples samples;
    if (Result<> read = samples.restore(bytes); !read) return read;
    for (const auto& [key, held] : samples.all()) {
        const bool known = key.first < model().robots.size() &&
                           key.second < model().type_of(RobotId(key.first)).sensors.size();
        if (!known || model().type_of(RobotId(key.first)).sensors[key.second].spec.kind().number !=
                          number_of(held.sample))
            return Error{"a saved run holds a sample of a sensor that this world does not have",
                         "continue it with the world that it was saved with"};
    }
    samples_ = std::move(samples);
    renew_samples();
    return Ok{};
}

StepProbe& Client::step_probe() {
    if (!probe_) probe_ = std::make_unique<StepProbe>(model());
    if (probe_->tick() == tick()) return *probe_;
    std::vector<const RobotState*> states;
    for (std::size_t r = 0; r < model().robots.size(); ++r) states.push_back(&state(RobotId(r)));
    probe_->step(tick(), states);
    return *probe_;
}

std::span<const ContactReport> Client::contacts() {
    return step_probe().contacts();
}

std::vector<JointReaction> Client::joint_reactions(RobotId robot) {
    (void)known(robot);
    return step_probe().joint_reactions(robot);
}

}  // namespace roboss
