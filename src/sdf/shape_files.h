// ShapeFiles: the files behind <mesh> and <heightmap>, each read once however many elements name it with the
// same scale and part. A file that cannot be read is an error at each.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "mesh/mesh_file.h"
#include "sdf/element_reader.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// What a geometry is for: to collide, its files must be there; to be seen, what is missing is a warning.
enum class GeometryUse { kCollide, kSee };

/// What a <mesh> asks of the file spec.uri.
MeshRequest mesh_request(const Element& mesh, const GeometrySpec& spec);
/// Names all that the triangles depend on.
std::string key_of(const MeshRequest& request);

class ShapeFiles {
  public:
    /// Fills spec.mesh from spec.uri and spec.scale, and spec.as_hull, for a <mesh>.
    void read_mesh(const Element& mesh, Diagnostics& diagnostics, GeometrySpec& spec);
    /// Fills spec.heights for a <heightmap>.
    void read_heightmap(const Element& heightmap, const ElementReader& reader, GeometryUse use,
                        GeometrySpec& spec);

  private:
    /// What a file holds, or why it cannot be read: told at each element that names it.
    template <class Spec>
    struct Read {
        std::shared_ptr<const Spec> content;
        std::optional<Error> error;
    };
    std::map<std::string, Read<MeshSpec>> meshes_;
    std::map<std::string, Read<HeightGridSpec>> heights_;
};

/// The corners of a <polyline>.
void read_polyline(const Element& polyline, const ElementReader& reader, GeometrySpec& spec);

}  // namespace roboss::sdf_import
