// Closed loops: a four-bar linkage driven round and round for a minute.
#include <support/mechanisms.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

/// Where the rocker's end is when the coupler starts at b: circles of coupler and rocker, the upper crossing.
Vec3 rocker_end(const Vec3& b, const Vec3& pivot, double coupler, double rocker) {
    const Vec3 along = pivot - b;
    const double distance = norm(along);
    const Vec3 e = along / distance;
    const double x = (coupler * coupler - rocker * rocker + distance * distance) / (2 * distance);
    return b + e * x + Vec3{-e.z, 0, e.x} * std::sqrt(coupler * coupler - x * x);
}

Outcome drive_four_bar(const Contender& contender) {
    constexpr double kSpeed = 2, kEffort = 20;  // rad/s, N m
    constexpr double kCoupler = 0.5, kRocker = 0.4;
    const Vec3 pivot{0.5, 0, 0};
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::four_bar(), "linkage");
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(3);
    trial.engine().drive_velocity({0, 0, 0}, kSpeed, kEffort);
    double gap = 0, miss = 0;
    trial.run(60, 0.02, [&] {
        gap = largest(gap, trial.widest_gap(0));
        const Vec3 exact = rocker_end(trial.place(0, 1, {}), pivot, kCoupler, kRocker);
        miss = largest(miss, norm(trial.place(0, 2, {kRocker, 0, 0}) - exact));
    });
    return trial.outcome({gap, miss, trial.engine().joint({0, 0, 0}).velocity / kSpeed});
}

}  // namespace

std::vector<Case> loop_cases() {
    Case c{"four-bar",
           "Four-bar linkage, crank driven at 2 rad/s, 60 s",
           "the joints stay together; the rocker's end is where the circles about its pivot and the crank's "
           "end cross",
           {{"widest gap at a joint", "m", 1e-6},
            {"rocker's end against the closed form", "m", 1e-6},
            {"speed of the crank at the end over its target", "", {}}},
           drive_four_bar};
    c.also_coarse = true;
    return {c};
}

}  // namespace roboss::bench
