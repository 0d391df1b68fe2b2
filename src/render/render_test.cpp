// What cameras see, against closed forms and against all triangles tried one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "render/shape_rays.h"
#include "render/test_scene.h"

namespace roboss {
namespace {

using namespace render_test;
using render::CameraView;
using render::Lens;
using render::Sighting;

Scene mixed_scene(std::uint64_t seed) {
    Dice dice{seed};
    Scene scene;
    scene.meshes.push_back(cloud(seed, 300));
    scene.statics.push_back(ground(60));
    for (int i = 0; i < 24; ++i) {
        const auto kind = static_cast<SceneShapeKind>(i % 8);
        SceneShape one = shape(kind, Vec3{9, 0, 2} + dice.point(4));
        one.frame.q =
            normalized(Quat{dice.roll(-1, 1), dice.roll(-1, 1), dice.roll(-1, 1), dice.roll(-1, 1)});
        one.size = {dice.roll(0.3, 2), dice.roll(0.3, 2), dice.roll(0.3, 2)};
        one.radius = dice.roll(0.2, 0.9), one.length = dice.roll(0.3, 2);
        one.rgb = {dice.roll(0, 1), dice.roll(0, 1), dice.roll(0, 1)};
        if (i % 5 == 0) one.alpha = 0.4;
        scene.statics.push_back(one);
    }
    LightSpec lamp;
    lamp.X_FL.p = {5, 2, 6}, lamp.cast_shadows = true;
    scene.look.lights = {lamp};
    return scene;
}

CameraView mixed_view() {
    CameraView from = view({0, 0, 2}, 160, 121, 1.2);
    from.optics.anti_aliasing = 4;
    return from;
}

TEST(Render, DepthOfASphereIsThatOfTheClosedForm) {
    const Room room(scene_of({ball({5, 0.3, -0.2}, 1)}));
    const CameraView from = view({}, 64, 48, 1);
    const Lens lens(from.optics);
    const std::vector<Sighting> seen = sight(room.cameras, from, 0.1, 100);
    int hits = 0;
    for (int v = 0; v < 48; ++v)
        for (int u = 0; u < 64; ++u) {
            const Vec3 d = *lens.direction(u + 0.5, v + 0.5), c{5, 0.3, -0.2};
            const double b = dot(d, c), root = b * b - dot(d, d) * (dot(c, c) - 1);
            const Sighting& one = seen[static_cast<std::size_t>(64 * v + u)];
            if (std::fabs(root) < 1e-4) continue;  // the rim
            ASSERT_EQ(one.item != render::kNothing, root > 0) << u << ' ' << v;
            if (root < 0) continue;
            EXPECT_NEAR(one.depth, (b - std::sqrt(root)) / dot(d, d), 1e-12);
            ++hits;
        }
    EXPECT_GT(hits, 100);
}

TEST(Render, AVisualIsSeenIfItsFlagsAndTheMaskHaveABitInCommon) {
    Scene scene = scene_of({box({4, 0, 0}, {2, 9, 9}), box({8, 0, 0}, {2, 9, 9})});
    scene.statics[0].visibility_flags = 6, scene.statics[1].visibility_flags = 8;
    const Room room(scene);
    const auto depth = [&](double mask) {
        CameraView from = view({}, 8, 8, 0.5);
        from.optics.visibility_mask = mask;
        const Sighting one = sight(room.cameras, from, 0.1, 100).at(27);
        return one.item == render::kNothing ? -1 : one.depth;
    };
    EXPECT_NEAR(depth(4294967295), 3, 1e-12);
    EXPECT_NEAR(depth(2), 3, 1e-12);
    EXPECT_NEAR(depth(9), 7, 1e-12) << "the nearer one is not seen";
    EXPECT_EQ(depth(1), -1);
}

TEST(Render, DepthOfAPlaneAndABoxIsThatOfTheClosedForm) {
    const Room room(scene_of({ground(400), box({8, 0, 1}, {2, 2, 2})}));
    const CameraView from = view({0, 0, 1.5}, 64, 48, 1);
    const Lens lens(from.optics);
    const std::vector<Sighting> seen = sight(room.cameras, from, 0.1, 100);
    for (int v = 0; v < 48; ++v)
        for (int u = 0; u < 64; ++u) {
            const Vec3 d = *lens.direction(u + 0.5, v + 0.5);
            const double on_ground = d.z < 0 ? -1.5 / d.z : 1e9;
            const bool front = std::fabs(7 * d.y) < 1 && std::fabs(0.5 + 7 * d.z) < 1;
            const double expected = front ? 7 : on_ground;
            const bool rim =
                std::fabs(std::fabs(7 * d.y) - 1) < 1e-6 || std::fabs(std::fabs(0.5 + 7 * d.z) - 1) < 1e-6;
            const Sighting& one = seen[static_cast<std::size_t>(64 * v + u)];
            if (rim || expected > 99) continue;
            EXPECT_NEAR(one.depth, expected, 1e-11) << u << ' ' << v;
        }
}

TEST(Render, APointIsSeenAtThePixelOfThePinholeFormula) {
    Dice dice{7};
    for (int i = 0; i < 50; ++i) {
        const Vec3 p{dice.roll(2, 20), 0, 0};
        const Vec3 at{p.x, dice.roll(-0.4, 0.4) * p.x, dice.roll(-0.3, 0.3) * p.x};
        const Room room(scene_of({ball(at, 0.02 * p.x)}));
        CameraView from = view({}, 320, 240, 1);
        const double f = 160 / std::tan(0.5);
        const double u = 160 - f * at.y / at.x, v = 120 - f * at.z / at.x;
        const std::vector<Sighting> seen = sight(room.cameras, from, 0.1, 100);
        double sum_u = 0, sum_v = 0, count = 0;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            if (seen[k].item == render::kNothing) continue;
            sum_u += static_cast<double>(k % 320) + 0.5, sum_v += static_cast<double>(k / 320) + 0.5, ++count;
        }
        if (u < 8 || v < 8 || u > 312 || v > 232) continue;  // cut by the edge
        ASSERT_GT(count, 10);
        EXPECT_NEAR(sum_u / count, u, 0.35);
        EXPECT_NEAR(sum_v / count, v, 0.35);
    }
}

TEST(Lens, DistortionIsItsFormulaAndIsInverted) {
    CameraOptics optics;
    optics.k1 = -0.25, optics.k2 = 0.12, optics.k3 = -0.01, optics.p1 = 0.002, optics.p2 = -0.001;
    optics.fx = 300, optics.fy = 310, optics.cx = 155, optics.cy = 122, optics.skew = 1.5;
    const Lens lens(optics);
    for (double u = 0.5; u < 320; u += 13)
        for (double v = 0.5; v < 240; v += 11) {
            const auto d = lens.direction(u, v);
            ASSERT_TRUE(d) << u << ' ' << v;
            const double a = -d->y, b = -d->z, rr = a * a + b * b;
            const double radial = 1 - 0.25 * rr + 0.12 * rr * rr - 0.01 * rr * rr * rr;
            const double x = a * radial + 2 * 0.002 * a * b - 0.001 * (rr + 2 * a * a);
            const double y = b * radial + 0.002 * (rr + 2 * b * b) - 2 * 0.001 * a * b;
            EXPECT_NEAR(300 * x + 1.5 * y + 155, u, 1e-7);
            EXPECT_NEAR(310 * y + 122, v, 1e-7);
            const auto at = lens.project(*d * 3.0);
            ASSERT_TRUE(at);
            EXPECT_NEAR(at->first, u, 1e-7);
            EXPECT_NEAR(at->second, v, 1e-7);
        }
}

TEST(Lens, AWideAngleLensMapsAnglesToRadii) {
    CameraOptics optics;
    optics.width = optics.height = 200, optics.lens = "equidistant", optics.horizontal_fov = 3;
    const Lens equidistant(optics);
    for (const double u : {100.0, 120.0, 160.0, 199.0}) {
        const auto d = equidistant.direction(u, 100);
        ASSERT_TRUE(d);
        EXPECT_NEAR(std::atan2(-d->y, d->x), (u - 100) / 100 * 1.5, 1e-12);
    }
    optics.cutoff_angle = 1;
    EXPECT_FALSE(Lens(optics).direction(199, 100));
    optics.cutoff_angle = 2, optics.lens = "stereographic";
    const auto d = Lens(optics).direction(150, 100);
    ASSERT_TRUE(d);
    EXPECT_NEAR(std::tan(std::atan2(-d->y, d->x) / 2) / std::tan(0.75), 0.5, 1e-12);
}

/// The nearest hit of all triangles, one by one, in double.
double nearest_of(const SceneMesh& mesh, const Vec3& o, const Vec3& d) {
    double best = 1e30;
    for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]];
        const double at = render::cross_triangle(o, d, a, mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        if (at > 0.1) best = std::fmin(best, at);
    }
    return best;
}

