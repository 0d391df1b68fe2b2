// Cars that drive to and fro among a hundred static boxes. The ground grows with the number of cars and the
// boxes with the ground, so that cars and boxes stand equally dense in every size of the scene.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "scenes/car_drive.h"
#include "scenes/overlap.h"
#include "scenes/random.h"

namespace roboss::bench {
namespace {

constexpr std::size_t kBoxes = 100;
constexpr double kCarArea = 0.7;     // m^2 of ground a car
constexpr double kCarRadius = 0.27;  // m, holds the car
constexpr double kBoxMin = 0.6,
                 kBoxMax = 1.5;         // edges, as parts of the square root of a hundredth of the ground
constexpr double kBoxScale = 1.0 / 25;  // ... of the ground's side
constexpr Tick kTurnMin = 500, kTurnMax = 1500;  // ticks between a car's changes of direction
constexpr std::uint64_t kSeed = 20050101;

struct Block {
    Vec3 centre, half;
    double yaw = 0;
};

bool keeps_clear(const Block& block, const Vec3& p, double radius) {
    const double c = std::cos(block.yaw), s = std::sin(block.yaw);
    const Vec3 d = p - block.centre;
    const double x = std::fabs(c * d.x + s * d.y) - block.half.x;
    const double y = std::fabs(c * d.y - s * d.x) - block.half.y;
    return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) > radius;
}

std::vector<Block> lay_blocks(Random& random, double side) {
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < kBoxes; ++i) {
        const double unit = side * kBoxScale * 0.5;
        Block block;
        block.half = {unit * random.uniform(kBoxMin, kBoxMax), unit * random.uniform(kBoxMin, kBoxMax), 0.25};
        block.centre = {random.uniform(0, side), random.uniform(0, side), 0.25};
        block.yaw = random.uniform(-3.1, 3.1);
        blocks.push_back(block);
    }
    return blocks;
}

Pose free_place(Random& random, double side, const std::vector<Block>& blocks,
                const std::vector<Vec3>& taken) {
    for (int tries = 0; tries < 100'000; ++tries) {
        const Vec3 p{random.uniform(0, side), random.uniform(0, side), 0};
        const bool is_free = std::all_of(blocks.begin(), blocks.end(),
                                         [&](const Block& b) { return keeps_clear(b, p, kCarRadius); }) &&
                             std::all_of(taken.begin(), taken.end(), [&](const Vec3& q) {
                                 return norm_squared(p - q) > 4 * kCarRadius * kCarRadius;
                             });
        if (is_free) return {p, from_rpy(0, 0, random.uniform(-3.1, 3.1))};
    }
    throw std::runtime_error("a city this small has no room for a car among its boxes: take more robots");
}

/// Ticks between the changes of direction, and the first of them, of one car.
struct Rhythm {
    Tick period = 0, shift = 0;
};

Verdict judge_city(const Scene& scene, const Engine& engine) {
    const Overlap overlap = measure_overlap(scene.world, engine);
    double fastest = 0, lowest = 1e9, highest = -1e9, sum = 0;
    for (std::size_t i = kBoxes + 1; i < scene.world.instances.size(); ++i) {
        const LinkState chassis = engine.link({i, 0});
        fastest = std::max(fastest, norm(chassis.v_WC));
        lowest = std::min(lowest, chassis.X_WL.p.z), highest = std::max(highest, chassis.X_WL.p.z);
        sum += norm(chassis.v_WC);
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "%.0f %% of cars touch; deepest overlap %.2f mm; mean speed %.3f m/s; z %.3f to %.3f m",
                  100.0 * static_cast<double>(overlap.touching) / static_cast<double>(scene.robots),
                  1e3 * overlap.deepest_m, sum / static_cast<double>(scene.robots), lowest, highest);
    return {overlap.deepest_m < 0.02 && fastest < 3 && lowest > 0.03 && highest < 0.6, text};
}

}  // namespace

Scene city_scene(std::size_t cars) {
    Scene scene;
    scene.robots = cars;
    World& world = scene.world = test::empty_world(kSceneDt);
    world.name = "city";
    Random random(kSeed);
    const double side = std::sqrt(kCarArea * static_cast<double>(cars));
    test::place(world, test::ground(test::surface(kCarMu)), "ground");
    const std::vector<Block> blocks = lay_blocks(random, side);
    for (const Block& block : blocks)
        test::place(world, test::scenery(test::box_shape(block.half * 2.0, test::surface(kCarMu))),
                    "box_" + std::to_string(world.instances.size()),
                    {block.centre, from_rpy(0, 0, block.yaw)});
    const std::size_t car = world.prototypes.size();
    world.prototypes.push_back(scene_car());
    std::vector<Vec3> taken;
    std::vector<Rhythm> rhythms;
    for (std::size_t i = 0; i < cars; ++i) {
        const Pose X_WM = free_place(random, side, blocks, taken);
        taken.push_back(X_WM.p);
        world.instances.push_back({"car_" + std::to_string(i), car, X_WM, {}});
        const auto period = static_cast<Tick>(random.uniform(kTurnMin, kTurnMax));
        rhythms.push_back({period, static_cast<Tick>(random.uniform(0, static_cast<double>(period)))});
    }
    scene.start = [cars](Engine& engine) {
        for (std::size_t i = 0; i < cars; ++i) drive_car(engine, kBoxes + 1 + i, kWheelSpeed);
    };
    scene.control = [rhythms](Engine& engine, Tick tick) {
        for (std::size_t i = 0; i < rhythms.size(); ++i) {
            const Tick since = tick + rhythms[i].shift;
            if (tick == 0 || since % rhythms[i].period != 0) continue;
            const bool forward = (since / rhythms[i].period) % 2 == 0;
            drive_car(engine, kBoxes + 1 + i, forward ? kWheelSpeed : -kWheelSpeed);
        }
    };
    auto judged = std::make_shared<Scene>();
    judged->world = world;
    judged->robots = cars;
    scene.judge = [judged](const Engine& engine, Tick) { return judge_city(*judged, engine); };
    return scene;
}

}  // namespace roboss::bench
