// Both keep the order of the points, so that the hull depends on the points as a sequence only.
#include "geometry/hull_points.h"

#include <algorithm>
#include <cmath>

namespace roboss {
namespace {

constexpr int kSteps = 16;  // directions along an edge of the cube that is blown up to the sphere

struct Extent {
    double low = 0, high = 0;
    double width() const { return high - low; }
};

Extent along(std::span<const Vec3> points, const Vec3& direction) {
    Extent extent{INFINITY, -INFINITY};
    for (const Vec3& p : points) {
        const double x = dot(p, direction);
        extent.low = std::min(extent.low, x), extent.high = std::max(extent.high, x);
    }
    return extent;
}

/// A unit vector along v, or `otherwise` if v is too short to have a direction.
Vec3 direction_of(const Vec3& v, const Vec3& otherwise) {
    const double length = norm(v);
    return length > 1e-12 ? v / length : otherwise;
}

/// Some unit vector across the unit vector u.
Vec3 across(const Vec3& u) {
    const Vec3 axis = std::fabs(u.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return normalized(cross(u, axis));
}

/// Three directions at right angles: the longest way in the set, the longest across it, and the normal of
/// both.
std::vector<Vec3> main_directions(std::span<const Vec3> points) {
    const Vec3 first = points.front();
    const auto further = [&](const auto& measure) {
        return *std::max_element(points.begin(), points.end(),
                                 [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
    };
    const Vec3 far = further([&](const Vec3& p) { return norm(p - first); });
    const Vec3 u = direction_of(far - first, {1, 0, 0});
    const auto sideways = [&](const Vec3& p) { return (p - first) - u * dot(p - first, u); };
    const Vec3 wide = further([&](const Vec3& p) { return norm(sideways(p)); });
    const Vec3 v =
        norm(sideways(wide)) > 1e-9 * norm(far - first) ? direction_of(sideways(wide), across(u)) : across(u);
    return {u, v, cross(u, v)};
}

/// Marks the first of the points furthest along the direction, and of those furthest against it.
void take_extremes(std::span<const Vec3> points, const Vec3& direction, std::vector<char>& taken) {
    std::size_t most = 0, least = 0;
    double high = -INFINITY, low = INFINITY;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double x = dot(points[k], direction);
        if (x > high) high = x, most = k;
        if (x < low) low = x, least = k;
    }
    taken[most] = taken[least] = 1;
}

}  // namespace

std::vector<Vec3> thickened(std::span<const Vec3> points, double thickness) {
    std::vector<Vec3> result(points.begin(), points.end());
    if (points.empty()) return result;
    for (const Vec3& direction : main_directions(points)) {
        if (along(points, direction).width() >= thickness) continue;
        const std::size_t count = result.size();
        for (std::size_t i = 0; i < count; ++i) result.push_back(result[i] + direction * (0.5 * thickness));
        for (std::size_t i = 0; i < count; ++i) result[i] -= direction * (0.5 * thickness);
    }
    return result;
}

std::vector<Vec3> extreme_points(std::span<const Vec3> points) {
    if (points.empty()) return {};
    std::vector<char> taken(points.size(), 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                Vec3 direction;
                direction[axis] = 1;
                direction[(axis + 1) % 3] = 2.0 * i / kSteps - 1;
                direction[(axis + 2) % 3] = 2.0 * j / kSteps - 1;
                take_extremes(points, direction, taken);
            }
        }
    }
    std::vector<Vec3> result;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (taken[k]) result.push_back(points[k]);
    return result;
}

}  // namespace roboss
