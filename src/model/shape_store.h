// Collision elements to shapes: meshes become hulls (what moves) or triangle surfaces (scenery), a concave
// polyline several convex prisms. Each mesh is built once, however many elements name it. Internal to the
// model layer.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "model/model.h"

namespace roboss {

struct PlacedShape {
    Shape shape;
    Vec3 p_CS;  // origin of the shape in the collision's frame, whose axes it has
};

class ShapeStore {
  public:
    /// What is built goes into the model; findings into the diagnostics.
    ShapeStore(Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    /// The shapes of a collision; none if its file could not be read (reported by the importer).
    std::vector<PlacedShape> shapes_of(const CollisionSpec& collision, bool is_static);

  private:
    std::vector<PlacedShape> hull_of(const CollisionSpec& collision, bool is_static);
    std::vector<PlacedShape> surface_of(const CollisionSpec& collision);
    std::vector<PlacedShape> height_field_of(const CollisionSpec& collision, bool is_static);
    std::vector<PlacedShape> prisms_of(const CollisionSpec& collision);
    std::vector<PlacedShape> cone_of(const CollisionSpec& collision);
    Result<ConvexHull> mended_hull(const CollisionSpec& collision);
    PlacedShape keep(ConvexHull hull);

    Model& model_;
    Diagnostics& diagnostics_;
    std::map<const MeshSpec*, PlacedShape> hulls_;
    std::map<const void*, Shape> surfaces_;
    std::map<std::pair<double, double>, PlacedShape> cones_;  // by radius and length
};

}  // namespace roboss
