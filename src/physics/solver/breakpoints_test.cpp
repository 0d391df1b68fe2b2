// The derivative along a step, of the rows that bend and a straight line for the others, against the sum over
// all rows.
#include "physics/solver/breakpoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "physics/solver/newton_rows.h"

namespace roboss {
namespace {

class Chance {
  public:
    explicit Chance(unsigned seed) : random_(seed) {}
    double in(double low, double high) { return low + (high - low) * share(); }

  private:
    double share() { return static_cast<double>(random_()) / 4294967296.0; }
    std::mt19937 random_;
};

void start(BoundedRow& row, Chance& chance) {
    row.target = chance.in(-1, 1), row.u = chance.in(-1, 1), row.du = chance.in(-1, 1);
    row.stiffness = std::pow(10, chance.in(0, 6));
    row.low = chance.in(-2, 0), row.high = chance.in(0, 2);
}

void start(FrictionDisc& disc, Chance& chance) {
    disc.coefficient = 1, disc.bound = chance.in(0, 2);
    disc.stiffness = std::pow(10, chance.in(0, 6));
    disc.u_1 = chance.in(-1, 1), disc.u_2 = chance.in(-1, 1);
    disc.du_1 = chance.in(-1, 1), disc.du_2 = chance.in(-1, 1);
}

/// Minus the rows' impulses along the step; the smooth part is left out.
double slope_of_all(IslandRows& rows, double fraction) {
    return -newton::row_slope(rows, fraction);
}

TEST(LineSearchBreakpoints, BoundedRowsAreExactAlongTheWay) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        Chance chance(seed);
        IslandRows rows;
        rows.joints.resize(8);
        for (JointRow& row : rows.joints) start(row, chance);
        const double low = -1, high = chance.in(0, 2);
        LineSearchBreakpoints<double> bends;
        bends.find(rows, low, high, slope_of_all(rows, low), slope_of_all(rows, high));
        for (int i = 0; i < 20; ++i) {
            const double fraction = chance.in(low, high), right = slope_of_all(rows, fraction);
            EXPECT_NEAR(bends.slope(fraction), right, 1e-9 * (1 + std::fabs(right))) << "seed " << seed;
        }
    }
}

/// Sliding on in about the same direction is taken for a straight line: what that leaves out is small, and
/// nothing at both ends.
TEST(LineSearchBreakpoints, DiscsAreExactAtBothEndsAndNearlySoBetween) {
    double worst = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        Chance chance(seed);
        IslandRows rows;
        rows.contacts.resize(1);
        start(rows.contacts[0].normal, chance);
        start(rows.contacts[0].slip, chance);
        const FrictionDisc& disc = rows.contacts[0].slip;
        const double low = -1, high = chance.in(0, 2);
        LineSearchBreakpoints<double> bends;
        bends.find(rows, low, high, slope_of_all(rows, low), slope_of_all(rows, high));
        for (const double end : {low, high})
            EXPECT_NEAR(bends.slope(end), slope_of_all(rows, end),
                        1e-9 * (1 + std::fabs(slope_of_all(rows, end))));
        const double most = disc.bound * std::hypot(disc.du_1, disc.du_2);
        for (int i = 0; i < 20; ++i) {
            const double fraction = chance.in(low, high);
            const double error = std::fabs(bends.slope(fraction) - slope_of_all(rows, fraction));
            EXPECT_LE(error, 0.1 * most + 1e-9) << "seed " << seed;
            worst = std::max(worst, error / most);
        }
    }
    EXPECT_GT(worst, 0) << "no disc was taken for a straight line";
}

}  // namespace
}  // namespace roboss
