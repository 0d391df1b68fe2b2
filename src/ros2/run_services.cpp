// See run_services.h.
#include "ros2/run_services.h"

#include <algorithm>
#include <utility>

namespace roboss::ros2 {

namespace si = simulation_interfaces;

using State = si::SimulationState;
using SetState = si::SetSimulationState;

namespace {

constexpr std::int64_t kLookEvery_ms = 5;  // while the run steps
constexpr std::int64_t kSeen_ms = 500;     // until a new state is seen, at most
constexpr std::uint64_t kMostTicks = std::uint64_t{1} << 50;

/// A run that steps, from call to call of GetStatus.
struct Stepping {
    Tick begin = 0;
    std::uint64_t ticks = 0, done = 0;
    std::function<void(std::uint64_t)> progress;
    std::function<void(const si::Result&)> then;
};

void watch(const SimulationContext& c, const std::shared_ptr<Stepping>& s) {
    c.waits.ask_status([c, s](const RunStatus* status) {
        if (status == nullptr)
            return s->then(result_of(si::Result::kOperationFailed, "the run did not answer"));
        if (status->tick < s->begin)
            return s->then(result_of(si::Result::kOperationFailed, "the run went back in time meanwhile"));
        const auto done = std::min(static_cast<std::uint64_t>(status->tick - s->begin), s->ticks);
        if (done != s->done) s->progress(done);
        s->done = done;
        if (status->paused && done == s->ticks) {
            // Until the services see that tick, too; the run may show it to them later, or not at all.
            const Tick end = s->begin + static_cast<Tick>(s->ticks);
            return c.waits.until([c, end] { return c.run.tick() >= end; }, [s](bool) { s->then(fine()); },
                                 kSeen_ms);
        }
        if (status->paused)
            return s->then(result_of(si::Result::kOperationFailed,
                                     "the run was paused after " + std::to_string(done) + " steps"));
        c.waits.after(kLookEvery_ms, [c, s] { watch(c, s); });
    });
}

std::vector<std::uint16_t> features_of(const SimulationContext& c) {
    using F = si::SimulatorFeatures;
    std::vector<std::uint16_t> features{F::kSpawning,
                                        F::kDeleting,
                                        F::kEntityTags,
                                        F::kEntityBounds,
                                        F::kEntityBoundsBox,
                                        F::kEntityCategories,
                                        F::kSpawningResourceString,
                                        F::kEntityStateGetting,
                                        F::kEntityStateSetting,
                                        F::kEntityInfoGetting,
                                        F::kEntityInfoSetting,
                                        F::kSpawnables,
                                        F::kSimulationReset,
                                        F::kSimulationResetState,
                                        F::kSimulationResetSpawned,
                                        F::kSimulationStateGetting,
                                        F::kSimulationStateSetting,
                                        F::kSimulationStatePause,
                                        F::kStepSimulationSingle,
                                        F::kStepSimulationMultiple,
                                        F::kStepSimulationAction,
                                        F::kWorldInfoGetting,
                                        F::kAvailableWorlds,
                                        F::kSpawningEntities};
    if (!c.options.places.empty()) {
        features.push_back(F::kNamedPoses);
        features.push_back(F::kPoseBounds);
    }
    return features;
}

/// Sends a request whose success is all that counts.
void ask_plainly(const SimulationContext& c, ControlAction action, const Reply<SetState>& reply) {
    c.waits.ask(std::move(action), [reply](const ControlOutcome& outcome) {
        if (is_done(outcome)) return reply({fine()});
        reply({result_of(SetState::Response::kStateTransitionError, failure_of(outcome).error_message)});
    });
}

void set_state(const SimulationContext& c, RunMemory& memory, std::uint8_t wanted, std::uint8_t now,
               const Reply<SetState>& reply) {
    if (wanted == now)
        return reply({result_of(SetState::Response::kAlreadyInTargetState, "it is in this state already")});
    switch (wanted) {
        case State::kStopped:
            return stop_run(c, memory, [reply](const si::Result& result) {
                const bool fails = result.result != si::Result::kOk;
                reply({fails ? result_of(SetState::Response::kStateTransitionError, result.error_message)
                             : result});
            });
        case State::kPlaying:
            memory.paused_at_start = false;
            return ask_plainly(c, ResumeRun{}, reply);
        case State::kPaused:
            memory.paused_at_start = now == State::kStopped;
            if (now == State::kStopped) return reply({fine()});
            return ask_plainly(c, PauseRun{}, reply);
        case State::kQuitting:
            return ask_plainly(c, QuitRun{}, reply);
        default:
            reply({result_of(SetState::Response::kIncorrectTransition,
                             "a run always has its world: it can be stopped, played, paused and ended")});
    }
}

void add_state_services(const SimulationContext& c, RunMemory& memory) {
    c.table.add<si::GetSimulationState>(
        c.name("get_simulation_state"),
        [c, &memory](const auto&, const Reply<si::GetSimulationState>& reply) {
            c.waits.ask_status([&memory, reply](const RunStatus* status) {
                si::GetSimulationState::Response response;
                response.result = status != nullptr
                                      ? fine()
                                      : result_of(si::Result::kOperationFailed, "the run did not answer");
                if (status != nullptr) response.state.state = simulation_state(*status, memory);
                reply(response);
            });
        });
    c.table.add<SetState>(c.name("set_simulation_state"), [c, &memory](const SetState::Request& request,
                                                                       const Reply<SetState>& reply) {
        c.waits.ask_status([c, &memory, reply, wanted = request.state.state](const RunStatus* status) {
            if (status == nullptr)
                return reply({result_of(si::Result::kOperationFailed, "the run did not answer")});
            set_state(c, memory, wanted, simulation_state(*status, memory), reply);
        });
    });
}

}  // namespace

std::uint8_t simulation_state(const RunStatus& status, const RunMemory& memory) {
    if (!status.paused) return State::kPlaying;
    return status.tick == 0 && !memory.paused_at_start ? State::kStopped : State::kPaused;
}

si::Result failure_of(const ControlOutcome& outcome) {
    const auto* refused = std::get_if<ControlRefused>(&outcome);
    return result_of(si::Result::kOperationFailed,
                     refused != nullptr ? refused->error().text() : "the run gave another answer");
}

void step_run(const SimulationContext& c, std::uint64_t ticks,
              const std::function<void(std::uint64_t)>& progress,
              const std::function<void(const si::Result&)>& then, const std::function<bool()>& is_cancelled) {
    if (ticks > kMostTicks) return then(result_of(si::Result::kOperationFailed, "too many steps"));
    c.waits.ask_status([c, ticks, progress, then, is_cancelled](const RunStatus* status) {
        if (status == nullptr) return then(result_of(si::Result::kOperationFailed, "the run did not answer"));
        if (!status->paused) return then(result_of(si::Result::kOperationFailed, "the run is not paused"));
        if (is_cancelled())
            return then(result_of(si::Result::kOperationFailed, "cancelled before the first step"));
        if (ticks == 0) return then(fine());
        const auto stepping = std::make_shared<Stepping>(Stepping{status->tick, ticks, 0, progress, then});
        c.waits.ask(StepRun{static_cast<Tick>(ticks)}, [c, stepping](const ControlOutcome& outcome) {
            if (!is_done(outcome)) return stepping->then(failure_of(outcome));
            watch(c, stepping);
        });
    });
}

void reset_run(const SimulationContext& c, const std::function<void(const si::Result&)>& then) {
    const auto is_seen = [&run = c.run, before = c.run.era()] {
        return run.era() != before && run.tick() >= 0;
    };
    c.waits.ask(
        ResetRun{},
        [c, is_seen, then](const ControlOutcome& outcome) {
            const auto* refused = std::get_if<ControlRefused>(&outcome);
            const bool has_gone_back = refused != nullptr && refused->code == "changed-world";
            if (!is_done(outcome) && !has_gone_back) return then(failure_of(outcome));
            c.waits.until(is_seen, [then](bool seen) {
                then(seen ? fine()
                          : result_of(si::Result::kOperationFailed,
                                      "the beginning of the run was not seen in time"));
            });
        },
        RunWaits::kLong_ms);
}

void stop_run(const SimulationContext& c, RunMemory& memory,
              const std::function<void(const si::Result&)>& then) {
    c.waits.ask(PauseRun{}, [c, &memory, then](const ControlOutcome& paused) {
        if (!is_done(paused)) return then(failure_of(paused));
        reset_run(c, [&memory, then](const si::Result& result) {
            memory.paused_at_start = false;
            then(result);
        });
    });
}

void add_run_services(const SimulationContext& c, RunMemory& memory) {
    c.table.add<si::GetSimulatorFeatures>(
        c.name("get_simulator_features"), [c](const auto&, const Reply<si::GetSimulatorFeatures>& reply) {
            reply({{features_of(c),
                    {"sdf", "urdf", "mjcf"},
                    "RoBOSS, simulation_interfaces " + std::string(c.options.version == 1 ? "1.6" : "2.1")}});
        });
    add_state_services(c, memory);
    c.table.add<si::StepSimulation>(c.name("step_simulation"), [c](const si::StepSimulation::Request& request,
                                                                   const Reply<si::StepSimulation>& reply) {
        step_run(
            c, request.steps, [](std::uint64_t) {}, [reply](const si::Result& result) { reply({result}); });
    });
}

}  // namespace roboss::ros2
