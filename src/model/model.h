// Model: the compiled, immutable, hashed world that every Simulator and Client shares. A RobotType is
// compiled once however many robots are of it. Links welded by fixed joints are one Body of the dynamics
// tree.
//
// Coordinates of a robot: q = [base position p_WB0 (3), base orientation (w x y z) (4), joint coordinates], v
// = [base angular velocity w_WB0 (3), base linear velocity v_WB0 of the base origin (3), both in world axes]
// for a free base, then joint velocities. A fixed base has the 7 base coordinates too (its place in the
// world) but no base velocity.
#pragma once

#include <array>
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
#include "math/aabb.h"
#include "math/pose.h"
#include "model/dof_paths.h"
#include "model/joint_elimination.h"
#include "model/reach_sphere.h"
#include "model/shape_groups.h"
#include "model/surroundings.h"
#include "world/world.h"

namespace roboss {

/// How a body moves on its parent (world/joint_kind.h). Zero is kFree, the base of a robot that nothing
/// fixes.
enum class JointKind : std::uint8_t;

/// A rigid body of the tree. Its frame B sits at its joint: X_PB(q) = X_PJ * motion(q); bodies come parents
/// first.
struct Body {
    int parent = -1;       ///< -1: the base frame (fixed base) or the world (body 0 of a free base)
    JointKind joint{};     ///< how it moves on its parent
    Transform X_PJ;        ///< joint frame in the parent body (world, if it has none) at zero
    Vec3 axis_J{0, 0, 1};  ///< unit, in the joint frame
    double pitch = 0;      ///< of a screw: displacement along the axis, m per radian
    /// The tree walks a ball joint from the file's child to its parent: q and v stay those of the file.
    bool reversed_ball = false;
    int q_index = 0;          ///< first coordinate in RobotState::q
    int v_index = 0;          ///< first in RobotState::v
    int nv = 0;               ///< velocities of its joint
    double mass = 0;          ///< kg
    double gravity_mass = 0;  ///< kg, of the links that feel gravity
    Vec3 p_BC;                ///< m, centre of mass
    Vec3 p_BG;                ///< m, centre of the gravity mass
    Mat3 inertia_C;           ///< kg m^2, about the centre of mass, axes of B
    /// 1/kg: mobility of the centre of mass at the zero pose; scales the solver's regularisation.
    double inverse_mass_linear = 0,
           inverse_inertia_angular = 0;  ///< 1/(kg m^2): the same of its rotation
};

/// One degree of freedom of a joint (not of the free base), in the order of v.
struct Dof {
    int body = 0;                                             ///< that the joint moves, in RobotType::bodies
    JointId joint;                                            ///< that it belongs to
    double lower = -std::numeric_limits<double>::infinity(),  ///< rad or m
        upper = std::numeric_limits<double>::infinity();      ///< rad or m
    double max_effort = std::numeric_limits<double>::infinity();    ///< N m or N, of its motor
    double max_velocity = std::numeric_limits<double>::infinity();  ///< rad/s or m/s
    double damping = 0,                                             ///< N m s/rad or N s/m
        friction = 0,                                               ///< N m or N, Coulomb friction
        spring_stiffness = 0,                                       ///< N m/rad or N/m
        spring_reference = 0,                                       ///< rad or m where the spring is relaxed
        armature = 0;            ///< kg m^2 or kg, rotor inertia at the joint
    double position_gain = 0,    ///< N m/rad or N/m; 0: as stiff as the solver allows
        velocity_gain = 0;       ///< N m s/rad or N s/m
    double inverse_inertia = 0;  ///< 1/(kg m^2) or 1/kg, mobility at the zero pose
    double limit_stiffness =
               std::numeric_limits<double>::infinity(),  ///< N m/rad or N/m; infinite: a hard limit
        limit_dissipation = 0;                           ///< N m s/rad or N s/m, of a soft limit
    /// Compares all members.
    friend bool operator==(const Dof&, const Dof&) = default;
};

/// A link of the file, and the body that it is welded into.
struct Link {
    std::string name;     ///< as in LinkSpec
    int body = -1;        ///< in RobotType::bodies; -1: welded to the fixed base
    Transform X_BL;       ///< link in its body (fixed base: in the base frame)
    Vec3 p_BC;            ///< m, the link's own centre of mass, in its body
    double mass = 0;      ///< kg; for the reactions of joints, welds among them
    Mat3 inertia_C{};     ///< kg m^2, about its own centre of mass, axes of its body
    bool gravity = true;  ///< whether gravity acts on it
    int carrier = -1;     ///< the tree's joint between it and `parent`, in RobotType::joints; -1: a free base
    int parent = -1;      ///< in RobotType::links; -1: the world
};

/// A joint of the file, and where its coordinates are.
struct Joint {
    std::string name;      ///< as in JointSpec
    JointSpecKind kind{};  ///< its type
    int body = -1;         ///< the (last) body it moves; -1 for fixed
    int q_index = -1;      ///< first coordinate, -1 for fixed
    int v_index = -1;      ///< first entry of v, -1 for fixed
    int nv = 0;            ///< number of its velocities
    /// The tree walks it from child to parent: of several axes, the last comes first in q and v.
    bool reversed = false;
    int loop = -1;  ///< in RobotType::loops if it closes one: then it has no place in q and v
    Vec3 p_BJ{};    ///< m; fixed: its origin in the body that its two links are of

