// The fields of robot soccer and where robots stand on them: numbers that the generator of the world, the
// referee and the teams of examples/soccer share.
//
// Large field, ball, walls and corners: "FIRA Large League MiroSot Game Rules", FIRA 2005, law 1. Sizes of
// the small and the middle field, their goals and circles: those of the IEEE Very Small Size league, as
// FIRASim has them for 3 and 5 robots. Lengths in m. The middle of the field is the origin; goals lie at -x
// and +x.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace soccer {

struct Field {
    std::string_view league;
    int robots = 0;  // of each team, the goalkeeper is number 0
    double half_length = 0, half_width = 0;
    double half_goal = 0, goal_depth = 0;
    double circle = 0;                                // radius of the centre circle
    double goal_area_half = 0, goal_area_depth = 0;   // before the goal: along y, along x
    double penalty_half = 0, penalty_area_depth = 0;  // likewise
    double penalty_mark = 0;                          // distance from the goal line
};

inline constexpr std::array<Field, 3> kFields{{
    {"small", 3, 0.75, 0.65, 0.2, 0.10, 0.20, 0.35, 0.15, 0.40, 0.35, 0.375},
    {"middle", 5, 1.10, 0.90, 0.2, 0.15, 0.25, 0.25, 0.15, 0.40, 0.35, 0.375},
    {"large", 11, 2.00, 1.40, 0.3, 0.15, 0.75, 0.425, 0.25, 0.60, 0.70, 0.50},
}};

inline constexpr double kWallHeight = 0.05, kWallThickness = 0.025, kCorner = 0.07;
inline constexpr double kBallRadius = 0.02135, kBallMass = 0.046;  // a golf ball
inline constexpr double kRobotSize = 0.075;
inline constexpr double kWheelRadius = 0.022, kHalfTrack = 0.031;
inline constexpr double kTopSpeed = 5.0;  // m/s

// The scoreboard: a row of beads for each team, "blue_0" is the joint of blue's first one.
inline constexpr int kGoalBeads = 15;       // goals that it can show
inline constexpr double kBeadPitch = 0.04;  // m
inline constexpr double kBeadWay = kGoalBeads * kBeadPitch;

/// The field of the league with so many robots a side; nullptr: no league has that many.
inline const Field* field_for(int robots) {
    for (const Field& field : kFields)
        if (field.robots == robots) return &field;
    return nullptr;
}

/// Whether a point is in a goal area: in that of the side of -x or of +x.
inline bool in_goal_area(const Field& field, double x, double y) {
    const double line = field.half_length - field.goal_area_depth;
    return (x < -line || x > line) && y < field.goal_area_half && y > -field.goal_area_half;
}

/// A place and a heading (rad), as a team sees the field that plays towards +x: its own goal is at -x.
struct Stand {
    double x = 0, y = 0, yaw = 0;
};

/// Where robot `number` stands at a kick-off: its team has it, or the other one.
inline Stand kick_off_stand(const Field& field, int number, bool has_kick_off) {
    const double length = field.half_length, width = field.half_width;
    if (number == 0) return {-length + 0.6 * kRobotSize, 0, 0};
    if (number == 1) return {has_kick_off ? -0.09 : -field.circle - 0.06, 0, 0};
    constexpr int kInARow = 5;
    const int others = field.robots - 2, place = number - 2;
    const int row = place / kInARow, column = place % kInARow;
    const int in_row = row < others / kInARow ? kInARow : others % kInARow;
    const double share = (2.0 * column + 1.0) / in_row - 1.0;
    return {-length * (row == 0 ? 0.65 : 0.43), 0.8 * width * share, 0};
}

}  // namespace soccer
