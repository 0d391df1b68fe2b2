// Bodies that tumble over the ground fast enough to take the kick-drift step: what they lose does not
// depend on the time step in the limit, and they gain nothing.
#include <gtest/gtest.h>

#include <cmath>

#include <support/scenes.h>

namespace roboss::test {
namespace {

/// Energy in J after 2 s of an ellipsoid (half axes .1, .1 and `radius_z` m, 1 kg) that rolls at 20 rad/s.
double energy_after_rolling(double dt_s, double radius_z, double* at_start = nullptr) {
    World world = empty_world(dt_s);
    place(world, ground(surface(0.8)), "ground");
    ModelSpec body = solid_sphere(1.0, 0.1, surface(0.8));
    CollisionSpec& shape = body.links[0].collisions[0];
    shape = collision(GeometryKind::kEllipsoid, surface(0.8));
    shape.geometry.size = {0.1, 0.1, radius_z};
    body.links[0].inertia_C = box_inertia(1.0, {0.15, 0.15, 1.5 * radius_z});
    place(world, body, "body", {{0, 0, radius_z}, {}});
    Simulation sim(world);
    sim.states[0].v = {0, 20, 0, 20 * radius_z, 0, 0};
    if (at_start != nullptr) *at_start = sim.energy();
    sim.run(2.0);
    return sim.energy();
}

TEST(Tumble, AnEllipsoidThatRollsFastGainsNothingAndLosesLessTheSmallerTheStep) {
    for (const double radius_z : {0.07, 0.09, 0.0999}) {
        double start = 0;
        const double coarse = energy_after_rolling(4e-3, radius_z, &start);
        const double middle = energy_after_rolling(2e-3, radius_z),
                     fine = energy_after_rolling(1e-3, radius_z);
        tell("energy kept at 4 ms", coarse / start);
        tell("energy kept at 1 ms", fine / start);
        EXPECT_LT(fine, start);
        EXPECT_LT(std::fabs(fine - middle), 0.6 * std::fabs(middle - coarse) + 1e-5 * start) << radius_z;
    }
}

}  // namespace
}  // namespace roboss::test
