// The parts of a model's conversion: elements of the source to the World's plain data.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sdf/element_reader.h"
#include "sdf/look_files.h"
#include "sdf/resource_paths.h"
#include "sdf/shape_files.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// What every conversion needs.
struct Import {
    const ResourcePaths& paths;
    ElementReader reader;
    ShapeFiles& files;
    LookFiles& looks;
    double dt_s = 0.001;    // the world's step, which some numbers for ODE depend on
    int max_contacts = -1;  // of the world's physics, for collisions that do not say; negative: all
    Diagnostics& diagnostics() const { return reader.diagnostics(); }
};

/// The pose of a part of a link in the link frame, whatever frame it is written in.
using PoseInLink = std::function<Pose(const Element& part)>;

/// Mass, centre and inertia of a link, as written, as SDF's defaults (reported), or automatic (auto="true"):
/// that of its collisions, which stand where `pose_of` says.
void convert_inertial(const Element& link, const PoseInLink& pose_of, const Import& import, LinkSpec& spec);

/// <enable_wind> and <roboss:drag> of a link; `wind`: what the model says of <enable_wind>.
void convert_drag(const Element& link, bool wind, const Import& import, LinkSpec& spec);

/// nullopt for <empty> or a shape that is not known. `X` is the pose of the element that holds the geometry;
/// a plane's normal is folded into it.
std::optional<GeometrySpec> convert_geometry(const Element& geometry, GeometryUse use, const Import& import,
                                             Pose& X);

/// A <roboss:surface_velocity>; `scope` is the prefix of the names in a nested model.
void convert_surface_velocity(const Element& element, const std::string& scope, const Import& import,
                              ModelSpec& model);
/// Whether the collision takes part in the surface motion of its link: all do, unless only some have the
/// element.
bool takes_part_in_motion(const Element& collision);

SurfaceSpec convert_surface(const Element& collision, const Import& import);
std::optional<CollisionSpec> convert_collision(const Element& collision, const Pose& X_LS,
                                               const Import& import);
/// A visual; of a mesh, one for each of its materials.
std::vector<VisualSpec> convert_visual(const Element& visual, const Pose& X_LV, const Import& import);

/// The label of a Label plugin of Gazebo; 0: it has none that counts (reported).
int read_label(const Element& plugin, const Import& import);

/// A <sensor> or <roboss:sensor>; `scope` is the prefix of the names in a nested model ("inner::" or "").
SensorSpec convert_sensor(const Element& sensor, const Pose& X_LS, const std::string& scope,
                          const Import& import);

/// The cameras of a <sensor type="multicamera">, each a sensor named SENSOR/CAMERA; none of another sensor,
/// or where it has no <camera>.
std::vector<SensorSpec> convert_multicamera(const Element& sensor, const Pose& X_LS, const std::string& scope,
                                            const Import& import);

struct PluginSensor;
/// Plugins and other extensions under `parent`, a part of a model: controllers run on board, those that
/// publish become sensors, which are appended to `sensors`; the rest is reported. `scope` is the prefix of
/// the names in a nested model.
void convert_extensions(const Element& parent, const std::string& scope, const Import& import,
                        ModelSpec& model, std::vector<PluginSensor>& sensors);

}  // namespace roboss::sdf_import
