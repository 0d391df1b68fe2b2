// Exact states to the JSON of a page.
#include "gateway/inspector.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>

#include "gateway/numbers_json.h"
#include "gateway/onboard_json.h"
#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "wire/state_block.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json json_of(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json json_of(bool value) {
    return value;
}

Json json_of(const Vec3& v) {
    return {json_of(v.x), json_of(v.y), json_of(v.z)};
}

Json json_of(const Pose& X) {
    return {json_of(X.p.x), json_of(X.p.y), json_of(X.p.z), json_of(X.q.w),
            json_of(X.q.x), json_of(X.q.y), json_of(X.q.z)};
}

Json json_of(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(json_of(value));
    return list;
}

Json json_of(const std::vector<std::string>& texts) {
    return texts;
}

/// Its size alone.
template <class T>
Json json_of(const Image<T>& image) {
    return {{"columns", image.columns}, {"rows", image.rows}};
}

const char* name_of(MotorMode mode) {
    static constexpr const char* kNames[] = {"passive", "velocity", "position", "effort"};
    return kNames[static_cast<std::size_t>(mode) % 4];
}

Json joint_json(const Model& model, const RobotType& type, const RobotState& state, JointId id) {
    const Joint& joint = type.joints[id.index()];
    Json position = Json::array(), velocity = Json::array(), motors = Json::array();
    for (int axis = 0; axis < joint.nv; ++axis) {
        const JointState s = joint_state(type, state, id, axis);
        position.push_back(json_of(s.position));
        velocity.push_back(json_of(s.velocity));
        const MotorSetpoint& motor = state.motors[type.motor_index(joint, axis)];
        motors.push_back({{"mode", name_of(motor.mode)},
                          {"target", json_of(motor.target)},
                          {"effort", json_of(motor_effort(model, type, state, id, axis))},
                          {"max_effort", json_of(motor.max_effort)}});
    }
    return {
        {"position", std::move(position)}, {"velocity", std::move(velocity)}, {"motors", std::move(motors)}};
}

Json json_of(const Quat& q) {
    return {json_of(q.w), json_of(q.x), json_of(q.y), json_of(q.z)};
}

/// A reading as its kind names its values (src/sensor_kinds). The overloads below add what pages draw.
template <class Reading>
Json json_of(const Reading& reading) {
    Json json = Json::object();
    reading.fields([&](const ReadingField& field, const auto& value) { json[field.name] = json_of(value); },
                   reading);
    return json;
}

Json json_of(const LaserReading& reading) {
    return {{"ranges", json_of(reading.ranges)}};
}

Json json_of(const GpsReading& reading) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    if (!reading.geodetic)
        return {{"position", json_of(reading.p_W)},
                {"world", json_of(reading.p_W)},
                {"geodetic", false},
                {"velocity", json_of(reading.v_W)}};
    return {{"world", json_of(reading.p_W)},
            {"position",
             {json_of(reading.latitude_rad * kDegrees), json_of(reading.longitude_rad * kDegrees),
              json_of(reading.altitude_m)}},
            {"geodetic", true},
            {"velocity", json_of(reading.v_W)}};
}

Json json_of(const CompassReading& reading) {
    const Quat& q = reading.q_WS;
    const double yaw = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
    Json json{{"yaw", json_of(yaw)}};
    json.update(json_of<CompassReading>(reading));
    return json;
}

/// nullptr: it measures nothing.
Json json_of(const Sample* sample, double dt_s) {
    if (sample == nullptr) return Json::object();
    Json json = std::visit([](const auto& reading) { return json_of(reading); }, *sample);
    json["taken"] = static_cast<double>(taken_at(*sample)) * dt_s;
    return json;
}

