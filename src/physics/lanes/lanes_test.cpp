// Robots in lanes get the bits of robots by themselves: whatever they drive on, whoever of them goes another
// way, however many fill a register.
#include <gtest/gtest.h>

#include <support/compare_lanes.h>
#include <support/mechanisms.h>
#include <support/meshes.h>
#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

TEST(Lanes, CarsDriveTurnBrakeAndLeanOnTheirMotorsAlike) {
    const Drive drive = [](Simulation& sim) {
        if (sim.tick % 40 != 0) return;
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t wheel = 0; wheel < sim.states[r].motors.size(); ++wheel) {
                const double turn = wheel % 2 == 0 ? 1.0 : -1.0;
                sim.set_motor(r, wheel, MotorMode::kVelocity,
                              static_cast<double>((sim.tick / 40 + static_cast<Tick>(r)) % 5) * 4.0 +
                                  turn * static_cast<double>(r % 3));
            }
    };
    compare(scattered(car(), 13, 0.001), drive, 400);
}

TEST(Lanes, MotorsInDifferentModesPartTheLanes) {
    const Drive drive = [](Simulation& sim) {
        if (sim.tick != 0) return;
        constexpr MotorMode kModes[] = {MotorMode::kPassive, MotorMode::kVelocity, MotorMode::kPosition,
                                        MotorMode::kEffort};
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, kModes[(r / 3) % 4], 0.3);
    };
    compare(scattered(car(), 16, 0.001), drive, 200);
}

TEST(Lanes, SpidersFallLandAndWalkAlike) {
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kPosition,
                              (sim.tick / 50 + static_cast<Tick>(d)) % 2 == 0 ? 0.15 : -0.1);
    };
    compare(scattered(with_balls(spider(), 0.02), 9, 0.0), drive, 300);
}

TEST(Lanes, ArmsOnFixedBasesFollowTheirServosAlike) {
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, d % 2 == 0 ? MotorMode::kPosition : MotorMode::kVelocity,
                              0.5 * fixed_sin(0.01 * static_cast<double>(sim.tick) + static_cast<double>(r)));
    };
    compare(scattered(arm(), 11, 2.0), drive, 300);
}

/// Servos with gains, far from their targets and near: at their bounds, at their maximum velocity, below.
TEST(Lanes, PendulumsOnPlanarJointsAlike) {
    ModelSpec m = one_link(link("puck", 2.0, Mat3::diagonal(0.06, 0.07, 0.1)));
    m.joints.push_back(planar_joint("plane", "world", "puck", {{}, from_rpy(0.2, 0, 0)}, {0, 0, 1}));
    m.links.push_back(rod("rod", 1.0, 0.6, {{0.05, 0.02, 0}, {}}));
    m.joints.push_back(
        joint(JointSpecKind::kRevolute, "hinge", "puck", "rod", m.links.back().X_ML, {0.3, 1, 0}));
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; r < sim.states.size(); ++r) {
            if (sim.tick == 0) sim.states[r].v[3] = 1.0 + 0.1 * static_cast<double>(r);
            if (sim.tick % 100 != 0) continue;
            sim.set_motor(r, 0, MotorMode::kVelocity, 0.2 * static_cast<double>(r % 4));
            sim.set_motor(r, 2, MotorMode::kEffort, 0.1);
        }
    };
    compare(scattered(m, 11, 2.0), drive, 300);
}

TEST(Lanes, ArmsWithGainsFollowAlike) {
    World world = scattered(arm(), 11, 2.0);
    for (JointSpec& j : world.prototypes.back().joints)
        for (AxisSpec& axis : j.axes) {
            axis.position_gain = 60, axis.velocity_gain = 3;
            axis.max_effort = 15, axis.max_velocity = 1.5;
        }
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kPosition,
                              0.2 * static_cast<double>(r) * (sim.tick / 100 % 2 == 0 ? 1 : -1));
    };
    compare(world, drive, 300);
}

