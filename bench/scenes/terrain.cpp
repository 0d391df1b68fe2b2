// Four-wheelers on hills: what contacts with triangles cost. The ground is a height field of 129 x 129 points
// over 60 m, or the mesh of the same triangles; the wheels are spheres, cylinders or ellipsoids, or the
// robots rock on feet that are boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include <support/bodies.h>

#include "scenes/random.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kDt = 0.004, kEdge = 60, kHigh = 1.5;  // s, m, m
constexpr std::size_t kPoints = 129;                    // along an edge
constexpr double kRadius = 0.095, kBelow = 0.06;  // m, of the wheels; of their axes below the chassis' centre
constexpr double kSpeed = 6, kEffort = 3;         // rad/s, N m
constexpr double kRock = 1.5;                     // rad/s, of feet
constexpr Tick kStride = 50;                      // ticks that feet turn one way
constexpr int kLand = 250;                        // ticks
/// m: the highest axle of a rover that tumbles over the wheel opposite, on a slope of a half.
constexpr double kHighestAxle = 0.75;
constexpr std::array<Vec3, 4> kAxles{
    {{0.2, 0.2, -kBelow}, {0.2, -0.2, -kBelow}, {-0.2, 0.2, -kBelow}, {-0.2, -0.2, -kBelow}}};

/// Rounded as a picture of 8 bits has it; slopes of up to a half.
double height_at(std::size_t column, std::size_t row) {
    const double i = static_cast<double>(column), j = static_cast<double>(kPoints - 1 - row);
    const double h = 0.5 + 0.22 * std::sin(0.35 * i) * std::cos(0.27 * j) +
                     0.12 * std::sin(1.1 * i + 0.6 * j) + 0.06 * std::sin(2.3 * j - 1.9 * i);
    return kHigh * std::floor(255 * std::clamp(h, 0.0, 1.0)) / 255;
}

std::shared_ptr<const HeightGridSpec> hills() {
    auto grid = std::make_shared<HeightGridSpec>();
    grid->source = "hills", grid->columns = grid->rows = kPoints, grid->size_x = grid->size_y = kEdge;
    for (std::size_t row = 0; row < kPoints; ++row)
        for (std::size_t column = 0; column < kPoints; ++column)
            grid->heights.push_back(height_at(column, row));
    return grid;
}

std::shared_ptr<const MeshSpec> hills_mesh() {
    auto mesh = std::make_shared<MeshSpec>();
    mesh->source = "hills";
    const double step = kEdge / (kPoints - 1);
    for (std::size_t row = 0; row < kPoints; ++row)
        for (std::size_t column = 0; column < kPoints; ++column)
            mesh->vertices.push_back({step * static_cast<double>(column) - 0.5 * kEdge,
                                      step * static_cast<double>(row) - 0.5 * kEdge, height_at(column, row)});
    for (std::size_t row = 0; row + 1 < kPoints; ++row)
        for (std::size_t column = 0; column + 1 < kPoints; ++column) {
            const auto a = static_cast<std::uint32_t>(row * kPoints + column), b = a + 1,
                       d = a + static_cast<std::uint32_t>(kPoints), c = d + 1;
            mesh->triangles.push_back({a, b, c}), mesh->triangles.push_back({a, c, d});
        }
    return mesh;
}

/// Height of the grid's cells, bilinear: within the roughness of a cell of the triangles.
double ground_below(const HeightGridSpec& grid, double x, double y) {
    const double step = kEdge / (kPoints - 1), last = static_cast<double>(kPoints - 2);
    const double u = (x + 0.5 * kEdge) / step, v = (y + 0.5 * kEdge) / step;
    const double i = std::clamp(std::floor(u), 0.0, last), j = std::clamp(std::floor(v), 0.0, last);
    const double* h = &grid.heights[static_cast<std::size_t>(j) * kPoints + static_cast<std::size_t>(i)];
    const double s = u - i, t = v - j;
    return (1 - t) * ((1 - s) * h[0] + s * h[1]) + t * ((1 - s) * h[kPoints] + s * h[kPoints + 1]);
}

CollisionSpec wheel_shape(GeometryKind kind) {
    const SurfaceSpec s = test::surface(1.0);
    switch (kind) {
        case GeometryKind::kSphere:
            return test::sphere_shape(kRadius, s);
        case GeometryKind::kCylinder:
            return test::cylinder_shape(kRadius, 0.06, s, {{}, from_rpy(kPi / 2, 0, 0)});
        case GeometryKind::kEllipsoid: {
            CollisionSpec c = test::collision(GeometryKind::kEllipsoid, s);
            c.geometry.size = {kRadius, 0.035, kRadius};
            return c;
        }
        default:
            return test::box_shape({0.1, 0.07, 0.04}, s, {{0, 0, 0.02 - kRadius}, {}});
    }
}

