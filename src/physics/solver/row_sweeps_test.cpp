// Sweeps over robots with joints find impulses that keep every bound, and velocities that belong to them.
#include "physics/solver/row_sweeps.h"

#include <gtest/gtest.h>

#include <cmath>

#include <support/random.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "model/coordinates.h"
#include "physics/dynamics/dynamics.h"

namespace roboss::test {
namespace {

/// Two free cars and a double pendulum, with joint rows, a coupling and contacts of random directions.
class SweptIsland : public testing::Test {
  protected:
    SweptIsland() : sim_(world()), random_(7) {
        int first = 0;
        for (std::size_t r = 0; r < sim_.states.size(); ++r) {
            RobotWork& work = works_.emplace_back();
            work.type = &sim_.type(r);
            forward_kinematics<double>(*work.type, sim_.states[r].q, work);
            forward_velocities<double>(*work.type, sim_.states[r].v, work);
            compute_inertias(*work.type, work);
            compute_mass_matrix<double>(*work.type, 0.0, work);
            for (int i = 0; i < work.type->nv; ++i) work.impulse.push_back(random_.uniform(-1, 1));
            offsets_.push_back(first);
            first += work.type->nv;
        }
        for (const RobotWork& work : works_) robots_.push_back(&work);
        v_.assign(static_cast<std::size_t>(first), 0.0);
        for (int d = offsets_[0] + 6; d < offsets_[1]; ++d) add_joint(d);
        add_coupling(offsets_[1] + 6, offsets_[1] + 7);
        for (int c = 0; c < 12; ++c) add_contact(c % 3, (c + 1 + c / 6) % 3);
    }

    static World world() {
        World world = empty_world(2e-3);
        place(world, car(), "one", {{0, 0, 1}, {}});
        place(world, car(), "two", {{1, 0, 1}, {}});
        place(world, pendulum(), "hanging", {{2, 0, 1}, {}});
        return world;
    }

    void add_joint(int dof) {
        JointRow row;
        row.dof = dof;
        row.target = random_.uniform(-1, 1);
        row.compliance = 0.01, row.low = -0.05, row.high = 0.2;
        rows_.joints.push_back(row);
    }
    void add_coupling(int a, int b) {
        CouplingRow row;
        row.first = rows_.coupling_columns.size();
        rows_.coupling_columns.push_back({a, 1.0}), rows_.coupling_columns.push_back({b, -2.0});
        row.last = rows_.coupling_columns.size();
        row.compliance = 1e-3, row.low = -1e9, row.high = 1e9;
        rows_.couplings.push_back(row);
    }
    /// Of two robots; of one with scenery, if both are the same.
    void add_contact(int a, int b) {
        ContactRow row;
        ContactColumns& columns = rows_.columns;
        row.first = columns.size();
        const auto add = [&](int robot) {
            const auto r = static_cast<std::size_t>(robot);
            for (int i = 0; i < works_[r].type->nv; ++i) {
                columns.extend(1);
                const std::size_t k = columns.size() - 1;
                columns.dof[k] = offsets_[r] + i, columns.base[k] = 0;
                columns.n[k] = random_.uniform(-1, 1);
                columns.t1[k] = random_.uniform(-1, 1), columns.t2[k] = random_.uniform(-1, 1);
            }
        };
        add(a);
        if (b != a) add(b);
        row.last = columns.size();
        row.normal.target = random_.uniform(-0.2, 0.5), row.normal.compliance = 0.05;
        row.normal.low = 0, row.normal.high = 1e9;
        row.slip.coefficient = 0.3, row.slip.compliance = 0.05;
        rows_.contacts.push_back(row);
    }

    /// The rows take the impulses that were found.
    void take(const RowSweeps& sweeps) {
        for (std::size_t r = 0; r < rows_.joints.size(); ++r) rows_.joints[r].impulse = sweeps.joint(r);
        rows_.couplings[0].impulse = sweeps.coupling(0);
        for (std::size_t c = 0; c < rows_.contacts.size(); ++c) {
            const RowSweeps::ContactImpulse& found = sweeps.contact(c);
            rows_.contacts[c].normal.impulse = found.n;
            rows_.contacts[c].slip.impulse_1 = found.t1, rows_.contacts[c].slip.impulse_2 = found.t2;
        }
    }