/// Cars on soft wheels, which stay in lanes; with friction by direction, which does not.
TEST(Lanes, CarsOnOtherSurfacesAlike) {
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; r < sim.states.size(); ++r)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kVelocity, d % 2 == 0 ? 4 : 10);
    };
    for (const bool soft : {true, false}) {
        World world = scattered(car(), 9, 0.05);
        for (LinkSpec& l : world.prototypes.back().links)
            for (CollisionSpec& c : l.collisions) {
                if (soft)
                    c.surface.stiffness = 2e4, c.surface.damping = 100;
                else
                    c.surface.mu2 = 0.2, c.surface.fdir1 = {1, 0, 0};
            }
        compare(world, drive, 300);
    }
}

/// Trees with every kind of joint, dropped: limits, joint friction, springs, bounces, rest.
TEST(Lanes, MixedTreesFallAlike) {
    const Drive none = [](Simulation&) {};
    compare(scattered(with_balls(mixed_tree(), 0.03), 10, 1.0, 1e-3), none, 600);
}

TEST(Lanes, BouncingCarsAlike) {
    World world = scattered(car(), 8, 0.3);
    for (LinkSpec& l : world.prototypes.back().links)
        for (CollisionSpec& c : l.collisions) c.surface.restitution = 0.6;
    compare(
        world, [](Simulation&) {}, 400);
}

/// Deep in the ground at the start: the displacement of the tick has a solution of its own.
TEST(Lanes, CarsThatStartInTheGroundAreMendedAlike) {
    compare(
        scattered(car(), 8, -0.03), [](Simulation&) {}, 200);
}

TEST(Lanes, WhoSleepsSleepsAtTheSameTick) {
    World world = scattered(car(), 9, 0.001);
    world.sleep = true;
    const Drive drive = [](Simulation& sim) {
        if (sim.tick != 0) return;
        for (std::size_t r = 0; r < sim.states.size(); r += 2)
            for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
                sim.set_motor(r, d, MotorMode::kVelocity, 3);
    };
    compare(world, drive, 600);
}

/// A crowd in which some meet and others do not, on slopes of each other.
TEST(Lanes, CrowdsAlike) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        compare(
            random_crowd(seed, 40),
            [&](Simulation& sim) {
                if (sim.tick == 0) stir(sim, seed);
            },
            60);
}

/// Of the steps of driving cars, the share that are taken in lanes.
double share_in_lanes(Precision precision, std::size_t width) {
    World world = scattered(car(), static_cast<int>(width), 0.001);
    world.precision = precision;
    Simulation sim(world);
    for (std::size_t r = 0; r < sim.states.size(); ++r)
        for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
            sim.set_motor(r, d, MotorMode::kVelocity, 10);
    sim.run(2);
    StepReport report;
    constexpr int kTicks = 250;
    const int stepped = step_only_in_lanes(sim, precision, width, kTicks, report);
    EXPECT_GE(report.contacts, stepped * 4);
    return stepped / (static_cast<double>(kTicks) * static_cast<double>(width));
}

/// Past, against and over boxes and meshes, fast enough to be swept and to turn far.
TEST(Lanes, FastCarsPassAndHitSceneryAlike) {
    World world = scattered(car(), 13, 0.02);
    for (int i = 0; i < 13; ++i) {
        const Vec3 p{5.0 * i + 0.8 * fixed_cos(0.4 * i), 0.3 * i + 0.8 * fixed_sin(0.4 * i) + 0.02 * i - 0.1,
                     0.2};
        const Vec3 size{0.2, 0.4, 0.4};
        place(world,
              scenery(i % 2 == 0 ? box_shape(size, surface(0.5)) : mesh_shape(box_mesh(size), surface(0.5))),
              "block_" + std::to_string(i), {p, from_rpy(0, 0, 0.3 * i)});
    }
    const Drive drive = [](Simulation& sim) {
        if (sim.tick % 60 != 0) return;
        for (std::size_t r = 0; r < sim.states.size(); ++r) {
            RobotState& s = sim.states[r];
            const double speed = 4.0 + 4.0 * static_cast<double>(r), yaw = 0.4 * static_cast<double>(r);
            s.v[2] = 10.0 * static_cast<double>(r % 4);
            s.v[3] = speed * fixed_cos(yaw), s.v[4] = speed * fixed_sin(yaw);
        }
    };
    compare(world, drive, 150);
}

