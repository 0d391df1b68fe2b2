// The fields and robots of RoboCup's Small Size League: numbers that the generator of the world and the
// bridge of examples/soccer share. Fields and goals: rules of the league 2023, law 1, with the margins that
// grSim has. The robot is that of the team Parsian as grSim has it (config/Parsian.ini). Lengths in m, angles
// in rad. The middle of the field is the origin; goals lie at -x and +x.
#pragma once

#include <array>
#include <string_view>

#include "app/worlds/soccer_field.h"
#include "core/fixed_math.h"

namespace soccer {

struct SslField {
    std::string_view league;
    int robots = 0;  // of each team, the goalkeeper is number 0
    double half_length = 0, half_width = 0;
    double half_goal = 0;
    double defence_half = 0, defence_depth = 0;                  // the defence area: along y, along x
    double side_margin = 0, end_margin = 0;                      // from the lines to the boundary
    double goal_depth = 0.18, circle = 0.5, penalty_mark = 6.0;  // the mark: distance from the other goal
};

inline constexpr std::array<SslField, 2> kSslFields{{
    {"ssl-a", 11, 6.0, 4.5, 0.9, 1.8, 1.8, 0.3, 0.6, 0.18, 0.5, 8.0},
    {"ssl-b", 6, 4.5, 3.0, 0.5, 1.0, 1.0, 0.3, 0.3, 0.18, 0.5, 6.0},
}};
inline constexpr double kSslLine = 0.01;        // width of a line
inline constexpr double kSslGoalHeight = 0.16;  // and 2 cm of wall around it
inline constexpr double kSslWall = 0.02, kSslBoundaryHeight = 0.10;

struct SslRobot {
    static constexpr double kRadius = 0.09, kHeight = 0.147;
    static constexpr double kFront = 0.070;  // the flat front's distance from the middle
    static constexpr double kWheelRadius = 0.027;
    static constexpr double kWheelLever = 0.080;  // from the middle to a wheel's contact point
    /// Where the wheels are: wheel1 ... wheel4 of grSim, counter-clockwise from the front left one.
    static constexpr std::array<double, 4> kWheelAngles{roboss::kPi / 3, 3 * roboss::kPi / 4,
                                                        5 * roboss::kPi / 4, 5 * roboss::kPi / 3};
    // The dribbler is a bar before the front, over the ball: its axis, and where a ball is that touches it.
    // The line between both rises by 30 degrees, so the bar presses the ball down.
    static constexpr double kBarRadius = 0.007, kBarLength = 0.056;
    static constexpr double kBarX = 0.070, kBarZ = kBallRadius + 0.5 * (kBarRadius + kBallRadius);
    // Guides beside it, within the circle of the robot, keep the ball before the bar.
    static constexpr double kGuide = 0.004, kGuideTip = 0.083;
    static constexpr double kBallX = kBarX + 0.8660254 * (kBarRadius + kBallRadius);
};

/// The SSL field for a number of robots a side; nullptr: no league has that many.
inline const SslField* ssl_field_for(int robots) {
    for (const SslField& field : kSslFields)
        if (field.robots == robots) return &field;
    return nullptr;
}

/// Where robot `number` stands at a kick-off, as a team sees it that plays towards +x: its team has it, or
/// the other.
inline Stand ssl_stand(const SslField& field, int number, bool has_kick_off) {
    if (number == 0) return {-field.half_length + 0.15, 0, 0};
    if (number == 1) return {has_kick_off ? -0.2 : -field.circle - 0.2, 0, 0};
    // The others in two lines before the defence area.
    const int others = field.robots - 2, place = number - 2;
    const int row = place % 2, in_row = (others + 1 - row) / 2, column = place / 2;
    const double share = (2.0 * column + 1.0) / in_row - 1.0;
    return {-field.half_length * (row == 0 ? 0.25 : 0.5), 0.6 * field.half_width * share, 0};
}

}  // namespace soccer
