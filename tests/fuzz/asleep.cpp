// Property: robots that start overlapping end where they would without sleep.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fuzz/property.h"
#include "physics/dynamics/dynamics.h"

namespace roboss::fuzz {
namespace {

/// Largest distance of a body from where it is in the other run, m.
double distance(const Motion& a, const Motion& b, Mechanics<double>& in_a, Mechanics<double>& in_b) {
    double most = 0;
    for (std::size_t r = 0; r < a.states().size(); ++r) {
        const RobotType& type = a.model().type_of(RobotId(r));
        forward_kinematics<double>(type, a.states()[r].q, in_a);
        forward_kinematics<double>(type, b.states()[r].q, in_b);
        for (std::size_t body = 0; body < type.bodies.size(); ++body)
            most = std::fmax(
                most, norm(in_a.origin + in_a.bodies[body].centre - in_b.origin - in_b.bodies[body].centre));
    }
    return most;
}

bool any_sleeps(const std::vector<RobotState>& states) {
    return std::ranges::any_of(states, [](const RobotState& state) { return state.rest.asleep; });
}

}  // namespace

Finding run_asleep(const Request& request) {
    Motion motion(request.setting), awake(request.setting, false);
    Mechanics<double> in_motion, in_awake;
    Finding finding;
    double asleep_s = 0;
    while (motion.time_s() < request.seconds) {
        motion.step(), awake.step();
        if (!any_sleeps(motion.states()) && asleep_s == 0) continue;
        asleep_s += motion.model().dt_s;
        // While something falls over, a micrometre decides when it does; where it comes to rest is judged.
        if (std::fmax(motion.fastest(), awake.fastest()) > kJudgedBelow) continue;
        const double apart = distance(motion, awake, in_motion, in_awake),
                     share = apart / (kSleepersApartMost + kSleepersDriftMost * asleep_s);
        if (request.print_line) {
            char buffer[120];
            std::snprintf(buffer, sizeof buffer, "%6lld %8.4f s  apart %-12.6g m, of the bound %-10.4g",
                          static_cast<long long>(motion.tick()), motion.time_s(), apart, share);
            request.print_line(buffer);
        }
        if (!(share <= finding.figure)) finding.figure = share, finding.tick = motion.tick();
    }
    finding.failed = !(finding.figure <= 1);
    if (finding.failed) finding.text = "a robot slept that moves";
    return finding;
}

}  // namespace roboss::fuzz
