// Property: the energy of a passive system never grows.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <support/mechanical_sums.h>

#include "fuzz/property.h"

namespace roboss::fuzz {
namespace {

/// Follows the energy and its growth above the lowest value so far. What it is relative to: the energy
/// itself; under gravity, whose zero is free, that above the lowest potential energy so far.
class EnergyGauge {
  public:
    EnergyGauge(const test::MechanicalSums& start, bool gravity)
        : gravity_(gravity), lowest_(start.energy()), deepest_(start.potential), most_(start.kinetic) {}

    /// Growth now.
    double read(const test::MechanicalSums& sums) {
        // Of the motion at its liveliest: below it a state counts as being at rest.
        const double at_rest = gravity_ ? 1e-3 : 1e-6;
        most_ = std::fmax(most_, sums.kinetic);
        deepest_ = std::fmin(deepest_, sums.potential);
        const double energy = sums.energy();
        const double growth = (energy - lowest_) / std::fmax(lowest_ - deepest_, at_rest * most_);
        lowest_ = std::fmin(lowest_, energy);
        return std::isfinite(growth) ? growth : std::numeric_limits<double>::infinity();
    }

  private:
    bool gravity_;
    double lowest_, deepest_, most_;
};

std::string line(const Motion& motion, const test::MechanicalSums& sums, double growth, int contacts) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer,
                  "%6lld %8.4f s  E %-14.8g kinetic %-14.8g growth %-10.3g fastest %-10.4g contacts %d",
                  static_cast<long long>(motion.tick()), motion.time_s(), sums.energy(), sums.kinetic, growth,
                  motion.fastest(), contacts);
    return buffer;
}

}  // namespace

Finding run_energy(const Request& request) {
    Motion motion(request.setting);
    test::MechanicalSummer summer(motion.model());
    test::MechanicalSums sums = summer(motion.states());
    EnergyGauge gauge(sums, norm_squared(motion.model().gravity) > 0);
    if (request.print_line) request.print_line(line(motion, sums, 0, 0));
    Finding finding;
    while (motion.time_s() < request.seconds && std::isfinite(finding.figure)) {
        const StepReport& report = motion.step();
        sums = summer(motion.states());
        const double growth = find_not_finite(motion.states()).valid()
                                  ? std::numeric_limits<double>::infinity()
                                  : gauge.read(sums);
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
