// Rows of the cluster measurements: one piece of work on so many Simulators.
#pragma once

#include <nlohmann/json.hpp>

#include "cluster/virtual_network.h"
#include "cluster/work.h"

namespace roboss::bench {

using Json = nlohmann::ordered_json;

struct ClusterSettings {
    NetworkCosts network;
    Tick window_max = 0;  // 0: by the number of robots
    std::size_t lanes = 1;
    bool work_stealing = true;  // idle Simulators take over ticks of stragglers
    bool count_work = false;    // also the efficiency by counted work, and what the clock makes of equal work
};

/// Efficiencies (docs/cluster-efficiency.md says how each is meant; "counted" and "even" where it is asked
/// for), costs and traffic. Throws if the run does not end with the state hash of the recorded one.
Json measure(const Work& work, std::size_t simulators, const ClusterSettings& settings,
             bool one_island = false);

/// The paper's figure 5: the run begins with `simulators`, of which one leaves every `every` ticks. Mean step
/// times by simulated time.
Json detach(const Work& work, std::size_t simulators, Tick every, const ClusterSettings& settings);

/// A row for people.
std::string line_of(const Json& row);

}  // namespace roboss::bench
