// Shapes of both kinds, those that a file describes and those that the Model collides with, as shapes of a
// scene; each mesh and each picture is kept once, however many shapes show it. Internal to the scene layer.
#pragma once

#include <map>
#include <optional>

#include "scene/scene.h"

namespace roboss {

class ShapeTable {
  public:
    /// Nothing where the file of a mesh could not be read, or an outline has no area.
    std::optional<SceneShape> shape_of(const GeometrySpec& geometry);
    SceneShape shape_of(const Shape& shape);
    SceneFinish finish_of(const FinishSpec& finish);
    std::vector<SceneMesh> take_meshes() { return std::move(meshes_); }
    std::vector<SceneTexture> take_textures() { return std::move(textures_); }

  private:
    std::optional<SceneMesh> mesh_of(const GeometrySpec& geometry) const;
    std::size_t keep(const void* source, SceneMesh mesh);
    std::optional<std::size_t> texture_of(const std::shared_ptr<const PictureSpec>& picture);

    std::vector<SceneMesh> meshes_;
    std::map<const void*, std::size_t> known_;  // by what a mesh was made of
    std::vector<SceneTexture> textures_;
    std::map<const void*, std::size_t> known_textures_;  // by picture
};

}  // namespace roboss