    RowSweeps::Problem problem() { return {accuracy_, robots_, offsets_, rows_}; }

    Simulation sim_;
    Random random_;
    Accuracy accuracy_;
    std::vector<RobotWork> works_;
    std::vector<const Mechanics<double>*> robots_;
    std::vector<int> offsets_;
    IslandRows rows_;
    std::vector<double> v_;
};

/// The wanted impulse of a row, cut to its bounds.
double wanted(const BoundedRow& row, double u, double impulse) {
    const double raw = impulse + (row.target - u - row.compliance * impulse);
    return std::fmin(std::fmax(raw, row.low), row.high);
}

TEST_F(SweptIsland, ConvergesToImpulsesThatFitTheirVelocities) {
    RowSweeps sweeps;
    sweeps.run(problem(), {.most = 3000}, v_);
    for (int i = 0; i < 10; ++i) sweeps.go_on(problem(), 3000, v_);
    take(sweeps);
    // Momentum: M v = impulse + J^T of what was found.
    std::vector<double> applied(v_.size(), 0.0), momentum(v_.size());
    add_impulses(rows_, applied);
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const auto first = static_cast<std::size_t>(offsets_[r]);
        tree_times(robots_[r]->type->paths, robots_[r]->mass_matrix.data(), v_.data() + first,
                   momentum.data() + first);
        for (std::size_t i = 0; i < robots_[r]->impulse.size(); ++i)
            EXPECT_NEAR(momentum[first + i], robots_[r]->impulse[i] + applied[first + i], 1e-9);
    }
    set_steps(rows_, v_);
    std::size_t pushing = 0, sliding = 0, bounded = 0;
    for (const JointRow& row : rows_.joints) {
        EXPECT_NEAR(wanted(row, row.du, row.impulse), row.impulse, 1e-7);
        bounded += row.impulse == row.low || row.impulse == row.high;
    }
    EXPECT_NEAR(rows_.couplings[0].du, -rows_.couplings[0].compliance * rows_.couplings[0].impulse, 1e-7);
    for (const ContactRow& row : rows_.contacts) {
        EXPECT_NEAR(wanted(row.normal, row.normal.du, row.normal.impulse), row.normal.impulse, 1e-7);
        pushing += row.normal.impulse > 0;
        const double bound = 0.3 * row.normal.impulse;
        const double friction = std::hypot(row.slip.impulse_1, row.slip.impulse_2);
        EXPECT_LE(friction, bound * (1 + 1e-12));
        if (friction < bound * (1 - 1e-6)) {
            EXPECT_NEAR(row.slip.du_1, -row.slip.compliance * row.slip.impulse_1, 1e-7);
            EXPECT_NEAR(row.slip.du_2, -row.slip.compliance * row.slip.impulse_2, 1e-7);
        } else if (bound > 0) {
            ++sliding;
            const double s_1 = row.slip.du_1 + row.slip.compliance * row.slip.impulse_1,
                         s_2 = row.slip.du_2 + row.slip.compliance * row.slip.impulse_2;
            EXPECT_LE(s_1 * row.slip.impulse_1 + s_2 * row.slip.impulse_2, 1e-9) << "friction opposes slip";
            EXPECT_NEAR(s_1 * row.slip.impulse_2 - s_2 * row.slip.impulse_1, 0, 1e-6);
        }
    }
    EXPECT_GT(pushing, 2u);
    EXPECT_LT(pushing, rows_.contacts.size());
    EXPECT_GT(sliding, 0u);
    EXPECT_GT(bounded, 0u);
}

TEST_F(SweptIsland, GoesOnFromWhereItWasWhenSolvedAgain) {
    RowSweeps sweeps;
    sweeps.run(problem(), {.most = 3000}, v_);
    for (int i = 0; i < 5; ++i) sweeps.go_on(problem(), 3000, v_);
    take(sweeps);
    const std::vector<double> v = v_;
    RowSweeps::Problem again = problem();
    again.again = true;
    sweeps.run(again, {.most = 1}, v_);
    for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v_[i], v[i], 1e-4 * std::fabs(v[i]) + 1e-5);
}

}  // namespace
}  // namespace roboss::test
