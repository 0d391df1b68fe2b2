// KineticEnergyMonitor of Gazebo: notes when a link loses much kinetic energy in one tick.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// A sensor of its model (sensor_kinds/onboard_values.h) reads the energy and what was lost.
struct KineticEnergyMonitorSpec {
    LinkNames links;       ///< one
    double threshold = 7;  ///< J: a loss beyond it counts

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"base_link_name", "", "the link is that of <link_name>", "Write <link_name>."}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 90,
                                       .name = "kinetic-energy-monitor",
                                       .phrase = "a kinetic energy monitor",
                                       .classes = "KineticEnergyMonitor",
                                       .files = "kinetic-energy-monitor-system",
                                       .ignored = kIgnored};

    /// The numbers of its memory: energy in J, the last loss in J, its tick, how many there were.
    enum Memory { kEnergy, kLost, kLostAt, kLosses, kSize };

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link_name", "link_name"}, s.links);
        visit({"kinetic_energy_threshold", "kinetic_energy_threshold", "J"}, s.threshold);
    }
    /// It takes no commands.
    std::vector<Channel> channels() const { return {}; }
    /// At the start.
    std::vector<double> memory() const { return {0, 0, -1, 0}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (links.size() != 1)
            problems.push_back({"names " + std::to_string(links.size()) + " links; it observes one",
                                "Write one <link_name>."});
    }
    /// Compares all members.
    friend bool operator==(const KineticEnergyMonitorSpec&, const KineticEnergyMonitorSpec&) = default;
};

}  // namespace roboss
