// View extras: what only some robots show besides their pose (wire/view_state.h): surfaces that move, and
// bonds. Robots without them cost nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/robot_state.h"

namespace roboss {

/// A SurfaceMotion, rounded for display.
struct ViewSurface {
    RobotId robot;                    ///< whose state says so
    LinkId link;                      ///< of the robot
    std::array<float, 3> linear_L{},  ///< m/s, at the link's origin, link axes
        angular_L{},                  ///< rad/s, link axes
        belt_L{};                     ///< m/s, link axes: speed times the axis that the surface runs around
    /// Compares all members.
    friend bool operator==(const ViewSurface&, const ViewSurface&) = default;
};

/// A Bond that holds, for display.
struct ViewBond {
    RobotId holder;              ///< the robot that holds
    LinkId link;                 ///< of the holder
    RobotId other;               ///< the robot that is held; not valid: the scenery
    LinkId other_link;           ///< of `other`
    std::array<float, 3> p_L{};  ///< m, in the holder's link: where it holds
    /// Compares all members.
    friend bool operator==(const ViewBond&, const ViewBond&) = default;
};

/// What some robots show besides their poses.
struct ViewExtras {
    std::vector<ViewSurface> surfaces;  ///< by robot, as they were appended
    std::vector<ViewBond> bonds;        ///< by holder, as they were appended
    /// Compares all members.
    friend bool operator==(const ViewExtras&, const ViewExtras&) = default;
};

/// Adds the surfaces that run over the robot, and the bonds by which it holds others.
inline void append(const Model& model, RobotId robot, const RobotState& state, ViewExtras& extras) {
    const auto rounded = [](const Vec3& v) {
        return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    for (const Bond& bond : state.bonds)
        if (bond.phase == BondPhase::kHolds)
            extras.bonds.push_back(
                {robot, bond.link, RobotId(bond.other), bond.other_link, rounded(bond.p_L)});
    if (model.type_of(robot).kinematic) return;  // its surfaces go where it goes
    for (const SurfaceMotion& motion : state.surfaces)
        extras.surfaces.push_back({robot, motion.link, rounded(motion.linear_L), rounded(motion.angular_L),
                                   rounded(motion.belt_L)});
}

}  // namespace roboss
