// How fast the error of contact-free motion falls with the step: the slope of log(error) over log(dt), which
// the theory of the integrator gives (6 for Butcher's Runge-Kutta method, which bodies on joints take, 4 for
// the classical one of a lone body, 1 for semi-implicit Euler).
#include <support/reference/hinge_chain.h>
#include <support/reference/tumbling_body.h>
#include <support/robots.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

using test::Real;
constexpr double kDuration = 1.0;

double arm_error(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::arm(), "arm");
    Trial trial(contender, world);
    test::RealVector exact{0.5L, 1.2L, 0.8L, -0.7L, 0, 0, 0, 0};
    for (std::size_t j = 0; j < 4; ++j)
        trial.engine().set_joint({0, j, 0}, {static_cast<double>(exact[j]), 0});
    for (std::size_t j = 0; j < 4; ++j) exact[j] = static_cast<double>(exact[j]);
    test::HingeChain(world.prototypes[0], world.gravity).advance(kDuration, exact);
    trial.run(kDuration);
    double error = 0;
    for (std::size_t j = 0; j < 4; ++j)
        error = largest(error,
                        std::fabs(trial.engine().joint({0, j, 0}).position - static_cast<double>(exact[j])));
    return error;
}

double block_error(const Contender& contender) {
    const Vec3 size{0.1, 0.4, 0.9}, w{4, 5, -3};
    World world = test::empty_world(contender.dt_s, {});
    test::place(world, test::solid_box(1, size, test::surface(0)), "block");
    Trial trial(contender, world);
    trial.engine().set_base(0, {}, w, {});
    const Mat3 inertia = test::box_inertia(1, size);
    test::TumblingBody exact({inertia(0, 0), inertia(1, 1), inertia(2, 2)}, test::RealMat3::identity(),
                             {w.x, w.y, w.z});
    trial.run(kDuration);
    const test::RealMat3 R = exact.orientation(kDuration);
    const Mat3 now = to_matrix(trial.link(0).X_WL.q);
    double error = 0;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            error = largest(error, std::fabs(now(r, c) - static_cast<double>(R(r, c))));
    return error;
}

template <class Error>
Outcome measure_order(const Contender& contender, const Error& error) {
    std::vector<double> steps{4e-3, 2e-3, 1e-3, 5e-4}, errors;
    for (const double dt_s : steps) {
        Contender at = contender;
        at.dt_s = dt_s;
        errors.push_back(error(at));
    }
    Outcome out{{log_slope(steps, errors)}};
    for (std::size_t i = 0; i < steps.size(); ++i) out.trace.emplace_back(steps[i], errors[i]);
    return out;
}

Outcome order_of_arm(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::arm(), "arm");
    if (!Trial(contender, world).possible()) return Trial::impossible(1);
    return measure_order(contender, arm_error);
}

}  // namespace

std::vector<Case> convergence_cases() {
    const auto order = [](double theory) {
        return Quantity{"order, fitted over dt 4, 2, 1, 0.5 ms", "", 0.2, theory};
    };
    Case arm{"order-arm",
             "Order of convergence: swinging arm, joint angles after 1 s",
             "6, that of Butcher's Runge-Kutta method of seven stages; error against the converged reference",
             {order(6)},
             order_of_arm};
    Case block{"order-block",
               "Order of convergence: tumbling block, orientation after 1 s",
               "4, that of the classical Runge-Kutta method; error against the elliptic functions",
               {order(4)},
               [](const Contender& contender) { return measure_order(contender, block_error); }};
    return {arm, block};
}

}  // namespace roboss::bench
