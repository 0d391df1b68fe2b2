// Motors at stall and at their limits, on one hinge.
#include <support/robots.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

constexpr double kMass = 1, kLength = 1, kGravity = 9.81;

/// A rod on a hinge about y, level along +x at angle -pi/2.
World hinge_world(double dt_s, double max_effort, double gravity, double max_velocity = -1) {
    World world = test::empty_world(dt_s, {0, 0, -gravity});
    ModelSpec rod = test::pendulum(kMass, kLength);
    rod.joints[0].axes[0].max_effort = max_effort;
    rod.joints[0].axes[0].max_velocity = max_velocity;
    test::place(world, rod, "rod");
    return world;
}

/// About the hinge.
double rod_inertia(const World& world) {
    const LinkSpec& rod = world.prototypes[0].links[0];
    return rod.inertia_C(1, 1) + rod.mass * norm_squared(rod.p_LC);
}

/// A target out of reach: the motor gives its bound, so the speed grows by effort / inertia.
Outcome stall(const Contender& contender) {
    constexpr double kEffort = 1.5, kDuration = 0.1, kWeak = 3.0;
    Trial trial(contender, hinge_world(contender.dt_s, kEffort, 0));
    if (!trial.possible()) return Trial::impossible(2);
    const double inertia = rod_inertia(trial.world());
    trial.engine().drive_velocity({0, 0, 0}, 1e3, kEffort);
    trial.run(kDuration);
    const double speed = trial.engine().joint({0, 0, 0}).velocity;
    // Too weak for the weight of the level rod: one tick, while it is level.
    Trial loaded(contender, hinge_world(contender.dt_s, kWeak, kGravity));
    loaded.engine().set_joint({0, 0, 0}, {-kPi / 2, 0});
    loaded.engine().drive_velocity({0, 0, 0}, -2, kWeak);
    loaded.run(contender.dt_s);
    const double torque = 0.5 * kMass * kGravity * kLength - kWeak;
    const double sinking = loaded.engine().joint({0, 0, 0}).velocity / contender.dt_s;
    return trial.outcome({std::fabs(speed / (kEffort * kDuration / inertia) - 1),
                          std::fabs(sinking / (torque / inertia) - 1)});
}

Outcome velocity_limit(const Contender& contender) {
    constexpr double kLimit = 0.4, kTarget = 0.7;
    Trial trial(contender, hinge_world(contender.dt_s, 1.5, 0, kLimit));
    if (!trial.possible()) return Trial::impossible(3);
    trial.engine().drive_velocity({0, 0, 0}, -3, 1.5);
    trial.run(1);
    const double limited = std::fabs(trial.engine().joint({0, 0, 0}).velocity);
    Trial free(contender, hinge_world(contender.dt_s, 1.5, 0));
    free.engine().drive_velocity({0, 0, 0}, kTarget, 1.5);
    free.run(1);
    const double reached = free.engine().joint({0, 0, 0}).velocity;
    Trial loaded(contender, hinge_world(contender.dt_s, 50, kGravity));
    loaded.engine().drive_velocity({0, 0, 0}, kTarget, 50);
    loaded.run(0.1);
    double worst = 0;
    loaded.run(5, 0.01, [&] {
        worst = largest(worst, std::fabs(loaded.engine().joint({0, 0, 0}).velocity / kTarget - 1));
    });
    return trial.outcome({std::fabs(limited / kLimit - 1), std::fabs(reached / kTarget - 1), worst});
}

}  // namespace

std::vector<Case> motor_cases() {
    Case stalled{
        "stall",
        "Motor at stall: a target out of reach; too weak for its load",
        "acceleration = (bound - load) / inertia",
        {{"speed after 0.1 s, relative", "", 1e-9}, {"acceleration against the load, relative", "", 1e-9}},
        stall};
    Case limited{"velocity-limit",
                 "Motor at its velocity limit and at its target",
                 "the speed is the limit; the target",
                 {{"at the axis' limit, relative", "", 1e-9},
                  {"at its target, relative", "", 1e-9},
                  {"at its target, swinging a load of 4.9 N m, worst", "", 1e-9}},
                 velocity_limit};
    return {stalled, limited};
}

}  // namespace roboss::bench
