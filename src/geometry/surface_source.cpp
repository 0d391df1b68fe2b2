// Surfaces from sources that were sent: nothing in them is taken on trust.
#include <algorithm>

#include "geometry/height_field.h"
#include "geometry/triangle_mesh.h"

namespace roboss {
namespace {

constexpr double kFurthest = 1e9;  // m

using Built = Result<std::shared_ptr<const TriangleSurface>>;

Built build(const MeshSource& source) {
    const auto sensible = [](const Vec3& v) { return is_finite(v) && norm(v) < kFurthest; };
    if (!std::all_of(source.vertices.begin(), source.vertices.end(), sensible))
        return Error{"a corner of a triangle mesh is not finite or beyond all sizes", ""};
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= source.vertices.size())
                return Error{"a triangle names a corner that is not there", ""};
    return std::shared_ptr<const TriangleSurface>(
        std::make_shared<const TriangleMesh>(source.vertices, source.triangles));
}

Built build(const HeightSource& source) {
    const auto sensible = [](double x) { return x > -kFurthest && x < kFurthest; };
    const bool full = source.columns >= 2 && source.rows >= 2 && source.columns < (1u << 30) &&
                      source.heights.size() / source.columns == source.rows &&
                      source.heights.size() % source.columns == 0;
    if (!full) return Error{"a height field is no full grid", ""};
    if (!std::all_of(source.heights.begin(), source.heights.end(), sensible) || !sensible(source.size_x) ||
        !sensible(source.size_y) || !(source.size_x > 0 && source.size_y > 0))
        return Error{"a height field is not finite or beyond all sizes", ""};
    return std::shared_ptr<const TriangleSurface>(std::make_shared<const HeightField>(
        source.columns, source.rows, source.heights, source.size_x, source.size_y));
}

}  // namespace

Result<std::shared_ptr<const TriangleSurface>> build_surface(const SurfaceSource& source) {
    return std::visit([](const auto& s) { return build(s); }, source);
}

}  // namespace roboss
