// SensorQuery: everything that a reading is computed from.
#pragma once

#include <cstdint>

#include "core/result.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

class CameraScene;
class RayScene;
class StepProbe;

/// What several sensors share at a tick, built when the first of them asks. Clients and the viewer's gateway
/// implement it.
class SensorSources {
  public:
    virtual ~SensorSources() = default;
    /// The shapes of all robots at the tick of the query.
    virtual RayScene& ray_scene() = 0;
    /// The states of all robots at the tick of the query, and one tick later if no order takes effect at it.
    virtual StepProbe& step_probe() = 0;
    /// The state of any robot at the tick of the query.
    virtual const RobotState& state_of(RobotId robot) = 0;
    /// The visuals of all robots at the tick of the query. An Error, "no-look": the caller has only the
    /// Model, which says nothing of visuals.
    virtual Result<const CameraScene*> camera_scene();
};

/// Sensor number `sensor` (of RobotType::sensors) of a robot in `state` at `tick`, in a run with this seed.
struct SensorQuery {
    const Model& model;
    RobotId robot;
    std::size_t sensor = 0;
    const RobotState& state;
    Tick tick = 0;
    std::uint64_t seed = 0;
    SensorSources& sources;
    Tick since = -1;  ///< of a radio: messages that arrived after this tick; -1: all that are kept

    const RobotType& type() const { return model.type_of(robot); }
    const SensorInfo& info() const { return type().sensors[sensor]; }
};

/// The sensor's frame in the world.
Transform sensor_pose(const SensorQuery& query);

}  // namespace roboss