    /// Where axis `axis` of the file stands behind q_index and v_index.
    int axis_offset(int axis) const;
};

/// A joint that closes a kinematic loop: it is not in the tree; rows keep its two frames together.
struct LoopJoint {
    JointId joint;            ///< in RobotType::joints
    JointSpecKind kind{};     ///< its type
    int body_a = -1,          ///< body A, of the file's parent; -1: the fixed base
        body_b = -1;          ///< body B, of the file's child; -1: the fixed base
    int link_a = -1,          ///< the file's parent; -1: the world
        link_b = -1;          ///< the file's child; -1: the world
    Transform X_AJ,           ///< joint frame in A
        X_BJ;                 ///< joint frame in B; both coincide when the joint is at zero
    Vec3 axis_J{0, 0, 1},     ///< unit, first axis in the joint frame
        axis2_J{0, 1, 0};     ///< unit, second axis; a third one is at right angles to both
    double pitch = 0;         ///< of a screw, m per radian
    std::vector<Dof> dofs;    ///< its free directions
    int motor_index = 0;      ///< of the first of them in RobotState::motors
    double inverse_mass = 0,  ///< 1/kg: mobility of B against A at the joint, at the zero pose
        inverse_inertia = 0;  ///< 1/(kg m^2): the same of the rotation
};

/// Gearbox or mimic: follower = multiplier * d + higher[0] d^2 + higher[1] d^3 + higher[2] d^4 + offset,
/// where d = leader - reference, between coordinates of two degrees of freedom.
struct CoordinateCoupling {
    JointId joint;               ///< of the follower
    int follower = 0,            ///< in RobotType::dofs
        leader = 0;              ///< in RobotType::dofs
    double multiplier = 1,       ///< leader's unit to follower's unit
        offset = 0;              ///< rad or m
    double inverse_inertia = 0;  ///< 1/(kg m^2) or 1/kg, mobility of the difference at the zero pose
    double reference = 0;        ///< rad or m, of the leader; of a linear coupling it is part of the offset
    std::array<double, 3> higher{};  ///< of the powers 2 to 4; zeros: linear

