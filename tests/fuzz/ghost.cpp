// Property: who passes clear of everything is not pushed, not by one bit.
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuzz/property.h"
#include "fuzz/shot.h"
#include "fuzz/swept.h"

namespace roboss::fuzz {

namespace {

/// Nearer than this counts as touching, m: samples of the path are joined by chords, which miss a part of the
/// arc.
double clear_at(double turn) {
    constexpr double kClear = 1e-4, kReach = 0.2;
    const double part = turn / Flight::kFine;
    return kClear + kReach * part * part / 8;
}

}  // namespace

Finding run_ghost(const Request& request) {
    constexpr double kResolution = 2e-5;  // m
    Flight flight(request.setting);
    SweptDistance swept(flight.model(), flight.shot().stand_ins);
    Finding finding;
    while (!flight.over()) {
        flight.step();
        if (!flight.finite())
            return {true, std::numeric_limits<double>::infinity(), flight.tick(), "not finite"};
        const double change = flight.change(), turn = flight.turn(flight.before());
        if ((change == 0 || turn > Flight::kTurnMost) && !request.print_line)
            continue;  // no need to know how near it was
        const double clear = clear_at(turn);
        swept.clear();
        for (const std::vector<RobotState>& states : flight.fine_way()) swept.add(states);
        const double gap = swept.least_gap(clear, kResolution);
        if (request.print_line) {
            char buffer[120];
            std::snprintf(buffer, sizeof buffer, "%6lld  least gap %-10.4g change of velocity %-10.4g",
                          static_cast<long long>(flight.tick()), gap, change);
            request.print_line(buffer);
        }
        if (gap <= clear || turn > Flight::kTurnMost || change <= finding.figure) continue;
        finding.failed = true;
        finding.figure = change, finding.tick = flight.tick();
        char buffer[120];
        std::snprintf(buffer, sizeof buffer, "pushed though clear by %.3g mm, m/s or rad/s:", 1e3 * gap);
        finding.text = buffer;
    }
    return finding;
}

}  // namespace roboss::fuzz
