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
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

enum class GeometryKind {
    kPlane,
    kBox,
    kSphere,
    kCylinder,
    kCapsule,
    kEllipsoid,
    kMesh,
    kHeightmap,
    kPolyline
};

/// The triangles of a mesh file, scale applied, equal corners joined; m. Shared by all elements that name it.
struct MeshSpec {
    std::string source;  // file, for messages
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// By vertex: where a picture lies on it, from its lower left corner; empty: nowhere. Of visuals only.
    std::vector<std::array<float, 2>> uv{};
};

/// Heights (m) on a regular grid over size_x by size_y metres about `centre`; row by row, x growing within a
/// row, y from row to row.
struct HeightGridSpec {
    std::string source;
    std::size_t columns = 0, rows = 0;
    std::vector<double> heights;
    double size_x = 1, size_y = 1;
    Vec3 centre;
};

/// A geometry element. `size`: box: full edge lengths; ellipsoid: radii; plane: x, y extent (drawing only).
/// Plane: the normal is +z of the shape's own frame (the importer folds <normal> into the pose).
struct GeometrySpec {
    GeometryKind kind = GeometryKind::kBox;
    Vec3 size{1, 1, 1};
    double radius = 0;
    double length = 0;  // cylinder; capsule: of the straight part
    std::string uri;    // mesh, heightmap: the resolved file
    Vec3 scale{1, 1, 1};
    double texture_size = 0;                        // m of a heightmap that one picture covers; 0: all of it
    std::shared_ptr<const MeshSpec> mesh;           // mesh; none: the file could not be read
    std::shared_ptr<const HeightGridSpec> heights;  // heightmap; none: the file could not be read
    std::vector<Vec3> outline;                      // polyline: corners (z = 0), extruded from 0 to `length`
    bool as_hull = false;                           // mesh: its convex hull, also where it never moves
};

struct SurfaceSpec {
    double mu = 1.0;                 // SDF ode/mu
    double mu2 = 1.0;                // SDF ode/mu2
    Vec3 fdir1;                      // of mu, in the shape's own frame; zero: mu counts in all directions
    double restitution = 0.0;        // SDF bounce/restitution_coefficient
    double bounce_threshold = 0.01;  // m/s, below it nothing bounces
    double torsional_mu = 1.0;       // dimensionless; acts with one of the two radii
    double torsional_radius = 0.0;   // m, of the contact patch
    double torsional_surface_radius = 0.0;  // m, of the surface: patch radius = sqrt(this * depth)
    double rolling_mu = 0.0;                // m, <roboss:rolling_friction>
    double stiffness = 0.0;                 // N/m, SDF kp; 0: rigid
    double damping = 0.0;                   // N s/m, SDF kd; of a soft contact
    double min_depth = 0.0;                 // m, penetration that a rigid contact leaves alone
    double max_vel = -1.0;                  // m/s, with which penetration is mended; negative: as usual
    int max_contacts = -1;                  // points kept of a pair of shapes; negative: all
    unsigned collide_bitmask = 0xFFFFu;
    unsigned category_bitmask = 0xFFFFu;  // as SDF: the collide bitmask unless written
};

struct CollisionSpec {
    std::string name;
    GeometrySpec geometry;
    Pose X_LS;  // shape in link
    SurfaceSpec surface;
    SourceLocation where;
};

enum class PictureKind { kPng, kJpeg, kWebp };

/// A picture as its file has it, never decoded here. Shared by all visuals that show it.
struct PictureSpec {
    std::string source;  // file, for messages
    PictureKind kind = PictureKind::kPng;
    std::uint32_t width = 0, height = 0;  // pixels
    std::vector<std::uint8_t> bytes;
};

/// What lies over a visual's colour (SDF <pbr>, or what a mesh file says); nullptr: no such picture.
struct FinishSpec {
    std::shared_ptr<const PictureSpec> colour, normal, roughness_map, metalness_map;
    std::optional<double> roughness, metalness;  // 0..1; none: the viewer's own
};

/// A mesh of several materials is one visual for each.
struct VisualSpec {
    std::string name;
    GeometrySpec geometry;
    Pose X_LV;
    Vec3 rgb{0.7, 0.7, 0.7};
    double alpha = 1.0;
    FinishSpec finish{};
};

/// Resistance of the air (SDF <enable_wind>, <roboss:drag>).
struct DragSpec {
    bool acts = false;        // false: no drag at all
    bool wind = false;        // the wind carries the link; else it moves through still air
    double coefficient = -1;  // of the area; negative: by the kind of shape
    double area = -1;         // m^2, projected, in all directions; negative: of the shapes
    double linear = 0;        // N s/m, proportional to the velocity
};

