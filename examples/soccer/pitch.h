// What the referee and the teams share: the robots of a world of `roboss-world soccer`, what a team sees of
// them, and the length of a half.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <roboss/app/worlds/soccer_field.h>
#include <roboss/client/control_program.h>

namespace soccer {

enum class Team : int { kBlue = 0, kYellow = 1 };

inline Team other(Team team) {
    return team == Team::kBlue ? Team::kYellow : Team::kBlue;
}
inline const char* name_of(Team team) {
    return team == Team::kBlue ? "blue" : "yellow";
}

/// Whether a number from the network is an angle: finite and at most 1e6 rad. Sine and cosine convert the
/// quadrant to an integer, which has no room for far greater ones.
inline bool is_angle(double rad) {
    return std::fabs(rad) <= 1e6;
}

inline constexpr double kFrame = 1.0 / 60;  // s, between two looks of a team at the field

/// Lengths in m, angles in rad, of something on the field.
struct Mover {
    double x = 0, y = 0, yaw = 0;
    double vx = 0, vy = 0, turn = 0;  // m/s, rad/s
};

/// The field as a team sees it that plays towards +x.
struct View {
    Field field;
    double time_s = 0;
    std::vector<Mover> own, others;  // by number
    Mover ball;
};

/// The ids of a soccer world's robots.
struct Pitch {
    Field field;
    std::array<std::vector<roboss::RobotId>, 2> robots;  // by team and number
    roboss::RobotId ball;
    std::array<std::optional<roboss::RobotId>, 2> stations;  // by team; of a world with radio

    /// @throws std::runtime_error if the world was not made by `roboss-world soccer`.
    static Pitch of(const roboss::Client& client);
    const std::vector<roboss::RobotId>& of_team(Team team) const {
        return robots[static_cast<std::size_t>(team)];
    }
};

/// Length of a half, s: ROBOSS_SOCCER_HALF, or 300. All programs of a match must have the same.
double half_length_s();

/// +1 if the team plays towards +x in this half, else -1.
inline double side_of(Team team, bool second_half) {
    return (team == Team::kBlue) != second_half ? 1 : -1;
}

/// What an overhead camera adds to the truth: ROBOSS_SOCCER_CAMERA="2 1 33" is 2 mm and 1 degree of noise
/// (standard deviation) and images that are 33 ms old. All 0: teams see true states.
struct Camera {
    double noise_m = 0, noise_rad = 0, delay_s = 0;
    /// std::nullopt if the variable is set to anything else.
    static std::optional<Camera> from_environment();
    /// @throws std::runtime_error with a remedy in that case.
    static Camera required();
};

/// As the team sees it that plays to `side`: of the world's x axis, +1 or -1.
View see(roboss::Client& client, const Pitch& pitch, Team team, const Camera& camera, double side);

}  // namespace soccer
