// What a surface does to a contact, against closed forms: soft contacts, friction that depends on the
// direction, filters.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81;

SurfaceSpec soft(double stiffness, double damping) {
    SurfaceSpec s = surface(0.5);
    s.stiffness = stiffness;
    s.damping = damping;
    return s;
}

/// A ball of 2 kg and 0.1 m radius on a plane.
World ball_on_plane(double dt_s, const SurfaceSpec& of_ball, const SurfaceSpec& of_plane, double height) {
    World world = empty_world(dt_s);
    place(world, ground(of_plane), "ground");
    place(world, solid_sphere(2.0, 0.1, of_ball), "ball", {{0, 0, 0.1 + height}, {}});
    return world;
}

TEST(SoftContact, SinksByWeightOverStiffness) {
    for (const double dt_s : {1e-3, 4e-3}) {
        Simulation sim(ball_on_plane(dt_s, soft(1e4, 200), surface(0.5), 0));
        sim.run(3);
        EXPECT_NEAR((0.1 - sim.states[0].q[2]) / (2.0 * kG / 1e4), 1, 1e-6);
        EXPECT_LT(std::fabs(sim.states[0].v[5]), 1e-9);
    }
}

TEST(SoftContact, TwoSpringsAreInSeries) {
    Simulation sim(ball_on_plane(1e-3, soft(1e4, 200), soft(4e4, 800), 0));
    sim.run(3);
    EXPECT_NEAR((0.1 - sim.states[0].q[2]) / (2.0 * kG / 8e3), 1, 1e-6);
}

TEST(SoftContact, OscillatesAsADampedSpring) {
    constexpr double kMass = 2, kStiffness = 800, kDamping = 4, kDt = 1e-4;
    Simulation sim(ball_on_plane(kDt, soft(kStiffness, kDamping), surface(0.5), 0));
    const double omega = std::sqrt(kStiffness / kMass), rest = 0.1 - kMass * kG / kStiffness;
    sim.states[0].q[2] = rest + 0.01;  // stays in contact all the time
    std::vector<double> times, peaks;
    double before = -1;
    for (int i = 0; i < 20000; ++i) {
        sim.step();
        const double v = sim.states[0].v[5];
        if (before > 0 && v <= 0) times.push_back(sim.time()), peaks.push_back(sim.states[0].q[2] - rest);
        before = v;
    }
    ASSERT_GE(times.size(), 5u);
    const double period = (times[4] - times[0]) / 4, decrement = std::log(peaks[0] / peaks[4]) / 4;
    // The implicit step adds omega dt / 2 to the damping ratio.
    const double zeta = kDamping / (2 * std::sqrt(kStiffness * kMass)) + 0.5 * omega * kDt;
    tell("relative error of the decrement", decrement / (2 * kPi * zeta / std::sqrt(1 - zeta * zeta)) - 1);
    EXPECT_NEAR(period * omega * std::sqrt(1 - zeta * zeta) / (2 * kPi), 1, 1e-3);
    EXPECT_NEAR(decrement / (2 * kPi * zeta / std::sqrt(1 - zeta * zeta)), 1, 5e-3);
}

TEST(SoftContact, NeverPullsAndNeverGivesEnergy) {
    Simulation sim(ball_on_plane(1e-3, soft(5e3, 1), surface(0.5), 0.3));
    double energy = sim.energy(), gain = 0, highest = 0;
    bool left = false;
    for (int i = 0; i < 3000; ++i) {
        sim.step();
        if (sim.states[0].q[2] > 0.11 && sim.states[0].v[5] > 0) left = true;
        if (left) highest = std::fmax(highest, sim.states[0].q[2] - 0.1);
        // the spring's energy counts too: compare in flight only
        if (sim.states[0].q[2] < 0.1) continue;
        gain = std::fmax(gain, sim.energy() - energy);
        energy = std::fmin(energy, sim.energy());
    }
    EXPECT_TRUE(left) << "it bounces off its spring";
    EXPECT_LT(highest, 0.3);
    EXPECT_LT(gain, 1e-6);
}

/// Highest speed of a ball that starts `depth` in the ground, m/s.
double speed_out_of(Simulation& sim, double seconds) {
    double fastest = 0;
    while (sim.time() < seconds) {
        sim.step();
        fastest = std::fmax(fastest, sim.states[0].v[5]);
    }
    return fastest;
}