struct LinkSpec {
    std::string name;  // nested models: "inner::link"
    Pose X_ML;         // link in the (outer) model frame, all joints at zero
    double mass = 1.0;
    Vec3 p_LC;                          // centre of mass
    Mat3 inertia_C = Mat3::identity();  // about the centre of mass, link axes, kg m^2
    bool gravity = true;
    DragSpec drag;
    std::vector<CollisionSpec> collisions;
    std::vector<VisualSpec> visuals;
    std::vector<SensorSpec> sensors;
    SourceLocation where;
};

/// The types and what each means: world/joint_type.h. Zero is a fixed joint.
enum class JointSpecKind : int;

/// A joint axis that follows another: position = multiplier * (leader's position - reference) + offset.
struct MimicSpec {
    std::string joint;  // the leader's
    int axis = 0;
    double multiplier = 1, offset = 0, reference = 0;
    std::string element;  // of the leader's axis, if its type has it (JointType::axes); else `axis` counts
};

inline constexpr double kUnlimited = 1e15;  // from here on there is no limit: SDF writes 1e16

/// One axis of a joint. Infinite limits mean none.
struct AxisSpec {
    Vec3 xyz{0, 0, 1};                   // unit, in the joint frame
    double lower = -1e16, upper = 1e16;  // rad or m
    double max_effort = -1;              // N m or N; negative: unlimited
    double max_velocity = -1;            // rad/s or m/s; negative: unlimited
    double damping = 0, friction = 0;    // N m s/rad, N m (or linear)
    double spring_stiffness = 0, spring_reference = 0;
    double limit_stiffness = 1e8, limit_dissipation = 1;
    double initial_position = 0;
    // <roboss:motor>: gains of the position motor (0: as stiff as the solver allows)
    double position_gain = 0, velocity_gain = 0;
    double armature = 0;  // rotor inertia seen at the joint, kg m^2
    std::optional<MimicSpec> mimic;

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

struct JointSpec {
    std::string name;
    JointSpecKind kind{};
    std::string parent;  // link name or "world"
    std::string child;
    Pose X_MJ;                   // joint frame in the model frame, all joints at zero
    std::vector<AxisSpec> axes;  // as JointType::axes
    double screw_pitch = 0;      // m per radian
    double ball_damping = 0;     // N m s/rad, in all directions
    // Gearbox: angle of the child against the reference link = -ratio * angle of the parent against it.
    double gearbox_ratio = 1;
    std::string gearbox_reference;  // link name or "world"
    SourceLocation where;
};

/// <plugin> and namespaced elements that are kept for others to read.
struct ExtensionElement {
    std::string name;  // e.g. "plugin", "roboss:sensor"
    std::string text;  // the element as XML
    SourceLocation where;
};

struct ModelSpec {
    std::string name;  // of the first instance; for messages
    bool is_static = false;
    bool self_collide = false;
    bool may_sleep = true;  // SDF allow_auto_disable
    std::string canonical_link;
    std::vector<LinkSpec> links;
    std::vector<JointSpec> joints;
    std::vector<ExtensionElement> extensions;
    SourceLocation where;
};

struct ModelInstance {
    std::string name;  // unique in the world
    std::size_t prototype = 0;
    Pose X_WM;
    SourceLocation where;
};

/// WGS84 anchor of the world's origin; heading: rotation of the world's x axis from east, counter-clockwise,
/// rad.
struct SphericalCoordinates {
    double latitude_rad = 0, longitude_rad = 0, elevation_m = 0, heading_rad = 0;
};

/// What is asked of the solver: one of the three settings, then numbers by name (model/accuracy.h).
struct AccuracySpec {
    std::string setting;  // "fast", "standard", "high"; empty: as it is
    struct Number {
        std::string name;
        double value = 0;
    };
    std::vector<Number> numbers;
    SourceLocation where;
};

/// Numbers that robots are stepped with where floats will do (docs/physics.md, Precision). The state is
/// always kept in doubles.
enum class Precision : std::uint8_t { kDouble, kFloat };

struct World {
    std::string name;
    std::string file;
    Vec3 gravity{0, 0, -9.8};
    Vec3 magnetic_field_T{5.5645e-6, 22.8758e-6, -42.3884e-6};
    Vec3 wind;                     // m/s
    double air_density = 1.22500;  // kg/m^3, at the world's origin
    double dt_s = 0.001;
    double real_time_factor = 1.0;  // 0: as fast as possible
    bool sleep = false;             // robots at rest sleep; the SDF importer switches it on, as in SDFormat
    std::string profile;            // name of the <physics> that was chosen
    Precision precision = Precision::kDouble;
    std::vector<AccuracySpec> accuracy;  // of the world, then of its profile: a later one wins
    std::optional<SphericalCoordinates> spherical;
    std::vector<ModelSpec> prototypes;
    std::vector<ModelInstance> instances;
    std::vector<ExtensionElement> extensions;
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
    void check(const ModelInstance& instance, Diagnostics& diagnostics);

  private:
    std::unordered_map<std::string, SourceLocation> names_;
};

}  // namespace roboss
