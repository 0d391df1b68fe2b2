// Soft substeps: bodies that touch each other with `--accuracy fast`. They must keep rest, slopes,
// loads, momentum and energy, rebounds, belts, the same bits on every processor and for every team.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include <support/bodies.h>
#include <support/meshes.h>
#include <support/scenes.h>
#include <support/simulation.h>

#include "core/thread_pool.h"
#include "physics/soft/soft_kernel.h"
#include "physics/soft/soft_solver.h"

namespace roboss::test {
namespace {

constexpr Vec3 kSize{0.1, 0.12, 0.08};

World fast_world(const Vec3& gravity = {0, 0, -9.81}) {
    World world = empty_world(2e-3, gravity);
    AccuracySpec fast;
    fast.setting = "fast";
    world.accuracy.push_back(fast);
    return world;
}

void add(World& world, ModelSpec model, const Vec3& p, const Quat& q = {}) {
    place(world, std::move(model), "body_" + std::to_string(world.instances.size()), {p, q});
}

double fastest(const Simulation& sim) {
    double most = 0;
    for (const RobotState& state : sim.states)
        for (const double v : state.v) most = std::fmax(most, std::fabs(v));
    return most;
}

/// Boxes, balls and cylinders above each other.
World heap(int count, int layers) {
    World world = fast_world();
    place(world, ground(surface(0.6)), "ground");
    Random random(2026);
    const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count) / layers)));
    for (int i = 0; i < count; ++i) {
        const int place = i / layers;
        const Vec3 p{0.2 * (place % side) + random.uniform(-0.04, 0.04),
                     0.2 * (place / side) + random.uniform(-0.04, 0.04), 0.15 + 0.2 * (i % layers)};
        const SurfaceSpec s = surface(0.6);
        add(world,
            i % 3 == 0   ? solid_box(1.0, kSize, s)
            : i % 3 == 1 ? solid_sphere(0.8, 0.05, s)
                         : solid_cylinder(0.8, 0.05, 0.1, s),
            p, random.rotation());
    }
    return world;
}

TEST(SoftContacts, AStackOfTenComesToRest) {
    World world = fast_world();
    place(world, ground(surface(0.6)), "ground");
    for (int i = 0; i < 10; ++i) add(world, solid_box(1.0, kSize, surface(0.6)), {0, 0, kSize.z * (i + 0.5)});
    Simulation sim(world);
    sim.run(4);
    tell("fastest after 4 s, m/s or rad/s", fastest(sim));
    EXPECT_LT(fastest(sim), 1e-9);
    EXPECT_NEAR(sim.states.back().q[2], 9.5 * kSize.z, 1e-3);
}

TEST(SoftContacts, AHundredKilogramsRestOnOne) {
    World world = fast_world();
    place(world, ground(surface(0.6)), "ground");
    add(world, solid_box(1.0, kSize, surface(0.6)), {0, 0, 0.5 * kSize.z});
    add(world, solid_box(100.0, kSize, surface(0.6)), {0, 0, 1.5 * kSize.z});
    Simulation sim(world);
    sim.run(2);
    const double overlap = 1.5 * kSize.z - sim.states.back().q[2];
    tell("sinking of the heavy box, mm", 1e3 * overlap);
    EXPECT_LT(overlap, 1e-3);
    EXPECT_LT(fastest(sim), 1e-6);
}

TEST(SoftContacts, NothingCreepsOnASlope) {
    const Quat tilt = from_rpy(0, 20 * kPi / 180, 0);
    World world = fast_world();
    place(world, scenery(box_shape({10, 10, 0.2}, surface(0.6), {rotate(tilt, {0, 0, -0.1}), tilt})),
          "slope");
    for (int i = 0; i < 2; ++i)
        add(world, solid_box(1.0, kSize, surface(0.6)), rotate(tilt, {0, 0, kSize.z * (i + 0.5)}), tilt);
    Simulation sim(world);
    sim.run(4);
    tell("speed on the slope after 4 s, m/s", fastest(sim));
    EXPECT_LT(fastest(sim), 1e-9);
}

