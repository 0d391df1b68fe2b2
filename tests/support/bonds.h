// What tests of bonds need: orders that attach, how far a bond has slipped, a gantry that carries things
// along a path, and what the bonds of a simulation must keep at every tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/scenes.h>

namespace roboss::test {

inline const LinkId kFirstLink(std::size_t{0});

inline Order order_for(const Simulation& sim, std::size_t robot, Action action) {
    return {sim.tick, ClientId(std::size_t{0}), 1, RobotId(robot), std::move(action)};
}

inline Attach attach_to(std::size_t other, double reach = 0.1) {
    Attach attach;
    attach.link = attach.other_link = kFirstLink;
    attach.other = RobotId(other), attach.reach = reach;
    return attach;
}

/// Attaches the first link of `other` to `link` of `holder` in the next tick, which it steps.
inline void attach(Simulation& sim, std::size_t holder, std::size_t other, LinkId link = kFirstLink,
                   double max_force = std::numeric_limits<double>::infinity()) {
    Attach action = attach_to(other);
    action.link = link, action.max_force = max_force;
    const Order order = order_for(sim, holder, action);
    const Result<> checked = check_order(*sim.model, order);
    ASSERT_TRUE(checked.ok()) << checked.error().text();
    sim.step({&order, 1});
}

/// How far a bond is from what it keeps.
struct Slip {
    double distance = 0, angle = 0;  // m, rad
};

inline Slip slip_of(const Simulation& sim, std::size_t holder, std::size_t number = 0) {
    const Bond& bond = sim.states[holder].bonds[number];
    const Transform X_WL = link_pose(sim.type(holder), sim.states[holder], bond.link);
    Transform X_WO;
    if (bond.other != RobotId::kNone)
        X_WO = link_pose(sim.type(bond.other), sim.states[bond.other], bond.other_link);
    const Transform wanted = X_WL * to_transform(bond.X_LO);
    return {norm(X_WO.p - wanted.p), norm(logarithm(to_quat(X_WO.R * transpose(wanted.R))))};
}

inline Slip worst_slip(const Simulation& sim) {
    Slip worst;
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t b = 0; b < sim.states[r].bonds.size(); ++b) {
            const Slip slip = slip_of(sim, r, b);
            worst.distance = std::max(worst.distance, slip.distance);
            worst.angle = std::max(worst.angle, slip.angle);
        }
    return worst;
}

/// Three slides along x, y, z and a turn about z on a fixed base; link 3 is the hand, with its shape about
/// the model's origin.
inline ModelSpec gantry(double hand_mass = 1.0) {
    ModelSpec m;
    m.name = "gantry", m.canonical_link = "x";
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
    const char* const names[] = {"x", "y", "z", "hand"};
    std::string parent = "world";
    for (std::size_t i = 0; i < 4; ++i) {
        const double mass = i == 3 ? hand_mass : 5.0;
        m.links.push_back(link(names[i], mass, box_inertia(mass, {0.2, 0.2, 0.1})));
        m.joints.push_back(joint(i == 3 ? JointSpecKind::kRevolute : JointSpecKind::kPrismatic,
                                 std::string("move_") + names[i], parent, names[i], {}, axes[i]));
        parent = names[i];
    }
    m.links.back().collisions.push_back(box_shape({0.2, 0.2, 0.1}, surface(0.5)));
    return m;
}
inline const LinkId kHand(std::size_t{3});

}  // namespace roboss::test