ModelSpec rover(GeometryKind wheels) {
    ModelSpec model = test::one_link(test::link("chassis", 6, Mat3::diagonal(0.08, 0.12, 0.18)));
    model.name = "rover";
    model.links[0].collisions.push_back(test::box_shape({0.45, 0.3, 0.12}, test::surface(1.0)));
    for (std::size_t k = 0; k < kAxles.size(); ++k) {
        const std::string name = "wheel_" + std::to_string(k);
        const Pose X{kAxles[k], {}};
        LinkSpec wheel = test::link(name, 0.4, Mat3::diagonal(0.0008, 0.0012, 0.0008), X);
        wheel.collisions.push_back(wheel_shape(wheels));
        model.links.push_back(wheel);
        model.joints.push_back(test::joint(JointSpecKind::kContinuous, name, "chassis", name, X, {0, 1, 0}));
    }
    return model;
}

/// True above the field. In long runs rovers drive over its edge and fall.
bool is_on_field(const Vec3& p) {
    return std::abs(p.x) < 0.5 * kEdge && std::abs(p.y) < 0.5 * kEdge;
}

/// Nothing is in the ground, none has been thrown off it. A rover over the edge is not judged.
Verdict judge(const HeightGridSpec& grid, const Engine& engine, std::size_t robots) {
    double low = 1e9, high = -1e9, speed = 0;
    for (std::size_t i = 1; i <= robots; ++i) {
        const LinkState chassis = engine.link({i, 0});
        if (!is_on_field(chassis.X_WL.p)) continue;
        speed += norm(chassis.v_WC) / static_cast<double>(robots);
        for (std::size_t wheel = 1; wheel <= kAxles.size(); ++wheel) {
            const Vec3 p = engine.link({i, wheel}).X_WL.p;
            if (!is_on_field(p)) continue;
            const double above = p.z - ground_below(grid, p.x, p.y);
            low = std::min(low, above), high = std::max(high, above);
        }
    }
    char text[120];
    std::snprintf(text, sizeof text, "axles %.3f to %.3f m above the ground, %.2f m/s", low, high, speed);
    return {low > -0.03 && high < kHighestAxle && speed < 2, text};
}

Scene make_scene(std::size_t robots, bool as_mesh, GeometryKind wheels) {
    Scene scene;
    scene.robots = robots, scene.dt_s = kDt, scene.settle = kLand;
    World& world = scene.world = test::empty_world(kDt);
    world.name = "terrain";
    const std::shared_ptr<const HeightGridSpec> grid = hills();
    CollisionSpec ground =
        test::collision(as_mesh ? GeometryKind::kMesh : GeometryKind::kHeightmap, test::surface(1.0));
    if (as_mesh)
        ground.geometry.mesh = hills_mesh();
    else
        ground.geometry.heights = grid;
    test::place(world, test::scenery(ground), "ground");
    world.prototypes.push_back(rover(wheels));
    Random random(3);
    constexpr std::size_t kInRow = 25;
    for (std::size_t i = 0; i < robots; ++i) {
        const double x = -24 + 2.0 * static_cast<double>(i % kInRow),
                     y = -19 + 2.0 * static_cast<double>(i / kInRow);
        double z = 0;
        for (int k = 0; k < 9; ++k)
            z = std::max(z, ground_below(*grid, x + 0.3 * (k % 3 - 1), y + 0.3 * (k / 3 - 1)));
        const Pose X{{x, y, z + kRadius + kBelow}, from_rpy(0, 0, random.uniform(-3, 3))};
        world.instances.push_back({"rover_" + std::to_string(i), 1, X, {}});
    }
    const auto drive = [robots](Engine& engine, double speed) {
        for (std::size_t i = 1; i <= robots; ++i)
            for (std::size_t k = 0; k < kAxles.size(); ++k) engine.drive_velocity({i, k, 0}, speed, kEffort);
    };
    if (wheels == GeometryKind::kBox) {
        scene.start = [drive](Engine& engine) { drive(engine, 0.5 * kRock); };
        scene.control = [drive](Engine& engine, Tick tick) {
            if (tick > 0 && tick % kStride == kStride / 2)
                drive(engine, tick / kStride % 2 == 0 ? -0.5 * kRock : 0.5 * kRock);
        };
    } else {
        scene.start = [drive](Engine& engine) { drive(engine, kSpeed); };
    }
    scene.judge = [grid, robots](const Engine& engine, Tick) { return judge(*grid, engine, robots); };
    return scene;
}

SceneKind terrain_kind(const char* ground, const char* wheels, bool as_mesh, GeometryKind kind) {
    return {std::string(ground) + "_" + wheels,
            std::string("four-wheelers on hills: ") + (as_mesh ? "a mesh" : "a height field") + ", " +
                wheels + ", dt 4 ms",
            {100},
            [as_mesh, kind](std::size_t robots) { return make_scene(robots, as_mesh, kind); }};
}

}  // namespace

std::vector<SceneKind> terrain_kinds() {
    struct Wheels {
        const char* name;
        GeometryKind kind;
    };
    constexpr Wheels kWheels[] = {{"spheres", GeometryKind::kSphere},
                                  {"cylinders", GeometryKind::kCylinder},
                                  {"ellipsoids", GeometryKind::kEllipsoid},
                                  {"boxes", GeometryKind::kBox}};
    std::vector<SceneKind> kinds;
    for (const bool as_mesh : {false, true})
        for (const Wheels& wheels : kWheels)
            kinds.push_back(
                terrain_kind(as_mesh ? "terrain_mesh" : "terrain", wheels.name, as_mesh, wheels.kind));
    return kinds;
}

}  // namespace roboss::bench