TEST(SoftContact, PushesOutOfTheGroundNoFasterThanItsSurfacesSay) {
    for (const double max_vel : {0.01, 0.1, 1.0, -1.0})
        for (const double stiffness : {1e4, 1e5, 1e7})
            for (const double damping : {0.0, 1.0, 100.0}) {
                SurfaceSpec s = soft(stiffness, damping);
                s.max_vel = max_vel;
                const double most = max_vel < 0 ? 2 : max_vel;
                Simulation sim(ball_on_plane(1e-3, s, surface(0.5), -0.03));
                EXPECT_LE(speed_out_of(sim, 1), most) << stiffness << " N/m, " << damping << " N s/m";
                if (most < 0.1) continue;
                sim.run(3);
                EXPECT_NEAR((0.1 - sim.states[0].q[2]) / (2.0 * kG / stiffness), 1, 2e-2)
                    << stiffness << " N/m, " << damping << " N s/m, " << max_vel << " m/s";
            }
}

TEST(SoftContact, ThrowsNoBoxWhoseFourCornersStartInTheGround) {
    SurfaceSpec s = soft(1e5, 1);
    s.max_vel = 0.1, s.min_depth = 1e-3;
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_box(3.0, {0.1, 0.1, 0.1}, s), "box", {{0, 0, 0.04}, {}});
    Simulation sim(world);
    EXPECT_LE(speed_out_of(sim, 1), 0.1);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].q[2], 0.05 - 3 * kG / 4e5, 1e-6);
}

TEST(SoftContact, ThrowsNothingThatAnOrderPutIntoTheGround) {
    SurfaceSpec s = soft(1e5, 1);
    s.max_vel = 0.1;
    Simulation sim(ball_on_plane(1e-3, s, surface(0.5), 0));
    sim.run(0.5);
    const Order down{sim.tick, ClientId(0u), 1, RobotId(0u), SetPose{{{0, 0, 0.09}, {}}}};
    sim.step({&down, 1});
    EXPECT_LE(speed_out_of(sim, sim.time() + 1), 0.1);
}

/// A ball that falls onto a spring gets its energy back, however slowly its surfaces recover.
TEST(SoftContact, ReboundsWhateverTheSpeedOfRecovery) {
    std::vector<double> heights;
    for (const double max_vel : {-1.0, 0.01}) {
        SurfaceSpec s = soft(5e4, 1);
        s.max_vel = max_vel;
        Simulation sim(ball_on_plane(1e-4, s, surface(0.5), 0.3));
        while (sim.states[0].v[5] <= 0) sim.step();
        double highest = 0;
        while (sim.states[0].v[5] > 0) sim.step(), highest = sim.states[0].q[2] - 0.1;
        heights.push_back(highest);
    }
    EXPECT_GT(heights[0], 0.2);
    EXPECT_NEAR(heights[1] / heights[0], 1, 0.06);
}

TEST(SoftContact, AsStiffAsRigidOnesIsRigid) {
    Simulation rigid(ball_on_plane(1e-3, surface(0.5), surface(0.5), 0)),
        hard(ball_on_plane(1e-3, soft(1e13, 1), surface(0.5), 0));
    rigid.run(0.2);
    hard.run(0.2);
    EXPECT_EQ(rigid.states[0].q, hard.states[0].q);
}

TEST(RigidContact, RecoversAsFastAndAsFarAsTheSurfaceSays) {
    SurfaceSpec s = surface(0.5);
    s.min_depth = 2e-3;
    s.max_vel = 0.01;
    Simulation sim(ball_on_plane(1e-3, s, surface(0.5), -0.012));
    sim.run(0.5);
    EXPECT_LT(sim.states[0].q[2], 0.088 + 0.005 + 1e-5) << "0.5 s at 1 cm/s, at most";
    EXPECT_GT(sim.states[0].q[2], 0.088 + 0.9 * 0.005);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].q[2], 0.098, 1e-4) << "2 mm are left alone";
}

/// A flat box whose friction is 0.6 along its own x axis and 0.3 across, turned by `yaw`, on rough ground.
World anisotropic_box(double yaw) {
    SurfaceSpec s = surface(0.6);
    s.mu2 = 0.3;
    s.fdir1 = {2, 0, 0};
    World world = empty_world(1e-3);
    place(world, ground(surface(5)), "ground");
    place(world, solid_box(1.0, {0.3, 0.3, 0.05}, s), "box", {{0, 0, 0.025}, from_rpy(0, 0, yaw)});
    return world;
}

TEST(AnisotropicFriction, StopsAfterTheWayOfItsDirection) {
    constexpr double kSpeed = 2;
    for (const double yaw : {0.0, 0.7}) {
        for (const double angle : {0.0, kPi / 2}) {
            Simulation sim(anisotropic_box(yaw));
            const double c = std::cos(yaw + angle), s = std::sin(yaw + angle);
            sim.states[0].v = {0, 0, 0, kSpeed * c, kSpeed * s, 0};
            sim.run(2);
            const double mu = angle == 0 ? 0.6 : 0.3, displacement = kSpeed * kSpeed / (2 * mu * kG);
            const double x = sim.states[0].q[0], y = sim.states[0].q[1];
            EXPECT_NEAR((c * x + s * y) / displacement, 1, 5e-3) << "yaw " << yaw << ", angle " << angle;
            EXPECT_LT(std::fabs(c * y - s * x), 1e-4 * displacement);
        }
    }
}

