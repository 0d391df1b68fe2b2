// What a driver does in plain situations; the whole city is driven by the tests of the command.
#include "driving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/fixed_math.h"

namespace city_driver {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// 21 beams over the half circle ahead, nothing in sight, driving straight on at 1 m/s.
struct Scene {
    std::vector<double> ranges = std::vector<double>(21, kNothing);
    DriverView view;

    Scene() {
        view.min_angle = -0.5 * roboss::kPi, view.max_angle = 0.5 * roboss::kPi, view.range_max = 6;
        view.speed = view.ordered_left = view.ordered_right = 1.0;
        view.goal_distance = 20;
    }
    static double angle(std::size_t beam) {
        return -0.5 * roboss::kPi + static_cast<double>(beam) * roboss::kPi / 20;
    }
    /// A wall across the way, `distance` ahead, from `right` to `left` (m aside, left positive).
    void add_wall(double distance, double right, double left) {
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const double aside = distance * std::tan(angle(i));
            if (std::fabs(angle(i)) < 1.5 && aside > right && aside < left)
                ranges[i] = std::min(ranges[i], distance / std::cos(angle(i)));
        }
    }
    WheelSpeeds drive_now() {
        view.ranges = ranges;
        return drive(view);
    }
};

double forward(const WheelSpeeds& w) {
    return 0.5 * (w.left + w.right);
}
double turning_left(const WheelSpeeds& w) {
    return w.right - w.left;
}

TEST(Driving, AnOpenRoadIsDrivenStraightAndFaster) {
    Scene scene;
    const WheelSpeeds w = scene.drive_now();
    EXPECT_GT(forward(w), 1.1);
    EXPECT_NEAR(turning_left(w), 0, 0.01);
}

TEST(Driving, WheelsNeverPassTheirLimit) {
    Scene scene;
    for (int period = 0; period < 100; ++period) {
        scene.view.goal_angle = 0.3 * period;
        const WheelSpeeds w = scene.drive_now();
        EXPECT_LT(std::fabs(w.left), 2.3);
        EXPECT_LT(std::fabs(w.right), 2.3);
        scene.view.ordered_left = w.left, scene.view.ordered_right = w.right;
    }
}

TEST(Driving, AnObstacleOnTheRightIsPassedOnTheLeftAndTheOtherWayRound) {
    Scene right, left;
    right.add_wall(1.5, -2.0, 0.15);
    left.add_wall(1.5, -0.15, 2.0);
    EXPECT_GT(turning_left(right.drive_now()), 0.1);
    EXPECT_LT(turning_left(left.drive_now()), -0.1);
}

TEST(Driving, TheGoalDecidesWhereBothWaysAreFree) {
    Scene scene;
    scene.add_wall(1.5, -0.5, 0.5);
    scene.view.goal_angle = 0.8;
    EXPECT_GT(turning_left(scene.drive_now()), 0.1);
    scene.view.goal_angle = -0.8;
    EXPECT_LT(turning_left(scene.drive_now()), -0.1);
}

TEST(Driving, AWallCloseAheadMakesItBrake) {
    Scene scene;
    scene.add_wall(0.3, -5, 5);
    scene.view.speed = 1.0;
    EXPECT_LT(forward(scene.drive_now()), 0.9);
}

TEST(Driving, BoxedInItTurnsOnTheSpotAlwaysTheSameWay) {
    Scene scene;
    for (double& range : scene.ranges) range = 0.3;
    scene.view.speed = 0;
    scene.view.turn_rate = 1.0;
    for (double side : {-1.0, 1.0}) {
        scene.view.ordered_left = -0.3 * side, scene.view.ordered_right = 0.3 * side;
        const WheelSpeeds w = scene.drive_now();
        EXPECT_NEAR(forward(w), 0, 0.05);
        EXPECT_GT(side * turning_left(w), 0.5);
    }
}

TEST(Driving, PushingInVainItBacksAndBackingInVainItStops) {
    Scene scene;
    scene.view.speed = 0;
    EXPECT_LT(forward(scene.drive_now()),
              1.0);  // its wheels turn but it stands: they slow down, then reverse
    scene.view.ordered_left = scene.view.ordered_right = -0.5;
    scene.add_wall(0.3, -5, 5);
    scene.view.speed = -0.5;
    EXPECT_LT(forward(scene.drive_now()), -0.4);
    scene.view.speed = 0;
    EXPECT_GT(forward(scene.drive_now()), -0.45);
}

TEST(Driving, FreeWayIsTheGapToTheFirstThingInTheLane) {
    Scene scene;
    scene.ranges[10] = 2.0;  // straight ahead
    scene.view.ranges = scene.ranges;
    EXPECT_NEAR(free_way(scene.view, 0, 0.3), 1.7, 1e-12);
    EXPECT_NEAR(free_way(scene.view, 0.5 * roboss::kPi, 0.3), 6.0, 1e-12);
    EXPECT_LT(free_way(scene.view, 0.1, 0.3), 2.0);
    EXPECT_EQ(free_way(scene.view, 0.3, 0.3), 6.0);
    scene.ranges[10] = -kNothing;  // nearer than the laser can measure
    scene.view.ranges = scene.ranges;
    EXPECT_EQ(free_way(scene.view, 0, 0.3), 0.0);
}

TEST(Driving, NoLaserNoDriving) {
    Scene scene;
    scene.ranges.clear();
    EXPECT_LT(forward(scene.drive_now()), 1.0);
}

TEST(Driving, GoalsLieInTheCityAndChangeNowAndThen) {
    const Rectangle city{-10, 5, 30, 9};
    std::set<double> places;
    for (double t = 0; t < 250; t += 0.05) {
        const Place goal = goal_of(1, 7, t, city);
        EXPECT_GE(goal.x, city.min_x);
        EXPECT_LE(goal.x, city.max_x);
        EXPECT_GE(goal.y, city.min_y);
        EXPECT_LE(goal.y, city.max_y);
        places.insert(goal.x);
    }
    EXPECT_EQ(places.size(), 11u);
    EXPECT_NE(goal_of(1, 7, 0, city).x, goal_of(1, 8, 0, city).x);
    EXPECT_NE(goal_of(1, 7, 0, city).x, goal_of(2, 7, 0, city).x);
}

}  // namespace
}  // namespace city_driver
