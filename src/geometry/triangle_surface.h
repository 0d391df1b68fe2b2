// Scenery made of triangles, in its own frame: a mesh or a height field, behind one face for the narrow phase
// and for rays. Triangles know what lies beyond their edges, so that the seams inside a smooth surface do not
// count as edges.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "core/result.h"
#include "geometry/shape.h"
#include "math/aabb.h"

namespace roboss {

struct SurfaceTriangle {
    std::array<Vec3, 3> v;       // counter-clockwise seen from where n points
    Vec3 n;                      // unit
    std::array<Vec3, 3> beyond;  // third corner of the neighbour across the edge from v[i] to v[i + 1]
    std::array<double, 3>
        fold{};  // sine of the angle at that edge: > 0 valley, < 0 ridge; kBorder: no neighbour

    static constexpr double kBorder = -2.0;
};

/// The same without its neighbours.
struct SurfaceFace {
    std::array<Vec3, 3> v;
    Vec3 n;
};

/// What lies on the other side of the triangles.
enum class SurfaceSides {
    kSolid,  // a closed mesh, or ground: solid below, contacts push along n only
    kBoth    // an open sheet: contacts push to the side where the body's centre is
};

/// What a surface is built from: the same source gives the same surface, bit for bit.
struct MeshSource {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};
struct HeightSource {
    std::uint64_t columns = 0, rows = 0;
    std::vector<double> heights;
    double size_x = 0, size_y = 0;
};
using SurfaceSource = std::variant<MeshSource, HeightSource>;

class TriangleSurface {
  public:
    virtual ~TriangleSurface() = default;

    const Aabb& box() const { return box_; }
    SurfaceSides sides() const { return sides_; }
    std::uint64_t hash() const { return hash_; }  // of its content

    virtual std::size_t triangle_count() const = 0;
    /// Numbers of the triangles that may meet `box`, all that do among them, ascending; clears `out` first.
    virtual void query(const Aabb& box, std::vector<std::uint32_t>& out) const = 0;
    /// False only if query() would find none.
    virtual bool may_overlap(const Aabb& box) const = 0;
    virtual SurfaceTriangle triangle(std::uint32_t number) const = 0;
    virtual SurfaceFace face(std::uint32_t number) const = 0;
    /// Whether no neighbour of a triangle's corner rises along the unit vector d by more than the sine
    /// `tolerance`.
    virtual bool tops(std::uint32_t number, std::size_t corner, const Vec3& d, double tolerance) const = 0;
    /// Distance along the unit vector `direction` to the first triangle, or `limit` if none is nearer.
    virtual double ray(const Vec3& origin, const Vec3& direction, double limit) const = 0;
    virtual SurfaceSource source() const = 0;
    /// Whether a body below a triangle is still pushed up through it (ground has no underside).
    virtual bool is_ground() const { return false; }

  protected:
    Aabb box_;
    SurfaceSides sides_ = SurfaceSides::kBoth;
    std::uint64_t hash_ = 0;
};

/// The surface of a source that may come from anywhere; an Error if it makes no sense.
Result<std::shared_ptr<const TriangleSurface>> build_surface(const SurfaceSource& source);

Shape surface_shape(const TriangleSurface& surface);

/// Distance along a ray to one triangle (both sides count); infinity: none. Borders count as inside, so no
/// ray slips through a seam.
double ray_triangle(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& v);

/// Sine of the angle by which `beyond` rises out of the triangle's plane across the edge from a to b.
double fold_at(const Vec3& n, const Vec3& a, const Vec3& b, const Vec3& beyond);

}  // namespace roboss
