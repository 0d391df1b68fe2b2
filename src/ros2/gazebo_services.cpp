// See gazebo_services.h.
#include "ros2/gazebo_services.h"

#include <cmath>

#include "ros2/entity_services.h"
#include "ros2/run_services.h"
#include "ros2_types/messages/gazebo_services.h"

namespace roboss::ros2 {

namespace gz = ros_gz_interfaces;
namespace si = simulation_interfaces;

namespace {

using Then = std::function<void(bool)>;

/// Asks for the first of these requests, then for the others, as long as they succeed.
void ask_all(const SimulationContext& c, std::vector<ControlAction> requests, const Then& then) {
    if (requests.empty()) return then(true);
    const ControlAction first = requests.front();
    requests.erase(requests.begin());
    const auto go_on = [c, requests = std::move(requests), then](bool done) {
        if (!done) return then(false);
        ask_all(c, requests, then);
    };
    if (std::holds_alternative<ResetRun>(first))
        return reset_run(c, [go_on](const si::Result& result) { go_on(result.result == si::Result::kOk); });
    c.waits.ask(
        first, [go_on](const ControlOutcome& outcome) { go_on(is_done(outcome)); }, RunWaits::kLong_ms);
}

/// The requests to the run that a request to the world stands for, in Gazebo's order: reset, then steps or
/// pause. A run that is not to play then is paused first, so that it is at its beginning after a reset.
/// Empty: parts of it cannot be done.
std::vector<ControlAction> requests_of(const gz::WorldControl& control, const SimulationContext& c) {
    std::vector<ControlAction> requests;
    const gz::WorldReset& reset = control.reset;
    if (control.seed != 0 || reset.time_only || reset.model_only) return {};
    const double until_s = control.run_to_sim_time.sec + 1e-9 * control.run_to_sim_time.nanosec;
    const Tick now = reset.all ? 0 : c.run.tick();
    const Tick ahead = static_cast<Tick>(std::llround(until_s / c.run.model().dt_s)) - now;
    const std::uint32_t steps = control.multi_step > 0 ? control.multi_step : control.step ? 1 : 0;
    const bool plays = steps == 0 && ahead <= 0 && !control.pause;
    if (!plays && reset.all) requests.push_back(PauseRun{});
    if (reset.all) requests.push_back(ResetRun{});
    if (steps > 0)
        requests.push_back(StepRun{static_cast<Tick>(steps)});
    else if (ahead > 0)
        requests.push_back(StepRun{ahead});
    else if (plays)
        requests.push_back(ResumeRun{});
    else
        requests.push_back(PauseRun{});
    return requests;
}

}  // namespace

GazeboServices::GazeboServices(Transport& transport, EntityId node, const std::string& world,
                               SimulationServices& services)
    : services_(services), table_(transport, node) {
    add_entity_services("/world/" + world);
    add_control_service("/world/" + world);
}

void GazeboServices::add_entity_services(const std::string& world) {
    table_.add<gz::SpawnEntity>(world + "/create", [this](const gz::SpawnEntity::Request& request,
                                                          const Reply<gz::SpawnEntity>& reply) {
        const gz::EntityFactory& wanted = request.entity_factory;
        if (!wanted.clone_name.empty() || (wanted.sdf.empty() && wanted.sdf_filename.empty())) {
            table_.notice("create: only descriptions and their files can be spawned");
            return reply({false});
        }
        const Spawn spawn{
            wanted.name, wanted.allow_renaming, "",         wanted.sdf.empty() ? wanted.sdf_filename : "",
            wanted.sdf,  wanted.relative_to,    wanted.pose};
        services_.spawner().spawn(spawn, [this, reply](const si::Result& result, const std::string&) {
            if (result.result != si::Result::kOk) table_.notice("create: " + result.error_message);
            reply({result.result == si::Result::kOk});
        });
    });
    table_.add<gz::DeleteEntity>(world + "/remove", [this](const gz::DeleteEntity::Request& request,
                                                           const Reply<gz::DeleteEntity>& reply) {
        if (!services_.context().entities.find(request.entity.name)) return reply({false});
        services_.spawner().remove({request.entity.name}, [reply](const si::Result& result) {
            reply({result.result == si::Result::kOk});
        });
    });
    table_.add<gz::SetEntityPose>(world + "/set_pose", [this](const gz::SetEntityPose::Request& request,
                                                              const Reply<gz::SetEntityPose>& reply) {
        si::EntityState state;
        state.pose = request.pose;
        const si::Result result =
            set_entity_state(services_.context(), {request.entity.name, state, true, false, false});
        reply({result.result == si::Result::kOk});
    });
}

void GazeboServices::add_control_service(const std::string& world) {
    table_.add<gz::ControlWorld>(world + "/control", [this](const gz::ControlWorld::Request& request,
                                                            const Reply<gz::ControlWorld>& reply) {
        std::vector<ControlAction> requests = requests_of(request.world_control, services_.context());
        if (requests.empty()) {
            table_.notice("control: seeds and resets of a part cannot be set");
            return reply({false});
        }
        ask_all(services_.context(), std::move(requests), [reply](bool done) { reply({done}); });
    });
}

}  // namespace roboss::ros2