TEST(AnisotropicFriction, BendsTheWayAsTheEllipseOfMostDissipationSays) {
    // dv_i/dt = -g mu_i^2 v_i / |mu v|: v_x / v_y^(mu_x^2 / mu_y^2) does not change while it slides
    Simulation sim(anisotropic_box(0));
    sim.states[0].v = {0, 0, 0, 2, 1.5, 0};
    const double invariant = 2 / (1.5 * 1.5 * 1.5 * 1.5);
    for (int i = 0; i < 250; ++i) {
        sim.step();
        const double vx = sim.states[0].v[3], vy = sim.states[0].v[4];
        ASSERT_GT(vy, 0.1);
        ASSERT_NEAR(vx / (vy * vy * vy * vy) / invariant, 1, 0.02) << "tick " << i;
        ASSERT_LT(std::fabs(sim.states[0].v[2]), 1e-3) << "does not turn";
    }
    EXPECT_LT(sim.states[0].v[3] / sim.states[0].v[4], 0.5 * 2 / 1.5) << "bent towards the slippery axis";
}

TEST(AnisotropicFriction, HoldsAlongTheRoughAxisOnly) {
    for (const bool along : {true, false}) {  // slope of 25 degrees: tan = 0.466
        SurfaceSpec s = surface(0.6);
        s.mu2 = 0.3;
        s.fdir1 = along ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Quat tilt = from_rpy(0, 25 * kPi / 180, 0);
        World world = empty_world(1e-3);
        place(world, ground(surface(5)), "ground", {{}, tilt});
        place(world, solid_box(1.0, {0.3, 0.3, 0.05}, s), "box", {rotate(tilt, Vec3{0, 0, 0.025}), tilt});
        Simulation sim(world);
        sim.run(1);
        const Vec3 v{sim.states[0].v[3], sim.states[0].v[4], sim.states[0].v[5]};
        const double a = 25 * kPi / 180;
        if (along) {
            EXPECT_LT(norm(v), 1e-6);
        } else {
            EXPECT_NEAR(norm(v), kG * (std::sin(a) - 0.3 * std::cos(a)), 1e-4);
        }
    }
}

TEST(TorsionalFriction, ASpinningBallSlowsDownLinearly) {
    constexpr double kMass = 2, kRadius = 0.1, kSpin = 30, kPatch = 0.01;
    SurfaceSpec s = surface(0.5);
    s.torsional_mu = 0.8;
    s.torsional_radius = kPatch;
    Simulation sim(ball_on_plane(1e-3, s, surface(0.5), 0));
    sim.run(0.05);
    sim.states[0].v[2] = kSpin;
    const double deceleration = 3 * kPi / 16 * 0.8 * kPatch * kMass * kG / (0.4 * kMass * kRadius * kRadius);
    const double start = sim.time(), stop = kSpin / deceleration;
    sim.run(0.5 * stop);
    EXPECT_NEAR(sim.states[0].v[2] / (kSpin - deceleration * (sim.time() - start)), 1, 1e-4);
    sim.run(0.5 * stop + 0.01);
    EXPECT_LT(std::fabs(sim.states[0].v[2]), 1e-6);
    EXPECT_LT(std::hypot(sim.states[0].q[0], sim.states[0].q[1]), 1e-6) << "spins on the spot";
}

TEST(TorsionalFriction, TheSurfacesRadiusMakesAPatchOfTheDepth) {
    // A soft ball sinks by m g / kp; its patch has the radius sqrt(R depth).
    SurfaceSpec s = soft(1e4, 200);
    s.torsional_mu = 1;
    s.torsional_surface_radius = 0.1;
    Simulation sim(ball_on_plane(1e-3, s, surface(0.5), 0));
    sim.run(2);
    sim.states[0].v[2] = 100;
    sim.run(0.1);
    const double patch = std::sqrt(0.1 * 2 * kG / 1e4);
    const double deceleration = 3 * kPi / 16 * patch * kG / (0.4 * 0.01);
    EXPECT_NEAR((100 - sim.states[0].v[2]) / (0.1 * deceleration), 1, 1e-4);
}

