// What a joint that closes a loop asks of the two bodies it joins: scalar conditions with their errors and
// rates, and its free directions with their coordinates. For the step, the compiler and readings alike.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "math/spatial.h"
#include "model/model.h"

namespace roboss {

/// A body as a loop joint sees it, about O, world axes. `bias` is the acceleration with all joint
/// accelerations zero.
struct BodyKinematics {
    Transform X_OB;
    Spatial velocity, bias;
};

/// One condition. Its rate is dot(wrench, velocity of B - velocity of A); its second derivative the same of
/// the accelerations; `curvature` is what the biases alone give.
struct ClosureRow {
    double error = 0;  // m or rad
    double curvature = 0;
    Spatial wrench;
    double mobility = 0;  // scale of J M^-1 J^T
};

struct ClosureRows {
    std::array<ClosureRow, 6> rows;
    std::size_t count = 0;
    std::span<const ClosureRow> all() const& { return {rows.data(), count}; }
    std::span<const ClosureRow> all() const&& = delete;  // it would outlive the rows
};

ClosureRows closure_rows(const LoopJoint& loop, const BodyKinematics& a, const BodyKinematics& b);

/// A free direction; the rate of its position is dot(wrench, velocity of B - velocity of A). Angles are in
/// (-pi, pi]; of a ball joint the rotation vector.
struct FreeDirection {
    double position = 0;
    Spatial wrench;
};

struct FreeDirections {
    std::array<FreeDirection, 3> directions;
    std::size_t count = 0;
    std::span<const FreeDirection> all() const& { return {directions.data(), count}; }
    std::span<const FreeDirection> all() const&& = delete;
};

FreeDirections free_directions(const LoopJoint& loop, const Transform& X_OA, const Transform& X_OB);

}  // namespace roboss
