// Services of simulation_interfaces 2.1 that act on the run, and its action.
#pragma once

#include "ros2_types/messages/simulation_messages.h"

namespace roboss::ros2::simulation_interfaces {

/// simulation_interfaces/msg/SimulationState
struct SimulationState {
    static constexpr const char* kName = "simulation_interfaces/msg/SimulationState";
    static constexpr std::uint8_t kStopped = 0;
    static constexpr std::uint8_t kPlaying = 1;
    static constexpr std::uint8_t kPaused = 2;
    static constexpr std::uint8_t kQuitting = 3;
    static constexpr std::uint8_t kNoWorld = 4;
    static constexpr std::uint8_t kLoadingWorld = 5;
    std::uint8_t state = 0;  ///< one of the constants

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("STATE_STOPPED", kStopped);
        visit("STATE_PLAYING", kPlaying);
        visit("STATE_PAUSED", kPaused);
        visit("STATE_QUITTING", kQuitting);
        visit("STATE_NO_WORLD", kNoWorld);
        visit("STATE_LOADING_WORLD", kLoadingWorld);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("state", m.state);
    }
};

/// simulation_interfaces/msg/SimulatorFeatures
struct SimulatorFeatures {
    static constexpr const char* kName = "simulation_interfaces/msg/SimulatorFeatures";
    static constexpr std::uint8_t kSpawning = 0;
    static constexpr std::uint8_t kDeleting = 1;
    static constexpr std::uint8_t kNamedPoses = 2;
    static constexpr std::uint8_t kPoseBounds = 3;
    static constexpr std::uint8_t kEntityTags = 4;
    static constexpr std::uint8_t kEntityBounds = 5;
    static constexpr std::uint8_t kEntityBoundsBox = 6;
    static constexpr std::uint8_t kEntityBoundsConvex = 7;
    static constexpr std::uint8_t kEntityCategories = 8;
    static constexpr std::uint8_t kSpawningResourceString = 9;
    static constexpr std::uint8_t kEntityStateGetting = 10;
    static constexpr std::uint8_t kEntityStateSetting = 11;
    static constexpr std::uint8_t kEntityInfoGetting = 12;
    static constexpr std::uint8_t kEntityInfoSetting = 13;
    static constexpr std::uint8_t kSpawnables = 14;
    static constexpr std::uint8_t kSimulationReset = 20;
    static constexpr std::uint8_t kSimulationResetTime = 21;
    static constexpr std::uint8_t kSimulationResetState = 22;
    static constexpr std::uint8_t kSimulationResetSpawned = 23;
    static constexpr std::uint8_t kSimulationStateGetting = 24;
    static constexpr std::uint8_t kSimulationStateSetting = 25;
    static constexpr std::uint8_t kSimulationStatePause = 26;
    static constexpr std::uint8_t kStepSimulationSingle = 31;
    static constexpr std::uint8_t kStepSimulationMultiple = 32;
    static constexpr std::uint8_t kStepSimulationAction = 33;
    static constexpr std::uint8_t kWorldLoading = 40;
    static constexpr std::uint8_t kWorldResourceString = 41;
    static constexpr std::uint8_t kWorldTags = 42;
    static constexpr std::uint8_t kWorldUnloading = 43;
    static constexpr std::uint8_t kWorldInfoGetting = 44;
    static constexpr std::uint8_t kAvailableWorlds = 45;
    static constexpr std::uint8_t kSpawningEntities = 50;
    std::vector<std::uint16_t> features;     ///< those of the constants that there are
    std::vector<std::string> spawn_formats;  ///< sdf, urdf, mjcf
    std::string custom_info;                 ///< for people

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("SPAWNING", kSpawning);
        visit("DELETING", kDeleting);
        visit("NAMED_POSES", kNamedPoses);
        visit("POSE_BOUNDS", kPoseBounds);
        visit("ENTITY_TAGS", kEntityTags);
        visit("ENTITY_BOUNDS", kEntityBounds);
        visit("ENTITY_BOUNDS_BOX", kEntityBoundsBox);
        visit("ENTITY_BOUNDS_CONVEX", kEntityBoundsConvex);
        visit("ENTITY_CATEGORIES", kEntityCategories);
        visit("SPAWNING_RESOURCE_STRING", kSpawningResourceString);
        visit("ENTITY_STATE_GETTING", kEntityStateGetting);
        visit("ENTITY_STATE_SETTING", kEntityStateSetting);
        visit("ENTITY_INFO_GETTING", kEntityInfoGetting);
        visit("ENTITY_INFO_SETTING", kEntityInfoSetting);
        visit("SPAWNABLES", kSpawnables);
        visit("SIMULATION_RESET", kSimulationReset);
        visit("SIMULATION_RESET_TIME", kSimulationResetTime);
        visit("SIMULATION_RESET_STATE", kSimulationResetState);
        visit("SIMULATION_RESET_SPAWNED", kSimulationResetSpawned);
        visit("SIMULATION_STATE_GETTING", kSimulationStateGetting);
        visit("SIMULATION_STATE_SETTING", kSimulationStateSetting);
        visit("SIMULATION_STATE_PAUSE", kSimulationStatePause);
        visit("STEP_SIMULATION_SINGLE", kStepSimulationSingle);
        visit("STEP_SIMULATION_MULTIPLE", kStepSimulationMultiple);
        visit("STEP_SIMULATION_ACTION", kStepSimulationAction);
        visit("WORLD_LOADING", kWorldLoading);
        visit("WORLD_RESOURCE_STRING", kWorldResourceString);
        visit("WORLD_TAGS", kWorldTags);
        visit("WORLD_UNLOADING", kWorldUnloading);
        visit("WORLD_INFO_GETTING", kWorldInfoGetting);
        visit("AVAILABLE_WORLDS", kAvailableWorlds);
        visit("SPAWNING_ENTITIES", kSpawningEntities);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("features", m.features);
        visit("spawn_formats", m.spawn_formats);
        visit("custom_info", m.custom_info);
    }
};

