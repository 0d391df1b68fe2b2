// Spatial algebra against the laws of mechanics: power, the invariance of power under the cross products, and
// a rigid body's momentum and energy computed the long way, as a cloud of point masses.
#include "math/spatial.h"

#include <gtest/gtest.h>

#include <array>

#include "math/quat.h"

namespace roboss {
namespace {

struct PointMass {
    double mass;
    Vec3 p;
};
const std::array<PointMass, 5> kCloud = {{{1.0, {1, 0, 0.5}},
                                          {2.0, {0, -1, 0.2}},
                                          {0.5, {2, 2, -1}},
                                          {0.7, {-1, 0.3, 3}},
                                          {1.3, {0.1, 0.2, -0.4}}}};
const Spatial kMotion{{0.3, -1.2, 0.8}, {2, 0.5, -1}};
const Spatial kOther{{-0.7, 0.1, 1.5}, {0.2, -2, 0.9}};
const Spatial kForce{{1.1, 0.4, -2}, {-0.6, 3, 0.25}};

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-13);
    EXPECT_NEAR(a.y, b.y, 1e-13);
    EXPECT_NEAR(a.z, b.z, 1e-13);
}

Vec3 velocity_at(const Spatial& motion, const Vec3& p) {
    return motion.linear + cross(motion.angular, p);
}

/// Mass, centre and inertia about the centre of the cloud.
SpatialInertia cloud_inertia() {
    double mass = 0;
    Vec3 moment;
    for (const PointMass& point : kCloud) mass += point.mass, moment += point.p * point.mass;
    const Vec3 centre = moment / mass;
    Sym3 about_centre;
    for (const PointMass& point : kCloud) {
        const Vec3 r = point.p - centre;
        const double m = point.mass;
        about_centre += Sym3{m * (r.y * r.y + r.z * r.z),
                             m * (r.x * r.x + r.z * r.z),
                             m * (r.x * r.x + r.y * r.y),
                             -m * r.x * r.y,
                             -m * r.x * r.z,
                             -m * r.y * r.z};
    }
    return spatial_inertia(mass, centre, about_centre);
}

TEST(Spatial, MomentumIsThatOfTheBodysPoints) {
    Spatial momentum;
    for (const PointMass& point : kCloud) {
        const Vec3 p = velocity_at(kMotion, point.p) * point.mass;
        momentum += Spatial{cross(point.p, p), p};
    }
    const Spatial computed = cloud_inertia() * kMotion;
    expect_near(computed.angular, momentum.angular);
    expect_near(computed.linear, momentum.linear);
}

TEST(Spatial, HalfMotionTimesMomentumIsTheKineticEnergy) {
    double energy = 0;
    for (const PointMass& point : kCloud)
        energy += 0.5 * point.mass * norm_squared(velocity_at(kMotion, point.p));
    EXPECT_NEAR(0.5 * dot(kMotion, cloud_inertia() * kMotion), energy, 1e-12);
}

TEST(Spatial, InertiasOfPartsAddUpToThatOfTheWhole) {
    SpatialInertia sum;
    for (const PointMass& point : kCloud) sum += spatial_inertia(point.mass, point.p, Sym3{});
    const Spatial of_parts = sum * kMotion, of_whole = cloud_inertia() * kMotion;
    expect_near(of_parts.angular, of_whole.angular);
    expect_near(of_parts.linear, of_whole.linear);
}

TEST(Spatial, CarryingMotionAndForceAlongKeepsTheirPower) {
    // d/dt (f . m) = 0 when both are carried along by the same motion.
    EXPECT_NEAR(dot(cross_force(kMotion, kForce), kOther) + dot(kForce, cross_motion(kMotion, kOther)), 0.0,
                1e-13);
}

TEST(Spatial, MotionsCrossAntisymmetrically) {
    const Spatial forth = cross_motion(kMotion, kOther), back = cross_motion(kOther, kMotion);
    expect_near(forth.angular, -back.angular);
    expect_near(forth.linear, -back.linear);
}

TEST(Sym3, RotatedInertiaIsRTimesInertiaTimesRTransposed) {
    const Mat3 R = to_matrix(from_rpy(0.4, 1.0, -2.2));
    const Mat3 inertia{{2, 0.1, -0.2}, {0.1, 3, 0.3}, {-0.2, 0.3, 4}};
    const Vec3 v{0.5, -1.5, 2};
    expect_near(rotated(R, inertia) * v, R * inertia * transpose(R) * v);
}

}  // namespace
}  // namespace roboss
