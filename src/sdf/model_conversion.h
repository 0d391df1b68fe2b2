// Makes a ModelSpec of a model that libsdformat has read: frames and joints from libsdformat, numbers from
// the source. Nested models are flattened, their links and joints named "inner::link".
#pragma once

#include <optional>
#include <string>

#include "sdf/element_reader.h"
#include "sdf/libsdformat_reader.h"
#include "sdf/resource_paths.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// What every conversion needs.
struct Import {
    const ResourcePaths& paths;
    ElementReader reader;
    Diagnostics& diagnostics() const { return reader.diagnostics(); }
};

/// `is_static`: what the model's place in the world says (an <include> may override the model's own word).
ModelSpec convert_model(const ReadModel& read, bool is_static, const Import& import);

/// The pose in the model frame of "link", "frame", "joint", "nested" or "nested::link" at zero joints;
/// nullopt: unknown.
std::optional<Pose> pose_in_model(const ReadModel& read, const std::string& scoped_name);

// Parts of it, each in a file of its own:

/// Mass, centre and inertia of a link, as written, as SDF's defaults (reported), or automatic (auto="true").
void convert_inertial(const Element& link, const Import& import, LinkSpec& spec);

/// nullopt for <empty> or a shape that is not known (reported). `X` is the pose of the element that holds the
/// geometry; a plane's normal is folded into it.
std::optional<GeometrySpec> convert_geometry(const Element& geometry, const Import& import, Pose& X);

SurfaceSpec convert_surface(const Element& collision, const Import& import);
std::optional<CollisionSpec> convert_collision(const Element& collision, const Pose& X_LS,
                                               const Import& import);
VisualSpec convert_visual(const Element& visual, const Pose& X_LV, const Import& import);

/// A <sensor> or <roboss:sensor>; `scope` is the prefix of the names in a nested model ("inner::" or "").
SensorSpec convert_sensor(const Element& sensor, const Pose& X_LS, const std::string& scope,
                          const Import& import);

/// nullopt for a joint that cannot be kept (reported).
std::optional<JointSpec> convert_joint(const sdf::Joint& joint, const Element& source, const Pose& X_MS,
                                       const std::string& scope, const Import& import);

/// Reports plugins and other extensions under `parent`, and keeps the plugins.
void convert_extensions(const Element& parent, const Import& import,
                        std::vector<ExtensionElement>& extensions);

/// A libsdformat pose.
Pose to_pose(const ignition::math::Pose3d& pose);

}  // namespace roboss::sdf_import
