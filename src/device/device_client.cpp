// See device_client.h.
#include "device/device_client.h"

#include <stdexcept>

namespace roboss {
namespace {

[[noreturn]] void missing(const std::string& what, const std::string& remedy) {
    throw std::invalid_argument(Error{what, remedy, "no-ability"}.text());
}

constexpr const char* kAskLess =
    "ask for joints, poses and sensors that the device gives (docs/devices.md), or run the program in a "
    "simulation";

}  // namespace

DeviceClient::DeviceClient(std::shared_ptr<const Model> model, std::span<const Device> devices,
                           std::uint64_t seed)
    : model_(std::move(model)), devices_(devices), seed_(seed) {
    const std::size_t robots = model_->robots.size();
    for (std::size_t r = 0; r < robots; ++r) states_.push_back(initial_state(*model_, RobotId(r)));
    posed_.resize(robots), jointed_.resize(robots);
}

const Device* DeviceClient::device_of(RobotId robot) const {
    for (const Device& device : devices_)
        if (device.robot == robot) return &device;
    return nullptr;
}

std::string DeviceClient::called(RobotId robot) const {
    const Device* device = device_of(robot);
    return "robot '" + known(robot).name + "' (" +
           (device == nullptr ? "no device"
                              : std::string(device->adapter->protocol()) + " at " + device->address) +
           ")";
}

const RobotState& DeviceClient::state(RobotId robot) const {
    missing("nobody knows the whole state of " + called(robot), kAskLess);
}

const RobotState& DeviceClient::state_with(StatePart part, RobotId robot) const {
    (void)known(robot);
    const bool is_known = part == StatePart::kJoints ? jointed_[robot.index()] : posed_[robot.index()];
    if (is_known) return states_[robot.index()];
    if (const RobotState* other = others_ ? others_(robot) : nullptr; other != nullptr) return *other;
    if (part == StatePart::kJoints) missing("nobody reports joints of " + called(robot), kAskLess);
    missing(
        "nobody reports the pose of " + called(robot),
        "connect a camera that sees it (--camera), or let the device send its own pose (docs/devices.md)");
}

void DeviceClient::observe(Tick tick) {
    before_ = tick_, tick_ = tick;
    for (const Device& device : devices_) {
        if (device.robot.valid()) take_joints(device);
        for (const auto& [robot, pose] : device.adapter->readings().poses) {
            if (pose.estimated) continue;
            RobotState& state = states_[robot.index()];
            apply_order(*model_, {tick, {}, 0, robot, SetPose{pose.X_WR}}, state);
            const Order moves{tick, {}, 0, robot, SetVelocity{pose.linear, pose.angular}};
            if (check_order(*model_, moves)) apply_order(*model_, moves, state);
            posed_[robot.index()] = true;
        }
    }
    renew_samples();
}

void DeviceClient::take_joints(const Device& device) {
    const std::size_t r = device.robot.index();
    for (const auto& [joint, reading] : device.adapter->readings().joints) {
        const SetJointState set{joint, {reading.position}, {reading.velocity}};
        const Order order{tick_, {}, 0, device.robot, set};
        if (check_order(*model_, order)) apply_order(*model_, order, states_[r]);
        jointed_[r] = true;
    }
}

Result<> DeviceClient::order(RobotId robot, const Action& action) {
    Order order;
    order.apply_at = tick_;
    order.robot = robot;
    order.action = action;
    if (Result<> checked = check_order(*model_, order); !checked) return report_refusal(checked.error());
    const Device* device = device_of(robot);
    if (device == nullptr)
        return report_refusal({"an order for " + called(robot),
                               "connect its device too (--robot, --connect), or ignore the refusal",
                               "no-device"});
    Result<> done = device->adapter->order(action);
    if (done) return done;
    const Error& why = done.error();
    return report_refusal({called(robot) + ": " + why.message, why.remedy, why.code});
}

void DeviceClient::control(ControlAction request) {
    const Error none{"there is no run to control: the robots are real", "ask it of a simulation", "no-run"};
    answers_.push_back({std::move(request), ControlRefused(none)});
}

std::vector<RadioMessage> DeviceClient::received(const RobotRef& robot, const SensorRef&) {
    missing(called(this->robot(robot)) + " has no radio that RoBOSS knows", kAskLess);
}

Sample DeviceClient::measure(RobotId robot, std::size_t sensor) {
    const SensorSpec& spec = model_->type_of(robot).sensors[sensor].spec;
    const Device* device = device_of(robot);
    if (device != nullptr) {
        const auto& sensors = device->adapter->readings().sensors;
        if (const auto found = sensors.find(sensor); found != sensors.end()) {
            Sample sample = found->second;
            std::visit([this](auto& reading) { reading.tick = tick_; }, sample);
            return sample;
        }
    }
    missing(called(robot) + " gives no readings of sensor '" + spec.name + "'", kAskLess);
}

RayScene& DeviceClient::ray_scene() {
    missing("no rays can be cast: the robots are real", kAskLess);
}

StepProbe& DeviceClient::step_probe() {
    missing("nobody measures contacts and joint reactions of real robots", kAskLess);
}

Result<const CameraScene*> DeviceClient::camera_scene() {
    return Error{"nothing can be rendered: the robots are real", kAskLess, "no-ability"};
}

Error DeviceClient::report_refusal(Error error) {
    refusals_.add_order(error);
    return error;
}

}  // namespace roboss
