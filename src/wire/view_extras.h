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

/// A Bond, for display.
struct ViewBond {
    RobotId holder;     ///< the robot that holds
    LinkId link;        ///< of the holder
    RobotId other;      ///< the robot that is held
    LinkId other_link;  ///< of `other`
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

/// The speed with which the surface runs around an axis, where its state has one.
template <class Motion>
Vec3 belt_of(const Motion& motion) {
    if constexpr (requires { motion.belt_L; }) return motion.belt_L;
    return {};
}

/// Whether the surfaces of robots of this type run over them. Those of a kinematic body go where it goes.
template <class Type>
bool has_belts(const Type& type) {
    if constexpr (requires { type.kinematic; }) return !type.kinematic;
    return true;
}

/// Adds the surfaces and bonds of a robot's state.
inline void append(const Model& model, RobotId robot, const RobotState& state, ViewExtras& extras) {
    const auto rounded = [](const Vec3& v) {
        return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const bool belts = has_belts(model.type_of(robot));
    for (const SurfaceMotion& motion : state.surfaces)
        if (belts)
            extras.surfaces.push_back({robot, motion.link, rounded(motion.linear_L),
                                       rounded(motion.angular_L), rounded(belt_of(motion))});
    for (const Bond& bond : state.bonds)
        extras.bonds.push_back({robot, bond.link, RobotId(bond.other), bond.other_link});
}

}  // namespace roboss