/// From what states remember: against whom, and how hard along the normal. The lower RobotId of a pair
/// remembers it, so of a lower robot only what is known is reported.
Json contacts_json(RobotId robot, std::span<const std::optional<RobotState>> states, double dt_s) {
    Json list = Json::array();
    const auto add = [&](std::int64_t other, const ContactMemory& contact) {
        list.push_back({{"other", other}, {"normal_force", json_of(contact.impulse / dt_s)}});
    };
    for (std::uint32_t lower = 0; lower < robot.value; ++lower)
        if (states[lower])
            for (const ContactMemory& contact : states[lower]->contacts)
                if (contact.other_robot == robot.value) add(lower, contact);
    for (const ContactMemory& contact : states[robot.index()]->contacts)
        add(contact.other_robot == RobotId::kNone ? -1 : static_cast<std::int64_t>(contact.other_robot),
            contact);
    return list;
}

}  // namespace

void Inspector::begin(std::shared_ptr<const ShownScene> scene) {
    rays_.reset();
    probe_.reset();
    samples_.all().clear();
    radio_ = {};
    scene_ = std::move(scene);
    tick_ = rays_tick_ = -1;
    states_.assign(scene_->model->robots.size(), std::nullopt);
    known_ = 0;
}

void Inspector::take(const StateBlock& block) {
    if (!scene_) return;
    if (block.tick != tick_) {
        std::fill(states_.begin(), states_.end(), std::nullopt);
        known_ = 0;
        tick_ = block.tick;
        rays_tick_ = -1;
    }
    std::size_t offset = 0;
    for (std::size_t i = 0; i < block.robots.size(); ++i) {
        const RobotId robot = block.robots[i];
        if (robot.index() < states_.size() && !states_[robot.index()]) {
            Result<RobotState> state =
                decode_state(state_bytes(block, i, offset), scene_->model->type_of(robot), states_.size());
            if (state) states_[robot.index()] = std::move(state).value(), ++known_;
        }
        offset += block.sizes[i];
    }
}

bool Inspector::shows(RobotId robot) const {
    if (robot.index() >= states_.size() || !states_[robot.index()]) return false;
    return complete() || !needs_everybody(*scene_->model, robot);
}

std::vector<RobotState> Inspector::all_states() const {
    ROBOSS_CHECK(complete(), "states of some robots are not here");
    std::vector<RobotState> states;
    states.reserve(states_.size());
    for (const auto& state : states_) states.push_back(*state);
    return states;
}

/// Asked for by sensors of robots that it shows().
RayScene& Inspector::ray_scene() {
    ROBOSS_CHECK(complete(), "a sensor looks at robots whose states are not here");
    if (!rays_) rays_ = std::make_unique<RayScene>(scene_->model);
    if (rays_tick_ != tick_) {
        std::vector<const RobotState*> states;
        for (const auto& state : states_) states.push_back(&*state);
        rays_->update(states);
        rays_tick_ = tick_;
    }
    return *rays_;
}

StepProbe& Inspector::step_probe() {
    ROBOSS_CHECK(complete(), "a step needs robots whose states are not here");
    if (!probe_) probe_ = std::make_unique<StepProbe>(*scene_->model);
    if (probe_->tick() != tick_) {
        std::vector<const RobotState*> states;
        for (const auto& state : states_) states.push_back(&*state);
        probe_->step(tick_, states);
    }
    return *probe_;
}

const RobotState& Inspector::state_of(RobotId robot) {
    ROBOSS_CHECK(states_[robot.index()].has_value(), "a sensor looks at a robot whose state is not here");
    return *states_[robot.index()];
}

/// Also after a rewind to before its last sample.
bool Inspector::is_due(RobotId robot, std::size_t sensor) const {
    const Sample* held = samples_.find({robot.value, static_cast<std::uint32_t>(sensor)});
    if (held == nullptr || taken_at(*held) > tick_) return true;
    const Model& model = *scene_->model;
    const double rate = model.type_of(robot).sensors[sensor].spec.update_rate_hz;
    return rate <= 0 || sample_is_due(rate, model.dt_s, taken_at(*held), tick_);
}