/// simulation_interfaces/srv/GetSimulatorFeatures
struct GetSimulatorFeatures {
    static constexpr const char* kName = "simulation_interfaces/srv/GetSimulatorFeatures";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSimulatorFeatures_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSimulatorFeatures_Response";
        SimulatorFeatures features;  ///< those that there are

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("features", m.features);
        }
    };
};

/// simulation_interfaces/srv/GetSimulationState
struct GetSimulationState {
    static constexpr const char* kName = "simulation_interfaces/srv/GetSimulationState";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSimulationState_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSimulationState_Response";
        SimulationState state;  ///< of the run
        Result result;          ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("state", m.state);
            visit("result", m.result);
        }
    };
};

/// simulation_interfaces/srv/SetSimulationState
struct SetSimulationState {
    static constexpr const char* kName = "simulation_interfaces/srv/SetSimulationState";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SetSimulationState_Request";
        SimulationState state;  ///< that is wanted

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("state", m.state);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/SetSimulationState_Response";
        static constexpr std::uint8_t kAlreadyInTargetState = 101;
        static constexpr std::uint8_t kStateTransitionError = 102;
        static constexpr std::uint8_t kIncorrectTransition = 103;
        Result result;  ///< how it went

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("ALREADY_IN_TARGET_STATE", kAlreadyInTargetState);
            visit("STATE_TRANSITION_ERROR", kStateTransitionError);
            visit("INCORRECT_TRANSITION", kIncorrectTransition);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

/// simulation_interfaces/srv/ResetSimulation
struct ResetSimulation {
    static constexpr const char* kName = "simulation_interfaces/srv/ResetSimulation";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/ResetSimulation_Request";
        static constexpr std::uint8_t kDefault = 0;
        static constexpr std::uint8_t kTime = 1;
        static constexpr std::uint8_t kState = 2;
        static constexpr std::uint8_t kSpawned = 4;
        static constexpr std::uint8_t kAll = 255;
        std::uint8_t scope = 0;  ///< bits of the constants; 0: all

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("SCOPE_DEFAULT", kDefault);
            visit("SCOPE_TIME", kTime);
            visit("SCOPE_STATE", kState);
            visit("SCOPE_SPAWNED", kSpawned);
            visit("SCOPE_ALL", kAll);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("scope", m.scope);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/ResetSimulation_Response";
        Result result;  ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

/// simulation_interfaces/srv/StepSimulation
struct StepSimulation {
    static constexpr const char* kName = "simulation_interfaces/srv/StepSimulation";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/StepSimulation_Request";
        std::uint64_t steps = 1;  ///< ticks

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("steps", m.steps);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/StepSimulation_Response";
        Result result;  ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

/// simulation_interfaces/action/SimulateSteps
struct SimulateSteps {
    static constexpr const char* kName = "simulation_interfaces/action/SimulateSteps";
    /// The goal.
    struct Goal {
        static constexpr const char* kName = "simulation_interfaces/action/SimulateSteps_Goal";
        std::uint64_t steps = 0;  ///< ticks

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("steps", m.steps);
        }
    };
    /// The end of the goal.
    struct Result {
        static constexpr const char* kName = "simulation_interfaces/action/SimulateSteps_Result";
        simulation_interfaces::Result result;  ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
    /// The state on the way.
    struct Feedback {
        static constexpr const char* kName = "simulation_interfaces/action/SimulateSteps_Feedback";
        std::uint64_t completed_steps = 0;  ///< ticks
        std::uint64_t remaining_steps = 0;  ///< ticks

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("completed_steps", m.completed_steps);
            visit("remaining_steps", m.remaining_steps);
        }
    };
};

}  // namespace roboss::ros2::simulation_interfaces
