// The part of Client that all implementations share.
#include "client/client.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/similar.h"
#include "model/addressee.h"
#include "model/link_value.h"
#include "model/topics.h"

namespace roboss {

namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& remedy) {
    throw std::invalid_argument(Error{message, remedy}.text());
}

std::string called(const Robot& robot) {
    return "robot '" + robot.name + "'";
}

constexpr std::size_t kListedMost = 20;

/// "it has 0 'gps', 1 'scan'"
std::string what_it_has(const std::string& owner, const std::vector<std::string>& names) {
    if (names.empty()) return owner + " has none";
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kListedMost); ++i)
        text += (text.empty() ? "" : ", ") + std::to_string(i) + " '" + names[i] + "'";
    if (names.size() > kListedMost) text += " and " + std::to_string(names.size() - kListedMost) + " more";
    return owner + " has " + text;
}

template <class Items, class Name>
std::vector<std::string> names_of(const Items& items, const Name& name_of) {
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const auto& item : items) names.push_back(name_of(item));
    return names;
}

std::vector<std::string> names_of(const std::vector<Link>& links) {
    return names_of(links, [](const Link& l) { return l.name; });
}
std::vector<std::string> names_of(const std::vector<Joint>& joints) {
    return names_of(joints, [](const Joint& j) { return j.name; });
}
std::vector<std::string> names_of(const std::vector<SensorInfo>& sensors) {
    return names_of(sensors, [](const SensorInfo& s) { return s.spec.name; });
}

/// "robot 'rover' has no joint 'left_weel'", with what was probably meant.
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const std::string& owner,
                              const std::vector<std::string>& names) {
    const std::string meant = did_you_mean(name, names, "");
    refuse(what + " '" + name + "'", (meant.empty() ? "" : meant + " ") + what_it_has(owner, names));
}

/// Position of a link, joint or sensor; throws if there is none.
template <class Items, class Ref>
std::size_t place_of(const Items& items, const Ref& wanted, std::size_t index, const char* what,
                     const std::string& owner) {
    const std::string has_no = owner + " has no " + what;
    if (!wanted.named()) {
        if (index < items.size()) return index;
        refuse(has_no + " number " + std::to_string(index), what_it_has("it", names_of(items)));
    }
    const std::string name(wanted.name());
    const std::vector<std::string> names = names_of(items);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) refuse_name(has_no, name, "it", names);
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

const Robot& Client::known(RobotId robot) const {
    const std::vector<Robot>& robots = model().robots;
    if (robot.index() < robots.size()) return robots[robot.index()];
    refuse("there is no robot number " + std::to_string(robot.value),
           "the world has " + std::to_string(robots.size()) + " robots, counted from 0");
}

RobotId Client::robot_named(const std::string& name) const {
    const std::vector<Robot>& robots = model().robots;
    if (robot_ids_.empty())
        for (std::size_t r = 0; r < robots.size(); ++r) robot_ids_.emplace(robots[r].name, RobotId(r));
    if (const auto found = robot_ids_.find(name); found != robot_ids_.end()) return found->second;
    refuse_name("there is no robot", name, "the world",
                names_of(robots, [](const Robot& r) { return r.name; }));
}

RobotId Client::robot(const RobotRef& robot) const {
    if (robot.named()) return robot_named(std::string(robot.name()));
    return (void)known(robot.id()), robot.id();
}

const RobotType& Client::type(const RobotRef& robot) const {
    return model().type_of(this->robot(robot));
}

LinkId Client::link(const RobotRef& robot, const LinkRef& link) const {
    const RobotId id = this->robot(robot);
    return LinkId(place_of(model().type_of(id).links, link, link.id().index(), "link", called(known(id))));
}

JointId Client::joint_id(const RobotRef& robot, const JointRef& joint) const {
    const RobotId id = this->robot(robot);
    return JointId(
        place_of(model().type_of(id).joints, joint, joint.id().index(), "joint", called(known(id))));
}

std::size_t Client::sensor(const RobotRef& robot, const SensorRef& sensor) const {
    const RobotId id = this->robot(robot);
    return place_of(model().type_of(id).sensors, sensor, sensor.index(), "sensor", called(known(id)));
}

Transform Client::pose(const RobotRef& robot, const LinkRef& link) const {
    const RobotId id = this->robot(robot);
    return link_pose(model().type_of(id), state_with(StatePart::kPose, id), this->link(id, link));
}

Twist Client::twist(const RobotRef& robot, const LinkRef& link) const {
    const RobotId id = this->robot(robot);
    return link_twist(model().type_of(id), state_with(StatePart::kTwist, id), this->link(id, link));
}

/// The joint, if it has such an axis.
const Joint& Client::axis_of_joint(RobotId id, JointId joint, int axis) const {
    const Joint& info = model().type_of(id).joints[joint.index()];
    if (axis < 0 || axis >= info.nv)
        refuse("joint '" + info.name + "' of " + called(known(id)) + " has no axis " + std::to_string(axis),
               "it has " + std::to_string(info.nv) + " degrees of freedom, counted from 0");
    return info;
}

