// Spinning bodies that pass each other closely: what is proven to stay apart does.
#include "geometry/time_of_impact.h"

#include <gtest/gtest.h>

#include <random>

namespace roboss {
namespace {

constexpr double kTick = 0.002;

Course flying(const Shape& shape, const Vec3& p, const Vec3& linear, const Vec3& angular) {
    Course c = resting_course(shape, {to_matrix(exponential(angular)), p});
    c.linear = linear, c.angular = angular;
    c.turning = turning_speed<double>(shape, c.X.R, angular);
    return c;
}

double least_gap_on_the_way(const Course& a, const Course& b) {
    constexpr int kTimes = 200;
    double gap = 1;
    for (int i = 0; i <= kTimes; ++i) {
        const double t = kTick * i / kTimes;
        gap = std::min(gap, least_gap(collide(*a.shape, a.at(t), *b.shape, b.at(t), 1e-3)));
    }
    return gap;
}

TEST(TimeOfImpact, WhatSurelyPassesNeverTouches) {
    Shape box, can, egg, pill;
    box.kind = ShapeKind::kBox, box.half = {0.08, 0.05, 0.04};
    can.kind = ShapeKind::kCylinder, can.radius = 0.07, can.half_length = 0.08;
    egg.kind = ShapeKind::kEllipsoid, egg.half = {0.12, 0.09, 0.07};
    pill.kind = ShapeKind::kCapsule, pill.radius = 0.05, pill.half_length = 0.06;
    const Shape* shapes[] = {&box, &can, &egg, &pill};
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    const auto vector = [&] { return Vec3{number(), number(), number()}; };
    int passed = 0, close = 0, grazing = 0;
    for (int i = 0; i < 600; ++i) {
        const Shape &first = *shapes[random() % 4], &second = *shapes[random() % 4];
        const Vec3 away = normalized(vector()), spin_a = vector() * 20.0, spin_b = vector() * 20.0;
        const double far = bounding_radius(first) + bounding_radius(second);
        const Course b = flying(second, {}, {}, spin_b);
        Course a = flying(first, away * far, vector() * 3.0, spin_a);
        Manifold m = collide(first, a.X, second, b.X, far);
        a = flying(first, a.X.p - m.n_W * (least_gap(m) - 1e-3 * (1 + number())), a.linear, spin_a);
        a.origin = a.X.p;
        const double deep = 5e-4, gap = least_gap_on_the_way(a, b);
        if (surely_pass(a, b, kTick, m.n_W, deep)) {
            EXPECT_GT(gap, kImpactGap - deep) << "pair " << i;
            grazing += gap < 0;
        }
        if (!surely_pass(a, b, kTick, m.n_W, 0)) continue;
        ++passed, close += gap < 1e-3;
        EXPECT_GT(gap, kImpactGap) << "pair " << i;
        Manifold there = collide(first, a.X, second, b.X, 0.1);
        EXPECT_FALSE(time_of_impact(a, b, kTick, 1e-5, 0.1, there)) << "pair " << i;
    }
    EXPECT_GT(passed, 100);
    EXPECT_GT(close, 30);
    EXPECT_GT(grazing, 5);
}

}  // namespace
}  // namespace roboss
