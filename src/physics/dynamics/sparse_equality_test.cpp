// Loops solved joint by joint give what their dense matrix in the coordinates of the tree gives.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <support/joint_net.h>
#include <support/mechanisms.h>
#include <support/scissors.h>
#include <support/simulation.h>

#include "physics/dynamics/equality.h"
#include "physics/dynamics/joint_complement.h"

namespace roboss::test {
namespace {

struct Case {
    std::string name;
    ModelSpec model;
    bool lock = false;
};

class SparseEqualities : public testing::TestWithParam<int> {
  protected:
    static Case of(int number) {
        switch (number) {
            case 0:
                return {"net of 16 plates", joint_net(4, 0.4), false};
            case 1:
                return {"net of 36 plates", joint_net(6, 0.6), false};
            case 2:
                return {"net, a joint locked", joint_net(4, 0.5), true};
            case 3:
                return {"scissors", scissors(7, false), false};
            case 4:
                return {"scissors on a free base", scissors(8, true), false};
            default:
                return {"scissors, a joint locked", scissors(9, true), true};
        }
    }
    World world() const {
        World world = empty_world(1e-3);
        place(world, case_.model, "robot");
        return world;
    }

    const Case case_ = of(GetParam());
};

RobotWork of_type(const RobotType& type) {
    RobotWork work;
    work.type = &type;
    return work;
}

/// Share of the largest entry by which two vectors differ.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::fmax(most, std::fabs(a[i] - b[i])), size = std::fmax(size, std::fabs(b[i]));
    return most / size;
}

TEST_P(SparseEqualities, AgreeWithTheDenseSolve) {
    SCOPED_TRACE(case_.name);
    Simulation sim(world());
    const RobotType& sparse = sim.type(0);
    ASSERT_FALSE(sparse.elimination.empty());
    RobotType dense = sparse;
    dense.elimination = {};
    std::vector<char> locked;
    if (case_.lock) locked.assign(static_cast<std::size_t>(sparse.nv), 0), locked[locked.size() / 2] = 1;

    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 5; ++round) {
        std::vector<double> v(static_cast<std::size_t>(sparse.nv));
        for (double& x : v) x = normal(random);
        if (case_.lock) v[locked.size() / 2] = 0;
        std::vector<double> v_dense = v;
        EqualityProjection by_joints, by_matrix;
        by_joints.close_velocities(of_type(sparse), sim.states[0].q, v, locked);
        by_matrix.close_velocities(of_type(dense), sim.states[0].q, v_dense, locked);
        EXPECT_LT(difference(v, v_dense), 1e-9) << "velocities, round " << round;

        std::vector<double> q = sim.states[0].q;
        for (std::size_t i = 7; i < q.size(); ++i) q[i] += 1e-3 * normal(random);
        std::vector<double> q_dense = q;
        by_joints.close_coordinates(of_type(sparse), q, locked);
        by_matrix.close_coordinates(of_type(dense), q_dense, locked);
        EXPECT_LT(difference(q, q_dense), 1e-9) << "coordinates, round " << round;
        if (!case_.lock) sim.step();
    }
}

TEST_P(SparseEqualities, StayClosedWhileTheyMove) {
    SCOPED_TRACE(case_.name);
    Simulation sim(world());
    const double energy = sim.energy();
    for (int i = 0; i < 300; ++i) sim.step();
    RobotWork work;
    work.type = &sim.type(0);
    forward_kinematics<double>(*work.type, sim.states[0].q, work);
    forward_velocities<double>(*work.type, sim.states[0].v, work);
    Equalities equalities;
    gather_equalities(work, sim.states[0].q, equalities);
    double gap = 0, rate = 0;
    for (const EqualityRow& row : equalities.rows) {
        gap = std::fmax(gap, std::fabs(row.error));
        rate = std::fmax(rate, std::fabs(times_row(equalities, row, sim.states[0].v)));
    }
    tell("largest gap, m", gap);
    tell("largest rate, m/s", rate);
    EXPECT_LT(gap, 1e-11);
    EXPECT_LT(rate, 1e-10);
    EXPECT_NEAR(sim.energy(), energy, 1e-4 * std::fabs(energy) + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, SparseEqualities, testing::Range(0, 6));

TEST(SparseEqualities, AreLeftToTheDenseMatrixWhereLoopsAreFewOrMassesDiffer) {
    World few = empty_world(1e-3);
    place(few, scissors(2, true), "robot");
    EXPECT_TRUE(Simulation(few).type(0).elimination.empty());
    World uneven = empty_world(1e-3);
    ModelSpec net = joint_net(4, 0.5);
    net.links[5].mass *= 1e5;
    place(uneven, net, "robot");
    EXPECT_TRUE(Simulation(uneven).type(0).elimination.empty());
}

TEST(JointComplement, BearsAllThatDoesNoWorkOnTheAxes) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (std::size_t count = 0; count <= 6; ++count) {
        std::vector<Spatial> axes;
        for (std::size_t i = 0; i < count; ++i)
            axes.push_back({{normal(random), normal(random), normal(random)},
                            {normal(random), normal(random), normal(random)}});
        const JointComplement complement = joint_complement(axes);
        ASSERT_EQ(complement.count, 6 - count);
        for (std::size_t i = 0; i < complement.count; ++i) {
            for (const Spatial& axis : axes) EXPECT_NEAR(dot(complement.wrenches[i], axis), 0, 1e-14);
            for (std::size_t j = 0; j <= i; ++j)
                EXPECT_NEAR(dot(complement.wrenches[i], complement.wrenches[j]), i == j, 1e-14);
        }
    }
}

}  // namespace
}  // namespace roboss::test
