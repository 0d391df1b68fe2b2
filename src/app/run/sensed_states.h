// SensedStates: the states of a run at a tick, as its sensors ask for them. What several sensors share is
// built when the first one asks, and at the next tick only updated.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"
#include "physics/probe.h"
#include "render/camera_scene.h"
#include "render/visuals_of.h"
#include "sensors/readings.h"

namespace roboss {

class SensedStates final : public SensorSources {
  public:
    /// `threads`: that images are shared out over.
    SensedStates(std::shared_ptr<const Model> model, render::VisualsOf visuals, unsigned threads)
        : model_(std::move(model)), visuals_(std::move(visuals)), threads_(threads) {}

    /// `states`, by RobotId, must live until the next call.
    void update(std::span<const RobotState> states, Tick tick);
    /// What sensor number `sensor` of a robot measures at this tick.
    Result<Sample> read(RobotId robot, std::size_t sensor, std::uint64_t seed);
    /// For a sensor of a robot; kinds of readings that it does not have can be asked for, too.
    SensorQuery query(RobotId robot, std::size_t sensor, std::uint64_t seed);
    const Model& model() const { return *model_; }

    RayScene& ray_scene() override;
    StepProbe& step_probe() override;
    const RobotState& state_of(RobotId robot) override { return *states_[robot.index()]; }
    Result<const CameraScene*> camera_scene() override;
    /// Pictures that cameras do not show, one a line; after the first reading of a camera.
    std::vector<std::string> problems() const;

  private:
    std::shared_ptr<const Model> model_;
    render::VisualsOf visuals_;
    unsigned threads_;
    std::vector<const RobotState*> states_;
    Tick tick_ = 0;
    std::unique_ptr<RayScene> rays_;
    std::unique_ptr<StepProbe> probe_;
    std::unique_ptr<CameraScene> cameras_;
    bool rays_due_ = true, cameras_due_ = true;  // to be updated to this tick
};

}  // namespace roboss
