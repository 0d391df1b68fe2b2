// See onboard_kinds/kinetic_energy_monitor.h.
#include "onboard/controllers.h"

namespace roboss {
namespace {

/// J.
double kinetic_energy(OnboardContext& c, LinkId id) {
    const Link& link = c.type().links[id.index()];
    const Transform X_WL = c.pose(id);
    const LinkTwist twist = c.twist(id);
    const Vec3 v = twist.linear + cross(twist.angular, c.centre(id) - X_WL.p);
    const Mat3 R_WB = X_WL.R * transpose(link.X_BL.R);
    const Vec3 w = transpose_times(R_WB, twist.angular);
    return 0.5 * link.mass * norm_squared(v) + 0.5 * dot(w, link.inertia_C * w);
}

}  // namespace

void run(const KineticEnergyMonitorSpec& spec, OnboardContext& c) {
    using Spec = KineticEnergyMonitorSpec;
    const std::span<double> memory = c.memory();
    const double energy = kinetic_energy(c, c.link(0)), lost = memory[Spec::kEnergy] - energy;
    memory[Spec::kEnergy] = energy;
    if (lost <= spec.threshold) return;
    memory[Spec::kLost] = lost, memory[Spec::kLostAt] = static_cast<double>(c.tick());
    memory[Spec::kLosses] += 1;
}

}  // namespace roboss
