// The summary of a run, for people and for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/types.h"
#include "physics/step_profile.h"

namespace roboss {

struct Summary {
    std::string world;
    std::size_t robots = 0;
    Tick ticks = 0;  // of this run (from its start, not from the world's)
    double dt_s = 0;
    double sim_time_s = 0;  // world time at the end
    double wall_time_s = 0;
    double paused_time_s = 0;     // of wall_time_s: paused, or serving a picture
    double real_time_factor = 0;  // while it ran
    double step_cpu_s = 0;        // thread CPU time of stepping alone
    std::uint64_t windows = 0, windows_repeated = 0;
    double islands_mean = 0;            // per window
    double contacts_mean = 0;           // contact points per tick
    double building_contacts_mean = 0;  // of these with static scenery other than planes, per tick
    std::uint64_t model_hash = 0, state_hash = 0;
    std::uint64_t losses = 0, recoveries = 0,
                  migrations = 0;  // of Simulators; of runs of recovery; of robots
    std::uint64_t cuts = 0;        // windows of a straggler that others took over in part (work stealing)
    std::size_t simulators = 0;    // at the end
    std::optional<StepProfile> profile;  // with --profile-steps
    double friction_tolerance = 0;       // of the world's accuracy
    /// In a replay: recorded states that were compared and are equal, and whether one was not.
    struct Replayed {
        std::size_t equal = 0;
        bool differs = false;
    };
    std::optional<Replayed> replayed;
    std::string journal;  // the file that the run has written; empty: none
    std::uint64_t journal_bytes = 0;
};

std::string to_json(const Summary& summary);
std::string to_text(const Summary& summary);
/// "-" is standard output.
Result<> write_json(const Summary& summary, const std::string& file);

}  // namespace roboss
