// Property: the energy of a passive system never grows.
#include <cmath>
#include <cstdio>
#include <limits>

#include <support/mechanical_sums.h>

#include "fuzz/energy_gauge.h"
#include "fuzz/property.h"

namespace roboss::fuzz {
namespace {

std::string line(const Motion& motion, const test::MechanicalSums& sums, double growth, int contacts) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer,
                  "%6lld %8.4f s  E %-14.8g kinetic %-14.8g growth %-10.3g fastest %-10.4g contacts %d",
                  static_cast<long long>(motion.tick()), motion.time_s(), sums.energy(), sums.kinetic, growth,
                  motion.fastest(), contacts);
    return buffer;
}

/// States with the velocities of `now` at the coordinates of `before`.
void set_velocities(const std::vector<RobotState>& now, std::vector<RobotState>& before) {
    for (std::size_t r = 0; r < now.size(); ++r) before[r].v = now[r].v;
}

}  // namespace

Finding run_energy(const Request& request) {
    Motion motion(request.setting);
    test::MechanicalSummer summer(motion.model());
    test::MechanicalSums sums = summer(motion.states());
    EnergyGauge gauge(sums, norm_squared(motion.model().gravity) > 0);
    if (request.print_line) request.print_line(line(motion, sums, 0, 0));
    Finding finding;
    std::vector<RobotState> before;
    while (motion.time_s() < request.seconds && std::isfinite(finding.figure)) {
        before = motion.states();
        const StepReport& report = motion.step();
        set_velocities(motion.states(), before);
        sums = summer(motion.states());
        const double growth = find_not_finite(motion.states()).valid()
                                  ? std::numeric_limits<double>::infinity()
                                  : gauge.read(summer(before), sums);
        if (request.print_line) request.print_line(line(motion, sums, growth, report.contacts));
        if (growth > finding.figure) finding.figure = growth, finding.tick = motion.tick();
    }
    finding.failed = !(finding.figure <= kEnergyGrowthMost);
    if (!std::isfinite(finding.figure))
        finding.text = "not finite";
    else if (finding.failed)
        finding.text = "energy grew";
    return finding;
}

}  // namespace roboss::fuzz
