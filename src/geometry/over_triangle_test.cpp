// Directions that need no search are those that the search finds.
#include "geometry/over_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/collide_general.h"

namespace roboss::narrow {
namespace {

TEST(OverTriangle, DirectionsThatNeedNoSearchAreThoseOfTheSearch) {
    Shape ball, pill, box, can, egg;
    ball.kind = ShapeKind::kSphere, ball.radius = 0.1;
    pill.kind = ShapeKind::kCapsule, pill.radius = 0.05, pill.half_length = 0.1;
    box.kind = ShapeKind::kBox, box.half = {0.1, 0.08, 0.05};
    can.kind = ShapeKind::kCylinder, can.radius = 0.1, can.half_length = 0.03;
    egg.kind = ShapeKind::kEllipsoid, egg.half = {0.1, 0.04, 0.1};
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    const auto vector = [&] { return Vec3{number(), number(), number()}; };
    for (const Shape* shape : {&ball, &pill, &box, &can, &egg}) {
        int at_corners = 0, over = 0;
        for (int i = 0; i < 4000; ++i) {
            SurfaceFace face{{{{0.3, 0.05, 0}, {-0.2, 0.25, 0}, {-0.1, -0.2, 0}}}, {0, 0, 1}};
            const Transform X_WT{to_matrix(exponential(vector() * 3.0)), vector()};
            for (Vec3& corner : face.v) corner = X_WT * corner;
            face.n = X_WT.R * face.n;
            const Transform X{to_matrix(exponential(vector() * 3.0)),
                              X_WT * Vec3{0.5 * number(), 0.5 * number(), 0.05 + 0.1 * (number() + 1)}};
            const Posed posed{*shape, X};
            const ConvexBody body(posed), sheet(face.v, face.n);
            const auto plain = plain_separation(body, face, 1e300);
            if (!plain) continue;
            const Separation found = best_separation(body, sheet, 1e300);
            ASSERT_NEAR(norm(plain->n), 1, 1e-12);
            ASSERT_LE(plain->s, found.s + 1e-9) << i;
            if (plain->s < 0) continue;
            ASSERT_NEAR(plain->s, found.s, 1e-7) << i;
            if (plain->s > 1e-3) {
                ASSERT_GT(dot(plain->n, found.n), 1 - 1e-6) << i;
            }
            ++(dot(plain->n, face.n) > 1 - 1e-9 ? over : at_corners);
        }
        EXPECT_GT(over, 200) << static_cast<int>(shape->kind);
        if (shape != &egg) {
            EXPECT_GT(at_corners, 200) << static_cast<int>(shape->kind);
        }
    }
}

TEST(OverTriangle, APointInsideHasNoClosestPointOfTheBody) {
    Shape can;
    can.kind = ShapeKind::kCylinder, can.radius = 0.1, can.half_length = 0.03;
    const Transform X{to_matrix(exponential(Vec3{0.3, 0.2, 0.1})), {1, 2, 3}};
    const Posed posed{can, X};
    const ConvexBody body(posed);
    EXPECT_FALSE(body.closest_to(X * Vec3{0.05, 0, 0.01}));
    const auto beside = body.closest_to(X * Vec3{0.3, 0, 0.01}),
               above = body.closest_to(X * Vec3{0.2, 0, 0.2});
    ASSERT_TRUE(beside && above);
    EXPECT_LT(norm(*beside - X * Vec3{0.1, 0, 0.01}), 1e-12);
    EXPECT_LT(norm(*above - X * Vec3{0.1, 0, 0.03}), 1e-12);
}

}  // namespace
}  // namespace roboss::narrow