const Sample* Inspector::sample(RobotId robot, std::size_t sensor) {
    const HeldSamples::Key key(robot.value, static_cast<std::uint32_t>(sensor));
    if (scene_->model->type_of(robot).sensors[sensor].spec.kind().is_image)
        return nullptr;  // PictureRenderer
    if (is_due(robot, sensor)) {
        Result<Sample> measured = measure(
            {*scene_->model, robot, sensor, *states_[robot.index()], tick_, scene_->file.seed, *this});
        if (!measured) return nullptr;
        samples_.put(key, std::move(measured).value());
    }
    return samples_.find(key);
}

std::string Inspector::robot(RobotId robot) {
    const Model& model = *scene_->model;
    const RobotType& type = model.type_of(robot);
    const RobotState& state = *states_[robot.index()];
    Json joints = Json::array(), sensors = Json::array();
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        joints.push_back(joint_json(model, type, state, JointId(j)));
    for (std::size_t s = 0; s < type.sensors.size(); ++s)
        sensors.push_back(json_of(sample(robot, s), model.dt_s));
    const auto v = [&](std::size_t k) { return type.free_base ? state.v[k] : 0.0; };
    const Pose X_WR = to_pose(to_transform(base_pose(state)) * inverse(type.X_RB));
    Json report{{"type", "robot"},
                {"scene", scene_->number},
                {"robot", robot.value},
                {"tick", tick_},
                {"time", static_cast<double>(tick_) * model.dt_s},
                {"pose", json_of(X_WR)},
                {"linear", json_of(Vec3{v(3), v(4), v(5)})},
                {"angular", json_of(Vec3{v(0), v(1), v(2)})},
                {"joints", std::move(joints)},
                {"sensors", std::move(sensors)},
                {"contacts", contacts_json(robot, states_, model.dt_s)},
                {"all_contacts", complete()}};
    add_onboard(model, robot, states_, report);
    add_own(state.own, report);
    return report.dump();
}

std::string Inspector::numbers(const NumbersWish& wish) {
    const RobotType& type = scene_->model->type_of(wish.robot);
    if (!has_numbers(type, wish)) return {};
    Json report{{"type", "numbers"}, {"scene", scene_->number}, {"robot", wish.robot.value}, {"tick", tick_}};
    add_numbers(type, *states_[wish.robot.index()], wish, report);
    return report.dump();
}

std::string Inspector::contacts() {
    const Model& model = *scene_->model;
    Json list = Json::array();
    for (const ContactReport& c : step_probe().contacts()) {
        const Vec3 force = (c.normal * c.impulse + c.friction) * (1 / model.dt_s);
        list.push_back({{"a", c.robot_a.value},
                        {"b", c.robot_b.valid() ? static_cast<std::int64_t>(c.robot_b.value) : -1},
                        {"point", json_of(c.p_W)},
                        {"normal", json_of(c.normal)},
                        {"force", json_of(force)}});
    }
    return Json{
        {"type", "overlay"}, {"scene", scene_->number}, {"tick", tick_}, {"contacts", std::move(list)}}
        .dump();
}

std::string Inspector::radio() {
    const Model& model = *scene_->model;
    const RadioLinks::Look look = radio_.look(model, *this, tick_, scene_->file.seed);
    Json links = Json::array(), senders = Json::array();
    for (const RadioLink& link : look.links)
        links.push_back({{"from", link.from.value},
                         {"antenna", link.antenna},
                         {"to", link.to.value},
                         {"sensor", link.sensor},
                         {"messages", link.messages},
                         {"strength", json_of(link.strength_dBm)},
                         {"margin", json_of(link.margin_dB)},
                         {"time", static_cast<double>(link.arrived) * model.dt_s}});
    for (const RadioSender& sender : look.senders)
        senders.push_back(
            {{"robot", sender.robot.value}, {"sensor", sender.sensor}, {"messages", sender.messages}});
    return Json{
        {"type", "overlay"},
        {"scene", scene_->number},
        {"tick", tick_},
        {"radio", {{"links", std::move(links)}, {"senders", std::move(senders)}, {"all", look.is_complete}}}}
        .dump();
}

}  // namespace roboss