TEST(Render, TheNearestTriangleOfAMeshIsFound) {
    Scene scene;
    scene.meshes.push_back(cloud(3, 400));
    scene.statics.push_back(shape(SceneShapeKind::kMesh, {6, 0, 0}));
    const Room room(scene);
    const CameraView from = view({}, 80, 60, 0.9);
    const Lens lens(from.optics);
    const std::vector<Sighting> seen = sight(room.cameras, from, 0.1, 100);
    int hits = 0, rims = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Vec3 d = *lens.direction(static_cast<double>(i % 80) + 0.5, static_cast<double>(i / 80) + 0.5);
        const double expected = nearest_of(scene.meshes[0], {-6, 0, 0}, d);
        const double found = seen[i].item == render::kNothing ? 1e30 : seen[i].depth;
        if (std::fabs(found - expected) > 1e-9 * expected)
            ++rims;  // a ray that floats put on the other side of an edge
        else
            hits += expected < 1e29;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(rims, 3);
}

TEST(Render, ImagesHaveTheSameBitsForAllThreads) {
    const Scene scene = mixed_scene(11);
    const Room one(scene, 1);
    const Image<std::uint8_t> picture = render::picture(one.cameras, mixed_view());
    const std::vector<Sighting> depth = sight(one.cameras, mixed_view(), 0.1, 100);
    for (const unsigned threads : {2u, 5u}) {
        const Room many(scene, threads);
        EXPECT_EQ(render::picture(many.cameras, mixed_view()), picture) << threads;
        const std::vector<Sighting> again = sight(many.cameras, mixed_view(), 0.1, 100);
        ASSERT_EQ(again.size(), depth.size());
        for (std::size_t i = 0; i < depth.size(); ++i) {
            ASSERT_EQ(again[i].item, depth[i].item);
            ASSERT_EQ(std::memcmp(&again[i].depth, &depth[i].depth, sizeof(double)), 0);
        }
    }
}

