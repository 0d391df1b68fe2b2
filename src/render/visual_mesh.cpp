// See visual_mesh.h.
#include "render/visual_mesh.h"

#include <cmath>

#include "render/shape_rays.h"

namespace roboss::render {
namespace {

constexpr double kCrease = 0.76;  // cosine of the angle between faces from which an edge is sharp: 40 degrees

Vec3 unit_or_up(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? v / length : Vec3{0, 0, 1};
}

}  // namespace

VisualMesh::VisualMesh(const SceneMesh& mesh)
    : vertices_(mesh.vertices), corners_(mesh.triangles), uv_(mesh.uv) {
    if (uv_.size() != vertices_.size()) uv_.clear();
    std::vector<Aabb> boxes(corners_.size());
    for (std::size_t t = 0; t < corners_.size(); ++t)
        for (const std::uint32_t corner : corners_[t]) boxes[t].include(vertices_[corner]);
    for (const Aabb& box : boxes) box_.include(box);
    tree_ = make_box_tree(boxes, 4);
    for (const std::uint32_t number : tree_.order) {
        TraceTriangle& to = triangles_.emplace_back();
        const Vec3 a = vertices_[corners_[number][0]];
        const Vec3 e1 = vertices_[corners_[number][1]] - a, e2 = vertices_[corners_[number][2]] - a;
        for (std::size_t k = 0; k < 3; ++k) {
            to.corner[k] = static_cast<float>(a[k]);
            to.e1[k] = static_cast<float>(e1[k]);
            to.e2[k] = static_cast<float>(e2[k]);
        }
        to.number = number;
    }
    smooth(mesh);
}

/// The normal of a corner: of all faces around its vertex that are not beyond a sharp edge, by area.
void VisualMesh::smooth(const SceneMesh& mesh) {
    std::vector<Vec3> areas(corners_.size());
    std::vector<std::uint32_t> starts(mesh.vertices.size() + 1);
    for (std::size_t t = 0; t < corners_.size(); ++t) {
        const Vec3& a = vertices_[corners_[t][0]];
        areas[t] = roboss::cross(vertices_[corners_[t][1]] - a, vertices_[corners_[t][2]] - a);
        for (const std::uint32_t corner : corners_[t]) ++starts[corner + 1];
    }
    for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    std::vector<std::uint32_t> around(3 * corners_.size()), filled(starts.begin(), starts.end() - 1);
    for (std::size_t t = 0; t < corners_.size(); ++t)
        for (const std::uint32_t corner : corners_[t])
            around[filled[corner]++] = static_cast<std::uint32_t>(t);
    constexpr std::uint32_t kFanMost = 64;  // of a larger fan (a cap's middle) the face itself counts
    normals_.resize(corners_.size());
    for (std::size_t t = 0; t < corners_.size(); ++t) {
        const Vec3 own = unit_or_up(areas[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = corners_[t][k];
            Vec3 sum;
            if (starts[vertex + 1] - starts[vertex] <= kFanMost)
                for (std::uint32_t i = starts[vertex]; i < starts[vertex + 1]; ++i)
                    if (const Vec3& other = areas[around[i]]; dot(other, own) > kCrease * norm(other))
                        sum += other;
            const Vec3 n = norm(sum) > 0 ? unit_or_up(sum) : own;
            normals_[t][k] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
        }
    }
}

double VisualMesh::cross(const Vec3& o, const Vec3& d, Place& place) const {
    const auto& [a, b, c] = corners(place.triangle);
    const Vec3 corner = vertices_[a], e1 = vertices_[b] - corner, e2 = vertices_[c] - corner;
    const Vec3 n = roboss::cross(e1, e2);
    const double rise = dot(n, d), nn = dot(n, n);
    if (rise == 0 || nn == 0) return kNever;
    const double t = dot(n, corner - o) / rise;
    const Vec3 p = o + d * t - corner;
    place.u = dot(roboss::cross(p, e2), n) / nn;
    place.v = dot(roboss::cross(e1, p), n) / nn;
    return t;
}

Vec3 VisualMesh::flat_normal(std::uint32_t triangle) const {
    const auto& [a, b, c] = corners(triangle);
    return unit_or_up(roboss::cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]));
}

Vec3 VisualMesh::smooth_normal(const Place& place) const {
    const double shares[3] = {1 - place.u - place.v, place.u, place.v};
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::array<float, 3>& n = normals_[place.triangle][k];
        sum +=
            Vec3{static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])} * shares[k];
    }
    return unit_or_up(sum);
}

std::array<double, 2> VisualMesh::uv(const Place& place) const {
    const double shares[3] = {1 - place.u - place.v, place.u, place.v};
    std::array<double, 2> sum{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 2; ++i)
            sum[i] += shares[k] * static_cast<double>(uv_[corners(place.triangle)[k]][i]);
    return sum;
}

double VisualMesh::uv_density(std::uint32_t triangle) const {
    const std::array<std::uint32_t, 3>& at = corners(triangle);
    const std::uint32_t a = at[0], b = at[1], c = at[2];
    const double area = norm(roboss::cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]));
    const auto side = [&](std::uint32_t to, std::size_t i) {
        return static_cast<double>(uv_[to][i]) - static_cast<double>(uv_[a][i]);
    };
    const double on_picture = std::fabs(side(b, 0) * side(c, 1) - side(b, 1) * side(c, 0));
    return area > 0 ? std::sqrt(on_picture / area) : 0;
}

}  // namespace roboss::render