/// On a slope that is too steep the two slide as one, by g (sin - mu cos).
TEST(SoftContacts, TheySlideAsFastAsFrictionLets) {
    const double angle = 30 * kPi / 180, mu = 0.3;
    const Quat tilt = from_rpy(0, angle, 0);
    World world = fast_world();
    place(world, scenery(box_shape({40, 10, 0.2}, surface(mu), {rotate(tilt, {0, 0, -0.1}), tilt})), "slope");
    add(world, solid_box(2.0, {0.4, 0.4, 0.05}, surface(mu)), rotate(tilt, {0, 0, 0.025}), tilt);
    add(world, solid_box(1.0, {0.2, 0.2, 0.05}, surface(0.9)), rotate(tilt, {0, 0, 0.075}), tilt);
    Simulation sim(world);
    sim.run(1);
    const double wanted = 9.81 * (std::sin(angle) - mu * std::cos(angle));
    const Vec3 along = rotate(tilt, {1, 0, 0});
    const auto& v = sim.states[1].v;
    const double speed = dot(along, Vec3{v[3], v[4], v[5]});
    tell("sliding speed after 1 s, relative error", speed / wanted - 1);
    EXPECT_NEAR(speed / wanted, 1, 5e-3);
}

/// Balls in a row: the last one gets the momentum times (1 + e) / 2 at each of two blows.
TEST(SoftContacts, BallsReboundByTheirRestitution) {
    const double e = 0.8;
    World world = fast_world({});
    for (int i = 0; i < 2; ++i) add(world, solid_sphere(1.0, 0.05, surface(0, e)), {0.2 * i, 0, 0});
    Simulation sim(world);
    sim.states[0].v[3] = 1;
    sim.run(0.3);
    tell("speed of the ball that was hit, m/s", sim.states[1].v[3]);
    EXPECT_NEAR(sim.states[0].v[3], (1 - e) / 2, 1e-9);
    EXPECT_NEAR(sim.states[1].v[3], (1 + e) / 2, 1e-9);
}

/// A spinning box on another one that has a slippery foot: the upper one takes the lower one along until both
/// turn alike, and the angular momentum is that of before.
TEST(SoftContacts, FrictionOfAPatchPassesTwist) {
    World world = fast_world();
    place(world, ground(surface(0)), "ground");
    add(world, solid_box(1.0, {0.2, 0.2, 0.1}, surface(0.5)), {0, 0, 0.05});
    add(world, solid_box(1.0, {0.1, 0.1, 0.1}, surface(0.5)), {0, 0, 0.15});
    Simulation sim(world);
    sim.states[1].v[2] = 5;
    const double before = sim.momentum().angular.z;
    sim.run(1);
    tell("angular velocities, rad/s", sim.states[0].v[2]);
    EXPECT_NEAR(sim.states[0].v[2], sim.states[1].v[2], 1e-6);
    EXPECT_NEAR(sim.momentum().angular.z / before, 1, 1e-6);
}

TEST(SoftContacts, AHeapFallsSinksLittleAndComesToRest) {
    Simulation sim(heap(90, 6));
    double kinetic = 0, gained = 0, before = sim.energy();
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        ASSERT_FALSE(sim.report.not_finite.valid());
        const double now = sim.energy();
        gained = std::fmax(gained, now - before), before = now;
        kinetic = std::fmax(kinetic, fastest(sim));
    }
    tell("most energy gained in a tick, J", gained);
    EXPECT_LT(gained, 5e-2);  // of 900 J that fall
    for (const RobotState& state : sim.states)
        if (state.q.size() == 7) {
            EXPECT_GT(state.q[2], 0.037);
        }
}

/// Triangles are left to the exact solver.
TEST(SoftContacts, BoxesOnUnevenGroundComeToRest) {
    World world = fast_world();
    const auto height = [](double x, double y) { return 0.01 * std::sin(9 * x) * std::cos(7 * y); };
    place(world, scenery(mesh_shape(sheet_mesh(2, 2, 40, 40, height), surface(0.8))), "ground");
    for (int i = 0; i < 8; ++i)
        add(world, solid_box(1.0, kSize, surface(0.8)),
            {0.3 * (i / 2 % 2), 0.3 * (i / 4), 0.07 + kSize.z * (i % 2)});
    Simulation sim(world);
    sim.run(4);
    tell("fastest after 4 s, m/s or rad/s", fastest(sim));
    EXPECT_LT(fastest(sim), 1e-6);
    for (const RobotState& state : sim.states)
        if (state.q.size() == 7) {
            EXPECT_GT(state.q[2], 0.02);
        }
}

TEST(SoftContacts, AHeapOfBoxesFallsAsleepAndWakes) {
    World world = fast_world();
    world.sleep = true;
    place(world, ground(surface(0.6)), "ground");
    Random random(8);
    for (int i = 0; i < 40; ++i)
        add(world, solid_box(1.0, kSize, surface(0.6)),
            {0.11 * (i % 3), 0.13 * (i / 3 % 3), 0.1 + 0.12 * (i / 9)}, random.rotation());
    Simulation sim(world);
    for (int i = 0; i < 5000 && sim.report.asleep < 40; ++i) sim.step();
    tell("asleep after, s", sim.time());
    EXPECT_EQ(sim.report.asleep, 40);
    RobotState& thrown = sim.states.back();
    thrown.rest = {}, thrown.v[5] = 2;
    sim.run(0.1);
    EXPECT_LT(sim.report.asleep, 40);
}

