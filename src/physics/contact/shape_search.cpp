// See shape_search.h.
#include "physics/contact/shape_search.h"

#include <algorithm>
#include <limits>

namespace roboss {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr Aabb kEverywhere{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

/// Shapes of no crowd whose boxes overlap `box`.
void find_loose(const RobotWork& robot, const Aabb& box, std::vector<std::uint32_t>& out) {
    out.clear();
    for (const std::uint32_t s : robot.type->shape_groups.loose)
        if (overlaps(robot.shapes[s].box, box)) out.push_back(s);
}

/// True if a box along the axes of X comes below a plane by no more than `margin` above it.
bool reaches_plane(const Transform& X, const Aabb& box, const Transform& X_WP, double margin) {
    const Vec3 n = transpose_times(X.R, X_WP.R.col(2)), half = (box.max - box.min) * 0.5;
    const double spread = std::fabs(n.x) * half.x + std::fabs(n.y) * half.y + std::fabs(n.z) * half.z;
    return !(dot(X_WP.R.col(2), X.p - X_WP.p) + dot(n, box.centre()) - spread > margin);
}

}  // namespace

/// A crowd where it is now.
struct ShapeSearch::Crowd {
    const ShapeCrowd& shapes;
    const CrowdWorkT<double>& work;
    const Transform& X_WB;
};

ShapeSearch::Crowd ShapeSearch::crowd_of(const RobotWork& robot, std::size_t k) {
    const ShapeCrowd& crowd = robot.type->shape_groups.crowds[k];
    return {crowd, robot.crowds[k], body_frame(robot, crowd.body)};
}

/// Calls add(number of a shape) for those that may reach into the box, in any order.
template <class Add>
void ShapeSearch::find_in(const Crowd& crowd, const Aabb& box, Add add) {
    if (!overlaps(crowd.work.box, box)) return;
    const BoxFrames frames({}, crowd.X_WB, crowd.work.margin);
    crowd.shapes.tree.visit([&](const Aabb& own) { return frames.meet(box, own); },
                            [&](std::uint32_t i) { add(crowd.shapes.shapes[i]); });
}

/// `box`: of the scenery.
template <class Add>
void ShapeSearch::find_at(const Crowd& crowd, const StaticShape& scenery, const Aabb& box, Add add) {
    const auto visit = [&](auto meets) {
        crowd.shapes.tree.visit(meets, [&](std::uint32_t i) { add(crowd.shapes.shapes[i]); });
    };
    const double margin = crowd.work.margin;
    if (scenery.shape.kind == ShapeKind::kPlane)
        return visit([&](const Aabb& own) { return reaches_plane(crowd.X_WB, own, scenery.X_WS, margin); });
    if (!overlaps(crowd.work.box, box)) return;
    if (scenery.shape.kind != ShapeKind::kSurface) return find_in(crowd, box, add);
    const Mat3 R_SW = transpose(scenery.X_WS.R);
    const Transform X_SB{R_SW * crowd.X_WB.R, R_SW * (crowd.X_WB.p - scenery.X_WS.p)};
    visit([&](const Aabb& own) {
        return scenery.shape.surface->may_overlap(turned_box(X_SB, own).inflated(margin));
    });
}

/// `sorts`: the lower number comes first, else that of a.
void ShapeSearch::between_crowds(const Crowd& a, const Crowd& b, bool sorts) {
    if (!overlaps(a.work.box, b.work.box)) return;
    const BoxFrames frames(a.X_WB, b.X_WB, a.work.margin + b.work.margin);
    Bvh::visit_pairs(
        a.shapes.tree, b.shapes.tree, [&](const Aabb& x, const Aabb& y) { return frames.meet(x, y); },
        [&](std::uint32_t i, std::uint32_t j) {
            const std::uint32_t s = a.shapes.shapes[i], t = b.shapes.shapes[j];
            pairs_.emplace_back(sorts ? std::min(s, t) : s, sorts ? std::max(s, t) : t);
        });
}

void ShapeSearch::sort() {
    if (!std::ranges::is_sorted(pairs_)) std::ranges::sort(pairs_);
}

std::span<const ShapeSearch::Pair> ShapeSearch::between(const RobotWork& a, const RobotWork& b) {
    pairs_.clear();
    find_loose(a, b.box, near_a_), find_loose(b, a.box, near_b_);
    for (const std::uint32_t s : near_a_)
        for (const std::uint32_t t : near_b_)
            if (overlaps(a.shapes[s].box, b.shapes[t].box)) pairs_.emplace_back(s, t);
    for (std::size_t k = 0; k < a.crowds.size(); ++k) {
        if (!overlaps(a.crowds[k].box, b.box)) continue;
        const Crowd crowd = crowd_of(a, k);
        for (const std::uint32_t t : near_b_)
            find_in(crowd, b.shapes[t].box, [&](std::uint32_t s) { pairs_.emplace_back(s, t); });
        for (std::size_t l = 0; l < b.crowds.size(); ++l) between_crowds(crowd, crowd_of(b, l), false);
    }
    for (std::size_t l = 0; l < b.crowds.size(); ++l) {
        if (!overlaps(b.crowds[l].box, a.box)) continue;
        for (const std::uint32_t s : near_a_)
            find_in(crowd_of(b, l), a.shapes[s].box, [&](std::uint32_t t) { pairs_.emplace_back(s, t); });
    }
    if (!a.crowds.empty() || !b.crowds.empty()) sort();
    return pairs_;
}

/// Two bodies of a robot whose boxes overlap.
void ShapeSearch::between_bodies(const RobotWork& robot, int body_a, int body_b) {
    const ShapeGroups& groups = robot.type->shape_groups;
    const int crowd_a = groups.crowd(body_a), crowd_b = groups.crowd(body_b);
    const auto add = [&](std::uint32_t s, std::uint32_t t) {
        pairs_.emplace_back(std::min(s, t), std::max(s, t));
    };
    const auto crowd = [&](int k) { return crowd_of(robot, static_cast<std::size_t>(k)); };
    if (crowd_a >= 0 && crowd_b >= 0) return between_crowds(crowd(crowd_a), crowd(crowd_b), true);
    if (crowd_a >= 0 || crowd_b >= 0) {
        const Crowd many = crowd(std::max(crowd_a, crowd_b));
        for (const std::uint32_t t : groups.of(crowd_a >= 0 ? body_b : body_a))
            find_in(many, robot.shapes[t].box, [&](std::uint32_t s) { add(s, t); });
        return;
    }
    for (const std::uint32_t s : groups.of(body_a)) {
        const Aabb& box = robot.shapes[s].box;
        if (!overlaps(box, boxes_[static_cast<std::size_t>(body_b + 1)])) continue;
        for (const std::uint32_t t : groups.of(body_b))
            if (overlaps(box, robot.shapes[t].box)) add(s, t);
    }
}

std::span<const ShapeSearch::Pair> ShapeSearch::within(const RobotWork& robot) {
    const RobotType& type = *robot.type;
    const ShapeGroups& groups = type.shape_groups;
    boxes_.assign(type.bodies.size() + 1, {});
    for (const std::uint32_t s : groups.loose)
        boxes_[static_cast<std::size_t>(type.shapes[s].body + 1)].include(robot.shapes[s].box);
    for (std::size_t k = 0; k < robot.crowds.size(); ++k)
        boxes_[static_cast<std::size_t>(groups.crowds[k].body + 1)] = robot.crowds[k].box;
    pairs_.clear();
    for (const auto& [a, b] : groups.self_bodies)
        if (overlaps(boxes_[static_cast<std::size_t>(a + 1)], boxes_[static_cast<std::size_t>(b + 1)]))
            between_bodies(robot, a, b);
    sort();
    return pairs_;
}

std::span<const ShapeSearch::Pair> ShapeSearch::with_scenery(const Model& model, const RobotWork& robot) {
    pairs_.clear(), boxes_.clear();
    model.static_bvh.query(robot.box, scenery_);
    for (const std::uint32_t i : scenery_) {
        const StaticShape& scenery = model.statics[i];
        boxes_.push_back(scenery.shape.kind == ShapeKind::kPlane ? kEverywhere
                                                                 : bounds(scenery.shape, scenery.X_WS));
    }
    for (const std::uint32_t s : robot.type->shape_groups.loose) {
        if (robot.type->shapes[s].body < 0) continue;
        for (std::size_t n = 0; n < scenery_.size(); ++n)
            if (overlaps(robot.shapes[s].box, boxes_[n])) pairs_.emplace_back(s, scenery_[n]);
    }
    for (std::size_t k = 0; k < robot.crowds.size(); ++k) {
        const Crowd crowd = crowd_of(robot, k);
        if (crowd.shapes.body < 0) continue;
        for (std::size_t n = 0; n < scenery_.size(); ++n)
            find_at(crowd, model.statics[scenery_[n]], boxes_[n],
                    [&](std::uint32_t s) { pairs_.emplace_back(s, scenery_[n]); });
    }
    sort();
    return pairs_;
}

std::span<const std::uint32_t> ShapeSearch::in_box(const RobotWork& robot, const Aabb& box) {
    find_loose(robot, box, near_a_);
    for (std::size_t k = 0; k < robot.crowds.size(); ++k)
        find_in(crowd_of(robot, k), box, [&](std::uint32_t s) { near_a_.push_back(s); });
    std::ranges::sort(near_a_);
    return near_a_;
}

}  // namespace roboss