TEST(RollingFriction, ARollingBallStopsWhereItsLeverSays) {
    constexpr double kSpeed = 1, kRadius = 0.1, kLever = 0.002;
    SurfaceSpec s = surface(0.5);
    s.rolling_mu = kLever;
    for (const double angle : {0.0, 0.6}) {
        Simulation sim(ball_on_plane(1e-3, s, surface(0.5), 0));
        sim.run(0.05);
        const double c = std::cos(angle), sn = std::sin(angle);
        sim.states[0].v = {-sn * kSpeed / kRadius, c * kSpeed / kRadius, 0, c * kSpeed, sn * kSpeed, 0};
        // moment lever * m g on a ball that rolls: inertia about the contact point 1.4 m r^2
        const double a = kLever * kG / (1.4 * kRadius);
        sim.run(kSpeed / a + 0.2);
        const double displacement = std::hypot(sim.states[0].q[0], sim.states[0].q[1]);
        EXPECT_NEAR(displacement / (kSpeed * kSpeed / (2 * a)), 1, 3e-3);
        EXPECT_NEAR(std::atan2(sim.states[0].q[1], sim.states[0].q[0]), angle, 1e-4);
        EXPECT_LT(std::hypot(sim.states[0].v[3], sim.states[0].v[4]), 1e-6) << "and stays";
    }
}

TEST(RollingFriction, HoldsABallOnASlopeBelowTheLeverOverTheRadius) {
    for (const bool holds : {true, false}) {
        SurfaceSpec s = surface(0.5);
        s.rolling_mu = holds ? 0.006 : 0.004;  // the slope's tangent is 0.05
        const double slope = std::atan(0.05);
        const Quat tilt = from_rpy(0, slope, 0);
        World world = empty_world(1e-3);
        place(world, ground(surface(0.5)), "ground", {{}, tilt});
        place(world, solid_sphere(2.0, 0.1, s), "ball", {rotate(tilt, Vec3{0, 0, 0.1}), {}});
        Simulation sim(world);
        sim.run(1);
        const double v = norm(Vec3{sim.states[0].v[3], sim.states[0].v[4], sim.states[0].v[5]});
        if (holds) {
            EXPECT_LT(v, 1e-6);
        } else {
            EXPECT_NEAR(v / ((kG * std::sin(slope) - 0.04 * kG * std::cos(slope)) / 1.4), 1, 2e-3);
        }
    }
}

/// A ball on a slide cannot turn, so torsional and rolling friction find nothing to act on.
TEST(RollingFriction, OfABallThatCannotTurnDoesNothing) {
    double rest[2] = {};
    for (const bool rolls : {false, true}) {
        SurfaceSpec s = surface(0.5);
        if (rolls) s.torsional_mu = 0.1, s.rolling_mu = 0.01;
        ModelSpec ball = solid_sphere(2.0, 0.1, s);
        ball.joints.push_back(
            joint(JointSpecKind::kPrismatic, "slide", "world", ball.links[0].name, {}, {0, 0, 1}));
        World world = empty_world(1e-3);
        place(world, ground(surface(0.5)), "ground");
        place(world, ball, "ball", {{0, 0, 0.05}, {}});
        Simulation sim(world);
        sim.run(1);
        for (const double x : sim.states[0].q) ASSERT_TRUE(std::isfinite(x));
        rest[rolls] = sim.states[0].q.back();
    }
    EXPECT_EQ(rest[0], rest[1]);
    EXPECT_NEAR(rest[0], 0.05, 1e-3) << "pushed out of the ground";
}

TEST(Surface, AtMostSoManyContactsOfAPair) {
    SurfaceSpec s = surface(0.5);
    for (const int most : {0, 1, 3, 4, 9}) {
        s.max_contacts = most;
        World world = empty_world(1e-3);
        place(world, ground(surface(0.5)), "ground");
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, s), "box", {{0, 0, 0.1}, {}});
        Simulation sim(world);
        EXPECT_EQ(sim.step().contacts, std::min(most, 4));
    }
}

TEST(Surface, CategoriesMeetTheOthersMask) {
    const auto falls = [](unsigned category_a, unsigned mask_a, unsigned category_b, unsigned mask_b) {
        SurfaceSpec a = surface(0.5), b = surface(0.5);
        a.category_bitmask = category_a, a.collide_bitmask = mask_a;
        b.category_bitmask = category_b, b.collide_bitmask = mask_b;
        Simulation sim(ball_on_plane(1e-3, a, b, 0));
        sim.run(0.2);
        return sim.states[0].q[2] < 0.05;
    };
    EXPECT_FALSE(falls(1, 1, 1, 1));
    EXPECT_FALSE(falls(1, 2, 2, 4)) << "a's mask names b's category";
    EXPECT_FALSE(falls(1, 2, 4, 1)) << "b's mask names a's category";
    EXPECT_TRUE(falls(1, 2, 4, 8));
}

}  // namespace
}  // namespace roboss::test
