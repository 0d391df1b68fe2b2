// A model as most engines want it: rigid bodies (links that fixed joints weld are one) and the joints between
// them, parents first. From plain data, without RoBOSS' own compiler, so that peers do not inherit its
// faults.
#pragma once

#include <vector>

#include "engines/engine.h"
#include "world/joint_type.h"

namespace roboss::bench {

/// A shape of a body.
struct PartShape {
    const CollisionSpec* collision = nullptr;
    Pose X_BS;
};

struct PartBody {
    std::string name;  // of its first link
    Pose X_MB;         // body frame (its first link's) in the model frame, all joints at zero
    double mass = 0;
    Vec3 p_BC;
    Mat3 inertia_C = Mat3{};  // about the centre of mass, body axes
    bool gravity = true;
    std::vector<PartShape> shapes;
    int joint = -1;  // index into Assembly::joints of the one that carries it; -1: free
};

struct PartJoint {
    const JointSpec* spec = nullptr;
    std::size_t index = 0;  // in ModelSpec::joints
    int parent = -1;        // body; -1: the world
    int child = -1;
    bool reversed = false;  // the tree walks it from its child link to its parent link
    bool closes_loop = false;
};

struct Assembly {
    std::vector<PartBody> bodies;    // parents before children
    std::vector<PartJoint> joints;   // not the fixed ones; the tree's joints stand in the order of its bodies
    std::vector<int> body_of_link;   // -1: part of the world
    std::vector<Pose> X_BL;          // by link; of a link of the world: X_ML
    std::vector<PartShape> scenery;  // shapes of the world; X_BS is in the model frame
};

/// Bodies, joints and shapes of a model. The model must outlive the result.
Assembly assemble(const ModelSpec& model);

/// Where a body of an instance is and how it moves.
struct BodyState {
    Pose X_WB;
    Vec3 angular, v_WC;  // rad/s; m/s of its centre of mass; world axes
};

/// How an instance starts: base and joints.
struct StartState {
    Pose X_WM;
    Vec3 angular, linear;                         // of the root body's centre of mass
    std::vector<std::vector<JointState>> joints;  // by ModelSpec::joints and axis
};

StartState start_state(const ModelSpec& model, const Pose& X_WM);

/// Forward kinematics over the tree's joints (no loops are closed, ball joints stay at zero).
std::vector<BodyState> forward_kinematics(const Assembly& assembly, const StartState& start);

/// Principal axes and moments of a symmetric matrix: m = R diag(moments) transpose(R), R a rotation.
struct PrincipalAxes {
    Mat3 R;
    Vec3 moments;
};
PrincipalAxes principal_axes(Mat3 m);

/// True if it is fixed, turns or slides about one axis, or is a ball joint: the kinds that every peer has. An
/// adapter that knows no others asks this, so that it refuses kinds that are new to it.
bool is_common(JointSpecKind kind);

/// Whether some model of the world hangs joints on joints: iterative solvers of single joints need more
/// rounds.
bool has_chains(const World& world);

/// Velocity of the surfaces of a static model (a belt), m/s, world axes; zero: they stand still.
Vec3 surface_velocity(const ModelSpec& model, const Pose& X_WM);
/// Whether surfaces of the world move.
bool has_belts(const World& world);

/// The size of bodies to which tolerances of an engine for bodies of a metre should be scaled: 0.1 where all
/// that moves is smaller than half a metre, else 1.
double body_scale(const World& world);

/// A link's state from its body's.
LinkState link_of_body(const BodyState& body, const Vec3& p_BC, const Pose& X_BL, const Vec3& p_LC);

}  // namespace roboss::bench
