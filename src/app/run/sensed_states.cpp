// See sensed_states.h.
#include "app/run/sensed_states.h"

#include <utility>

#include "physics/probe.h"

namespace roboss {

void SensedStates::update(std::span<const RobotState> states, Tick tick) {
    states_.clear();
    for (const RobotState& state : states) states_.push_back(&state);
    tick_ = tick;
    probe_.reset();
    rays_due_ = cameras_due_ = true;
}

SensorQuery SensedStates::query(RobotId robot, std::size_t sensor, std::uint64_t seed) {
    return {*model_, robot, sensor, state_of(robot), tick_, seed, *this};
}

Result<Sample> SensedStates::read(RobotId robot, std::size_t sensor, std::uint64_t seed) {
    return measure(query(robot, sensor, seed));
}

RayScene& SensedStates::ray_scene() {
    if (!rays_) rays_ = std::make_unique<RayScene>(model_);
    if (std::exchange(rays_due_, false)) rays_->update(states_);
    return *rays_;
}

StepProbe& SensedStates::step_probe() {
    if (!probe_) probe_ = std::make_unique<StepProbe>(*model_), probe_->step(tick_, states_);
    return *probe_;
}

Result<const CameraScene*> SensedStates::camera_scene() {
    if (!cameras_) {
        auto made = make_camera_scene(visuals_, model_, threads_);
        if (!made) return made.error();
        cameras_ = std::move(made).value();
    }
    if (std::exchange(cameras_due_, false)) cameras_->update(states_);
    return cameras_.get();
}

std::vector<std::string> SensedStates::problems() const {
    return cameras_ ? cameras_->world().problems : std::vector<std::string>();
}

}  // namespace roboss
