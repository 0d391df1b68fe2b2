// A contact island that is solved in parts, by blocks or by fronts, has the solution of the whole island.
#include "physics/contact/island_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <support/bodies.h>
#include <support/random.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss {
namespace {

/// Bodies side by side on the ground, with contacts between neighbours of which some push.
class Heap {
  public:
    explicit Heap(std::size_t bodies, unsigned seed) : random_(seed) {
        World world = test::empty_world(0.002);
        test::place(world, test::solid_box(1, {0.1, 0.1, 0.1}, test::surface(0.5)), "box");
        model_ = *test::Simulation(world).model;
        model_.accuracy.friction_tolerance = 1e-9;
        model_.accuracy.tolerance = 1e-10;  // Newton's method finishes, whatever moves
        robots_.resize(bodies);
        for (std::size_t r = 0; r < bodies; ++r) add_body(robots_[r], static_cast<int>(6 * r));
        for (std::size_t r = 0; r < bodies; ++r) {
            add_contact(static_cast<int>(6 * r), -1, {0, 0, 1}, -0.002);
            if (r > 0)
                add_contact(static_cast<int>(6 * r), static_cast<int>(6 * (r - 1)), {1, 0, 0},
                            random_.uniform(-0.1, 0.02));
        }
    }

    IslandSolver::Problem problem() { return {model_.accuracy, pointers_, offsets_, rows}; }

    IslandRows rows;
    std::vector<double> v;

  private:
    void add_body(Mechanics<double>& robot, int offset) {
        robot.type = &model_.types[0];
        robot.mass_matrix.assign(21, 0.0);
        for (std::size_t i = 0; i < 6; ++i) robot.mass_matrix[i * (i + 1) / 2 + i] = i < 3 ? 0.002 : 1.0;
        for (std::size_t i = 0; i < 6; ++i)
            v.push_back(i < 3 ? random_.uniform(-1, 1) : random_.uniform(-0.2, 0.2));
        for (std::size_t i = 0; i < 6; ++i)
            robot.impulse.push_back(v[static_cast<std::size_t>(offset) + i] * (i < 3 ? 0.002 : 1.0));
        robot.impulse[5] -= 0.02;  // gravity
        pointers_.push_back(&robot), offsets_.push_back(offset);
    }
    void add_contact(int dof_a, int dof_b, const Vec3& n, double target) {
        ContactRow& row = rows.contacts.emplace_back();
        row.first = rows.columns.size();
        Vec3 t1, t2;
        tangents(n, t1, t2);
        add_side(dof_a, n * -0.05, n, t1, t2, 1);
        if (dof_b >= 0) add_side(dof_b, n * 0.05, n, t1, t2, -1);
        row.last = rows.columns.size();
        row.joins = dof_b >= 0;
        row.normal.target = row.normal.position_target = target;
        row.normal.compliance = 1e-6, row.slip.compliance = 1e-2;
        row.normal.high = std::numeric_limits<double>::infinity();
        row.slip.coefficient = 0.5;
    }
    void add_side(int dof, const Vec3& p, const Vec3& n, const Vec3& t1, const Vec3& t2, double sign) {
        ContactColumns& columns = rows.columns;
        const std::size_t begin = columns.size();
        columns.extend(6);
        const auto put = [&](const Vec3& axis, std::vector<double>& to) {
            const Vec3 turning = cross(p, axis);
            for (std::size_t k = 0; k < 3; ++k)
                to[begin + k] = sign * turning[k], to[begin + 3 + k] = sign * axis[k];
        };
        put(n, columns.n), put(t1, columns.t1), put(t2, columns.t2);
        for (std::size_t k = 0; k < 6; ++k)
            columns.dof[begin + k] = dof + static_cast<int>(k), columns.base[begin + k] = k == 0;
    }

