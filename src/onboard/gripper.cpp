// See onboard_kinds/gripper.h; how bonds form and let go: physics/bonds.
#include <algorithm>

#include "onboard/controllers.h"

namespace roboss {

void run(const GripperSpec& spec, OnboardContext& c) {
    std::vector<Bond>& bonds = c.state().bonds;
    const std::span<double> memory = c.memory();
    double& phase = memory[GripperSpec::kPhase];
    const LinkId link = c.link(0);
    const auto is_own = [&](const Bond& bond) { return bond.link == link && bond.p_L == spec.X_LC.p; };
    const auto own = std::ranges::find_if(bonds, is_own);
    const bool on = c.is_commanded(0) ? c.command(0)[0] > 0 : spec.on;
    const auto heard = static_cast<double>(c.commanded_at(0));
    if (memory[GripperSpec::kHeard] != heard) {
        memory[GripperSpec::kHeard] = heard;
        if (phase == GripperSpec::kLost) phase = GripperSpec::kSearching;
    }
    if (!on) {
        if (own != bonds.end()) own->phase = BondPhase::kLoosed;
        phase = GripperSpec::kOff;
        return;
    }
    if (own != bonds.end()) {
        phase = own->phase == BondPhase::kLoosed ? GripperSpec::kLost : GripperSpec::kHolding;
        return;
    }
    if (phase == GripperSpec::kHolding) phase = GripperSpec::kLost;
    if (phase == GripperSpec::kLost) return;
    phase = GripperSpec::kSearching;
    Bond bond;
    bond.link = link, bond.p_L = spec.X_LC.p, bond.reach = spec.reach;
    bond.max_force = spec.max_force, bond.max_torque = spec.max_torque;
    bonds.push_back(bond);
}

}  // namespace roboss
