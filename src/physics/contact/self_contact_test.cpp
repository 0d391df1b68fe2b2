// A robot against itself: looking at bodies first finds what looking at every pair of its shapes finds.
#include <gtest/gtest.h>

#include <map>

#include <support/meshes.h>
#include <support/random.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "geometry/collide.h"
#include "physics/contact/contact.h"

namespace roboss::test {
namespace {

/// A spider of boxes and of balls with very many corners, two shapes on each link.
ModelSpec rough_spider() {
    ModelSpec m = spider();
    m.self_collide = true;
    for (LinkSpec& l : m.links) {
        const bool is_body = l.name == "body";
        const Vec3 size = is_body ? Vec3{0.3, 0.2, 0.1} : Vec3{0.1, 0.02, 0.03};
        l.collisions.push_back(box_shape(size, surface(0.5)));
        const MeshSpec ball = ball_mesh(is_body ? 0.12 : 0.03, 2);
        l.collisions.push_back(mesh_shape(ball, surface(0.5), {{0.06, 0, 0.01}, {}}));
    }
    return m;
}

using Found = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;  // points, by shapes

TEST(SelfContact, OfARobotAreThoseOfAllPairsOfItsShapes) {
    World world = empty_world(1e-3);
    place(world, rough_spider(), "spider", {{0, 0, 1}, {}});
    Simulation sim(world);
    const RobotType& type = sim.type(0);
    std::size_t touching = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        for (std::size_t i = 7; i < sim.states[0].q.size(); ++i)
            sim.states[0].q[i] = random.uniform(-2.5, 2.5);
        std::vector<RobotWork> robots(1);
        place_robot(*sim.model, sim.ids[0], sim.states[0], robots[0]);
        ContactFinder finder;
        std::vector<Contact> contacts;
        finder.find_pairs(robots);
        finder.find(*sim.model, robots, nullptr, false, contacts);
        Found found, expected;
        for (const Contact& c : contacts) ++found[{c.shape_a, c.shape_b}];
        for (const auto& [a, b] : type.self_pairs) {
            const auto s = static_cast<std::uint32_t>(a), t = static_cast<std::uint32_t>(b);
            const ShapeWork &x = robots[0].shapes[s], &y = robots[0].shapes[t];
            const Manifold manifold =
                collide(type.shapes[s].shape, x.X_WS, type.shapes[t].shape, y.X_WS, x.margin + y.margin);
            if (manifold.count > 0) expected[{s, t}] = static_cast<std::size_t>(manifold.count);
        }
        EXPECT_EQ(found, expected) << "seed " << seed;
        touching += expected.size();
    }
    EXPECT_GT(touching, 200u);  // or the test tests nothing
}

}  // namespace
}  // namespace roboss::test
