// See run_services.h. A run returns to its beginning as a whole: time, states and robots. Parts of that are
// made of orders and removals.
#include "model/topics.h"
#include "ros2/run_services.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;

namespace {

using Request = si::ResetSimulation::Request;

constexpr std::uint8_t kAllBits = Request::kTime | Request::kState | Request::kSpawned;

/// Puts a robot where it started, at rest. Its motors and on-board controllers keep what they were told.
Result<> restore(RunControl& run, RobotId robot) {
    const Model& model = run.model();
    const RobotType& type = model.type_of(robot);
    const RobotState start = initial_state(model, robot);
    if (type.is_static) return Ok{};
    const Transform X_WR = robot_pose(type, base_pose(start));
    if (Result<> given = run.order(robot, SetPose{to_pose(X_WR)}); !given) return given;
    if (type.free_base)
        if (Result<> given = run.order(robot, SetVelocity{}); !given) return given;
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        const Joint& joint = type.joints[j];
        if (joint.nv != 1 || joint.loop >= 0) continue;
        const double at = start.q[static_cast<std::size_t>(joint.q_index)];
        if (Result<> given = run.order(robot, SetJointState{JointId(j), {at}, {0.0}}); !given) return given;
    }
    return Ok{};
}

si::Result restore_all(const SimulationContext& c) {
    for (const RobotId robot : c.entities.all())
        if (const Result<> given = restore(c.run, robot); !given)
            return result_of(si::Result::kOperationFailed, given.error().message);
    return fine();
}

}  // namespace

void add_reset_service(const SimulationContext& c, RunMemory& memory, Spawner& spawner) {
    c.table.add<si::ResetSimulation>(
        c.name("reset_simulation"),
        [c, &memory, &spawner](const Request& request, const Reply<si::ResetSimulation>& reply) {
            const auto scope = static_cast<std::uint8_t>(
                request.scope == Request::kDefault ? kAllBits : request.scope & kAllBits);
            const auto spawned = spawner.spawned();
            const bool whole =
                scope == kAllBits || (scope == (Request::kTime | Request::kState) && spawned.empty());
            if (whole)
                return reset_run(c, [reply, &memory](const si::Result& result) {
                    memory.paused_at_start = false;
                    reply({result});
                });
            if ((scope & Request::kTime) != 0 || scope == 0)
                return reply({result_of(si::Result::kFeatureUnsupported,
                                        "the time is reset with states and spawned entities together only")});
            if (scope == Request::kState) return reply({restore_all(c)});
            spawner.remove(spawned, [c, reply, scope](const si::Result& removed) {
                const bool goes_on = removed.result == si::Result::kOk && (scope & Request::kState) != 0;
                reply({goes_on ? restore_all(c) : removed});
            });
        });
}

}  // namespace roboss::ros2
