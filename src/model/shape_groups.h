// The shapes of a robot by the bodies that they are on. A body with many shapes (a decomposed mesh) has a
// tree over them in its own frame: where the robot is alone, a step looks at the body's box, and at none of
// its shapes.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/bvh.h"

namespace roboss {

struct RobotType;

/// The shapes of a body that has many, all of them bounded.
struct ShapeCrowd {
    int body = -1;                      // in RobotType::bodies; -1: fixed base
    std::vector<std::uint32_t> shapes;  // in RobotType::shapes, ascending
    Bvh tree;                           // over their boxes in the body's frame; items are places in `shapes`
    Aabb box;                           // of all, body's frame
    double radius = 0;                  // m, about the body's origin: holds them all
};

struct ShapeGroups {
    static constexpr std::size_t kCrowd = 16;  // shapes of a body from which on they are a crowd

    std::vector<std::uint32_t> by_body;            // in RobotType::shapes, by body, then ascending
    std::vector<std::uint32_t> first;              // by body + 1: its place in by_body; then the end
    std::vector<int> crowd_of;                     // by body + 1: in `crowds`; -1: it has few shapes
    std::vector<ShapeCrowd> crowds;                // by body
    std::vector<std::uint32_t> loose;              // shapes that are in no crowd, ascending
    std::vector<std::pair<int, int>> self_bodies;  // pairs of bodies that RobotType::self_pairs has shapes of

    ShapeGroups() = default;
    explicit ShapeGroups(const RobotType& type);

    /// Shapes of a body; -1: of the base.
    std::span<const std::uint32_t> of(int body) const {
        const auto b = static_cast<std::size_t>(body + 1);
        return std::span(by_body).subspan(first[b], first[b + 1] - first[b]);
    }
    /// In `crowds`; -1: the body has few shapes.
    int crowd(int body) const { return crowd_of[static_cast<std::size_t>(body + 1)]; }
};

}  // namespace roboss