TEST(SoftContacts, NoBitDependsOnTheTeam) {
    const auto hash = [](unsigned threads) {
        ThreadPool pool(threads);
        Simulation sim(heap(240, 6));
        if (threads > 1) sim.scratch.use_team(Team(pool));
        sim.run(0.6);
        return sim.hash();
    };
    const std::uint64_t one = hash(1);
    EXPECT_EQ(one, hash(2));
    EXPECT_EQ(one, hash(3));
}

/// Other bodies in the call do not change a heap: its colours depend on its own pairs.
TEST(SoftContacts, NoBitDependsOnOtherHeaps) {
    World world = heap(40, 4);
    Simulation alone(world);
    for (int i = 0; i < 12; ++i)
        add(world, solid_box(1.0, kSize, surface(0.6)), {20 + 0.1 * (i % 3), 0, 0.05 + 0.09 * (i / 3)});
    Simulation both(world);
    alone.run(0.5), both.run(0.5);
    for (std::size_t r = 0; r < alone.states.size(); ++r)
        EXPECT_EQ(state_hash(RobotId(r), 1, alone.states[r]), state_hash(RobotId(r), 1, both.states[r])) << r;
}

/// A ball faster than its own size a tick, out of a heap that is in its way, does not pass the wall behind
/// it.
TEST(SoftContacts, FastBallsInAHeapStayInsideTheirBox) {
    World world = fast_world({});
    const double wall = 0.02, half = 0.5;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 p, size{2 * half + 2 * wall, 2 * half + 2 * wall, 2 * half + 2 * wall};
            (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = side * (half + 0.5 * wall);
            (axis == 0 ? size.x : axis == 1 ? size.y : size.z) = wall;
            place(world, scenery(box_shape(size, surface(0.3, 0.9), {p, {}})),
                  "wall_" + std::to_string(axis) + (side < 0 ? "a" : "b"));
        }
    Random random(7);
    for (int i = 0; i < 27; ++i)
        add(world, solid_sphere(0.1, 0.03, surface(0.3, 0.9)),
            {0.2 * (i % 3 - 1), 0.2 * (i / 3 % 3 - 1), 0.2 * (i / 9 - 1)});
    Simulation sim(world);
    for (RobotState& state : sim.states)
        for (std::size_t k = 3; k < state.v.size(); ++k) state.v[k] = random.uniform(-20, 20);
    for (int i = 0; i < 500; ++i) {
        sim.step();
        for (const RobotState& state : sim.states)
            for (std::size_t k = 0; k < 3 && state.q.size() == 7; ++k)
                ASSERT_LT(std::fabs(state.q[k]), half + wall) << "tick " << i;
    }
}

/// Random numbers for the lanes in use.
template <class Rows>
void fill(Rows& rows, int lanes, Random& random) {
    for (std::size_t at = 0; at < sizeof rows / sizeof(soft::Eight); ++at)
        for (int lane = 0; lane < lanes; ++lane)
            reinterpret_cast<soft::Eight*>(&rows)[at].x[lane] = random.uniform(0.1, 1);
}

/// Random rows of robots with joints, whose further coordinates are the last two of their bodies.
void add_columns(soft::Problem& p, soft::Batch& batch, int further, Random& random) {
    batch.first_column = p.columns.size();
    for (soft::Path* path : {&batch.path_a, &batch.path_b}) {
        path->further = further, path->first = p.places.size();
        const int* bodies = path == &batch.path_a ? batch.a : batch.b;
        for (int k = 0; k < further; ++k)
            for (int lane = 0; lane < 8; ++lane) p.places.push_back(8 * bodies[lane] + 6 + k);
    }
    for (std::size_t k = 0; k < (static_cast<std::size_t>(batch.points) + 3) * batch.columns(); ++k)
        fill(p.columns.emplace_back(), batch.patches, random);
}

