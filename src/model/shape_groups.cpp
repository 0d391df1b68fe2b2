// See shape_groups.h.
#include "model/shape_groups.h"

#include <algorithm>
#include <set>

#include "model/model.h"

namespace roboss {
namespace {

constexpr double kRounding = 1e-9;  // relative: a step computes places of shapes in another way

/// Nothing if a shape is not bounded.
void add_crowd(const RobotType& type, int body, std::span<const std::uint32_t> shapes, ShapeGroups& groups) {
    ShapeCrowd crowd;
    crowd.body = body;
    crowd.shapes.assign(shapes.begin(), shapes.end());
    std::vector<Aabb> boxes;
    for (const std::uint32_t s : shapes) {
        const BodyShape& shape = type.shapes[s];
        boxes.push_back(bounds(shape.shape, shape.X_BS));
        crowd.box.include(boxes.back());
        crowd.radius = std::max(crowd.radius, norm(shape.X_BS.p) + bounding_radius(shape.shape));
    }
    if (!is_finite(crowd.box.min) || !is_finite(crowd.box.max)) return;
    crowd.radius *= 1.0 + kRounding;
    crowd.tree = Bvh(boxes);
    groups.crowd_of[static_cast<std::size_t>(body + 1)] = static_cast<int>(groups.crowds.size());
    groups.crowds.push_back(std::move(crowd));
}

}  // namespace

ShapeGroups::ShapeGroups(const RobotType& type) {
    const std::size_t bodies = type.bodies.size() + 1;
    crowd_of.assign(bodies, -1);
    first.assign(bodies + 1, 0);
    for (const BodyShape& shape : type.shapes) ++first[static_cast<std::size_t>(shape.body + 2)];
    for (std::size_t b = 0; b < bodies; ++b) first[b + 1] += first[b];
    by_body.resize(type.shapes.size());
    std::vector<std::uint32_t> place = first;
    for (std::uint32_t s = 0; s < type.shapes.size(); ++s)
        by_body[place[static_cast<std::size_t>(type.shapes[s].body + 1)]++] = s;
    for (int body = -1; body + 1 < static_cast<int>(bodies); ++body)
        if (of(body).size() >= kCrowd) add_crowd(type, body, of(body), *this);
    for (std::uint32_t s = 0; s < type.shapes.size(); ++s)
        if (crowd(type.shapes[s].body) < 0) loose.push_back(s);
    std::set<std::pair<int, int>> pairs;
    for (const auto& [a, b] : type.self_pairs)
        pairs.insert(std::minmax(type.shapes[static_cast<std::size_t>(a)].body,
                                 type.shapes[static_cast<std::size_t>(b)].body));
    self_bodies.assign(pairs.begin(), pairs.end());
}

}  // namespace roboss
