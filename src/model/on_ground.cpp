// See on_ground.h.
#include "model/on_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "geometry/come_down.h"
#include "geometry/convex_body.h"
#include "model/coordinates.h"
#include "model/may_collide.h"
#include "model/robot_state.h"
#include "model/seal.h"

namespace roboss {
namespace {

constexpr double kStays = 1e-7;  // m

/// A collision shape of a robot at the start.
struct StandingShape {
    const BodyShape* shape = nullptr;
    Transform X_WS;
    Aabb box;
};

/// The robots of a model, from `first` to `last`.
struct StandingRobots {
    std::size_t first = 0, last = 0;
    std::vector<StandingShape> shapes;
    Aabb box;
};

bool overlap_from_above(const Aabb& a, const Aabb& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

void add_shapes(const Model& model, RobotId robot, StandingRobots& standing) {
    const RobotType& type = model.type_of(robot);
    TreePlacement placement;
    place_tree(type, initial_state(model, robot).q, placement);
    for (const BodyShape& shape : type.shapes) {
        if (shape.shape.kind == ShapeKind::kPlane || shape.shape.kind == ShapeKind::kSurface) continue;
        Transform X_WS = placement.of(shape.body) * shape.X_BS;
        X_WS.p += placement.origin;
        standing.shapes.push_back({&shape, X_WS, bounds(shape.shape, X_WS)});
        standing.box.include(standing.shapes.back().box);
    }
}

Vec3 lowest_point(const StandingShape& shape) {
    const narrow::Posed posed{shape.shape->shape, shape.X_WS};
    const narrow::ConvexBody body(posed);
    const Vec3 down{0, 0, -1};
    return body.centre() + body.support(down) + body.ball() * down;
}

/// How far up the lowest point of the robots comes out of all solids that it lies in, one above the other.
double rise_out_of_solids(const Model& model, const std::vector<Aabb>& scenery,
                          const StandingRobots& robots) {
    constexpr double kBeyond = 1e-6;  // m, so that it is in the next one, if there is any
    constexpr int kSolidsMax = 100;
    const auto lower = [](const StandingShape& a, const StandingShape& b) {
        return a.box.min.z < b.box.min.z;
    };
    const StandingShape& lowest = *std::ranges::min_element(robots.shapes, lower);
    Vec3 p = lowest_point(lowest);
    const double start = p.z;
    for (int k = 0; k < kSolidsMax; ++k) {
        std::optional<double> way;
        for (std::size_t i = 0; i < scenery.size() && !way; ++i) {
            const StaticShape& solid = model.statics[i];
            if (overlaps(scenery[i], {p, p}) && may_collide(lowest.shape->material, solid.material))
                way = rise_out(p, solid.shape, solid.X_WS);
        }
        if (!way) break;
        p.z += *way + kBeyond;
    }
    return p.z - start;
}

/// How far the robots have to move along z to touch the highest scenery below.
std::optional<double> way_down(const Model& model, const std::vector<Aabb>& scenery,
                               const StandingRobots& robots) {
    const double height = robots.box.max.z - robots.box.min.z + rise_out_of_solids(model, scenery, robots);
    std::optional<double> way;
    for (std::size_t i = 0; i < scenery.size(); ++i) {
        const StaticShape& below = model.statics[i];
        if (!overlap_from_above(scenery[i], robots.box)) continue;
        for (const StandingShape& s : robots.shapes) {
            if (!overlap_from_above(scenery[i], s.box)) continue;
            if (!may_collide(s.shape->material, below.material)) continue;
            const auto met = come_down(s.shape->shape, s.X_WS, height, below.shape, below.X_WS);
            if (met && (!way || *met > *way)) way = met;
        }
    }
    return way;
}

/// The same until they stay: from the ground they may reach what was above them.
std::optional<double> way_to_ground(const Model& model, const std::vector<Aabb>& scenery,
                                    StandingRobots& robots) {
    constexpr int kRoundsMax = 8;
    std::optional<double> whole;
    for (int round = 0; round < kRoundsMax; ++round) {
        const std::optional<double> way = way_down(model, scenery, robots);
        if (!way) return whole;
        whole = whole.value_or(0) + *way;
        if (std::fabs(*way) < kStays) return whole;
        const Vec3 up{0, 0, *way};
        for (StandingShape& s : robots.shapes) s.X_WS.p += up, s.box.min += up, s.box.max += up;
        robots.box.min += up, robots.box.max += up;
    }
    return whole;
}

std::string names_text(const std::vector<std::string>& names) {
    const std::string first = "'" + names.front() + "'";
    return names.size() == 1 ? first : first + " and " + std::to_string(names.size() - 1) + " more robots";
}

std::string way_text(double way) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%+.4g", way);
    return buffer;
}

}  // namespace

OnGround stand_on_ground(Model& model, std::size_t first) {
    OnGround done;
    std::vector<Aabb> scenery;
    for (const StaticShape& shape : model.statics) scenery.push_back(bounds(shape.shape, shape.X_WS));
    for (std::size_t begin = first, end = first; begin < model.robots.size(); begin = end) {
        StandingRobots robots;
        bool fixed = false;
        for (; end < model.robots.size() && model.robots[end].family == model.robots[begin].family; ++end) {
            fixed = fixed || !model.type_of(RobotId(end)).free_base;
            if (!fixed) add_shapes(model, RobotId(end), robots);
        }
        const std::string& name = model.robots[begin].name;
        if (fixed) {
            if (!model.type_of(RobotId(begin)).is_static) done.fixed.push_back(name);
            continue;
        }
        if (robots.shapes.empty()) {
            done.bare.push_back(name);
            continue;
        }
        const std::optional<double> way = way_to_ground(model, scenery, robots);
        if (!way) {
            done.no_ground.push_back(name);
            continue;
        }
        for (std::size_t i = begin; i < end; ++i) model.robots[i].X_WR.p.z += *way;
        if (done.stand == 0) done.first = name, done.lowest = done.highest = *way;
        done.lowest = std::min(done.lowest, *way), done.highest = std::max(done.highest, *way);
        ++done.stand;
    }
    return done;
}

std::shared_ptr<const Model> stood_on_ground(const Model& model, const SourceLocation& where,
                                             Diagnostics& diagnostics) {
    auto standing = std::make_shared<Model>(model);
    report(stand_on_ground(*standing, 0), where, diagnostics);
    seal(*standing);
    return standing;
}

void report(const OnGround& done, const SourceLocation& where, Diagnostics& diagnostics) {
    if (done.stand == 1)
        diagnostics.note(
            where, "start-on-ground",
            "'" + done.first + "' stands on the ground: moved along z by " + way_text(done.highest) + " m");
    if (done.stand > 1)
        diagnostics.note(where, "start-on-ground",
                         "'" + done.first + "' and " + std::to_string(done.stand - 1) +
                             " more robots stand on the ground: moved along z by " + way_text(done.lowest) +
                             " to " + way_text(done.highest) + " m");
    if (!done.fixed.empty())
        diagnostics.note(where, "start-fixed",
                         names_text(done.fixed) + ": fixed to the world, so not moved to the ground",
                         "Move the joint that fixes it.");
    if (!done.bare.empty())
        diagnostics.warning(where, "start-no-shapes",
                            names_text(done.bare) + ": without collision shapes, so nothing can stand",
                            "Give its links <collision> shapes, or a <pose> instead of --on-ground.");
    if (!done.no_ground.empty())
        diagnostics.warning(where, "start-no-ground",
                            "there is no ground below " + names_text(done.no_ground) +
                                ": left where the file "
                                "has it",
                            "Add ground (--ground for a plane at z = 0), or leave --on-ground out.");
}

}  // namespace roboss
