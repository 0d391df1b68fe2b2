// The kernels of all instruction sets give the same bits, and what they compute is right.
#include "physics/bodies/body_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <support/random.h>

#include "core/thread_pool.h"

namespace roboss {
namespace {

using test::Random;

constexpr std::uint64_t kSeed = 2026;

Six six(Random& random) {
    Six six;
    for (int i = 0; i < 6; ++i) six.x[i] = random.uniform(-1, 1);
    return six;
}

/// Some bodies that touch each other and scenery at random.
BodyIsland random_island(int bodies, int points, Random& random) {
    BodyIsland s;
    for (int b = 0; b < bodies; ++b) {
        FreeBody& body = s.bodies.emplace_back();
        const Six spread = six(random);
        for (int i = 0; i < 6; ++i) {
            for (int j = 0; j < 6; ++j) body.mass.row[i].x[j] = 0.1 * spread.x[i] * spread.x[j];
            body.mass.row[i].x[i] += 1 + i;
            body.lightness.x[i] = 1 / body.mass.row[i].x[i];
        }
        body.impulse = six(random), body.v = six(random);
    }
    for (int k = 0; k < points; ++k) {
        BodyPoint& p = s.points.emplace_back();
        p.a = random.integer(0, bodies - 1), p.b = random.integer(0, bodies - 1);
        if (p.b == p.a) p.b = -1;
        p.n_a = six(random), p.t1_a = six(random), p.t2_a = six(random);
        p.n_b = six(random), p.t1_b = six(random), p.t2_b = six(random);
        p.target_n = random.uniform(-0.5, 0.5), p.target_1 = random.uniform(-0.1, 0.1);
        p.stiffness_n = p.stiffness_t = 100;
        p.coefficient = 0.5, p.bound = random.uniform(0, 1), p.f_n = random.uniform(0, 1);
        p.d_n = p.d_11 = p.d_22 = 100, p.d_1n = random.uniform(-1, 1);
    }
    s.order.analyse(s.bodies.size(), s.points);
    s.kept_diagonal.resize(s.bodies.size()), s.diagonal.resize(s.bodies.size());
    s.pivot_factors.resize(s.bodies.size());
    for (std::size_t b = 0; b < s.bodies.size(); ++b) s.kept_diagonal[b] = s.bodies[b].mass;
    s.kept_upper.resize(s.order.edges()), s.upper.resize(s.order.edges());
    s.lower.resize(s.order.edges());
    return s;
}

void compute(const BodyKernel& kernel, bool coupled, BodyIsland& s) {
    kernel.take_velocities(s);
    kernel.balance(s);
    ASSERT_TRUE(kernel.find_step(s, coupled, 0));
    kernel.move(s, 0.75);
    kernel.balance(s);
    s.bodies[0].step.x[0] += kernel.slope(s) + kernel.slope_beyond(s, 0.3);
    kernel.sweep(s, {.most = 5});
    s.bounds_stay = true;
    for (BodyPoint& p : s.points) p.f_n = p.swept_n, p.f_1 = p.swept_1, p.f_2 = p.swept_2;
    kernel.sweep(s, {.most = 1, .most_to_settle = 100, .settle_tolerance = 1e-7});
}

bool same_bits(const Six& a, const Six& b) {
    return std::memcmp(a.x, b.x, 6 * sizeof(double)) == 0;
}

/// Those that this processor can run, beside the one for any.
std::vector<std::unique_ptr<BodyKernel>> other_kernels() {
    std::vector<std::unique_ptr<BodyKernel>> kernels;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        if (auto kernel = make_avx2_body_kernel()) kernels.push_back(std::move(kernel));
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto kernel = make_avx512_body_kernel()) kernels.push_back(std::move(kernel));
#endif
    return kernels;
}

void expect_same(const BodyIsland& expected, const BodyIsland& found) {
    for (std::size_t b = 0; b < expected.bodies.size(); ++b) {
        EXPECT_TRUE(same_bits(expected.bodies[b].v, found.bodies[b].v)) << b;
        EXPECT_TRUE(same_bits(expected.bodies[b].step, found.bodies[b].step)) << b;
        EXPECT_TRUE(same_bits(expected.bodies[b].gradient, found.bodies[b].gradient)) << b;
    }
    for (std::size_t k = 0; k < expected.points.size(); ++k) {
        const BodyPoint &p = expected.points[k], &q = found.points[k];
        EXPECT_EQ(p.swept_n, q.swept_n) << k;
        EXPECT_EQ(p.swept_1, q.swept_1) << k;
        EXPECT_EQ(p.swept_2, q.swept_2) << k;
    }
}

TEST(BodyKernel, EveryInstructionSetGivesTheSameBits) {
    const auto any = make_any_body_kernel();
    for (const bool coupled : {false, true}) {
        Random random(kSeed);
        BodyIsland expected = random_island(30, 70, random);
        compute(*any, coupled, expected);
        for (const auto& kernel : other_kernels()) {
            Random again(kSeed);
            BodyIsland found = random_island(30, 70, again);
            compute(*kernel, coupled, found);
            expect_same(expected, found);
        }
    }
}

TEST(BodyKernel, ATeamGivesTheBitsOfOneThread) {
    ThreadPool two(2), five(5);
    for (const bool coupled : {false, true})
        for (ThreadPool* pool : {&two, &five}) {
            Random random(kSeed), again(kSeed);
            BodyIsland expected = random_island(400, 1000, random), found = random_island(400, 1000, again);
            found.team = Team(*pool);
            found.ends.sort(found.bodies.size(), found.points);
            found.tasks.plan(found.order, pool->threads());
            EXPECT_GT(found.tasks.count(), 20U);
            compute(body_kernel(), coupled, expected);
            compute(body_kernel(), coupled, found);
            expect_same(expected, found);
        }
}

/// (M + J^T D J) x for a step x, D with the rows that are not symmetric.
std::vector<Six> times_matrix(const BodyIsland& s, bool coupled) {
    std::vector<Six> y(s.bodies.size());
    for (std::size_t b = 0; b < y.size(); ++b)
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) y[b].x[i] += s.bodies[b].mass.row[i].x[j] * s.bodies[b].step.x[j];
    const auto along = [&](const Six& a, const Six& b, const BodyPoint& p) {
        double u = 0;
        for (int i = 0; i < 6; ++i) {
            u += a.x[i] * s.bodies[static_cast<std::size_t>(p.a)].step.x[i];
            if (p.b >= 0) u += b.x[i] * s.bodies[static_cast<std::size_t>(p.b)].step.x[i];
        }
        return u;
    };
    for (const BodyPoint& p : s.points) {
        const double n = along(p.n_a, p.n_b, p), t1 = along(p.t1_a, p.t1_b, p), t2 = along(p.t2_a, p.t2_b, p);
        const double slide_1 = coupled ? p.d_1n * n : 0, slide_2 = coupled ? p.d_2n * n : 0;
        const double f_n = p.d_n * n, f_1 = p.d_11 * t1 + p.d_12 * t2 + slide_1,
                     f_2 = p.d_12 * t1 + p.d_22 * t2 + slide_2;
        for (int i = 0; i < 6; ++i) {
            y[static_cast<std::size_t>(p.a)].x[i] += p.n_a.x[i] * f_n + p.t1_a.x[i] * f_1 + p.t2_a.x[i] * f_2;
            if (p.b < 0) continue;
            y[static_cast<std::size_t>(p.b)].x[i] += p.n_b.x[i] * f_n + p.t1_b.x[i] * f_1 + p.t2_b.x[i] * f_2;
        }
    }
    return y;
}