    /// True if the follower does not follow in proportion.
    bool is_curved() const { return higher[0] != 0 || higher[1] != 0 || higher[2] != 0; }
    /// How far the follower stands from where it should; the multiplications in this order.
    double gap(double follower_at, double leader_at) const {
        if (!is_curved()) return follower_at - multiplier * leader_at - offset;
        const double d = leader_at - reference;
        return follower_at - (((higher[2] * d + higher[1]) * d + higher[0]) * d + multiplier) * d - offset;
    }
    /// Where the follower should stand.
    double follow(double leader_at) const { return -gap(0, leader_at); }
    /// How fast the follower moves with the leader there.
    double slope(double leader_at) const {
        if (!is_curved()) return multiplier;
        const double d = leader_at - reference;
        return ((4 * higher[2] * d + 3 * higher[1]) * d + 2 * higher[0]) * d + multiplier;
    }
    /// How the slope changes with the leader.
    double bend(double leader_at) const {
        const double d = leader_at - reference;
        return (12 * higher[2] * d + 6 * higher[1]) * d + 2 * higher[0];
    }
};

/// Friction, bounce and softness of one shape. How two of them combine: physics/contact/surface_pair.h.
struct Material {
    double mu = 1,                ///< friction coefficient, along direction_S
        mu2 = 1;                  ///< across direction_S
    Vec3 direction_S;             ///< unit, see BodyShape::direction_body; zero: mu counts in all directions
    double restitution = 0,       ///< 0: no bounce
        bounce_threshold = 0.01;  ///< m/s, below it nothing bounces
    double torsional_mu = 1,      ///< friction coefficient of turning about the normal
        patch_radius = 0,         ///< m, of the contact patch
        surface_radius = 0;       ///< m, of the surface: patch radius = sqrt(this * depth)
    double rolling = 0;           ///< m, rolling friction: torque / normal force
    double stiffness = 0,         ///< N/m of a soft contact; 0: rigid
        damping = 0;              ///< N s/m of a soft contact
    double slop = 1e-5;           ///< m, penetration that a rigid contact leaves alone
    double correction_speed = 2;  ///< m/s, at most, of recovery; only soft contacts have it as velocity
    std::uint32_t contacts_max = 0xFFFFFFFF;  ///< points kept of a pair of shapes
    std::uint32_t collide_bitmask = 0xFFFF,   ///< SDF `<collide_bitmask>`
        category_bitmask = 0xFFFF;            ///< SDF `<category_bitmask>`
};

/// How the surface of a thing moves along its shape: what touches it is carried along by friction. A point p
/// of the surface with the outward normal n moves with linear + angular x (p - at) + belt x n.
struct SurfaceFlow {
    Vec3 linear,  ///< m/s, world axes
        angular,  ///< rad/s, world axes
        belt,     ///< m/s, world axes: speed times the axis that the surface runs around, as a belt does
        at;       ///< m, world
    /// Whether it moves at all.
    bool moves() const { return linear != Vec3{} || angular != Vec3{} || belt != Vec3{}; }
    /// Compares all members.
    friend bool operator==(const SurfaceFlow&, const SurfaceFlow&) = default;
};

/// A collision shape of a robot.
struct BodyShape {
    Shape shape;        ///< kind and dimensions
    int body = -1;      ///< in RobotType::bodies; -1: fixed base
    LinkId link;        ///< of the file's link
    Transform X_BS;     ///< shape in its body
    Material material;  ///< of its surface
    /// Body in whose frame Material::direction_S is (rollers of a mecanum wheel); -1: in the shape's own.
    int direction_body = -1;
    bool moves = true;       ///< whether it takes part in the surface motion of its link
    double laser_retro = 0;  ///< the intensity that lasers read
};

/// Drag of one link: force = -(density / 2 * |A(u)| |u| + linear) * u at its centre of mass, with u its
/// velocity through the air. A(u): projected area times coefficient, given along the link's axes, in between
/// as an ellipsoid's.
struct LinkDrag {
    LinkId link;         ///< on a body
    Vec3 area;           ///< m^2, projected area times coefficient, along each axis of the link
    double linear = 0;   ///< N s/m
    bool wind = false;   ///< u is measured against the wind, else against the world
    double carried = 0;  ///< kg, that the wind carries along by Model::wind_regions
};

/// What the fluids of the world do to one link.
struct LinkFluid {
    LinkId link;                     ///< on a body
    bool buoyant = false;            ///< its solid shapes displace fluid
    std::vector<double> added_mass;  ///< as LinkSpec::added_mass
};

/// A sensor of a robot.
struct SensorInfo {
    SensorSpec spec;  ///< as in the file
    LinkId link;      ///< that carries it
};

/// One axis of a joint that an on-board controller names.
struct AxisRef {
    JointId joint;        ///< in RobotType::joints
    int motor_index = 0;  ///< in RobotState::motors
    int q_index = 0,      ///< of its coordinate in RobotState::q
        v_index = 0;      ///< of its velocity in RobotState::v
};

/// An on-board controller of a robot.
struct OnboardInfo {
    OnboardSpec spec;            ///< as in the file
    std::vector<AxisRef> axes;   ///< of the joints that it names, in the order of joints_named()
    std::vector<LinkId> links;   ///< that it names, in the order of links_named()
    LinkId base;                 ///< the model's canonical link, or the first of this robot
    std::vector<int> channels;   ///< in RobotType::channels: of each of its commands
    std::vector<int> commands;   ///< in RobotType::channels: those that it commands itself; -1: there is none
    int memory_index = 0;        ///< of its memory in RobotState::onboard
    std::vector<double> memory;  ///< at the start
};

/// A command that robots of a type take, and where the last one is kept.
struct ChannelInfo {
    Channel channel;  ///< name, topic, values
    int index = 0;  ///< in RobotState::onboard: the tick of the last command, -1 before the first; its values
    int list_index = -1;  ///< of a list: of its rows in RobotState::lists; then the values are not kept
};

/// All that robots of one kind have in common, with their names. Robots are of one *type*, in the sense of
/// docs/glossary.md, if a step treats them alike, whatever their parts, topics and sensors are called: then
/// their RobotTypes have one RobotType::like.
struct RobotType {
    std::string name;       ///< as ModelSpec::name
    bool free_base = true;  ///< whether nothing fixes body 0 to the world
    /// A static model that carries sensors or on-board controllers: no order moves it.
    bool is_static = false;
    /// Its base goes where its controller says, whatever touches it. What touches it meets its velocity:
    /// RobotState::surfaces holds that of all its links.
    bool kinematic = false;
    bool self_collide = false;  ///< whether its shapes touch each other
    bool may_sleep = true;      ///< whether it may sleep when it is at rest
    /// Free base: body 0's frame in the robot (SDF model) frame at the start; fixed base: identity.
    Transform X_RB;
    std::vector<Body> bodies;  ///< parents first
    std::vector<Dof> dofs;     ///< dofs[i] is v[base_nv() + i]
    /// For each entry of v: the previous one on its path to the root, -1 at the root.
    std::vector<int> dof_parent;
    DofPaths paths;                             ///< the same, as whole paths
    JointElimination elimination;               ///< of a robot with many loops; computed by seal()
    std::vector<Link> links;                    ///< by LinkId
    std::vector<Joint> joints;                  ///< by JointId
    std::vector<LoopJoint> loops;               ///< joints that close kinematic loops
    std::vector<CoordinateCoupling> couplings;  ///< gearboxes and mimics
    std::vector<BodyShape> shapes;              ///< collision shapes
    std::vector<LinkDrag> drags;                ///< of the links on which the air acts
    std::vector<LinkFluid> fluids;              ///< of the links that float or have added mass
    bool feels_flow = false;  ///< it has `fluids`, or controllers that are force laws; computed by seal()
    bool has_slip = false;    ///< it has wheels that slip (WheelSlip); computed by seal()
    int wind_index = -1;      ///< in RobotState::onboard, of the wind that it feels; -1: wind_of()
    std::vector<std::pair<int, int>> self_pairs;  ///< shapes of this robot that may collide with each other
    ShapeGroups shape_groups;                     ///< shapes by bodies; computed by seal()
    std::vector<SensorInfo> sensors;              ///< by the index that find_sensor() gives
    std::vector<OnboardInfo> onboard;             ///< on-board controllers, in the order in which they run
    std::vector<ChannelInfo> channels;            ///< commands that its on-board controllers take
    int onboard_size = 0,                         ///< size of RobotState::onboard
        list_count = 0;                           ///< size of RobotState::lists
    std::vector<std::uint32_t> radios;            ///< of `sensors`, those that are radios; computed by seal()
    std::vector<double> initial_q;                ///< joint coordinates behind the 7 base ones
    int nq = 7,                                   ///< size of RobotState::q
        nv = 0;                                   ///< size of RobotState::v
    double reach = 0;  ///< m, radius of the sphere about the base origin that holds every shape in every pose
    ReachSphere reach_sphere;  ///< holds them, too, and is no larger; computed by seal()
    double mass = 0;           ///< kg, of all bodies
    /// m, base frame: holds the scenery whose surfaces its controllers move; empty: there is none.
    Aabb scenery;
    /// Own gravity and wind of one robot (own_numbers.h). Empty in the types of a Model.
    OwnSurroundings around;
    std::uint64_t hash = 0;       ///< of the content
    std::uint64_t step_hash = 0;  ///< of what a step reads: no names, topics and sensors; computed by seal()
    TypeId
        like;  ///< the first in Model::types with this step_hash, for the type as a whole; computed by seal()

