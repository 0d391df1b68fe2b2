// World: what the file said, as plain data, in SI units and radians. No XML, no computing. Distinct models
// are kept once
// (`prototypes`) and placed many times (`instances`), so 10000 equal cars cost little to read and to check.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "math/pose.h"
#include "onboard_kinds/buoyancy.h"
#include "onboard_kinds/onboard_spec.h"
#include "sensor_kinds/sensor_spec.h"
#include "world/look.h"

namespace roboss {

/// The shapes of SDF `<geometry>`.
enum class GeometryKind {
    kPlane,      ///< `<plane>`: infinite
    kBox,        ///< `<box>`
    kSphere,     ///< `<sphere>`
    kCylinder,   ///< `<cylinder>`: axis along z
    kCapsule,    ///< `<capsule>`: axis along z
    kEllipsoid,  ///< `<ellipsoid>`
    kMesh,       ///< `<mesh>`: triangles of a file
    kHeightmap,  ///< `<heightmap>`
    kPolyline,   ///< `<polyline>`: an outline, extruded along z
    kCone        ///< `<cone>`: axis along z, tip up, centred on its height
};

/// The triangles of a mesh file, scale applied, equal corners joined; m. Shared by all elements that name it.
struct MeshSpec {
    std::string source;                                   ///< file, for messages
    std::vector<Vec3> vertices;                           ///< m, in the frame of the mesh
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`, three by triangle
    /// By vertex: where a picture lies on it, from its lower left corner; empty: nowhere. Of visuals only.
    std::vector<std::array<float, 2>> uv{};
};

/// Heights (m) on a regular grid over size_x by size_y metres about `centre`; row by row, x growing within a
/// row, y from row to row.
struct HeightGridSpec {
    std::string source;           ///< file, for messages
    std::size_t columns = 0,      ///< points along x
        rows = 0;                 ///< points along y
    std::vector<double> heights;  ///< m; columns * rows of them
    double size_x = 1,            ///< m, edge along x
        size_y = 1;               ///< m, edge along y
    Vec3 centre;                  ///< m, of the grid, in the frame of the shape
};

/// A geometry element. `size`: box: full edge lengths; ellipsoid: radii; plane: x, y extent (drawing only).
/// Plane: the normal is +z of the shape's own frame (the importer folds `<normal>` into the pose).
struct GeometrySpec {
    GeometryKind kind = GeometryKind::kBox;  ///< which members below count
    Vec3 size{1, 1, 1};                      ///< m; see above
    double radius = 0;                       ///< m; sphere, cylinder, capsule; cone: of its base
    double length = 0;        ///< m; cylinder, cone, polyline: height along z; capsule: of the straight part
    std::string uri;          ///< mesh, heightmap: the resolved file
    Vec3 scale{1, 1, 1};      ///< mesh: `<scale>`, already applied to `mesh`
    double texture_size = 0;  ///< m of a heightmap that one picture covers; 0: all of it
    std::shared_ptr<const MeshSpec> mesh;           ///< mesh; none: the file could not be read
    std::shared_ptr<const HeightGridSpec> heights;  ///< heightmap; none: the file could not be read
    std::vector<Vec3> outline;  ///< polyline: corners (z = 0), extruded from 0 to `length`
    bool as_hull = false;       ///< mesh: its convex hull, also where it never moves
};

/// How a collision rubs, bounces and gives way (SDF `<surface>`). How two of them combine:
/// physics/contact/surface_pair.h.
struct SurfaceSpec {
    double mu = 1.0;                 ///< friction coefficient, SDF `<ode><mu>`
    double mu2 = 1.0;                ///< across `fdir1`, SDF `<ode><mu2>`; without `fdir1` it has no effect
    Vec3 fdir1;                      ///< of mu, in the shape's own frame; zero: mu counts in all directions
    std::string fdir1_link;          ///< SDF `gz:expressed_in`: the link in whose frame fdir1 is instead
    double restitution = 0.0;        ///< SDF `<bounce><restitution_coefficient>`; 0: no bounce
    double bounce_threshold = 0.01;  ///< m/s, below it nothing bounces
    double torsional_mu = 1.0;       ///< dimensionless; acts with one of the two radii
    double torsional_radius = 0.0;   ///< m, of the contact patch
    double torsional_surface_radius = 0.0;  ///< m, of the surface: patch radius = sqrt(this * depth)
    double rolling_mu = 0.0;                ///< m, `<roboss:rolling_friction>`
    double stiffness = 0.0;                 ///< N/m, SDF kp; 0: rigid
    double damping = 0.0;                   ///< N s/m, SDF kd; of a soft contact
    double min_depth = 0.0;                 ///< m, penetration that a rigid contact leaves alone
    double max_vel = -1.0;                  ///< m/s, with which penetration is mended; negative: as usual
    int max_contacts = -1;                  ///< points kept of a pair of shapes; negative: all
    unsigned collide_bitmask = 0xFFFFu;     ///< SDF `<collide_bitmask>`
    unsigned category_bitmask = 0xFFFFu;    ///< as SDF: the collide bitmask unless written
};

/// A shape that touches others (SDF `<collision>`).
struct CollisionSpec {
    std::string name;        ///< as in the file
    GeometrySpec geometry;   ///< shape and dimensions
    Pose X_LS;               ///< shape in link
    SurfaceSpec surface;     ///< friction, bounce and softness
    bool moves = true;       ///< whether it takes part in the surface motion of its link, if that has one
    double laser_retro = 0;  ///< the intensity that lasers read, SDF `<laser_retro>`
    SourceLocation where;    ///< of the element
};

/// File formats of pictures.
enum class PictureKind {
    kPng,   ///< PNG
    kJpeg,  ///< JPEG
    kWebp   ///< WebP
};

/// A picture as its file has it, never decoded here. Shared by all visuals that show it.
struct PictureSpec {
    std::string source;                    ///< file, for messages
    PictureKind kind = PictureKind::kPng;  ///< format of `bytes`
    std::uint32_t width = 0,               ///< pixels
        height = 0;                        ///< pixels
    std::vector<std::uint8_t> bytes;       ///< the file as it is
};

/// What lies over a visual's colour (SDF `<pbr>`, or what a mesh file says); nullptr: no such picture.
struct FinishSpec {
    std::shared_ptr<const PictureSpec> colour,  ///< SDF `<albedo_map>`
        normal,                                 ///< SDF `<normal_map>`
        roughness_map,                          ///< SDF `<roughness_map>`
        metalness_map;                          ///< SDF `<metalness_map>`
    std::optional<double> roughness,            ///< 0..1, SDF `<roughness>`; none: the viewer's own
        metalness;                              ///< 0..1, SDF `<metalness>`; none: the viewer's own
};

/// A shape that is only drawn (SDF `<visual>`).
/// A mesh of several materials is one visual for each.
struct VisualSpec {
    std::string name;                ///< as in the file
    GeometrySpec geometry;           ///< shape and dimensions
    Pose X_LV;                       ///< visual in link
    Vec3 rgb{0.7, 0.7, 0.7};         ///< colour, 0..1 each
    double alpha = 1.0;              ///< opacity: 0 is invisible, 1 opaque
    FinishSpec finish{};             ///< pictures and gloss
    std::optional<Vec3> specular{},  ///< colour of highlights, 0..1 each; none: the viewer's own
        emissive{};                  ///< light that it gives off, 0..1 each; none: nothing
    bool cast_shadows = true;        ///< SDF `<cast_shadows>`
    std::uint32_t visibility_flags =
        0xFFFFFFFF;                       ///< cameras see it whose `<visibility_mask>` has one of these bits
    int label = 0;                        ///< 1..255, of Gazebo's Label plugin; 0: none
    bool labels_model = false;            ///< the label is that of the model: its visuals are one thing
    std::optional<double> temperature{};  ///< K, of Gazebo's Thermal plugin; none: that of the air
};

/// Resistance of the air (SDF `<enable_wind>`, `<roboss:drag>`).
struct DragSpec {
    bool acts = false;        ///< false: no drag at all
    bool wind = false;        ///< the wind carries the link; else it moves through still air
    double coefficient = -1;  ///< of the area; negative: by the kind of shape
    double area = -1;         ///< m^2, projected, in all directions; negative: of the shapes
    double linear = 0;        ///< N s/m, proportional to the velocity
};

/// Numbers of an added mass: xx, xy ... xr, yy ... rr, the upper triangle of a symmetric 6x6 matrix, row by
/// row: acceleration (x y z p q r) to force, kg, kg m, kg m^2, at the link's origin, link axes.
inline constexpr std::size_t kAddedMassNumbers = 21;

/// A rigid body of a model (SDF and URDF `<link>`).
struct LinkSpec {
    std::string name;                   ///< nested models: "inner::link"
    Pose X_ML;                          ///< link in the (outer) model frame, all joints at zero
    double mass = 1.0;                  ///< kg
    Vec3 p_LC;                          ///< m, centre of mass in the link frame
    Mat3 inertia_C = Mat3::identity();  ///< about the centre of mass, link axes, kg m^2
    bool gravity = true;                ///< whether gravity acts on it, SDF `<gravity>`
    DragSpec drag;                      ///< resistance of the air
    bool buoyant = false;               ///< the world's fluids carry it
    std::vector<double> added_mass;     ///< SDF `<fluid_added_mass>`: kAddedMassNumbers numbers; empty: none
    std::vector<CollisionSpec> collisions;  ///< shapes that touch
    std::vector<VisualSpec> visuals;        ///< shapes that are drawn
    std::vector<SensorSpec> sensors;        ///< sensors that it carries
    std::vector<LightSpec> lights;          ///< lights that move with it
    /// It only stands between two joints of one body of the file (MJCF): it has no mass and no shapes, and
    /// gets none.
    bool between_joints = false;
    SourceLocation where;  ///< of the element
};

/// The types and what each means: world/joint_type.h. Zero is a fixed joint.
enum class JointSpecKind : int;

/// A joint axis that follows another: position = multiplier * d + higher[0] d^2 + higher[1] d^3 +
/// higher[2] d^4 + offset, where d = leader's position - reference.
struct MimicSpec {
    std::string joint;      ///< the leader's
    int axis = 0;           ///< which of the leader's axes, from 0
    double multiplier = 1,  ///< leader's unit to follower's unit
        offset = 0,         ///< rad or m, of the follower
        reference = 0;      ///< rad or m, of the leader
    std::string element;  ///< of the leader's axis, if its type has it (JointType::axes); else `axis` counts
    std::array<double, 3> higher{};  ///< of the powers 2 to 4 (MJCF `polycoef`); zeros: in proportion

    /// True if it follows in proportion.
    bool is_linear() const { return higher[0] == 0 && higher[1] == 0 && higher[2] == 0; }
};

/// From here on a limit means none: SDF writes 1e16.
inline constexpr double kUnlimited = 1e15;

/// One axis of a joint. Infinite limits mean none.
struct AxisSpec {
    Vec3 xyz{0, 0, 1};               ///< unit, in the joint frame
    double lower = -1e16,            ///< rad or m, SDF `<limit><lower>`
        upper = 1e16;                ///< rad or m, SDF `<limit><upper>`
    double max_effort = -1;          ///< N m or N, SDF `<limit><effort>`; negative: unlimited
    double max_velocity = -1;        ///< rad/s or m/s, SDF `<limit><velocity>`; negative: unlimited
    double damping = 0,              ///< N m s/rad or N s/m, SDF `<dynamics><damping>`
        friction = 0;                ///< N m or N, Coulomb friction, SDF `<dynamics><friction>`
    double spring_stiffness = 0,     ///< N m/rad or N/m, SDF `<dynamics><spring_stiffness>`
        spring_reference = 0;        ///< rad or m where the spring is relaxed
    double limit_stiffness = 1e8,    ///< N m/rad or N/m, SDF `<limit><stiffness>`; from 1e8 on: a hard limit
        limit_dissipation = 1;       ///< N m s/rad or N s/m, SDF `<limit><dissipation>`; of a soft limit
    double initial_position = 0;     ///< rad or m at the start
    double position_gain = 0,        ///< N m/rad or N/m, `<roboss:motor>`; 0: as stiff as the solver allows
        velocity_gain = 0;           ///< N m s/rad or N s/m, `<roboss:motor>`
    double armature = 0;             ///< rotor inertia seen at the joint, kg m^2 or kg, `<roboss:motor>`
    std::optional<MimicSpec> mimic;  ///< the axis that it follows, SDF `<mimic>`; none: it is free

    /// Whether at least one of `lower` and `upper` is a limit.
    bool has_limits() const { return lower > -kUnlimited || upper < kUnlimited; }
    /// Whether it says more than a direction (limits' softness without limits says nothing).
    bool says_more() const {
        const bool dynamic = damping != 0 || friction != 0 || spring_stiffness != 0;
        const auto bounds = [](double most) { return most >= 0 && most < kUnlimited; };
        const bool driven = position_gain != 0 || velocity_gain != 0 || armature != 0;
        return dynamic || has_limits() || bounds(max_effort) || bounds(max_velocity) || driven ||
               initial_position != 0 || mimic;
    }
};

/// A joint between two links (SDF and URDF `<joint>`), or a gearbox between two joints.
struct JointSpec {
    std::string name;      ///< unique in its model
    JointSpecKind kind{};  ///< its type, e.g. revolute; default: fixed
    std::string parent;    ///< link name or "world"
    std::string child;     ///< link name
    Pose X_MJ;             ///< joint frame in the model frame, all joints at zero
    /// The joint frame as the child carries it, if that is not X_MJ when all joints are at zero; of loops
    /// only.
    std::optional<Pose> X_MJ_child{};
    bool closes_loop = false;    ///< it is never one of the tree's joints (MJCF equalities)
    std::vector<AxisSpec> axes;  ///< as JointType::axes
    double screw_pitch = 0;      ///< of a screw: m per radian
    double ball_damping = 0,     ///< of a ball: N m s/rad, in all directions
        ball_armature = 0;       ///< of a ball: kg m^2, rotor inertia in all directions
    /// Gearbox: angle of the child against the reference link = -ratio * angle of the parent against it.
    double gearbox_ratio = 1;
    std::string gearbox_reference;  ///< link name or "world"
    SourceLocation where;           ///< of the element
};

/// What becomes of a `<plugin>`.
enum class PluginFate {
    kRuns,       ///< as an on-board controller, a sensor or a setting of the world
    kNotNeeded,  ///< it draws, or does what every run does anyway (physics, sensors, user commands)
    kNotRun      ///< it has no counterpart, or cannot run as it is written
};

/// `<plugin>` and namespaced elements that are kept for others to read.
struct ExtensionElement {
    std::string name;                       ///< e.g. "plugin", "roboss:sensor"
    std::string text;                       ///< the element as XML
    SourceLocation where;                   ///< of the element
    std::string plugin;                     ///< of a plugin: its class; if it names none, its file
    std::string parent;                     ///< of a plugin: the element that it is in, e.g. "model", "link"
    std::string owner;                      ///< name of that, from its model down: "arm::hand"; "": the model
    PluginFate fate = PluginFate::kNotRun;  ///< of a plugin
    std::string reason;                     ///< of a plugin that does not run: why
};

/// A frame on a link: SDF `<frame>`, or a link of a URDF that a fixed joint merges into another one.
struct FrameSpec {
    std::string name;  ///< as in the file; in nested models "inner::frame"
    std::string link;  ///< that it is fixed to
    Pose X_LF;         ///< m, in that link's frame
};

/// A model (SDF `<model>`, URDF `<robot>`) with its nested models merged into it; poses at joint zero.
struct ModelSpec {
    std::string name;           ///< of the first instance; for messages
    bool is_static = false;     ///< SDF `<static>`: scenery that never moves
    bool kinematic = false;     ///< goes where its controller says, whatever touches it
    bool self_collide = false;  ///< SDF `<self_collide>`: its links touch each other
    bool may_sleep = true;      ///< SDF allow_auto_disable
    bool shared_names = false;  ///< a joint may have the name of a link (MJCF)
    /// Pairs of links that do not touch each other even so (MJCF `<exclude>`).
    std::vector<std::pair<std::string, std::string>> no_contact{};
    std::string canonical_link;                ///< name of the link that the model frame is fixed to
    std::vector<LinkSpec> links;               ///< in the order of the file
    std::vector<JointSpec> joints;             ///< in the order of the file
    std::vector<OnboardSpec> onboard;          ///< on-board controllers, in the order of the file
    std::vector<ExtensionElement> extensions;  ///< kept for other programs
    std::vector<FrameSpec> frames;             ///< named places on links; nothing that is compiled
    SourceLocation where;                      ///< of the element
};

/// Where a link is and how it moves at the start (SDF `<state>`). The joints follow from it.
struct LinkStart {
    std::string link;          ///< name in the model
    std::optional<Pose> X_WL;  ///< link frame in the world; none: as the joints put it
    Vec3 linear,               ///< m/s, of the link's origin, world axes
        angular;               ///< rad/s, world axes
};

/// Where an axis of a joint is at the start, instead of AxisSpec::initial_position.
struct AxisStart {
    std::string joint;    ///< name in the model
    int axis = 0;         ///< index into JointSpec::axes
    double position = 0;  ///< rad or m
};

/// A model of the world: a prototype at a pose.
struct ModelInstance {
    std::string name;                ///< unique in the world
    std::size_t prototype = 0;       ///< index into World::prototypes
    Pose X_WM;                       ///< model frame in the world at the start
    SourceLocation where;            ///< of the element
    std::vector<LinkStart> links{};  ///< that do not start at rest where the model puts them
    std::vector<AxisStart> axes{};   ///< that do not start where the model puts them
};

/// WGS84 anchor of the world's origin; heading: rotation of the world's x axis from east, counter-clockwise,
/// rad.
struct SphericalCoordinates {
    double latitude_rad = 0,  ///< north is positive
        longitude_rad = 0,    ///< east is positive
        elevation_m = 0,      ///< of the world's origin
        heading_rad = 0;      ///< of the world's x axis; see above
};

/// What is asked of the solver: one of the three settings, then numbers by name (model/accuracy.h).
struct AccuracySpec {
    std::string setting;  ///< "fast", "standard", "high"; empty: as it is
    /// One number that is set by its name.
    struct Number {
        std::string name;  ///< as AccuracyNumber::name
        double value = 0;  ///< in the unit of that number
    };
    std::vector<Number> numbers;  ///< they count over the setting
    SourceLocation where;         ///< of the element
};

/// Numbers that robots are stepped with where floats will do (docs/physics.md, Precision). The state is
/// always kept in doubles.
enum class Precision : std::uint8_t {
    kDouble,  ///< 64-bit floats
    kFloat    ///< 32-bit floats
};

/// What a world file describes (SDF `<world>`): models and settings.
struct World {
    std::string name;                                           ///< SDF `<world name>`
    std::string file;                                           ///< path of the file, for messages
    Vec3 gravity{0, 0, -9.8};                                   ///< m/s^2, world axes
    Vec3 magnetic_field_T{5.5645e-6, 22.8758e-6, -42.3884e-6};  ///< T, world axes
    Vec3 wind;                                    ///< m/s, world axes, SDF `<wind><linear_velocity>`
    double air_density = 1.22500;                 ///< kg/m^3, at the world's origin
    std::optional<BuoyancySpec> buoyancy;         ///< fluids that carry; none: nothing floats
    std::optional<WindEffectsSpec> wind_effects;  ///< how the wind changes and pushes; none: it is steady
    double dt_s = 0.001;                          ///< s, length of a step, SDF `<max_step_size>`
    double real_time_factor = 1.0;                ///< 0: as fast as possible
    bool sleep = false;   ///< robots at rest sleep; the SDF importer switches it on, as in SDFormat
    std::string profile;  ///< name of the `<physics>` that was chosen
    Precision precision = Precision::kDouble;       ///< of the steps
    std::vector<AccuracySpec> accuracy;             ///< of the world, then of its profile: a later one wins
    std::optional<SphericalCoordinates> spherical;  ///< where on Earth; none: the file does not say
    std::vector<ModelSpec> prototypes;              ///< distinct models, each kept once
    std::vector<ModelInstance> instances;           ///< models of the world, in the order of the file
    std::vector<ExtensionElement> extensions;       ///< kept for other programs
    WorldLook look;                                 ///< lights, sky and first camera, for viewers
};

/// Everything about a World that needs no XML to be judged: finite numbers, masses that are not negative,
/// inertias that a real body can have, unique names, joints between links that exist. All findings at once.
void validate(const World& world, Diagnostics& diagnostics);

/// The same of one model.
void validate(const ModelSpec& model, Diagnostics& diagnostics);

/// The same of what a World says beside its models.
void validate_settings(const World& world, Diagnostics& diagnostics);

/// The same of instances, one after the other: their names must differ.
class InstanceCheck {
  public:
    /// Adds an error if the name is empty or an earlier instance has it, or if the pose is not finite.
    void check(const ModelInstance& instance, Diagnostics& diagnostics);

  private:
    std::unordered_map<std::string, SourceLocation> names_;
};

}  // namespace roboss
