// Materials that OGRE scripts describe, as colours and a picture: those of Gazebo by their names, and those
// of
// `.material` files beside a model.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "math/vec3.h"

namespace roboss::sdf_import {

struct OgreMaterial {
    std::optional<Vec3> ambient, diffuse, specular, emissive;  // 0..1 each
    double alpha = 1;
    std::string texture;  // name of a picture file; empty: none
};

using OgreMaterials = std::map<std::string, OgreMaterial>;

/// The materials of a script, by name. What is not a material or not a colour is skipped. A material that
/// inherits from one of the script or of Gazebo begins as that one.
OgreMaterials parse_material_script(std::string_view text);

/// A material of Gazebo ("Gazebo/Grey") by its name; nullptr: there is none.
const OgreMaterial* gazebo_material(const std::string& name);

}  // namespace roboss::sdf_import