/// Random patches of random bodies.
soft::Problem random_problem(int bodies, int patches) {
    Random random(2026);
    soft::Problem p;
    p.velocity.resize(static_cast<std::size_t>(bodies) + 1), p.displacement.resize(p.velocity.size());
    for (int b = 0; b < bodies; ++b)
        for (int i = 0; i < 8; ++i) {
            p.velocity[static_cast<std::size_t>(b)].x[i] = random.uniform(-1, 1);
            p.displacement[static_cast<std::size_t>(b)].x[i] = random.uniform(-1e-3, 1e-3);
        }
    for (int k = 0; k < patches; ++k) {
        soft::Batch batch;
        batch.patches = 1 + k % 8, batch.points = 1 + k % 4, batch.scenery = k % 3 == 2;
        batch.first = p.points.size(), batch.jointed = k % 2 == 1;
        for (int lane = 0; lane < 8; ++lane) {
            const bool used = lane < batch.patches;
            const int half = bodies / 2, first = batch.jointed ? half : 0;
            batch.a[lane] = used ? first + (16 * k + 2 * lane) % half : bodies;
            batch.b[lane] = used && !batch.scenery ? first + (16 * k + 2 * lane + 1) % half : bodies;
        }
        if (batch.jointed) add_columns(p, batch, 1 + k / 2 % 2, random);
        p.batches.push_back(batch);
        fill(p.patches.emplace_back(), batch.patches, random);
        for (int point = 0; point < batch.points; ++point) {
            soft::Point& q = p.points.emplace_back();
            fill(q, batch.patches, random);
            for (int lane = 0; lane < batch.patches; ++lane) q.gap.x[lane] = random.uniform(-1e-3, 1e-3);
        }
    }
    return p;
}

std::vector<double> bits_of(const soft::Problem& p) {
    std::vector<double> all;
    for (std::size_t b = 0; b < p.velocity.size(); ++b)  // free bodies do not use the last two numbers
        all.insert(all.end(), p.velocity[b].x, p.velocity[b].x + (2 * b < p.velocity.size() ? 6 : 8));
    for (const soft::Point& q : p.points) all.insert(all.end(), q.total.x, q.total.x + 8);
    for (const soft::Patch& q : p.patches) all.insert(all.end(), q.total_1.x, q.total_1.x + 8);
    return all;
}

TEST(SoftKernel, AllInstructionSetsGiveTheSameBits) {
    std::vector<std::unique_ptr<soft::Kernel>> kernels;
    kernels.push_back(soft::make_any_kernel());
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) kernels.push_back(soft::make_avx2_kernel());
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        kernels.push_back(soft::make_avx512_kernel());
#endif
    std::vector<double> first;
    for (const auto& kernel : kernels) {
        if (!kernel) continue;
        soft::Problem p = random_problem(160, 40);
        const soft::Substep substep{5e-4, 1e-3, {100, 0.9, 0.1}, {200, 0.8, 0.2}};
        using soft::Pass;
        for (const Pass pass :
             {Pass::kWarm, Pass::kPush, Pass::kRelax, Pass::kPush, Pass::kRelax, Pass::kBounce})
            kernel->run(p, 0, p.batches.size(), pass, substep);
        const std::vector<double> bits = bits_of(p);
        if (first.empty()) first = bits;
        ASSERT_EQ(first.size(), bits.size());
        EXPECT_EQ(0, std::memcmp(first.data(), bits.data(), bits.size() * sizeof(double)));
    }
    EXPECT_FALSE(first.empty());
}

/// Pairs of a colour share no body, and each pair has its place once.
TEST(SoftBatches, ColoursShareNoBody) {
    Random random(5);
    std::vector<soft::Pair> pairs;
    const int bodies = 60;
    for (std::uint32_t k = 0; k < 900; ++k) {
        const int a = random.integer(0, bodies - 2), b = k % 5 == 0 ? -1 : random.integer(a + 1, bodies - 1);
        soft::Pair& pair = pairs.emplace_back();
        pair.a = a, pair.b = b, pair.first = k,
        pair.points = static_cast<std::uint32_t>(random.integer(1, 8));
    }
    soft::Problem problem;
    soft::Batches batches;
    batches.arrange(bodies, pairs, problem);
    std::vector<int> seen(pairs.size(), 0);
    for (const std::uint32_t k : batches.order()) ++seen[k];
    for (const int times : seen) EXPECT_EQ(times, 1);
    for (std::size_t c = 0; c + 1 < problem.colours.size(); ++c) {
        std::vector<int> used(bodies + 1, 0);
        for (std::size_t k = problem.colours[c]; k < problem.colours[c + 1]; ++k)
            for (int lane = 0; lane < problem.batches[k].patches; ++lane)
                for (const int body : {problem.batches[k].a[lane], problem.batches[k].b[lane]})
                    if (body < bodies) {
                        EXPECT_EQ(++used[static_cast<std::size_t>(body)], 1);
                    }
    }
}

}  // namespace
}  // namespace roboss::test
