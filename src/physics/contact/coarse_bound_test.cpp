// The box that is known without kinematics holds the exact one, in every pose and motion.
#include "physics/contact/coarse_bound.h"

#include <gtest/gtest.h>

#include <support/crowds.h>
#include <support/mechanisms.h>
#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

#include "physics/dynamics/integrate.h"

namespace roboss::test {
namespace {

/// On a column beside the base, so that the sphere about the first joint is not the one about the base.
ModelSpec arm_beside_its_base() {
    ModelSpec model = arm();
    for (LinkSpec& link : model.links) link.X_ML.p += Vec3{1.5, -0.8, 0.6};
    for (JointSpec& joint : model.joints)
        if (joint.parent == "world") joint.X_MJ.p += Vec3{1.5, -0.8, 0.6};
    return model;
}

TEST(CoarseBound, HoldsTheExactBoundOfEveryPoseAndMotion) {
    Random random(5);
    const auto fill = [&](std::vector<double>& row, double size) {
        for (double& x : row) x = random.uniform(-size, size);
    };
    int tighter = 0;
    for (const ModelSpec& spec : {arm(), arm_beside_its_base(), spider(), mixed_tree(),
                                  with_hulls(mixed_tree(), 20, 0.2), with_hulls(arm(), 20, 0.2)}) {
        World world = empty_world(1e-3);
        place(world, with_balls(spec, 0.1), spec.name, {{0.4, -0.3, 0.2}, from_rpy(0.3, -0.2, 0.8)});
        Simulation sim(world);
        const RobotType& type = sim.model->type_of(sim.ids[0]);
        tighter += type.reach_sphere.radius < type.reach;
        for (int i = 0; i < 200; ++i) {
            RobotState state = initial_state(*sim.model, sim.ids[0]);
            fill(state.v, 1.5);
            advance_coordinates<double>(type, state.v, 1.0, state.q);
            fill(state.v, 5);
            const Aabb coarse = coarse_bound(type, state, sim.model->dt_s);
            Aabb both = coarse;
            both.include(interaction_bound(*sim.model, sim.ids[0], state));
            EXPECT_EQ(both, coarse) << spec.name << ", pose " << i;
        }
    }
    EXPECT_GE(tighter, 1) << "else no sphere about a first joint was tested";
}

}  // namespace
}  // namespace roboss::test