    test::Random random_;
    Model model_;
    std::vector<Mechanics<double>> robots_;
    std::vector<const Mechanics<double>*> pointers_;
    std::vector<int> offsets_;
};

/// Coulomb's law at the velocities that were solved for: relative to the largest impulse.
double friction_error(const IslandRows& rows) {
    double largest = 0, error = 0;
    for (const ContactRow& row : rows.contacts) {
        largest = std::max(largest, row.normal.impulse);
        const double friction = std::hypot(row.slip.impulse_1, row.slip.impulse_2);
        error = std::max(error, friction - row.slip.coefficient * row.normal.impulse);
    }
    return largest > 0 ? error / largest : 0;
}

TEST(IslandParts, FindTheSolutionOfTheWhole) {
    int compared = 0;
    std::size_t smaller = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Heap whole(12, seed), parted(12, seed);
        IslandSolver solver;
        IslandParts parts;
        solver.solve(whole.problem(), whole.v);
        const SolveReport report = parts.solve(parted.problem(), parted.v);
        EXPECT_LE(report.residual, 1e-8) << seed;
        EXPECT_LE(friction_error(parted.rows), 1e-3) << seed;
        smaller += parts.largest_part() < 12 ? 1 : 0;
        if (friction_error(whole.rows) > 1e-6) continue;  // the other one did not settle
        ++compared;
        for (std::size_t i = 0; i < whole.v.size(); ++i)
            EXPECT_NEAR(whole.v[i], parted.v[i], 1e-6) << seed << ' ' << i;
    }
    EXPECT_GE(compared, 20);
    EXPECT_GE(smaller, 20u);
}

TEST(IslandParts, NoContactThatIsLeftOutWouldPush) {
    for (unsigned seed = 100; seed < 140; ++seed) {
        Heap heap(30, seed);
        IslandParts parts;
        parts.solve(heap.problem(), heap.v);
        for (const ContactRow& row : heap.rows.contacts) {
            double u = 0;
            for (std::size_t c = row.first; c < row.last; ++c)
                u += heap.rows.columns.n[c] * heap.v[static_cast<std::size_t>(heap.rows.columns.dof[c])];
            const double raw = (row.normal.target - u) / row.normal.compliance;
            EXPECT_NEAR(row.normal.impulse, std::max(0.0, raw), 1e-6 * (1 + std::fabs(raw))) << seed;
        }
    }
}

/// A heap solved for its velocities, then made ready for its displacement; every tenth contact with another
/// target for that, from the one on that the seed gives.
struct Displaced : Heap {
    explicit Displaced(unsigned seed) : Heap(30, seed) {
        parts.solve(problem(), v);
        for (std::size_t c = seed % 10; c < rows.contacts.size(); c += 10)
            rows.contacts[c].normal.position_target += 0.01;
        for (ContactRow& row : rows.contacts) row.slip.bound = row.slip.coefficient * row.normal.impulse;
    }
    void displace(std::size_t solved) {
        IslandSolver::Problem p = problem();
        p.position = true;
        parts.solve(p, v, {}, solved);
    }
    IslandParts parts;
};

TEST(IslandParts, DisplacementsThatAskForNothingElseThanTheVelocitiesAreThese) {
    Heap heap(30, 1);
    IslandParts parts;
    parts.solve(heap.problem(), heap.v);
    const std::vector<double> velocities = heap.v;
    IslandSolver::Problem p = heap.problem();
    p.position = true;
    const SolveReport report = parts.solve(p, heap.v, {}, heap.rows.contacts.size());
    EXPECT_EQ(heap.v, velocities);
    EXPECT_EQ(report.iterations, 0);
}

TEST(IslandParts, DisplacementsAreSolvedWhereverTheyAskForSomethingElse) {
    std::size_t kept = 0, moved = 0;
    for (unsigned seed = 200; seed < 240; ++seed) {
        Displaced all(seed), some(seed);
        const std::vector<double> velocities = some.v;
        all.displace(0), some.displace(some.rows.contacts.size());
        for (std::size_t i = 0; i < all.v.size(); ++i) {
            EXPECT_NEAR(all.v[i], some.v[i], 1e-6) << seed << ' ' << i;
            (some.v[i] == velocities[i] ? kept : moved) += 1;
        }
    }
    EXPECT_GE(kept, 1000u);
    EXPECT_GE(moved, 1000u);
}

TEST(IslandParts, NewContactsAreSolvedAndWhatTheyPush) {
    for (unsigned seed = 300; seed < 340; ++seed) {
        Heap all(30, seed), some(30, seed);
        const auto displace = [&](Heap& heap, bool knows) {
            IslandParts parts;
            std::vector<ContactRow>& contacts = heap.rows.contacts;
            const ContactRow last = contacts.back();
            contacts.pop_back();
            parts.solve(heap.problem(), heap.v);
            const std::size_t solved = contacts.size();
            contacts.push_back(last);
            contacts.back().normal.target = contacts.back().normal.position_target = 0.05;
            IslandSolver::Problem p = heap.problem();
            p.position = true;
            parts.solve(p, heap.v, {}, knows ? solved : 0);
        };
        displace(all, false), displace(some, true);
        for (std::size_t i = 0; i < all.v.size(); ++i)
            EXPECT_NEAR(all.v[i], some.v[i], 1e-6) << seed << ' ' << i;
    }
}

}  // namespace
}  // namespace roboss
