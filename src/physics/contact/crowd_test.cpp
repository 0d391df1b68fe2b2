// Bodies with very many shapes: their trees find what looking at every pair of shapes finds.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include <support/compare_lanes.h>
#include <support/crowds.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "core/thread_pool.h"
#include "geometry/collide.h"
#include "geometry/collide_surface.h"
#include "physics/contact/contact.h"

namespace roboss::test {
namespace {

constexpr int kHulls = 24;  // a link: a crowd
/// Points, by (robot b or -1, shape a, shape b).
using Found = std::map<std::tuple<int, std::uint32_t, std::uint32_t>, int>;

World two_spiders_over(const ModelSpec& scenery) {
    World world = empty_world(1e-3);
    ModelSpec model = with_hulls(spider(), kHulls, 0.12);
    model.self_collide = true;
    place(world, model, "a", {{0, 0, 0.2}, {}});
    world.instances.push_back({"b", 0, {{0.2, 0.1, 0.35}, {}}, {}});
    place(world, scenery, "scenery");
    place(world, test::scenery(box_shape({0.3, 0.2, 0.4}, SurfaceSpec{})), "box",
          {{0.3, 0, 0.1}, from_rpy(0.4, 0.3, 0)});
    return world;
}

void bend(Random& random, Simulation& sim) {
    for (RobotState& state : sim.states) {
        for (std::size_t i = 7; i < state.q.size(); ++i) state.q[i] = random.uniform(-1.5, 1.5);
        for (double& v : state.v) v = random.uniform(-2, 2);
        set_base_pose(state, {base_pose(state).p, random.rotation()});
    }
}

std::vector<RobotWork> placed(Simulation& sim) {
    std::vector<RobotWork> robots(sim.states.size());
    for (std::size_t r = 0; r < robots.size(); ++r)
        place_robot(*sim.model, sim.ids[r], sim.states[r], robots[r]);
    return robots;
}

int points_of(const Shape& a, const ShapeWork& wa, const Shape& b, const Transform& X_WB, double margin) {
    if (b.kind != ShapeKind::kSurface) return collide(a, wa.X_WS, b, X_WB, margin).count;
    SurfaceContacts found;
    collide_surface(a, wa.X_WS, *b.surface, X_WB, margin, found);
    return static_cast<int>(found.points.size());
}

/// Every shape against every other one.
Found all_pairs(const Model& model, const std::vector<RobotWork>& robots, std::size_t a) {
    Found found;
    PlacedShapes own, other;
    const RobotWork& robot = robots[a];
    own.start(robot, model.dt_s);
    const auto add = [&](int b, std::uint32_t s, std::uint32_t t, int points) {
        if (points > 0) found[{b, s, t}] = points;
    };
    const auto& shapes = robot.type->shapes;
    for (const auto& [s, t] : robot.type->self_pairs) {
        const auto i = static_cast<std::uint32_t>(s), j = static_cast<std::uint32_t>(t);
        add(static_cast<int>(a), i, j,
            points_of(shapes[i].shape, own[i], shapes[j].shape, own[j].X_WS, own[i].margin + own[j].margin));
    }
    for (std::uint32_t s = 0; s < shapes.size(); ++s) {
        for (std::size_t b = a + 1; b < robots.size(); ++b) {
            other.start(robots[b], model.dt_s);
            for (std::uint32_t t = 0; t < robots[b].type->shapes.size(); ++t)
                add(static_cast<int>(b), s, t,
                    points_of(shapes[s].shape, own[s], robots[b].type->shapes[t].shape, other[t].X_WS,
                              own[s].margin + other[t].margin));
        }
        for (std::uint32_t i = 0; i < model.statics.size(); ++i)
            add(-1, s, i,
                points_of(shapes[s].shape, own[s], model.statics[i].shape, model.statics[i].X_WS,
                          own[s].margin));
    }
    return found;
}

void expect_all_pairs(const ModelSpec& scenery) {
    Simulation sim(two_spiders_over(scenery));
    ASSERT_FALSE(sim.type(0).shape_groups.crowds.empty());
    std::size_t touching = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        bend(random, sim);
        std::vector<RobotWork> robots = placed(sim);
        ContactFinder finder;
        std::vector<Contact> contacts;
        finder.find_pairs(robots);
        finder.find(*sim.model, robots, nullptr, false, contacts);
        std::vector<Found> found(2);
        for (const Contact& c : contacts)
            ++found[static_cast<std::size_t>(c.robot_a)][{c.robot_b, c.shape_a, c.shape_b}];
        // A pair that the motion leads past each other is no contact, but it was found.
        for (const NearMiss& m : finder.near_misses())
            found[static_cast<std::size_t>(m.robot_a)].try_emplace({m.robot_b, m.shape_a, m.shape_b}, 0);
        for (std::size_t a = 0; a < 2; ++a) {
            const Found expected = all_pairs(*sim.model, robots, a);
            touching += expected.size();
            for (const auto& [pair, points] : expected)
                EXPECT_TRUE(found[a].contains(pair))
                    << "seed " << seed << ", shapes " << std::get<1>(pair) << " and " << std::get<2>(pair)
                    << ", other " << std::get<0>(pair);
            for (const auto& [pair, points] : found[a])
                EXPECT_TRUE(points == 0 || expected.contains(pair)) << "seed " << seed;
        }
    }
    EXPECT_GT(touching, 150u) << "else nothing is tested";
}

double hills(double x, double y) {
    return 0.1 * std::sin(7 * x) * std::cos(5 * y);
}

TEST(Crowd, TouchesOnAPlaneWhatAllPairsTouch) {
    expect_all_pairs(ground(SurfaceSpec{}));
}

TEST(Crowd, TouchesOnAHeightmapWhatAllPairsTouch) {
    constexpr std::size_t kSide = 33;
    std::vector<double> heights;
    for (std::size_t j = 0; j < kSide; ++j)
        for (std::size_t i = 0; i < kSide; ++i)
            heights.push_back(hills(0.1 * static_cast<double>(i), 0.1 * static_cast<double>(j)));
    expect_all_pairs(scenery(heightmap_shape(kSide, kSide, heights, 3.2, 3.2, SurfaceSpec{})));
}

TEST(Crowd, TouchesOnAMeshWhatAllPairsTouch) {
    expect_all_pairs(scenery(mesh_shape(sheet_mesh(3, 3, 30, 30, hills), SurfaceSpec{})));
}

TEST(Crowd, HighAboveTheGroundIsNotLookedAt) {
    World world = empty_world(1e-3);
    place(world, with_hulls(spider(), kHulls, 0.12), "a");
    place(world, ground(SurfaceSpec{}), "ground");
    Simulation sim(world);
    ShapeSearch search;
    set_base_pose(sim.states[0], {{0, 0, 5}, {}});
    EXPECT_TRUE(search.with_scenery(*sim.model, placed(sim)[0]).empty());
    set_base_pose(sim.states[0], {{0, 0, 0.1}, {}});
    EXPECT_FALSE(search.with_scenery(*sim.model, placed(sim)[0]).empty());
}

TEST(Crowd, TakesTheSameStepsWithAndWithoutLanes) {
    compare(
        two_spiders_over(ground(SurfaceSpec{})), [](Simulation&) {}, 8);
}

TEST(Crowd, InAHeapTakesTheSameStepsOnAnyNumberOfThreads) {
    World world = two_spiders_over(ground(SurfaceSpec{}));
    for (int i = 0; i < 2; ++i)
        world.instances.push_back({"c" + std::to_string(i), 0, {{0.1 * i, -0.1 * i, 0.5 + 0.1 * i}, {}}, {}});
    Simulation alone(world), shared(world);
    ThreadPool pool(3);
    shared.scratch.use_team(Team(pool));
    for (int i = 0; i < 10; ++i) {
        alone.step(), shared.step();
        expect_same_states(alone, shared, "a team");
    }
}

}  // namespace
}  // namespace roboss::test
