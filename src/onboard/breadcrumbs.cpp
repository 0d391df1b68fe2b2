// See onboard_kinds/breadcrumbs.h.
#include <algorithm>
#include <limits>

#include "onboard/controllers.h"

namespace roboss {
namespace {

/// It sleeps where it is, whatever is near: nothing holds it, and nothing steps it.
void store(RobotState& state) {
    constexpr Vec3 kHalf{0.01, 0.01, 0.01};  // m, of its bound
    const Vec3 at = base_pose(state).p;
    std::fill(state.v.begin(), state.v.end(), 0.0);
    state.wrenches.clear();
    state.rest = {};
    state.rest.asleep = true;
    state.rest.bound = {at - kHalf, at + kHalf};
}

/// Bonds a link with the world, where it is.
void fix(OnboardContext& c, LinkId link) {
    Bond bond;
    bond.phase = BondPhase::kHolds, bond.link = link;
    bond.max_force = bond.max_torque = std::numeric_limits<double>::infinity();
    bond.X_LO = to_pose(inverse(c.pose(link)));
    c.state().bonds.push_back(bond);
}

}  // namespace

void run(const BreadcrumbsSpec&, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    const auto commanded = static_cast<double>(c.commanded_at(0));
    if (commanded <= memory[BreadcrumbsSpec::kCounted]) return;
    memory[BreadcrumbsSpec::kCounted] = commanded;
    memory[BreadcrumbsSpec::kCount] += 1;
}

void run(const CrumbSpec& spec, OnboardContext& c) {
    if (c.type().nv == 0) return;
    if (!c.is_commanded(0)) return store(c.state());
    double& is_fixed = c.memory()[0];
    if (spec.fixed_after < 0 || is_fixed != 0) return;
    const double age = static_cast<double>(c.tick() - c.commanded_at(0)) * c.dt();
    if (spec.fixed_after > 0 && age <= spec.fixed_after) return;
    fix(c, c.info().base);
    is_fixed = 1;
}

}  // namespace roboss