TEST(BodyKernel, StepsSolveTheLinearSystem) {
    for (const bool coupled : {false, true}) {
        Random random(kSeed);
        BodyIsland s = random_island(40, 90, random);
        body_kernel().take_velocities(s);
        body_kernel().balance(s);
        ASSERT_TRUE(body_kernel().find_step(s, coupled, 0));
        const std::vector<Six> found = times_matrix(s, coupled);
        for (std::size_t b = 0; b < found.size(); ++b)
            for (int i = 0; i < 6; ++i)
                EXPECT_NEAR(found[b].x[i], -s.bodies[b].gradient.x[i], 1e-9) << b << ' ' << i << coupled;
    }
}

TEST(BodyOrder, AChainHasNoFill) {
    std::vector<BodyPoint> points(9);
    for (int i = 0; i < 9; ++i)
        points[static_cast<std::size_t>(i)].a = i, points[static_cast<std::size_t>(i)].b = i + 1;
    BodyOrder order;
    order.analyse(10, points);
    EXPECT_EQ(order.edges(), 9u);
    EXPECT_EQ(order.pivots().size(), 10u);
    EXPECT_TRUE(order.updates().empty());
}

TEST(BodyOrder, EveryPointHasTheEdgeOfItsBodies) {
    Random random(kSeed);
    BodyIsland s = random_island(50, 140, random);
    for (const BodyPoint& p : s.points) {
        if (p.b < 0) continue;
        const int first = p.b_first ? p.b : p.a, second = p.b_first ? p.a : p.b;
        EXPECT_EQ(s.order.ends()[static_cast<std::size_t>(p.edge)], second);
        const auto edge = static_cast<std::size_t>(p.edge);
        const auto pivot = std::ranges::find_if(
            s.order.pivots(), [&](const BodyOrder::Pivot& x) { return x.first <= edge && edge < x.last; });
        ASSERT_NE(pivot, s.order.pivots().end());
        EXPECT_EQ(pivot->body, first);
    }
}

}  // namespace
}  // namespace roboss
