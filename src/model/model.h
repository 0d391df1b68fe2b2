// Model: the compiled, immutable, hashed world that every Simulator and Client shares. A RobotType is
// compiled once however many robots are of it. Links welded by fixed joints are one Body of the dynamics
// tree.
//
// Coordinates of a robot: q = [base position p_WB0 (3), base orientation (w x y z) (4), joint coordinates], v
// = [base angular velocity w_WB0 (3), base linear velocity v_WB0 of the base origin (3), both in world axes]
// for a free base, then joint velocities. A fixed base has the 7 base coordinates too (its place in the
// world) but no base velocity.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/types.h"
#include "geometry/bvh.h"
#include "geometry/convex_hull.h"
#include "geometry/shape.h"
#include "geometry/triangle_surface.h"
#include "math/pose.h"
#include "model/dof_paths.h"
#include "world/world.h"

namespace roboss {

/// How a body moves on its parent (world/joint_kind.h). Zero is kFree, the base of a robot that nothing
/// fixes.
enum class JointKind : std::uint8_t;

/// A rigid body of the tree. Its frame B sits at its joint: X_PB(q) = X_PJ * motion(q); bodies come parents
/// first.
struct Body {
    int parent = -1;  // -1: the base frame (fixed base) or the world (body 0 of a free base)
    JointKind joint{};
    Transform X_PJ;
    Vec3 axis_J{0, 0, 1};
    double pitch = 0;  // of a screw: way along the axis, m per radian
    // The tree walks a ball joint from the file's child to its parent: q and v stay those of the file.
    bool reversed_ball = false;
    int q_index = 0;  // first coordinate in RobotState::q
    int v_index = 0;  // first in RobotState::v
    int nv = 0;
    double mass = 0;
    double gravity_mass = 0;  // of the links that feel gravity
    Vec3 p_BC;                // centre of mass
    Vec3 p_BG;                // centre of the gravity mass
    Mat3 inertia_C;           // about the centre of mass, axes of B
    // 1/kg and 1/(kg m^2): mobility of the centre of mass at the zero pose; scales the solver's
    // regularisation.
    double inverse_mass_linear = 0, inverse_inertia_angular = 0;
};

/// One degree of freedom of a joint (not of the free base), in the order of v.
struct Dof {
    int body = 0;
    JointId joint;
    double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
    double max_effort = std::numeric_limits<double>::infinity();
    double max_velocity = std::numeric_limits<double>::infinity();
    double damping = 0, friction = 0, spring_stiffness = 0, spring_reference = 0, armature = 0;
    double position_gain = 0, velocity_gain = 0;  // 0: as stiff as the solver allows
    double inverse_inertia = 0;                   // mobility at the zero pose
    // Of a soft limit, N m/rad and N m s/rad; an infinite stiffness is a hard one.
    double limit_stiffness = std::numeric_limits<double>::infinity(), limit_dissipation = 0;
};

struct Link {
    std::string name;
    int body = -1;  // -1: welded to the fixed base
    Transform X_BL;
    Vec3 p_BC;  // the link's own centre of mass, in its body
    // What it adds to its body, and what it hangs on: for the loads of joints, welds among them.
    double mass = 0;
    Mat3 inertia_C{};  // about its own centre of mass, axes of its body
    bool gravity = true;
    int carrier = -1;  // the tree's joint between it and `parent`, in RobotType::joints; -1: a free base
    int parent = -1;   // in RobotType::links; -1: the world
};

struct Joint {
    std::string name;
    JointSpecKind kind{};
    int body = -1;     // the (last) body it moves; -1 for fixed
    int q_index = -1;  // first coordinate, -1 for fixed
    int v_index = -1;
    int nv = 0;
    bool reversed =
        false;  // the tree walks it from child to parent: of several axes, the last comes first in q and v
    int loop = -1;  // in RobotType::loops if it closes one: then it has no place in q and v
    Vec3 p_BJ{};    // fixed: its origin in the body that its two links are of

