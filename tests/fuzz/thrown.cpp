// Property: what starts in the ground is pushed out no faster than its surfaces say, and gets no other
// energy.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <support/mechanical_sums.h>

#include "fuzz/property.h"

namespace roboss::fuzz {
namespace {

constexpr double kGravity = 9.81;

/// The greatest speed of recovery of the robot's surfaces, m/s.
double recovery_speed(const RobotType& type) {
    double speed = 0;
    for (const BodyShape& shape : type.shapes) speed = std::fmax(speed, shape.material.correction_speed);
    return speed;
}

}  // namespace

Finding run_thrown(const Request& request) {
    Motion motion(request.setting);
    test::MechanicalSummer summer(motion.model());
    const test::MechanicalSums start = summer(motion.states());
    const double speed = recovery_speed(motion.model().type_of(RobotId(0u))),
                 pushed = 0.5 * start.mass * speed * speed;
    Finding finding;
    double highest = start.potential;
    while (motion.time_s() < request.seconds && std::isfinite(finding.figure)) {
        const StepReport& report = motion.step();
        const test::MechanicalSums now = summer(motion.states());
        highest = std::fmax(highest, now.potential);
        // What recovery has raised may fall at once, relative to where it was raised to: bodies roll over.
        const double fallen = highest - now.potential,
                     raised = start.mass * kGravity * speed * motion.time_s(),
                     most = kThrownMost * pushed + raised + kFallErrorMost * fallen +
                            start.mass * kGravity * kThrownHeightMost,
                     share = (now.kinetic - fallen) / most;
        if (request.print_line) {
            char buffer[200];
            std::snprintf(buffer, sizeof buffer,
                          "%6lld %8.4f s  kinetic %-12.6g J, fallen %-12.6g J, of the bound %-10.4g fastest "
                          "%-10.4g recovery %.4g m/s contacts %d",
                          static_cast<long long>(motion.tick()), motion.time_s(), now.kinetic, fallen, share,
                          motion.fastest(), speed, report.contacts);
            request.print_line(buffer);
        }
        if (!std::isfinite(share)) finding.figure = std::numeric_limits<double>::infinity();
        if (share > finding.figure) finding.figure = share, finding.tick = motion.tick();
    }
    finding.failed = !(finding.figure <= 1);
    if (finding.failed) finding.text = "it is thrown";
    return finding;
}

}  // namespace roboss::fuzz
