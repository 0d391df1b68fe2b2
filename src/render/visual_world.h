// VisualWorld: what cameras see of a world, made of its Scene once and shared by all its runs: shapes with
// materials on the links of robots and in the world, meshes with trees, pictures, lights.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/picture.h"
#include "render/visual_mesh.h"
#include "render/visuals_of.h"

namespace roboss::render {

/// Colours are linear: the squares of those of the file.
struct Material {
    Vec3 rgb, emissive;
    double alpha = 1, roughness = 0.8, metalness = 0;
    const Picture* picture = nullptr;
};

struct VisualShape {
    TraceItem item;  // its place is X_FS, not the world's
    Transform X_FS;  // in its link, or in the world
    Material material;
    int label = 0;              // 0: none
    bool labels_model = false;  // the label is that of its model
    std::string model;          // of scenery: its model's name
    double temperature = -1;    // K; negative: that of the air
};

struct VisualLight {
    LightSpec spec;
    Pose X_FL;  // in the link, or in the world
};

struct VisualLink {
    std::vector<VisualShape> shapes;
    std::vector<VisualLight> lights;
};

class VisualWorld {
  public:
    /// `scene` must be of `model`.
    VisualWorld(const Scene& scene, const Model& model, const DecodePicture& decode);
    VisualWorld(const VisualWorld&) = delete;
    VisualWorld& operator=(const VisualWorld&) = delete;

    std::uint64_t model_hash = 0;                // of the Model that it is of
    std::vector<std::vector<VisualLink>> looks;  // links of robots that look alike
    std::vector<std::size_t> look_of;            // by RobotId
    VisualLink scenery;                          // in the world
    SceneSpec scene;
    bool has_scene = false;  // the file says something of it
    std::vector<std::unique_ptr<const VisualMesh>> meshes;
    std::vector<TraceMesh> trace_meshes;
    std::vector<std::unique_ptr<const Picture>> pictures;  // null: it cannot be decoded
    std::vector<std::string> problems;                     // of pictures, one a line

  private:
    VisualShape shape_of(const SceneShape& from) const;
};

/// Its box in the frame of the shape, m.
Aabb box_of(const TraceItem& item, const std::vector<std::unique_ptr<const VisualMesh>>& meshes);

}  // namespace roboss::render