/// Bent arms whose coarse bounds overlap, as stretched ones would, and whose exact ones do not: no set of
/// robots that may meet holds two of them, and bits are the same without lanes, where all are one.
TEST(Lanes, BentArmsInReachOfEachOtherMeetNobody) {
    ModelSpec model = with_balls(arm(), 0.03);
    World world = empty_world(2e-3);
    world.prototypes.push_back(model);
    for (int i = 0; i < 9; ++i)
        world.instances.push_back({"arm_" + std::to_string(i), 0, {{1.5 * i, 0, 0}, {}}, {}});
    const Drive drive = [](Simulation& sim) {
        for (std::size_t r = 0; sim.tick == 0 && r < sim.states.size(); ++r) {
            RobotState& s = sim.states[r];
            for (std::size_t d = 0; d < s.motors.size(); ++d) {
                s.q[7 + d] = d % 2 == 0 ? 0.0 : 2.5;
                sim.set_motor(r, d, MotorMode::kPosition, s.q[7 + d]);
            }
        }
    };
    compare(world, drive, 100);
    Simulation alone(world), in_lanes(world);
    alone.scratch.use_lanes(1);
    drive(alone), drive(in_lanes);
    EXPECT_EQ(alone.step().largest_group, 9);
    if (in_lanes.scratch.lanes(world.precision) > 1) {
        EXPECT_EQ(in_lanes.step().largest_group, 0);
    }
}

/// Each with names, topics and sensors of its own.
World differently_named_cars(int count) {
    World world = scattered(car(), count, 0);
    for (int i = 0; i < count; ++i) {
        const std::string own = "car_" + std::to_string(i) + "_";
        ModelSpec spec = car();
        spec.name = own;
        for (LinkSpec& link : spec.links) link.name = own + link.name;
        for (JointSpec& joint : spec.joints)
            joint.name = own + joint.name, joint.parent = own + joint.parent, joint.child = own + joint.child;
        spec.canonical_link = spec.links[0].name;
        SensorSpec sensor;
        sensor.name = own + "scan", sensor.parameters = LaserSpec{};
        spec.links[0].sensors.push_back(sensor);
        world.instances[static_cast<std::size_t>(i) + 1].prototype = world.prototypes.size();
        world.prototypes.push_back(spec);
    }
    return world;
}

TEST(Lanes, RobotsOfOneTypeShareThemWhateverTheyAreCalled) {
    const auto drive = [](Simulation& sim) {
        for (std::size_t r = 0; sim.tick == 0 && r < sim.states.size(); ++r)
            for (std::size_t wheel = 0; wheel < 4; ++wheel)
                sim.set_motor(r, wheel, MotorMode::kVelocity, static_cast<double>(r + wheel));
    };
    const World named = differently_named_cars(9);
    Simulation own_names(named), one_name(scattered(car(), 9, 0));
    ASSERT_EQ(own_names.model->type_of(own_names.ids[8]).links[0].name, "car_8_chassis");
    for (const RobotId robot : own_names.ids) EXPECT_EQ(own_names.model->like(robot).index(), 0u);
    compare(named, drive, 60);
    for (int i = 0; i < 60; ++i) {
        drive(own_names), drive(one_name);
        own_names.step(), one_name.step();
        expect_same_states(own_names, one_name, "own names");
    }
}

/// They are of use at all: most of the cars' steps are taken in lanes.
TEST(Lanes, DrivingCarsStayInTheirLanes) {
    const auto expect_most = [](Precision precision, std::span<const std::size_t> widths) {
        for (const std::size_t width : widths) {
            if (!has_lanes(precision, width)) continue;
            const double share = share_in_lanes(precision, width);
            tell("share of steps in " + std::to_string(width) + " lanes", share);
            EXPECT_GT(share, width > 8 ? 0.4 : 0.5);  // of more robots more often one decides otherwise
        }
    };
    expect_most(Precision::kDouble, kWidths);
    expect_most(Precision::kFloat, kFloatWidths);
}

}  // namespace
}  // namespace roboss::test
