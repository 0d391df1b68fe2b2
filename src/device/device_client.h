// DeviceClient: the Client whose robots are real. A control program, the same binary as in a simulation,
// reads what the devices measured and drives their motors. What no device can do or knows, throws or is
// refused, with words.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/refusals.h"
#include "device/adapter.h"

namespace roboss {

/// A device, and where it is.
struct Device {
    std::unique_ptr<DeviceAdapter> adapter;
    std::string address;  ///< as on the command line, for messages
    RobotId robot;        ///< that it is; not valid: a camera
};

class DeviceClient final : public Client {
  public:
    /// Devices stay with the caller, and outlive it.
    DeviceClient(std::shared_ptr<const Model> model, std::span<const Device> devices, std::uint64_t seed);

    const Model& model() const override { return *model_; }
    Tick tick() const override { return tick_; }
    /// Throws: no device knows all of a state.
    const RobotState& state(RobotId robot) const override;
    std::uint64_t seed() const override { return seed_; }
    Result<> order(RobotId robot, const Action& action) override;
    void control(ControlAction request) override;
    std::vector<ControlAnswer> take_control_answers() override { return std::exchange(answers_, {}); }
    std::vector<RadioMessage> received(const RobotRef& robot, const SensorRef& radio) override;

    /// Robots that no device knows are where this says; null: it does not know either.
    using Others = std::function<const RobotState*(RobotId)>;
    void set_others(Others others) { others_ = std::move(others); }
    /// Shows what the devices said last, as the observation at `tick`.
    void observe(Tick tick);
    /// Texts of refused orders since the last call, each kind once.
    std::vector<std::string> take_refusals() { return refusals_.take(); }

  private:
    const RobotState& state_with(StatePart part, RobotId robot) const override;
    Sample measure(RobotId robot, std::size_t sensor) override;
    RayScene& ray_scene() override;
    StepProbe& step_probe() override;
    Result<const CameraScene*> camera_scene() override;
    Tick observed_before() const override { return before_; }
    Error report_refusal(Error error) override;
    const Device* device_of(RobotId robot) const;
    /// "robot 'k' (the khepera at serial:/dev/ttyUSB0)".
    std::string called(RobotId robot) const;
    void take_joints(const Device& device);

    std::shared_ptr<const Model> model_;
    std::span<const Device> devices_;
    std::uint64_t seed_;
    Tick tick_ = 0, before_ = 0;
    std::vector<RobotState> states_;
    std::vector<bool> posed_, jointed_;  // by RobotId: what is known of states_
    Others others_;
    std::vector<ControlAnswer> answers_;
    Refusals refusals_;
};

}  // namespace roboss
