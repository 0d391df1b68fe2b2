// The arm's kinematics and motions, and what the scanner makes of its ranges: closed forms against each
// other.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/fixed_math.h"
#include "motion.h"
#include "scan.h"

namespace arm_cell {
namespace {

TEST(ArmKinematics, ForwardUndoesInverseWhereTheArmReaches) {
    int reached = 0;
    for (double x = -0.7; x <= 0.7; x += 0.1)
        for (double y = -0.7; y <= 0.7; y += 0.1)
            for (double yaw = -3; yaw <= 3; yaw += 0.75) {
                const auto q = inverse({x, y, 0.6, yaw}, 0.3);
                if (!q) continue;
                ++reached;
                const HandPose pose = forward(*q);
                EXPECT_NEAR(pose.x, x, 1e-12);
                EXPECT_NEAR(pose.y, y, 1e-12);
                EXPECT_NEAR(pose.z, 0.6, 1e-12);
                EXPECT_NEAR(std::sin(pose.yaw - yaw), 0, 1e-12) << "modulo half a turn";
                EXPECT_LE(std::fabs((*q)[3] - 0.3), roboss::kPi / 2 + 1e-12) << "the nearest one";
            }
    EXPECT_GT(reached, 500);
}

TEST(ArmKinematics, RefusesWhatIsOutOfReach) {
    EXPECT_TRUE(inverse({kUpperArm + kForearm - 0.001, 0, 0.6, 0}, 0));
    EXPECT_FALSE(inverse({kUpperArm + kForearm + 0.001, 0, 0.6, 0}, 0));
    EXPECT_FALSE(inverse({0.01, 0, 0.6, 0}, 0)) << "too near: the elbow does not fold so far";
    EXPECT_FALSE(inverse({0.4, 0, kTipHeight + 0.001, 0}, 0));
    EXPECT_FALSE(inverse({0.4, 0, kTipHeight - kLiftStroke - 0.001, 0}, 0));
}

TEST(ArmMotion, StaysWithinTheLimitsAndUsesThem) {
    const Joints from{0.7, 1.8, -0.1, 0.2},
        goals[] = {{-2.4, 1.8, -0.1, 1.0}, {0.7, 1.8, -0.2, 0.2}, {0.75, 1.8, -0.1, 0.2}};
    for (const Joints& to : goals) {
        const Motion way = motion(from, to, 2);
        EXPECT_EQ(way.at(0), from);
        EXPECT_EQ(way.at(2), from);
        EXPECT_EQ(way.at(way.end_s()), to);
        const double h = 1e-4;
        double used = 0;
        for (double t = 2 + h; t < way.end_s() - h; t += h)
            for (std::size_t i = 0; i < from.size(); ++i) {
                const double a = way.at(t - h)[i], b = way.at(t)[i], c = way.at(t + h)[i];
                const double velocity = std::fabs(c - a) / (2 * h) / kJointLimits[i].velocity;
                const double acceleration = std::fabs(a - 2 * b + c) / (h * h) / kJointLimits[i].acceleration;
                used = std::max({used, velocity, acceleration});
            }
        EXPECT_GT(used, 0.99);
        EXPECT_LT(used, 1.001);
    }
    EXPECT_EQ(motion(from, from, 2).at(2), from) << "no way, no time";
}

struct Rectangle {
    double x = 0, y = 0, yaw = 0, length = 0.08, width = 0.06, height = 0.06;
};

/// Ranges of the scanner above boxes on the belt; of each box it meets the top, or passes it.
std::vector<double> ranges_above(const std::vector<Rectangle>& boxes) {
    std::vector<double> ranges;
    const double field = std::atan2(kScannerField, kScannerHeight - kBeltTop);
    for (int row = 0; row < kScannerBeams; ++row)
        for (int column = 0; column < kScannerBeams; ++column) {
            const double e = field * (2.0 * row / (kScannerBeams - 1) - 1),
                         a = field * (2.0 * column / (kScannerBeams - 1) - 1);
            const double along = std::sin(e), aside = std::cos(e) * std::sin(a),
                         down = std::cos(e) * std::cos(a);
            double range = (kScannerHeight - kBeltTop) / down;
            if (std::fabs(range * aside) > kBeltWidth / 2) range = std::numeric_limits<double>::infinity();
            for (const Rectangle& box : boxes) {
                const double to_top = (kScannerHeight - kBeltTop - box.height) / down;
                const double dx = kScannerX + to_top * along - box.x,
                             dy = kBeltAside + to_top * aside - box.y;
                const double u = dx * std::cos(box.yaw) + dy * std::sin(box.yaw),
                             v = dy * std::cos(box.yaw) - dx * std::sin(box.yaw);
                if (std::fabs(u) < box.length / 2 && std::fabs(v) < box.width / 2) range = to_top;
            }
            ranges.push_back(range);
        }
    return ranges;
}

TEST(Scan, FindsOffsetTurnAndHeightOfABox) {
    for (double yaw = -1.5; yaw <= 1.5; yaw += 0.1) {
        const auto seen = find_box(ranges_above({{0.021, kBeltAside + 0.033, yaw}}));
        ASSERT_TRUE(seen) << yaw;
        EXPECT_NEAR(seen->x, 0.021, 0.001) << yaw;
        EXPECT_NEAR(seen->y, kBeltAside + 0.033, 0.001) << yaw;
        EXPECT_NEAR(seen->top, kBeltTop + 0.06, 1e-9);
        EXPECT_NEAR(std::sin(seen->yaw - yaw), 0, 0.05) << yaw;
    }
}

TEST(Scan, OfTwoBoxesTheNearerToTheBarrierCounts) {
    const auto seen = find_box(ranges_above({{-0.12, kBeltAside, 0.2}, {0.03, kBeltAside, -0.7}}));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, 0.03, 0.001);
    EXPECT_NEAR(seen->yaw, -0.7, 0.05);
}

TEST(Scan, AnEmptyBeltAndABoxThatIsCutOffAreNoBox) {
    EXPECT_FALSE(find_box(ranges_above({})));
    EXPECT_FALSE(find_box(ranges_above({{kScannerX + kScannerField, kBeltAside, 0}})));
}

}  // namespace
}  // namespace arm_cell