TEST(Render, TracersOfAllInstructionSetsGiveTheSameBits) {
    const auto avx2 = render::make_avx2_tracer();
    if (!avx2) GTEST_SKIP() << "this processor has no AVX2";
    const auto any = render::make_any_tracer();
    const Room room(mixed_scene(5));
    const Lens lens(mixed_view().optics);
    int hits = 0;
    for (int row = 0; row < 120; row += 2)
        for (int column = 0; column < 160; column += 4) {
            render::Block block;
            aim(mixed_view(), lens, column, row, 0.5, 0.5, block);
            render::PacketHits a, b;
            avx2->nearest(room.cameras.trace(), block.rays, a);
            any->nearest(room.cameras.trace(), block.rays, b);
            ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << column << ' ' << row;
            ASSERT_EQ(avx2->shadowed(room.cameras.trace(), block.rays),
                      any->shadowed(room.cameras.trace(), block.rays));
            hits += a.item[0] != render::kNothing;
        }
    EXPECT_GT(hits, 500);
}

TEST(Render, AShadowFallsWhereTheLightIsHidden) {
    Scene scene = scene_of({ground(40), box({5, 0, 3}, {1, 1, 0.2})});
    LightSpec sun;
    sun.kind = LightKind::kDirectional, sun.cast_shadows = true;
    scene.look.lights = {sun};  // straight down
    const Room room(scene);
    CameraView from = view({5, -6, 2}, 101, 101, 1.0);
    from.X_WC.R = to_matrix(Quat{std::sqrt(0.5), 0, 0, std::sqrt(0.5)});  // looks along y
    const Image<std::uint8_t> lit = render::picture(room.cameras, from);
    const Lens lens(from.optics);
    const auto brightness = [&](const Vec3& p_W) {
        const auto at = lens.project(transpose_times(from.X_WC.R, p_W - from.X_WC.p));
        const auto u = static_cast<std::size_t>(at->first), v = static_cast<std::size_t>(at->second);
        return static_cast<int>(lit.samples[3 * (101 * v + u)]);
    };
    EXPECT_LT(brightness({5, 0, 0}), brightness({6.5, 0, 0}) - 40);
    EXPECT_EQ(brightness({4.2, 0, 0}), brightness({5.8, 0, 0})) << "both in the light";
    scene.look.lights[0].cast_shadows = false;
    const Room bright(scene);
    EXPECT_GT(render::picture(bright.cameras, from).samples[3 * (101 * 84 + 50)], 0);
}

}  // namespace
}  // namespace roboss