    /// Where axis `axis` of the file stands behind q_index and v_index.
    int axis_offset(int axis) const;
};

/// A joint that closes a kinematic loop: it is not in the tree; rows keep its two frames together.
struct LoopJoint {
    JointId joint;
    JointSpecKind kind{};
    int body_a = -1, body_b = -1;  // of the file's parent and child; -1: the fixed base
    int link_a = -1, link_b = -1;  // the file's parent and child; -1: the world
    Transform X_AJ, X_BJ;          // the joint's frame in both; they coincide when the joint is at zero
    Vec3 axis_J{0, 0, 1}, axis2_J{0, 1, 0};  // a third one is at right angles to both
    double pitch = 0;                        // of a screw, m per radian
    std::vector<Dof> dofs;                   // its free directions
    int motor_index = 0;                     // of the first of them in RobotState::motors
    // 1/kg and 1/(kg m^2): mobility of B against A at the joint, at the zero pose.
    double inverse_mass = 0, inverse_inertia = 0;
};

/// Gearbox or mimic: follower = multiplier * leader + offset, between coordinates of two degrees of freedom.
struct CoordinateCoupling {
    JointId joint;                 // of the follower
    int follower = 0, leader = 0;  // in RobotType::dofs
    double multiplier = 1, offset = 0;
    double inverse_inertia = 0;  // mobility of the difference at the zero pose
};

/// Friction, bounce and softness of one shape. How two of them combine: physics/surface_pair.h.
struct Material {
    double mu = 1, mu2 = 1;  // along and across direction_S
    Vec3 direction_S;        // unit, in the shape's frame; zero: mu counts in all directions
    double restitution = 0, bounce_threshold = 0.01;
    double torsional_mu = 1, patch_radius = 0, surface_radius = 0;
    double rolling = 0;                 // m
    double stiffness = 0, damping = 0;  // N/m, N s/m of a soft contact; stiffness 0: rigid
    double slop = 1e-5;                 // m, penetration that a rigid contact leaves alone
    double correction_speed = 2;        // m/s at most, while mending; it never enters the velocity
    std::uint32_t contacts_max = 0xFFFFFFFF;
    std::uint32_t collide_bitmask = 0xFFFF, category_bitmask = 0xFFFF;
};

struct BodyShape {
    Shape shape;
    int body = -1;  // -1: fixed base
    LinkId link;
    Transform X_BS;
    Material material;
};

/// Drag of one link: force = -(density / 2 * |A(u)| |u| + linear) * u at its centre of mass, with u its
/// velocity through the air. A(u): projected area times coefficient, given along the link's axes, in between
/// as an ellipsoid's.
struct LinkDrag {
    LinkId link;        // on a body
    Vec3 area;          // m^2
    double linear = 0;  // N s/m
    bool wind = false;  // u is measured against the wind, else against the world
};

struct SensorInfo {
    SensorSpec spec;
    LinkId link;
};

struct RobotType {
    std::string name;
    bool free_base = true;
    bool is_static = false;  // a static model that carries sensors: no order moves it
    bool self_collide = false;
    bool may_sleep = true;
    Transform
        X_RB;  // free base: body 0's frame in the robot (SDF model) frame at the start; fixed base: identity
    std::vector<Body> bodies;
    std::vector<Dof> dofs;  // dofs[i] is v[base_nv() + i]
    std::vector<int>
        dof_parent;  // for each entry of v: the previous one on its path to the root, -1 at the root
    DofPaths paths;  // the same, as whole paths
    std::vector<Link> links;
    std::vector<Joint> joints;
    std::vector<LoopJoint> loops;
    std::vector<CoordinateCoupling> couplings;
    std::vector<BodyShape> shapes;
    std::vector<LinkDrag> drags;
    std::vector<std::pair<int, int>> self_pairs;  // shapes of this robot that may collide with each other
    std::vector<SensorInfo> sensors;
    std::vector<double> initial_q;  // joint coordinates behind the 7 base ones
    int nq = 7, nv = 0;
    double reach = 0;  // radius of the sphere about the base origin that holds every shape in every pose
    double mass = 0;
    std::uint64_t hash = 0;

