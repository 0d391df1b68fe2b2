// The references that accuracy is measured against, checked against each other and against what is known of
// them: a wrong truth would make a right simulator look wrong.
#include <gtest/gtest.h>

#include <support/reference/extrapolation.h>
#include <support/reference/hinge_chain.h>
#include <support/reference/skid_turn.h>
#include <support/reference/tumbling_body.h>
#include <support/robots.h>

namespace roboss::test {
namespace {

TEST(Reference, JacobiFunctionsHaveTheirKnownValuesAtTheQuarterPeriod) {
    for (const Real k : {0.1L, 0.6L, 0.999L}) {
        const Real quarter = std::comp_ellint_1(k);
        const JacobiFunctions f = jacobi(quarter, k);
        EXPECT_NEAR(static_cast<double>(f.sn), 1, 1e-17);
        EXPECT_NEAR(static_cast<double>(f.dn - std::sqrt(1 - k * k)), 0, 1e-15);
        const JacobiFunctions half = jacobi(quarter / 2, k);  // Abramowitz, Stegun, 16.5
        EXPECT_NEAR(static_cast<double>(half.sn - 1 / std::sqrt(1 + std::sqrt(1 - k * k))), 0, 1e-15);
    }
}

TEST(Reference, ExtrapolationSolvesTheOscillatorToTheLastDigits) {
    RealVector y{1, 0};
    extrapolate([](const RealVector& at) { return RealVector{at[1], -at[0]}; }, 10.0L, 0.1L, y);
    EXPECT_LT(std::fabs(static_cast<double>(y[0] - std::cos(10.0L))), 1e-16);
    EXPECT_LT(std::fabs(static_cast<double>(y[1] + std::sin(10.0L))), 1e-16);
}

/// d/dt of (angular velocity in body axes, orientation) of a free body.
RealVector tumbling_rate(const RealVec3& moments, const RealVector& y) {
    const RealVec3 w{y[0], y[1], y[2]};
    const RealVec3 torque = cross(RealVec3{moments.x * w.x, moments.y * w.y, moments.z * w.z}, w);
    const QuatT<Real> q = QuatT<Real>{y[3], y[4], y[5], y[6]} * QuatT<Real>{0, w.x / 2, w.y / 2, w.z / 2};
    return {torque.x / moments.x, torque.y / moments.y, torque.z / moments.z, q.w, q.x, q.y, q.z};
}

TEST(Reference, EllipticFunctionsAgreeWithTheIntegratedTumblingBody) {
    const RealVec3 moments{97.0L / 6, 82.0L / 6, 17.0L / 6};
    const QuatT<Real> q{0.5L, 0.5L, -0.5L, 0.5L};
    for (const RealVec3& w : {RealVec3{0.05L, 3, 0.05L}, RealVec3{2, 0.5L, -0.7L}, RealVec3{-0.3L, 0.5L, -3},
                              RealVec3{0.3L, -2, 0.1L}}) {
        TumblingBody exact(moments, to_matrix(q), w);
        RealVector y{w.x, w.y, w.z, q.w, q.x, q.y, q.z};
        for (int i = 1; i <= 50; ++i) {
            const Real t = 0.1L * static_cast<Real>(i);
            extrapolate([&](const RealVector& at) { return tumbling_rate(moments, at); }, 0.1L, 0.01L, y);
            const RealMat3 R = exact.orientation(t);
            const RealMat3 S = to_matrix(normalized(QuatT<Real>{y[3], y[4], y[5], y[6]}));
            for (std::size_t r = 0; r < 3; ++r)
                ASSERT_LT(static_cast<double>(norm(R.row(r) - S.row(r))), 1e-12) << "at " << t;
            const RealVec3 now = exact.angular_B(t);
            ASSERT_LT(static_cast<double>(norm(now - RealVec3{y[0], y[1], y[2]})), 1e-11) << "at " << t;
        }
    }
}

TEST(Reference, PendulumOfHingesHasThePeriodOfTheEllipticIntegral) {
    const ModelSpec model = pendulum(1.0, 1.0);
    const HingeChain chain(model, {0, 0, -9.81});
    const Real amplitude = 2.0L, inertia = model.links[0].inertia_C(1, 1) + 0.25L;
    const Real rate = std::sqrt(9.81L * 0.5L / inertia);
    RealVector y{amplitude, 0};
    chain.advance(4 * std::comp_ellint_1(std::sin(amplitude / 2)) / rate, y);
    EXPECT_NEAR(static_cast<double>(y[0] - amplitude), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(y[1]), 0, 1e-13);
}

TEST(Reference, ArmIsConverged) {
    const ModelSpec model = arm();
    const HingeChain chain(model, {0, 0, -9.81});
    RealVector coarse{0, -1.5L, 0, 0, 0, 0, 0, 0}, fine = coarse;
    chain.advance(2, coarse);
    chain.advance(2, fine, 0.0025L);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        EXPECT_LT(std::fabs(static_cast<double>(coarse[i] - fine[i])), 1e-11);
}

TEST(Reference, SkidTurnOnTheSpotIsTheClosedForm) {
    const double x = 0.15, y = 0.13, speed = 0.35;
    SkidCar car;
    for (const double side : {1.0, -1.0})
        for (const double end : {1.0, -1.0}) car.points.push_back({end * x, side * y, -side * speed});
    car.mass = 6, car.height = 0.05, car.mu = 0.9;
    const SkidTurn turn = skid_turn(car);
    EXPECT_LT(turn.residual, 1e-9);
    EXPECT_NEAR(turn.yaw_rate, speed * y / (x * x + y * y), 1e-9);  // no moment about the centre
    EXPECT_NEAR(turn.forward, 0, 1e-9);
    EXPECT_NEAR(turn.sideways, 0, 1e-9);
}

}  // namespace
}  // namespace roboss::test
