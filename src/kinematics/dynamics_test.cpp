// Inverse and forward dynamics against energies, finite differences, a textbook formula and the simulation's
// step.
#include "kinematics/dynamics.h"

#include <gtest/gtest.h>

#include <support/kinematic_robots.h>
#include <support/mechanical_sums.h>

namespace roboss::test {
namespace {

using Numbers = std::vector<double>;

Numbers times(const Numbers& matrix, const Numbers& x) {
    Numbers y(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < x.size(); ++j) y[i] += matrix[i * x.size() + j] * x[j];
    return y;
}

double largest_difference(const Numbers& a, const Numbers& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
    return largest;
}

/// One robot at a random configuration in motion, and what the functions give for it.
struct Example {
    Example(const ModelSpec& spec, Random& random)
        : robot(robot_of(spec)),
          q(random_configuration(robot, random)),
          v(random_row(robot.v_columns(), 2, random)),
          a(random_row(robot.v_columns(), 5, random)) {}

    std::size_t n() const { return robot.v_columns(); }
    const Vec3& gravity() const { return robot.model().gravity; }
    Numbers mass_matrix(const Numbers& at) const {
        Numbers out(n() * n());
        mass_matrices(robot, at, out);
        return out;
    }
    Numbers coriolis_matrix() const {
        Numbers out(n() * n());
        coriolis_matrices(robot, q, v, out);
        return out;
    }
    Numbers forces(const Numbers& velocities, const Numbers& accelerations, const Vec3& in_gravity) const {
        Numbers out(n());
        inverse_dynamics(robot, q, velocities, accelerations, in_gravity, out);
        return out;
    }

