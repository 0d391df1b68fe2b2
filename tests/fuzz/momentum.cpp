// Property: the momentum of a system on which nothing acts from outside stays, linear and angular.
#include <cmath>
#include <cstdio>
#include <limits>

#include <support/mechanical_sums.h>

#include "fuzz/property.h"

namespace roboss::fuzz {
namespace {

struct Drift {
    double linear = 0, angular = 0;
    double worst() const {
        const double most = std::fmax(linear, angular);
        return std::isfinite(linear + angular) ? most : std::numeric_limits<double>::infinity();
    }
};

/// Angular momentum about the common centre, so that a drift of the centre does not count twice.
Drift drift(const test::MechanicalSums& start, const test::MechanicalSums& now) {
    return {norm(now.linear - start.linear) / start.linear_scale,
            norm(now.spin() - start.spin()) / start.angular_scale};
}

}  // namespace

Finding run_momentum(const Request& request) {
    Motion motion(request.setting);
    test::MechanicalSummer summer(motion.model());
    const test::MechanicalSums start = summer(motion.states());
    Finding finding;
    while (motion.time_s() < request.seconds && std::isfinite(finding.figure)) {
        const StepReport& report = motion.step();
        const Drift now = drift(start, summer(motion.states()));
        if (request.print_line) {
            char buffer[160];
            std::snprintf(buffer, sizeof buffer,
                          "%6lld %8.4f s  linear %-10.3g angular %-10.3g fastest %-10.4g contacts %d",
                          static_cast<long long>(motion.tick()), motion.time_s(), now.linear, now.angular,
                          motion.fastest(), report.contacts);
            request.print_line(buffer);
        }
        if (now.worst() > finding.figure) finding.figure = now.worst(), finding.tick = motion.tick();
    }
    finding.failed = !(finding.figure <= kMomentumDriftMost);
    if (finding.failed) finding.text = std::isfinite(finding.figure) ? "momentum drifted" : "not finite";
    return finding;
}

}  // namespace roboss::fuzz
