// A six-legged walker: legs that strike, stick and lift eighteen times a second, for a figure that anybody
// can judge: does it get where it walks to?
#include <support/bodies.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"
#include "scenes/hexapod.h"

namespace roboss::bench {
namespace {

constexpr double kMeasured = 10;  // s

Outcome walk_straight(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::ground(test::surface(0.9)), "ground");
    test::place(world, hexapod(), "walker", {{0, 0, kHexapodHeight}, {}});
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(4);
    const Gait gait;
    const auto order = [&] { walk(trial.engine(), 1, gait, trial.time_s()); };
    order();
    trial.run(gait.start + 1, contender.dt_s, order);  // into its stride
    const Pose start = trial.link(1).X_WL;
    double sag = 0, tilt = 0, aside = 0;
    trial.run(kMeasured, contender.dt_s, [&] {
        order();
        const Pose now = trial.link(1).X_WL;
        sag = largest(sag, kHexapodHeight - now.p.z);
        tilt = largest(tilt, norm(cross(rotate(now.q, Vec3{0, 0, 1}), Vec3{0, 0, 1})));
        aside = largest(aside, std::fabs(now.p.y - start.p.y));
    });
    return trial.outcome({(trial.link(1).X_WL.p.x - start.p.x) / kMeasured, aside, sag, tilt});
}

}  // namespace

std::vector<Case> walker_cases() {
    const double speed = Gait().speed;
    Case c{"walker",
           "Six-legged walker, 18 servos, 40 cm, tripod gait, 10 s",
           "its feet's way on the ground gives the speed; it walks straight and level",
           {{"speed", "m/s", 0.1 * speed, speed},
            {"furthest aside", "m", 0.02},
            {"deepest sag of the body", "m", 0.02},
            {"largest tilt", "rad", 0.1}},
           walk_straight};
    c.also_coarse = true;
    return {c};
}

}  // namespace roboss::bench
