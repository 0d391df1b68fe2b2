// What only viewers need of a world beside its visuals: lights, the sky, the first camera. Nothing here is in
// the Model or in the state hash.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"

namespace roboss {

/// Types of SDF `<light>`.
enum class LightKind {
    kPoint,       ///< shines in all directions
    kSpot,        ///< a cone of light
    kDirectional  ///< parallel rays from far away
};

/// A light (SDF `<light>`). It shines along `direction` in its own frame.
struct LightSpec {
    std::string name;                    ///< as in the file
    LightKind kind = LightKind::kPoint;  ///< which members below count
    Pose X_FL;                           ///< light in its link; of a light of the world: in the world
    Vec3 diffuse{1, 1, 1},               ///< colour, 0..1 each
        specular{0.1, 0.1, 0.1};         ///< colour of highlights, 0..1 each
    double intensity = 1;                ///< factor of the colours
    Vec3 direction{0, 0, -1};            ///< in the frame of the light; spot and directional
    double range = 10,                   ///< m, beyond it nothing is lit; point and spot
        constant = 1,                    ///< of 1 / (constant + linear d + quadratic d^2)
        linear = 1,                      ///< 1/m; see above
        quadratic = 0;                   ///< 1/m^2; see above
    double inner_angle = 0,              ///< rad, of the bright cone, from side to side; spot
        outer_angle = 0,                 ///< rad, of the whole cone, from side to side; spot
        falloff = 1;                     ///< from the inner to the outer cone: 1 is linear
    bool cast_shadows = false;           ///< whether what it lights throws shadows
};

/// SDF `<fog>`.
struct FogSpec {
    Vec3 rgb{1, 1, 1};  ///< colour, 0..1 each
    double start = 1,   ///< m from the camera; nearer there is none
        end = 100,      ///< m from the camera; farther all is fog
        density = 1;    ///< 0..1, share of the fog at its thickest
};

/// SDF `<scene>`. What is not written is left to the viewer.
struct SceneSpec {
    std::optional<Vec3> ambient,  ///< light from everywhere, 0..1 each
        background;               ///< colour behind everything, 0..1 each
    bool sky = false;             ///< a sky instead of the background
    bool shadows = true,          ///< whether lights may cast shadows
        grid = true;              ///< whether a grid marks the ground
    std::optional<FogSpec> fog;   ///< none: clear air
};

/// The first camera (SDF `<gui><camera>`, or the `<camera_pose>` of Gazebo's MinimalScene).
struct CameraSpec {
    std::string name;           ///< as in the file
    Pose X_WC;                  ///< camera in the world; it looks along its x axis, z is up
    bool orthographic = false;  ///< SDF `<projection_type>`
    std::string view;           ///< SDF `<view_controller>`, e.g. "orbit"; empty: not written
    std::string track;          ///< SDF `<track_visual><name>`: the model to follow; empty: none
};

/// All of it.
struct WorldLook {
    std::vector<LightSpec> lights;     ///< of the world, in the order of the file
    std::optional<SceneSpec> scene;    ///< none: the viewer's own look
    std::optional<CameraSpec> camera;  ///< none: the viewer shows the whole world
};

}  // namespace roboss
