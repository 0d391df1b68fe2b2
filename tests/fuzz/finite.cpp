// Property: finite input gives finite states, and the invariants of states hold after each tick.
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuzz/property.h"
#include "physics/invariants.h"

namespace roboss::fuzz {

Finding run_finite(const Request& request) {
    Motion motion(request.setting);
    Finding finding;
    while (motion.time_s() < request.seconds) {
        const StepReport& report = motion.step();
        const double fastest = motion.fastest();
        if (request.print_line) {
            char buffer[160];
            std::snprintf(buffer, sizeof buffer,
                          "%6lld %8.4f s  fastest %-12.6g contacts %-4d iterations %-4d residual %.2g",
                          static_cast<long long>(motion.tick()), motion.time_s(), fastest, report.contacts,
                          report.iterations, report.residual);
            request.print_line(buffer);
        }
        if (fastest > finding.figure) finding.figure = fastest, finding.tick = motion.tick();
        const RobotId broken = find_not_finite(motion.states());
        if (!broken.valid()) {
            finding.text = check_invariants(motion.model(), motion.states());
            if (finding.text.empty()) continue;
            finding.failed = true, finding.tick = motion.tick();
            break;
        }
        finding.failed = true;
        finding.figure = std::numeric_limits<double>::infinity(), finding.tick = motion.tick();
        finding.text = "robot " + motion.model().robots[broken.index()].name + " is not finite";
        break;
    }
    return finding;
}

}  // namespace roboss::fuzz