    /// Velocities of the base: 6 if it is free, else 0.
    int base_nv() const { return free_base ? 6 : 0; }
    /// Motors: one a Dof of the tree, then one a free direction of the loop joints.
    std::size_t motor_count() const {
        return dofs.size() + (loops.empty() ? 0
                                            : static_cast<std::size_t>(loops.back().motor_index) -
                                                  dofs.size() + loops.back().dofs.size());
    }
    /// Index into RobotState::motors of axis `axis` of the joint.
    std::size_t motor_index(const Joint& joint, int axis) const {
        const int first = joint.loop >= 0 ? loops[static_cast<std::size_t>(joint.loop)].motor_index + axis
                                          : joint.v_index + joint.axis_offset(axis) - base_nv();
        return static_cast<std::size_t>(first);
    }
    /// The degree of freedom of axis `axis` of the joint.
    const Dof& dof(const Joint& joint, int axis) const {
        return joint.loop >= 0
                   ? loops[static_cast<std::size_t>(joint.loop)].dofs[static_cast<std::size_t>(axis)]
                   : dofs[motor_index(joint, axis)];
    }
    /// Whether it has loops or couplings.
    bool has_equalities() const { return !loops.empty() || !couplings.empty(); }
    /// The link with this name; nullopt: there is none.
    std::optional<LinkId> find_link(const std::string& wanted) const;
    /// The joint with this name; nullopt: there is none.
    std::optional<JointId> find_joint(const std::string& wanted) const;
    /// The sensor with this name: index into `sensors`; nullopt: there is none.
    std::optional<std::size_t> find_sensor(const std::string& wanted) const;
    /// The command with this name: index into `channels`; nullopt: there is none.
    std::optional<std::size_t> find_channel(const std::string& wanted) const;
    /// The command that a person calls so: its name, or the last parts of its name if no other command of the
    /// type ends in them ("cmd_vel" for "robot_1/cmd_vel"). Index into `channels`; nullopt: there is none, or
    /// several.
    std::optional<std::size_t> find_command(const std::string& wanted) const;
};

/// Something with a state of its own. A static model that carries sensors or on-board controllers is one too,
/// fixed and without shapes (these are scenery).
struct Robot {
    std::string name;  ///< unique in the world
    TypeId type;       ///< in Model::types
    Pose X_WR;         ///< robot (SDF model) frame at the start
    /// Robots made of one SDF model share a family and do not collide unless self_collide.
    std::uint32_t family = 0;
    std::vector<double> start_q{},  ///< joint coordinates at the start; empty: RobotType::initial_q
        start_v{};                  ///< RobotState::v at the start; empty: it is at rest
};

/// A collision shape of the scenery.
struct StaticShape {
    Shape shape;             ///< kind and dimensions
    Transform X_WS;          ///< shape in the world
    Material material;       ///< of its surface
    std::string name;        ///< "model::link::collision"
    RobotId robot;           ///< of the sensors and controllers that its own link carries, if any
    LinkId link;             ///< of `robot`, if any
    SurfaceFlow flow;        ///< of its surface, always
    bool driven = false;     ///< its surface moves as the state of `robot` says of `link`
    double laser_retro = 0;  ///< the intensity that lasers read

