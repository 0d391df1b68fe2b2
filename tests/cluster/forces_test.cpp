// What a Client reads of contacts and joint reactions while the world runs, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <support/bodies.h>
#include <support/robots.h>

#include "simulation/simulation.h"

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kDt = 1e-3;

std::shared_ptr<const Model> model_of(const World& world) {
    Diagnostics diagnostics;
    const std::shared_ptr<const Model> model = compile(world, {}, diagnostics);
    if (!model)
        for (const Diagnostic& d : diagnostics.items()) ADD_FAILURE() << d.message;
    return model;
}

class Asking : public ControlProgram {
  public:
    explicit Asking(std::function<void(Client&)> ask) : ask_(std::move(ask)) {}
    ControlOptions options() const override { return {5 * kDt, -1, true}; }
    void control(Client& client) override { ask_(client); }

  private:
    std::function<void(Client&)> ask_;
};

/// Runs the world over two Simulators and lets `ask` look at it every 5 ms.
void run(const World& world, double seconds, std::function<void(Client&)> ask) {
    std::vector<NamedProgram> programs;
    programs.push_back({"asking", std::make_unique<Asking>(std::move(ask))});
    SimulationOptions options;
    options.simulators = 2;
    auto simulation = Simulation::create(model_of(world), options, std::move(programs));
    ASSERT_TRUE(simulation.value()->run_until(static_cast<Tick>(seconds / kDt + 0.5)).ok());
}

TEST(Forces, TheCornersOfABoxAtRestShareItsWeightEvenly) {
    constexpr double kMass = 3;
    World world = empty_world(kDt);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_box(kMass, {0.2, 0.3, 0.2}, surface(0.5)), "box", {{1, 2, 0.1}, {}});
    int asked = 0;
    run(world, 1, [&](Client& client) {
        if (client.time_s() < 0.2) return;
        ++asked;
        ASSERT_EQ(client.contacts().size(), 4u);
        for (const ContactReport& c : client.contacts()) {
            EXPECT_EQ(c.robot_a, RobotId(0u));
            EXPECT_FALSE(c.robot_b.valid()) << "the ground is scenery";
            EXPECT_NEAR(c.impulse / (0.25 * kMass * kG * kDt), 1, 1e-6);
            EXPECT_NEAR(norm(c.friction) / (kMass * kG * kDt), 0, 1e-6);
            EXPECT_NEAR(std::fabs(c.p_W.x - 1), 0.1, 1e-6);
            EXPECT_NEAR(std::fabs(c.p_W.y - 2), 0.15, 1e-6);
        }
    });
    EXPECT_EQ(asked, 160);
}

TEST(Forces, AStackPressesMoreTheLowerOneLooks) {
    World world = empty_world(kDt);
    place(world, ground(surface(0.5)), "ground");
    for (int i = 0; i < 3; ++i)
        place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.5)), "box_" + std::to_string(i),
              {{0, 0, 0.1 + 0.2 * i}, {}});
    int asked = 0;
    run(world, 1, [&](Client& client) {
        if (client.time_s() < 0.5) return;
        ++asked;
        double on_ground = 0, between[2] = {0, 0};
        for (const ContactReport& c : client.contacts())
            (c.robot_b.valid() ? between[std::min(c.robot_a, c.robot_b).index()] : on_ground) += c.impulse;
        EXPECT_NEAR(on_ground / (3 * kG * kDt), 1, 1e-5);
        EXPECT_NEAR(between[0] / (2 * kG * kDt), 1, 1e-5);
        EXPECT_NEAR(between[1] / (kG * kDt), 1, 1e-5);
    });
    EXPECT_EQ(asked, 100);
}