    int base_nv() const { return free_base ? 6 : 0; }
    /// Motors: one a Dof of the tree, then one a free direction of the loop joints.
    std::size_t motor_count() const {
        return dofs.size() + (loops.empty() ? 0
                                            : static_cast<std::size_t>(loops.back().motor_index) -
                                                  dofs.size() + loops.back().dofs.size());
    }
    std::size_t motor_index(const Joint& joint, int axis) const {
        const int first = joint.loop >= 0 ? loops[static_cast<std::size_t>(joint.loop)].motor_index + axis
                                          : joint.v_index + joint.axis_offset(axis) - base_nv();
        return static_cast<std::size_t>(first);
    }
    const Dof& dof(const Joint& joint, int axis) const {
        return joint.loop >= 0
                   ? loops[static_cast<std::size_t>(joint.loop)].dofs[static_cast<std::size_t>(axis)]
                   : dofs[motor_index(joint, axis)];
    }
    bool has_equalities() const { return !loops.empty() || !couplings.empty(); }
    std::optional<LinkId> find_link(const std::string& wanted) const;
    std::optional<JointId> find_joint(const std::string& wanted) const;
    std::optional<std::size_t> find_sensor(const std::string& wanted) const;
};

/// Something with a state of its own. A static model that carries sensors is one too, fixed and without
/// shapes (these are scenery).
struct Robot {
    std::string name;
    TypeId type;
    Pose X_WR;  // robot (SDF model) frame at the start
    std::uint32_t family =
        0;  // robots made of one SDF model share a family and do not collide unless self_collide
};

struct StaticShape {
    Shape shape;
    Transform X_WS;
    Material material;
    std::string name;  // "model::link::collision"
    RobotId robot;     // of the sensors that its own link carries, if any (they do not see it)
    LinkId link;
};

/// What the user may trade for speed; part of the Model, so part of its hash.
struct Accuracy {
    double tolerance = 1e-9;           // relative residual of the momentum balance
    double friction_tolerance = 1e-4;  // relative error of the friction bound mu * normal impulse
    int newton_max = 60;               // Newton iterations of a contact island and tick
    int friction_max = 20;             // updates of its friction bounds
    double compliance = 1e-6;  // regularisation of hard joint rows, relative to the mobility they act on
    double contact_compliance = 1e-3;  // of hard contacts; they start from the impulse of the last tick
};

struct Model {
    std::string name;
    double dt_s = 0.001;
    Vec3 gravity{0, 0, -9.8};
    Vec3 magnetic_field_T;
    Vec3 wind;                 // m/s
    double air_density = 0.0;  // kg/m^3
    std::optional<SphericalCoordinates> spherical;
    Accuracy accuracy;
    Precision precision = Precision::kDouble;
    bool sleep = false;  // robots at rest sleep (physics/sleep.h)
    std::vector<RobotType> types;
    std::vector<Robot> robots;
    std::vector<StaticShape> statics;
    Bvh static_bvh;
    // What shapes point to. Never changed, so copies of a Model may share it.
    std::vector<std::shared_ptr<const ConvexHull>> hulls;
    std::vector<std::shared_ptr<const TriangleSurface>> surfaces;
    std::uint64_t hash = 0;

    const RobotType& type_of(RobotId robot) const { return types[robots[robot.index()].type.index()]; }
    std::optional<RobotId> find_robot(const std::string& wanted) const;
};

struct CompileOptions {
    std::optional<double> dt_s{};          // overrides the world's step
    std::optional<bool> sleep{};           // overrides the world's
    AccuracySpec accuracy{};               // after the world's own
    std::optional<Precision> precision{};  // overrides the world's
};

/// World to Model. Findings go to `diagnostics`. A model with errors is left out, with an error "left-out"
/// that names it; nullptr if an error concerns the whole world, or if nothing is left.
std::shared_ptr<const Model> compile(const World& world, const CompileOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace roboss
