// What one tick computes of one robot before anything is solved: poses, motion axes, mass matrix, free
// impulse. Buffers are kept from tick to tick, so that nothing is allocated once they have grown.
#pragma once

#include <span>
#include <vector>

#include "math/aabb.h"
#include "math/spatial.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

constexpr double kBaseMargin = 0.002;  // m: what gravity and solving may add to the way of one tick

struct BodyWork {
    Transform X_WB;
    Vec3 centre;             // of mass, from O, world axes
    Spatial velocity;        // about O
    Spatial bias;            // acceleration with all joint accelerations zero
    SpatialInertia inertia;  // of the body, then of its whole subtree
    Spatial impulse;         // momentum minus dt * bias force, summed over the subtree
};

struct ShapeWork {
    Transform X_WS;
    Aabb box;           // inflated by `margin`
    double margin = 0;  // contact margin of this shape at this tick, m
};

struct RobotWork {
    RobotId id;
    const RobotType* type = nullptr;
    RobotState* state = nullptr;
    Vec3 origin;  // O: the base origin, m, world
    std::vector<BodyWork> bodies;
    std::vector<Spatial> axes;        // one a degree of freedom: motion of its body per unit of v, about O
    std::vector<double> mass_matrix;  // packed by the type's paths; implicit damping and springs included
    std::vector<double> impulse;      // nv: M v + dt (applied - bias); the free velocity is M^-1 of it
    std::vector<double> velocity;     // nv: solved
    std::vector<ShapeWork> shapes;
    Aabb box;                    // interaction bound
    int contacts = 0;            // contact points that involve this robot
    bool touches_robot = false;  // has a contact with another robot or itself
    double speed = 0;            // m/s, no point of its shapes is faster
    bool ordered = false;        // an order changed it at this tick
    bool asleep = false;         // then nothing but the box is known, unless `placed`
    bool placed = false;
    bool held = false;    // rows act on it: it does not move freely
    bool pushed = false;  // a contact gives it an impulse in this tick
};

/// Everything up to the shapes and the interaction bound, for a robot that is awake; `ordered` is left as it
/// is.
void place_robot(const Model& model, RobotId id, RobotState& state, RobotWork& work);

/// Parts of RobotWork in the order of computing. `dt` in s.
void place_bodies(const RobotType& type, std::span<const double> q, RobotWork& work);
void move_bodies(const RobotType& type, std::span<const double> v, RobotWork& work);
void place_shapes(const RobotType& type, double dt, RobotWork& work);
/// work.impulse = momentum_weight * M v + dt * (applied - bias); with (1, 0) the generalised force alone.
/// With a weight, drag is taken implicitly: part of it then stands in the bodies' inertias, for
/// compute_mass_matrix.
void compute_impulse(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                     std::span<const double> v, RobotWork& work);
/// Inertias of the bodies alone, as compute_impulse sets them on its way; compute_mass_matrix needs them.
void compute_inertias(const RobotType& type, RobotWork& work);
void compute_mass_matrix(const RobotType& type, double dt, RobotWork& work);

}  // namespace roboss
