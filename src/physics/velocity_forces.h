// Keeps explicit centrifugal and gyroscopic forces from feeding energy to what turns far in a tick.
#pragma once

#include <cmath>

#include "physics/integrate.h"

namespace roboss {

/// Where a body turns so far in a tick that the forces must be tamed. Over T: one robot, or a few in lanes.
template <class T>
MaskOf<T> turns_far(const Mechanics<T>& work, double dt) {
    using std::sqrt;
    constexpr double kTurn = 0.5;  // rad
    T fastest = 0;
    for (const BodyWorkT<T>& body : work.bodies)
        fastest = larger(fastest, norm_squared(body.velocity.angular));
    return sqrt(fastest) * T(dt) > T(kTurn);
}

/// Centrifugal and gyroscopic forces do no work. Taken at the beginning of the tick, as here, they add
/// j M^-1 j / 2 to the energy, which is little until a body turns far in a tick; beyond, a robot would get
/// faster and faster without end. There j is cut back so that it adds no more than a small share.
/// `work` has its impulse and mass matrix; the impulse changes, and `buffer` is overwritten.
void tame_velocity_forces(const Model& model, RobotWork& work, FreeBuffer& buffer);

}  // namespace roboss
