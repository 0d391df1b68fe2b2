// See simulation_services.h.
#include "ros2/simulation_services.h"

#include <iterator>
#include <optional>

#include "ros2/action_server.h"
#include "ros2/entity_services.h"
#include "ros2/run_services.h"
#include "ros2/stamps.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;

namespace {

/// The action SimulateSteps: one goal at a time, since the run steps for one at a time.
class StepsAction {
  public:
    StepsAction(Transport& transport, EntityId node, const SimulationContext& c)
        : context_(c),
          server_(
              transport, node, c.name("simulate_steps"),
              {[this](const GoalId& goal, const si::SimulateSteps::Goal& wanted) {
                   return begin(goal, wanted.steps);
               },
               [this](const GoalId&) { cancel(); },
               [this] { return stamp_of(context_.run.model(), std::max<Tick>(context_.run.tick(), 0)); }}) {}

    bool take(const Incoming& call) { return server_.take(call); }
    void advance(std::int64_t now_ms) { server_.advance(now_ms); }
    std::vector<std::string> take_notices() { return server_.take_notices(); }

  private:
    bool begin(const GoalId& goal, std::uint64_t steps) {
        if (goal_) return false;
        goal_ = goal, cancelled_ = false;
        step_run(
            context_, steps,
            [this, goal, steps](std::uint64_t done) {
                server_.feedback(goal, {done, steps - done});
            },
            [this, goal](const si::Result& result) {
                goal_.reset();
                const bool succeeds = result.result == si::Result::kOk;
                server_.end(goal,
                            succeeds     ? GoalStatus::kSucceeded
                            : cancelled_ ? GoalStatus::kCanceled
                                         : GoalStatus::kAborted,
                            {result});
            },
            [this] { return cancelled_; });
        return true;
    }
    /// The run is paused where it is, and step_run() finds it there. Before the first step it is paused
    /// already: step_run() asks for that.
    void cancel() {
        cancelled_ = true;
        context_.waits.ask(PauseRun{}, [](const ControlOutcome&) {});
    }

    const SimulationContext& context_;
    std::optional<GoalId> goal_;
    bool cancelled_ = false;
    ActionServer<si::SimulateSteps> server_;
};

}  // namespace

/// In the order in which they need each other.
struct SimulationServices::Parts {
    Parts(Transport& transport, EntityId node, RunControl& run, SimulationOptions wanted)
        : options(std::move(wanted)),
          folders(options.model_folders),
          waits(run),
          entities(run),
          spawner(run, waits, entities, folders),
          table(transport, node),
          context{run, waits, entities, table, options},
          steps(transport, node, context) {
        add_entity_services(context);
        add_spawn_services(context, spawner, folders);
        add_run_services(context, memory);
        add_reset_service(context, memory, spawner);
        add_world_services(context, memory);
    }

    SimulationOptions options;
    ModelFolders folders;
    RunWaits waits;
    Entities entities;
    Spawner spawner;
    RunMemory memory;
    ServiceTable table;
    SimulationContext context;
    StepsAction steps;
};

SimulationServices::SimulationServices(Transport& transport, EntityId node, RunControl& run,
                                       SimulationOptions options)
    : parts_(std::make_unique<Parts>(transport, node, run, std::move(options))) {}

SimulationServices::~SimulationServices() = default;

bool SimulationServices::take(const Incoming& call) {
    return parts_->table.take(call) || parts_->steps.take(call);
}

void SimulationServices::advance(std::int64_t now_ms) {
    parts_->waits.advance(now_ms);
    parts_->steps.advance(now_ms);
}

std::vector<std::string> SimulationServices::take_notices() {
    std::vector<std::string> notices = parts_->table.take_notices();
    std::ranges::move(parts_->steps.take_notices(), std::back_inserter(notices));
    return notices;
}

Spawner& SimulationServices::spawner() {
    return parts_->spawner;
}

const SimulationContext& SimulationServices::context() const {
    return parts_->context;
}

}  // namespace roboss::ros2
