// One ModelSpec becomes one RobotType for each of its connected parts (links that no joint connects are
// robots of their own: a bigger unit would only make islands larger). Internal to the model layer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/hash.h"
#include "model/shape_store.h"

namespace roboss {

struct CompiledPart {
    RobotType type;
    std::string suffix;  // behind the instance's name: "" for the part with the canonical link, else "::link"
    Pose X_MR;           // robot frame in the SDF model frame
};

/// What the world around the models says.
struct Surroundings {
    bool has_fluid = false;                 // links may float
    const WindEffectsSpec* wind = nullptr;  // how the wind changes and pushes; nullptr: it is steady
};

std::vector<CompiledPart> compile_parts(const ModelSpec& spec, const Surroundings& around, ShapeStore& shapes,
                                        Diagnostics& diagnostics);

/// The links, sensors and on-board controllers of a static model as a type with a fixed base, without shapes:
/// its shapes are scenery.
RobotType stand_of(const ModelSpec& spec, ShapeStore& shapes, Diagnostics& diagnostics);
/// Whether it is a surface motion that never changes.
bool always_flows(const OnboardSpec& onboard);
/// Whether a controller of the type moves the surface of the link.
bool moves_surface(const RobotType& type, LinkId link);

Material to_material(const SurfaceSpec& surface);
void add_to_hash(Hash& hash, const Material& material);
void add_to_hash(Hash& hash, const SensorInfo& sensor);
/// The names in ROS 2 of all sensors, which are in no hash: types that differ in them alone are two.
std::string ros_names(const RobotType& type);
void add_to_hash(Hash& hash, const OnboardInfo& onboard);
/// The same of what a step reads: links, joints and channels by their numbers, no names and topics.
void add_to_step_hash(Hash& hash, const OnboardInfo& onboard);

/// Adds the on-board controllers of `spec` whose joints and links are in this part (those that name none: to
/// the main part), their channels and memory. A controller that cannot run is left out with a warning.
void add_onboard(const ModelSpec& spec, bool is_main, RobotType& type, Diagnostics& diagnostics);
/// Adds the wind to what feels it.
void add_wind(const WindEffectsSpec& wind, RobotType& type);
/// Lets every link with solid shapes float.
void float_all(RobotType& type);
/// Whether its controllers have what they name, and agree on their commands. Nothing of lay_out_onboard() is
/// needed for that.
bool onboard_fits(const RobotType& type);
/// Fills what follows from RobotType::onboard and channels: indices into the state, and its sizes.
void lay_out_onboard(RobotType& type);

/// Projected areas of the link's shapes along its axes, times their coefficients (m^2).
Vec3 drag_area(const LinkSpec& link);

/// A link of the file, yet without what it hangs on.
Link to_link(const LinkSpec& spec, int body, const Transform& X_BL);

/// Adds a link's inertia to its body: common centre of mass, parallel-axis theorem for both.
void add_mass(Body& body, const Link& link);

/// Gives bodies that can move and have no mass, or no inertia about some axis, a little of it, with a
/// warning. `links`: of type.links in `spec`.
void mend_inertia(RobotType& type, const ModelSpec& spec, const std::vector<std::size_t>& links,
                  Diagnostics& diagnostics);

/// A contact sensor of `link` with the numbers of the shapes that it names by their collisions; other sensors
/// as they are. `shapes`: how many shapes each collision of the link became.
SensorSpec with_chosen_shapes(SensorSpec sensor, const LinkSpec& link, std::span<const std::size_t> shapes,
                              Diagnostics& diagnostics);

/// Reports sensors that read a joint of another part of their model, or one that is left without motion.
void check_joints_read(const RobotType& type, const std::string& robot, Diagnostics& diagnostics);

/// Warns of joints whose effort or velocity limit is 0, as exporters write it: orders to them are refused.
void report_powerless(const RobotType& type, const ModelSpec& spec, Diagnostics& diagnostics);

/// Matrices of a robot have an entry for each degree of freedom and each one above it (DofPaths). False, and
/// an error, if they would be too large.
bool report_long_chains(const RobotType& type, const ModelSpec& spec, Diagnostics& diagnostics);

/// Radius of the sphere about the base origin that holds every shape in every pose.
double reach_of(const RobotType& type);
/// RobotType::reach_sphere, with slides within their limits: of a robot on a fixed base the sphere about its
/// first joint, if that is smaller than the one about its base (RobotType::reach).
ReachSphere reach_sphere_of(const RobotType& type);

/// RobotType::self_pairs: shapes of bodies that no joint joins, without the pairs that `spec` excludes
/// (nullptr: none). Needs RobotType::links.
std::vector<std::pair<int, int>> self_pairs_of(const RobotType& type, const ModelSpec* spec);

/// True if the joint of a body without mass moves as what hangs on it: then it needs none.
bool is_carried_by_what_follows(RobotType& type, std::size_t body);

/// Fills Body::inverse_mass_linear, inverse_inertia_angular and Dof::inverse_inertia from the mass matrix at
/// the zero pose.
void compute_mobility(RobotType& type);

/// Hash over every number and name of the type.
std::uint64_t type_hash(const RobotType& type);
/// Hash over what a step reads of the type, after lay_out_onboard(). Robots with equal ones may differ in
/// names, topics and sensors.
std::uint64_t step_hash(const RobotType& type);

}  // namespace roboss
