// The joint types of world files, a row each. The importer, `compile`, loops, orders, viewers and tools ask
// the row, not for the type: a new type is an enumerator and a row (joint_type.cpp), and a file in
// src/model/joints only if it moves in a way that none does yet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "world/joint_kind.h"

namespace roboss {

/// In the order of the rows; the number enters the hash of a Model.
enum class JointSpecKind : int {
    kFixed,
    kRevolute,
    kContinuous,
    kPrismatic,
    kBall,
    kScrew,
    kUniversal,
    kRevolute2,
    kGearbox,
    kPlanar
};

/// A row of the table: what a joint of a file is made of.
struct JointType {
    std::string_view name;  // SDFormat's, URDF's and the viewer's
    /// From the parent to the child; each moves a body of the tree. Motion k has axis k, but for a ball.
    std::span<const JointKind> motions{};
    /// The element of the file that holds the numbers of each axis; orders count axes in this order.
    std::span<const std::string_view> axes{};
    bool endless = false;       // its axes have no limits
    bool is_extension = false;  // SDFormat has no such type: <roboss:joint type="name"> within a `joint`
    bool couples = false;       // ties the motions of other joints together and connects no links

    /// It has no motion: its links are one body.
    bool welds() const { return motions.empty() && !couples; }
    /// Moves, but about no axis of its own: no limits, positions or followers, the same damping in all
    /// directions.
    bool is_isotropic() const { return !motions.empty() && axes.empty(); }
    /// Its only motion is a rotation about one axis.
    bool is_hinge() const { return motions.size() == 1 && motions[0] == JointKind::kRevolute; }
    /// How many of its motions are of this kind.
    std::size_t count(JointKind motion) const {
        return static_cast<std::size_t>(std::count(motions.begin(), motions.end(), motion));
    }
    /// The axis whose numbers stand in this element.
    std::optional<std::size_t> find_axis(std::string_view element) const;
};

/// All rows; the index is the number of the JointSpecKind.
std::span<const JointType> joint_types();
const JointType& joint_type(JointSpecKind kind);
std::optional<JointSpecKind> find_joint_type(std::string_view name);

}  // namespace roboss