/// The hinge gives what the centre's acceleration takes beyond gravity: weight and centripetal force.
TEST(Forces, TheHingeOfASwingingPendulumBearsWeightAndCentripetalForce) {
    constexpr double kMass = 2, kLength = 1, kThick = 0.02;
    World world = empty_world(kDt);
    ModelSpec rod = one_link(
        link("rod", kMass, box_inertia(kMass, {kLength, kThick, kThick}), {{0.5 * kLength, 0, 0}, {}}));
    rod.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "rod", {}, {0, 1, 0}));
    place(world, rod, "pendulum");
    const double inertia =
        kMass * (kLength * kLength + kThick * kThick) / 12 + kMass * 0.25 * kLength * kLength;
    double largest = 0;
    run(world, 2, [&](Client& client) {
        const JointState hinge = client.joint(RobotId(0u), JointId(0u));
        const auto acceleration = [&](double angle) {
            return 0.5 * kMass * kG * kLength * std::cos(angle) / inertia;
        };
        // the reaction is the mean over the tick that begins now
        const double a0 = acceleration(hinge.position), half = 0.5 * kDt;
        const double angle = hinge.position + half * hinge.velocity + 0.5 * half * half * a0;
        const double a = acceleration(angle), w = hinge.velocity + half * acceleration(angle);
        const double c = std::cos(angle), s = std::sin(angle), r = 0.5 * kLength;
        const Vec3 force =
            Vec3{-s * a - c * w * w, 0, -c * a + s * w * w} * (kMass * r) + Vec3{0, 0, kMass * kG};
        const std::vector<JointReaction> reactions = client.joint_reactions(RobotId(0u));
        ASSERT_EQ(reactions.size(), 1u);
        EXPECT_LT(norm(reactions[0].force - force), 1e-5 * kMass * kG) << "tick " << client.tick();
        EXPECT_LT(norm(reactions[0].torque), 1e-5 * kMass * kG) << "a hinge without motor, in its plane";
        largest = std::fmax(largest, norm(reactions[0].force));
    });
    EXPECT_NEAR(largest / (2.5 * kMass * kG), 1, 1e-2) << "at the bottom of a swing from the horizontal";
}

/// A gear is a torque at both of its hinges, as a motor is.
TEST(Forces, AFollowersHingeBearsTheTorqueOfItsMimic) {
    constexpr double kInertia = 0.5;
    World world = empty_world(kDt, {});
    ModelSpec m;
    m.name = "pair", m.canonical_link = "base";
    m.links.push_back(link("base", 1, Mat3::identity()));
    m.joints.push_back(joint(JointSpecKind::kFixed, "weld", "world", "base", {}));
    for (const std::string name : {"a", "b"}) {
        m.links.push_back(link(name, 1, Mat3::identity() * kInertia, {{name == "a" ? 0.0 : 1.0, 0, 0}, {}}));
        m.joints.push_back(
            joint(JointSpecKind::kRevolute, "hinge_" + name, "base", name, m.links.back().X_ML, {0, 0, 1}));
    }
    m.joints[2].axes[0].mimic = MimicSpec{"hinge_a", 0, 2.0, 0, 0, {}};
    place(world, m, "pair");
    int asked = 0;
    run(world, 0.1, [&](Client& client) {
        ASSERT_TRUE(client.set_joint(RobotId(0u), JointId(1u), MotorMode::kEffort, 1.0).ok());
        if (client.tick() < 20) return;
        ++asked;
        const std::vector<JointReaction> reactions = client.joint_reactions(RobotId(0u));
        ASSERT_EQ(reactions.size(), 3u);
        const double a = 1.0 / (kInertia * (1 + 4));  // torque over the inertia that the leader feels
        EXPECT_NEAR(reactions[0].torque.z / (kInertia * 3 * a), 1, 1e-5) << "the weld's, which bears both";
        EXPECT_NEAR(reactions[1].torque.z / (kInertia * a), 1, 1e-5) << "motor less the gear's share";
        EXPECT_NEAR(reactions[2].torque.z / (kInertia * 2 * a), 1, 1e-5);
    });
    EXPECT_GT(asked, 10);
}

}  // namespace
}  // namespace roboss::test
