// Accelerations of mechanisms at random states against other hands: a dense system of masses, loops and
// multipliers, and MuJoCo's (trees only: its loops are soft). No engine steps here.
#include <accuracy/accelerations.h>
#include <accuracy/dense_dynamics.h>
#include <support/bodies.h>

#include "accuracy/case.h"
#include "accuracy/figures.h"
#ifdef ROBOSS_BENCH_MUJOCO
#include <accuracy/mujoco_oracle.h>
#endif

namespace roboss::bench {
namespace {

using test::Mechanism;

const Pose kPlace{{0.5, -0.3, 0.2}, from_rpy(0.2, -0.4, 1.1)};
const Vec3 kGravity{0.3, -0.2, -9.81};

std::shared_ptr<const Model> compiled(const Mechanism& mechanism) {
    World world = test::empty_world(1e-3, kGravity);
    test::place(world, mechanism.model, "robot", kPlace);
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

Outcome against_dense_solve(const Contender&) {
    constexpr int kStates = 50;
    double worst = 0;
    for (const Mechanism& mechanism : test::constrained_mechanisms()) {
        const auto model = compiled(mechanism);
        test::Random random(11);
        for (int i = 0; i < kStates; ++i) {
            RobotState state = test::random_state_on_loops(*model, random, mechanism.spread);
            const std::vector<double> forces = test::random_forces(model->types[0], random);
            const std::vector<double> dense =
                test::dense_acceleration(*model, mechanism.model, state, forces);
            worst =
                largest(worst, test::relative_error(test::free_acceleration(*model, state, forces), dense));
        }
    }
    return {{worst}};
}

#ifdef ROBOSS_BENCH_MUJOCO
Outcome against_mujoco(const Contender&) {
    constexpr int kStates = 200;
    double worst = 0;
    for (const Mechanism& mechanism : test::trees()) {
        const auto model = compiled(mechanism);
        test::MujocoOracle oracle(mechanism.model, kPlace, kGravity, model->types[0]);
        test::Random random(7);
        for (int i = 0; i < kStates; ++i) {
            RobotState state = test::random_tree_state(*model, random);
            const std::vector<double> forces = test::random_forces(model->types[0], random);
            oracle.set(state, forces);
            worst = largest(worst, test::relative_error(test::free_acceleration(*model, state, forces),
                                                        oracle.acceleration()));
        }
    }
    return {{worst}};
}
#endif

}  // namespace

std::vector<Case> dynamics_cases() {
    std::vector<Case> cases{
        {"forward-dynamics",
         "Forward dynamics of twelve mechanisms: loops closed by every joint kind, screws, gearbox, mimic, "
         "Stewart",
         "one dense system of masses, loops and multipliers; derivatives of sixth order along the motion "
         "(tests/accuracy/dense_dynamics.h)",
         {{"acceleration, worst of 600 states, relative", "", 1e-9}},
         against_dense_solve}};
#ifdef ROBOSS_BENCH_MUJOCO
    cases.push_back({"trees",
                     "Forward dynamics of eight trees of every joint kind",
                     "MuJoCo's accelerations",
                     {{"acceleration, worst of 1600 states, relative", "", 1e-9}},
                     against_mujoco});
#endif
    for (Case& c : cases) c.ours_only = c.of_the_kernel = true;
    return cases;
}

}  // namespace roboss::bench
