// What one tick computes of one robot before anything is solved: poses, motion axes, mass matrix, free
// impulse. Buffers are kept from tick to tick, so that nothing is allocated once they have grown.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "math/aabb.h"
#include "math/spatial.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

constexpr double kBaseMargin = 0.002;  // m: what gravity and solving may add to the displacement of one tick

template <class T>
struct BodyWorkT {
    TransformT<T> X_WB;
    Vec3T<T> centre;             // of mass, from O, world axes
    SpatialT<T> velocity;        // about O
    SpatialT<T> bias;            // acceleration with all joint accelerations zero
    SpatialInertiaT<T> inertia;  // of the body, then of its whole subtree
    SpatialT<T> impulse;         // momentum minus dt * bias force, summed over the subtree
};
using BodyWork = BodyWorkT<double>;

template <class T>
struct ShapeWorkT {
    TransformT<T> X_WS;
    AabbT<T> box;  // inflated by `margin`
    T margin{};    // contact margin of this shape at this tick, m
};
using ShapeWork = ShapeWorkT<double>;

/// A crowd of shapes (ShapeGroups): what holds all of them.
template <class T>
struct CrowdWorkT {
    AabbT<T> box;  // inflated by `margin`
    T margin{};    // no shape of the crowd has a larger one
};

/// What one force law of the air or the water adds to the inertia of a link (fluid_forces.h).
struct FlowWork {
    int body = 0;                    // that the link is of
    Mat3 R_WL;                       // link axes
    Vec3 arm;                        // link's origin from O, world axes
    std::array<double, 36> inertia;  // motion (x y z p q r) to momentum, link axes, at its origin; symmetric
};

/// The mechanics of a robot (T = double), or of a few of one type in lanes.
template <class T>
struct Mechanics {
    const RobotType* type = nullptr;  // type_of() the robot, or of all in the lanes
    Vec3T<T> origin;                  // O: the base origin, m, world
    TransformT<T> X_W0;               // the base
    std::vector<BodyWorkT<T>> bodies;
    std::vector<SpatialT<T>> axes;  // one a degree of freedom: motion of its body per unit of v, about O
    std::vector<T> mass_matrix;     // packed by the type's paths; implicit damping and springs included
    // Of a robot with many loops, what the mass matrix is made of: the bodies' own inertias, and what stands
    // beside them on the diagonal, by joint dof.
    std::vector<SpatialInertiaT<T>> own_inertias;
    std::vector<T> joint_inertias;
    std::vector<T> impulse;             // nv: M v + dt (applied - bias); the free velocity is M^-1 of it
    std::vector<T> velocity;            // nv: solved
    std::vector<FlowWork> flows;        // as they stand beside the bodies' inertias
    std::vector<ShapeWorkT<T>> shapes;  // those of crowds are not placed: see PlacedShapes, shape_pose
    std::vector<CrowdWorkT<T>> crowds;  // as in ShapeGroups
    AabbT<T> box;                       // interaction bound
    Spatial base;                       // velocity of a kinematic base about O; of others zero
    T speed{};                          // m/s, no point of its shapes is faster
    bool touches_robot = false;         // has a contact with another robot or itself
};

struct RobotWork : Mechanics<double> {
    RobotId id;
    RobotState* state = nullptr;
    int contacts = 0;      // contact points that involve this robot
    bool ordered = false;  // an order changed it at this tick
    bool asleep = false;   // then nothing but the box is known, unless `placed`
    bool placed = false;
    bool held = false;    // rows act on it: it does not move freely
    bool pushed = false;  // a contact gives it an impulse in this tick
    bool bonded = false;  // a bond joins it to another robot or to the scenery in this tick

    /// Becomes that of a robot, whose state it keeps. `its_type`: type_of() it.
    void take(const RobotType& its_type, RobotState& its_state) { type = &its_type, state = &its_state; }
};

/// Everything up to the shapes and the interaction bound, for a robot that is awake; `ordered` is left as it
/// is.
void place_robot(const Model& model, RobotId id, RobotState& state, RobotWork& work);

/// Velocity of a kinematic robot about its base's origin, world axes: rad/s, m/s. Zero for others.
Spatial base_velocity(const RobotType& type, const RobotState& state);
inline bool is_zero(const Spatial& v) {
    return v.angular == Vec3{} && v.linear == Vec3{};
}

class BodyWalk;

/// Parts of it in the order of computing (dynamics.h); `dt` in s.
template <class T>
void forward_kinematics(const RobotType& type, std::span<const T> q, Mechanics<T>& work);
template <class T>
void forward_velocities(const RobotType& type, std::span<const T> v, Mechanics<T>& work);
/// Places shapes and crowds, and finds the interaction bound (shape_places.h).
template <class T>
void place_shapes(const RobotType& type, double dt, Mechanics<T>& work);
/// work.impulse = momentum_weight * M v + dt * (applied - bias); with (1, 0) the generalised force alone.
/// With a weight, drag is taken implicitly: part of it then stands in the bodies' inertias, for
/// compute_mass_matrix.
/// `walk`: by its threads.
void compute_impulse(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                     std::span<const double> v, RobotWork& work, BodyWalk* walk = nullptr);
/// Inertias of the bodies alone, as compute_impulse sets them on the way; compute_mass_matrix needs them.
void compute_inertias(const RobotType& type, RobotWork& work);
template <class T>
void compute_mass_matrix(const RobotType& type, double dt, Mechanics<T>& work);

}  // namespace roboss