JointState Client::joint(const RobotRef& robot, const JointRef& joint, int axis) const {
    const RobotId id = this->robot(robot);
    const JointId known_joint = joint_id(id, joint);
    (void)axis_of_joint(id, known_joint, axis);
    return joint_state(model().type_of(id), state_with(StatePart::kJoints, id), known_joint, axis);
}

double Client::joint_parameter(const RobotRef& robot, const JointRef& joint, JointParameter parameter,
                               int axis) const {
    const RobotId id = this->robot(robot);
    const RobotType& type = model().type_of(id);
    const Joint& info = axis_of_joint(id, joint_id(id, joint), axis);
    return dof_of(type, state(id), info, axis).*info_of(parameter).member;
}

std::optional<double> Client::link_parameter(const RobotRef& robot, const LinkRef& link,
                                             LinkParameter parameter) const {
    const RobotId id = this->robot(robot);
    return link_value(model().type_of(id), state(id), this->link(id, link), parameter);
}

Vec3 Client::gravity(const RobotRef& robot) const {
    return surrounding_of(model(), state(this->robot(robot)), Surrounding::kGravity);
}

Vec3 Client::wind(const RobotRef& robot) const {
    return surrounding_of(model(), state(this->robot(robot)), Surrounding::kWind);
}

OrderResult Client::set_pose(const RobotRef& robot, const Pose& X_WR) {
    return order(id_for_order(robot), SetPose{X_WR});
}

OrderResult Client::set_velocity(const RobotRef& robot, const Vec3& linear, const Vec3& angular) {
    return order(id_for_order(robot), SetVelocity{linear, angular});
}

Result<Tick> Client::ticks_of(double duration_s) const {
    if (!(duration_s > 0) || duration_s > 1e9)
        return Error{"a force for " + std::to_string(duration_s) + " s",
                     "give a duration between 0 and 1e9 s", "bad-duration"};
    return std::max<Tick>(static_cast<Tick>(std::floor(duration_s / model().dt_s + 0.5)), 1);
}

OrderResult Client::apply_wrench(const RobotRef& robot, const LinkRef& link, const Vec3& force,
                                 const Vec3& torque, double duration_s) {
    const Result<Tick> ticks = ticks_of(duration_s);
    if (!ticks) return report_refusal(ticks.error());
    const RobotId id = id_for_order(robot);
    return order(id, ApplyWrench{link_for_order(id, link), force, torque, ticks.value()});
}

OrderResult Client::pull(const RobotRef& robot, const LinkRef& link, const Vec3& p_L, const Vec3& target_W,
                         double max_force, double duration_s, double rate) {
    const Result<Tick> ticks = ticks_of(duration_s);
    if (!ticks) return report_refusal(ticks.error());
    const RobotId id = id_for_order(robot);
    return order(id, Pull{link_for_order(id, link), p_L, target_W, rate, max_force, ticks.value()});
}

OrderResult Client::set_joint(const RobotRef& robot, const JointRef& joint, MotorMode mode, double target,
                              double max_effort, int axis) {
    const RobotId id = id_for_order(robot);
    return order(id, SetJoint{joint_for_order(id, joint), axis, mode, target, max_effort});
}

OrderResult Client::set_joint_state(const RobotRef& robot, const JointRef& joint,
                                    std::vector<double> position, std::vector<double> velocity) {
    const RobotId id = id_for_order(robot);
    return order(id, SetJointState{joint_for_order(id, joint), std::move(position), std::move(velocity)});
}

OrderResult Client::set_joint_parameters(const RobotRef& robot, const JointRef& joint,
                                         std::vector<JointParameterValue> values, int axis) {
    const RobotId id = id_for_order(robot);
    return order(id, SetJointParameters{joint_for_order(id, joint), axis, false, std::move(values)});
}

OrderResult Client::reset_joint_parameters(const RobotRef& robot, const JointRef& joint, int axis) {
    const RobotId id = id_for_order(robot);
    return order(id, SetJointParameters{joint_for_order(id, joint), axis, true, {}});
}

OrderResult Client::set_link_parameters(const RobotRef& robot, const LinkRef& link,
                                        std::vector<LinkParameterValue> values) {
    const RobotId id = id_for_order(robot);
    return order(id, SetLinkParameters{link_for_order(id, link), false, std::move(values)});
}

OrderResult Client::reset_link_parameters(const RobotRef& robot, const LinkRef& link) {
    const RobotId id = id_for_order(robot);
    return order(id, SetLinkParameters{link_for_order(id, link), true, {}});
}

OrderResult Client::set_gravity(const RobotRef& robot, const Vec3& gravity) {
    return order(id_for_order(robot), SetSurroundings{false, {gravity, std::nullopt}});
}

OrderResult Client::set_wind(const RobotRef& robot, const Vec3& wind) {
    return order(id_for_order(robot), SetSurroundings{false, {std::nullopt, wind}});
}

OrderResult Client::reset_surroundings(const RobotRef& robot) {
    return order(id_for_order(robot), SetSurroundings{true, {}});
}