    /// Whether its surface moves, or may.
    bool may_flow() const { return driven || flow.moves(); }
};

/// What the user may trade for speed; part of the Model, so part of its hash.
struct Accuracy {
    double tolerance = 1e-9;           ///< relative residual of the momentum balance
    double friction_tolerance = 1e-4;  ///< relative error of the friction bound mu * normal impulse
    int newton_max = 60;               ///< Newton iterations of a contact island and tick
    int friction_max = 20;             ///< updates of its friction bounds
    double compliance = 1e-6;  ///< regularisation of hard joint rows, relative to the mobility they act on
    double impact_compliance = 1e-6;    ///< of hard contacts that are new
    double contact_compliance = 1e-3;   ///< of hard contacts; they start from the impulse of the last tick
    double friction_compliance = 1e-2;  ///< of the friction of hard contacts
};

/// The compiled world. It is never changed: an edit makes a new one (model/edit.h).
struct Model {
    std::string name;                      ///< as World::name
    double dt_s = 0.001;                   ///< s, length of a tick
    Vec3 gravity{0, 0, -9.8};              ///< m/s^2, world axes
    Vec3 magnetic_field_T;                 ///< T, world axes
    Vec3 wind;                             ///< m/s, world axes
    std::vector<WindRegion> wind_regions;  ///< where it carries links; empty: LinkDrag::linear counts
    double air_density = 0.0;              ///< kg/m^3
    FluidLayers fluid;                     ///< in which robots float
    std::optional<SphericalCoordinates> spherical;  ///< where on Earth; none: not given
    Accuracy accuracy;                              ///< of the solver
    Precision precision = Precision::kDouble;       ///< of the steps
    bool sleep = false;                             ///< robots at rest sleep (physics/sleep.h)
    std::vector<RobotType> types;                   ///< by TypeId
    std::vector<Robot> robots;                      ///< by RobotId
    std::vector<StaticShape> statics;               ///< scenery
    Bvh static_bvh;                                 ///< over the boxes of `statics`
    /// What shapes point to. Never changed, so copies of a Model may share it.
    std::vector<std::shared_ptr<const ConvexHull>> hulls;
    /// Triangle meshes and height fields, shared like the hulls.
    std::vector<std::shared_ptr<const TriangleSurface>> surfaces;
    std::uint64_t hash = 0;  ///< of the content: equal for equal worlds

