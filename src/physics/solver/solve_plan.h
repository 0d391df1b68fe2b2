// Which attempts the exact solver makes at a part of a contact island, in which order: a table, printed in
// docs/how-contacts-are-solved.md.
#pragma once

#include <cstddef>
#include <span>

#include "physics/solver/newton.h"

namespace roboss {

/// A way to solve a part. Where one does not end in a balance, the next one begins where the first did.
enum class Attempt : char {
    kNewton,    // Newton's method, from what every contact did in the last tick
    kSweeps,    // at rest Newton's method; else sweeps, and Newton's method from where they end
    kHardened,  // Newton's method on rows that are soft at first
    kActiveSet  // of a displacement: rounds that find which rows push
};

/// What the choice depends on.
struct PartFacts {
    std::size_t robots = 1;
    bool touches = false;       // it has contacts
    bool driven = false;        // it has motors
    bool displacement = false;  // solved is the displacement of the tick, not the velocity
};

struct SolvePlan {
    newton::Plan newton;                // of Attempt::kNewton
    std::span<const Attempt> attempts;  // if all fail: sweeps without a start
};

/// Robots that lean on each other are a pile from 4 on, with motors from 9 on: these hold them apart, so most
/// of their wheels and feet do what they did in the last tick. In a pile Newton's method would turn one row
/// after the other.
SolvePlan plan_for(const PartFacts& facts);

/// Of Attempt::kSweeps, and of a pile.
inline constexpr newton::Plan kPilePlan{
    .far_max = 30, .coupled_steps = 12, .halvings = 3, .progress = 0.3, .checks = 10};

}  // namespace roboss