OrderResult Client::command(const RobotRef& robot, const std::string& name, std::vector<double> values) {
    const RobotId id = this->robot(robot);
    const auto found = model().type_of(id).find_command(name);
    if (!found)
        refuse_name(
            called(known(id)) + " has no command", name, "it",
            names_of(model().type_of(id).channels, [](const ChannelInfo& c) { return c.channel.name; }));
    return order(id, Command{static_cast<std::uint32_t>(*found), std::move(values)});
}

OrderResult Client::publish(const std::string& topic, const std::vector<double>& values) {
    const std::vector<TopicPlace> places = find_topic(model(), topic);
    if (places.empty())
        return report_refusal({"no robot of the world takes messages at '" + topic + "'",
                               "`roboss check` lists the topics of all commands", "no-topic"});
    for (const TopicPlace& place : places)
        if (Result<> given = order(place.robot, Command{place.channel, values}); !given) return given;
    return Result<>(Ok{});
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

OrderResult Client::attach(const RobotRef& robot, const LinkRef& link, const RobotRef& other,
                           const LinkRef& other_link) {
    const RobotId id = id_for_order(robot), other_id = id_for_order(other);
    return order(id, Attach{.link = link_for_order(id, link),
                            .other = other_id,
                            .other_link = link_for_order(other_id, other_link)});
}

OrderResult Client::detach(const RobotRef& robot, const RobotRef& other) {
    return order(id_for_order(robot), Detach{id_for_order(other)});
}

OrderResult Client::transmit(const RobotRef& robot, const SensorRef& radio, std::vector<std::uint8_t> payload,
                             std::optional<RobotRef> to) {
    const RobotId id = this->robot(robot);
    const Result<std::uint32_t> number = radio_number(model(), id, sensor(id, radio));
    if (!number) return report_refusal(number.error());
    Transmit message{number.value(), {}, std::move(payload)};
    if (to && to->named()) {
        const std::string name(to->name());
        if (const auto found = find_addressee(model(), name))
            message.to = *found;
        else
            (void)robot_named(name);  // throws, with the names that there are
    } else if (to) {
        message.to = to->id();
    }
    return order(id, std::move(message));
}

OrderResult Client::transmit(const RobotRef& robot, const SensorRef& radio, std::string_view payload,
                             std::optional<RobotRef> to) {
    return transmit(robot, radio, std::vector<std::uint8_t>(payload.begin(), payload.end()), to);
}

std::vector<RadioMessage> Client::received(const RobotRef& robot, const SensorRef& radio) {
    const RobotId id = this->robot(robot);
    Result<std::vector<RadioMessage>> messages =
        receive({model(), id, sensor(id, radio), state(id), tick(), seed(), *this, observed_before()});
    if (!messages) refuse(messages.error().message, messages.error().remedy);
    return std::move(messages).value();
}

/// Ids go on to the check of the order, which refuses one that does not exist.
RobotId Client::id_for_order(const RobotRef& robot) const {
    return robot.named() ? this->robot(robot) : robot.id();
}

JointId Client::joint_for_order(RobotId robot, const JointRef& joint) const {
    return joint.named() ? joint_id(robot, joint) : joint.id();
}

LinkId Client::link_for_order(RobotId robot, const LinkRef& link) const {
    return link.named() ? this->link(robot, link) : link.id();
}

Sample Client::measure(RobotId robot, std::size_t sensor) {
    Result<Sample> measured =
        roboss::measure({model(), robot, sensor, state(robot), tick(), seed(), *this, observed_before()});
    if (!measured) refuse(measured.error().message, measured.error().remedy);
    return std::move(measured).value();
}

/// The sample that the sensor holds, or a new one where it has no rate or holds none yet.
Sample Client::sample(RobotId robot, const SensorRef& wanted, const SensorKind& asked) {
    const std::size_t sensor = this->sensor(robot, wanted);
    const SensorSpec& spec = model().type_of(robot).sensors[sensor].spec;
    if (spec.measures() && spec.kind().number != asked.number)
        refuse("sensor " + std::to_string(sensor) + " '" + spec.name + "' of " + called(known(robot)) +
                   " is read as " + asked.phrase,
               std::string("it is ") + spec.kind().phrase);
    const HeldSamples::Key key{robot.value, static_cast<std::uint32_t>(sensor)};
    if (const Sample* held = samples_.find(key)) return *held;
    Sample fresh = measure(robot, sensor);
    const bool holds = spec.update_rate_hz > 0 && spec.kind().is_held();
    return holds ? samples_.put(key, std::move(fresh)) : fresh;
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
        if (!has_its_beams(model().type_of(RobotId(key.first)).sensors[key.second].spec, held.sample))
            return Error{"a saved run holds a sample of a laser that has not one range for each beam",
                         "save the run again"};
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

std::vector<JointReaction> Client::joint_reactions(const RobotRef& robot) {
    return step_probe().joint_reactions(this->robot(robot));
}

}  // namespace roboss