    /// The type of a robot of this Model.
    const RobotType& type_of(RobotId robot) const { return types[robots[robot.index()].type.index()]; }
    /// The type that the robot is of, in Model::types: equal for robots that a step treats alike.
    TypeId like(RobotId robot) const { return type_of(robot).like; }
    /// The robot with this name; nullopt: there is none.
    std::optional<RobotId> find_robot(const std::string& wanted) const;
};

/// Gravity at a robot of this type, m/s^2, world axes.
[[gnu::always_inline]] inline const Vec3& gravity_of(const Model& model, const RobotType& type) {
    return type.around.gravity ? *type.around.gravity : model.gravity;
}
/// The steady wind there, m/s, world axes; where the type has a wind_index, the one that it approaches.
inline const Vec3& wind_of(const Model& model, const RobotType& type) {
    return type.around.wind ? *type.around.wind : model.wind;
}

/// What a caller sets instead of the world file.
struct CompileOptions {
    std::optional<double> dt_s{};          ///< overrides the world's step
    std::optional<bool> sleep{};           ///< overrides the world's
    AccuracySpec accuracy{};               ///< after the world's own
    std::optional<Precision> precision{};  ///< overrides the world's
};

/// World to Model. Findings go to `diagnostics`. A model with errors is left out, with an error "left-out"
/// that names it; nullptr if an error concerns the whole world, or if nothing is left.
std::shared_ptr<const Model> compile(const World& world, const CompileOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace roboss