    RobotModel robot;
    Numbers q, v, a;
};

/// Calls check(example) for several configurations of each robot.
template <class Check>
void for_each_example(std::uint64_t seed, Check check) {
    Random random(seed);
    for (const ModelSpec& spec : sample_robots()) {
        SCOPED_TRACE(spec.name);
        for (int i = 0; i < 3; ++i) check(Example(spec, random));
    }
}

TEST(Dynamics, KineticEnergyIsThatOfTheLinks) {
    for_each_example(11, [](const Example& e) {
        const Numbers momentum = times(e.mass_matrix(e.q), e.v);
        double energy = 0;
        for (std::size_t i = 0; i < e.n(); ++i) energy += 0.5 * e.v[i] * momentum[i];
        MechanicalSummer sum(e.robot.model());
        EXPECT_NEAR(energy, sum({state_of(e.robot, e.q, e.v)}).kinetic, 1e-12 * (1 + energy));
    });
}

TEST(Dynamics, GravityIsTheSlopeOfThePotentialEnergy) {
    constexpr double kStep = 1e-5;
    for_each_example(12, [](const Example& e) {
        Numbers g(e.n());
        gravity_forces(e.robot, e.q, g);
        MechanicalSummer sum(e.robot.model());
        for (std::size_t c = 0; c < e.n(); ++c) {
            Numbers unit(e.n(), 0.0);
            unit[c] = 1;
            const double low = sum({state_of(e.robot, moved(e.robot, e.q, unit, -kStep), {})}).potential,
                         high = sum({state_of(e.robot, moved(e.robot, e.q, unit, kStep), {})}).potential;
            EXPECT_NEAR(g[c], (high - low) / (2 * kStep), 1e-7) << "column " << c;
        }
    });
}

TEST(Dynamics, InverseDynamicsAreMassTimesAccelerationAndBias) {
    for_each_example(13, [](const Example& e) {
        const Numbers inertial = times(e.mass_matrix(e.q), e.a), turning = times(e.coriolis_matrix(), e.v);
        Numbers g(e.n()), c(e.n()), sum(e.n());
        gravity_forces(e.robot, e.q, g);
        coriolis_forces(e.robot, e.q, e.v, c);
        for (std::size_t i = 0; i < e.n(); ++i) sum[i] = inertial[i] + c[i] + g[i];
        EXPECT_LT(largest_difference(c, turning), 1e-11);
        EXPECT_LT(largest_difference(e.forces(e.v, e.a, e.gravity()), sum), 1e-11);
    });
}

TEST(Dynamics, ForwardDynamicsUndoInverseDynamics) {
    for_each_example(14, [](const Example& e) {
        Numbers a(e.n());
        forward_dynamics(e.robot, e.q, e.v, e.forces(e.v, e.a, e.gravity()), e.gravity(), a);
        EXPECT_LT(largest_difference(a, e.a), 1e-9);
    });
}

TEST(Dynamics, MassRateMinusTwiceCoriolisIsSkewSymmetric) {
    constexpr double kStep = 1e-5;
    for_each_example(15, [](const Example& e) {
        const Numbers before = e.mass_matrix(moved(e.robot, e.q, e.v, -kStep)),
                      after = e.mass_matrix(moved(e.robot, e.q, e.v, kStep)), C = e.coriolis_matrix();
        Numbers rate(C.size()), both(C.size());
        for (std::size_t i = 0; i < e.n(); ++i)
            for (std::size_t j = 0; j < e.n(); ++j) {
                rate[i * e.n() + j] = (after[i * e.n() + j] - before[i * e.n() + j]) / (2 * kStep);
                both[i * e.n() + j] = C[i * e.n() + j] + C[j * e.n() + i];
            }
        EXPECT_LT(largest_difference(rate, both), 1e-7);
    });
}

TEST(Dynamics, DoublePendulumIsThatOfTheTextbook) {
    const double m1 = 1.0, l1 = 0.6, m2 = 0.7, l2 = 0.5, g = 9.81;
    World world = empty_world(1e-3, {0, 0, -g});
    place(world, double_pendulum(), "pendulum");
    const RobotModel robot = RobotModel::create(compiled(world), RobotId(0U)).value();
    const Numbers q{0.4, -0.7}, v{1.2, 0.5}, a{-0.6, 2.0};
    const auto inertia = [](double m, double l) {
        return m / 12 * (0.04 * 0.04 + l * l);
    };  // box_inertia of rod()
    const double c1 = 0.5 * l1, c2 = 0.5 * l2, i1 = inertia(m1, l1), i2 = inertia(m2, l2);
    const double cos2 = std::cos(q[1]), sin2 = std::sin(q[1]);
    const double m11 = i1 + i2 + m1 * c1 * c1 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * cos2),
                 m12 = i2 + m2 * (c2 * c2 + l1 * c2 * cos2), m22 = i2 + m2 * c2 * c2, h = m2 * l1 * c2 * sin2;
    const double s1 = std::sin(q[0]), s12 = std::sin(q[0] + q[1]);
    const Numbers wanted{m11 * a[0] + m12 * a[1] - h * (2 * v[0] * v[1] + v[1] * v[1]) +
                             g * ((m1 * c1 + m2 * l1) * s1 + m2 * c2 * s12),
                         m12 * a[0] + m22 * a[1] + h * v[0] * v[0] + g * m2 * c2 * s12};
    Numbers forces(2);
    inverse_dynamics(robot, q, v, a, {0, 0, -g}, forces);
    EXPECT_LT(largest_difference(forces, wanted), 1e-12);
}

/// A step of the simulation with the efforts that inverse dynamics ask for, against the accelerations asked
/// for. A tick of dt differs from them by a multiple of dt: two ticks tell the limit.
TEST(Dynamics, AStepOfTheSimulationAcceleratesAsAsked) {
    Random random(16);
    for (const ModelSpec& spec : {arm(), arm_of_all_joints(), reversed_ball()}) {
        SCOPED_TRACE(spec.name);
        const Example e(spec, random);
        Numbers motors = e.forces(e.v, e.a, e.gravity()), passive(e.n());
        passive_forces(e.robot, e.q, e.v, passive);
        for (std::size_t c = 0; c < e.n(); ++c) motors[c] -= passive[c];
        const auto acceleration = [&](double dt) {
            Model model = e.robot.model();
            model.dt_s = dt;
            RobotState state = state_of(e.robot, e.q, e.v);
            for (std::size_t c = 0; c < e.n(); ++c)
                state.motors[e.robot.v_of(c)] = {MotorMode::kEffort, motors[c], 1e6};
            const RobotId id(0U);
            RobotState* const pointer = &state;
            Aabb bound;
            StepScratch scratch;
            step_island(model, 0, std::span(&id, 1), std::span(&pointer, 1), {}, std::span(&bound, 1),
                        scratch);
            Numbers a(e.n());
            for (std::size_t c = 0; c < e.n(); ++c) a[c] = (state.v[e.robot.v_of(c)] - e.v[c]) / dt;
            return a;
        };
        const Numbers coarse = acceleration(2e-6), fine = acceleration(1e-6);
        Numbers limit(e.n());
        for (std::size_t c = 0; c < e.n(); ++c) limit[c] = 2 * fine[c] - coarse[c];
        tell(spec.name + ", largest difference in m/s^2 or rad/s^2", largest_difference(limit, e.a));
        EXPECT_LT(largest_difference(limit, e.a), 1e-6);
    }
}

}  // namespace
}  // namespace roboss::test
