#include "pitch.h"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "core/fixed_math.h"
#include "core/noise.h"

namespace soccer {
namespace {

/// Position, heading and velocities in the frame of the world, or turned by half a turn about its z axis.
Mover mover_of(const roboss::Client& client, roboss::RobotId robot, double side) {
    const roboss::Transform X_WL = client.pose(robot, roboss::LinkId(0u));
    const roboss::Twist twist = client.twist(robot, roboss::LinkId(0u));
    const roboss::Vec3 ahead = X_WL.R * roboss::Vec3{1, 0, 0};
    return {side * X_WL.p.x,       side * X_WL.p.y,       roboss::fixed_atan2(side * ahead.y, side * ahead.x),
            side * twist.linear.x, side * twist.linear.y, twist.angular.z};
}

/// A tracking filter over a few images makes velocities; their error is that of a difference over 50 ms.
void blur(Mover& seen, const Camera& camera, const roboss::NoiseStream& stream) {
    constexpr double kFilter = 0.05;  // s
    const auto noise = [&](std::uint64_t index) { return roboss::random_gaussian(stream, index); };
    seen.x += camera.noise_m * noise(0);
    seen.y += camera.noise_m * noise(1);
    seen.yaw += camera.noise_rad * noise(2);
    seen.vx += camera.noise_m / kFilter * noise(3);
    seen.vy += camera.noise_m / kFilter * noise(4);
    seen.turn += camera.noise_rad / kFilter * noise(5);
}

}  // namespace

Pitch Pitch::of(const roboss::Client& client) {
    const roboss::Model& model = client.model();
    Pitch pitch;
    for (const Team team : {Team::kBlue, Team::kYellow})
        for (int number = 0;; ++number) {
            const auto robot = model.find_robot(std::string(name_of(team)) + "_" + std::to_string(number));
            if (!robot) break;
            pitch.robots[static_cast<std::size_t>(team)].push_back(*robot);
        }
    for (const Team team : {Team::kBlue, Team::kYellow})
        pitch.stations[static_cast<std::size_t>(team)] =
            model.find_robot(std::string(name_of(team)) + "_station");
    const auto ball = model.find_robot("ball");
    const Field* field = field_for(static_cast<int>(pitch.robots[0].size()));
    if (!ball || field == nullptr || pitch.robots[0].size() != pitch.robots[1].size())
        throw std::runtime_error(
            "this world has no \"ball\" and two teams \"blue_0\" ..., \"yellow_0\" ... of 3, 5 or 11 robots\n"
            "  remedy: make a world with `roboss-world soccer --league small -o soccer.sdf`");
    pitch.field = *field;
    pitch.ball = *ball;
    return pitch;
}

double half_length_s() {
    const char* text = std::getenv("ROBOSS_SOCCER_HALF");
    const double seconds = text != nullptr ? std::atof(text) : 300;
    if (!(seconds > 0))
        throw std::runtime_error(std::string("ROBOSS_SOCCER_HALF is \"") + text +
                                 "\"\n  remedy: give the length of a half in seconds, for example 300");
    return seconds;
}

std::optional<Camera> Camera::from_environment() {
    const char* text = std::getenv("ROBOSS_SOCCER_CAMERA");
    if (text == nullptr) return Camera{};
    std::istringstream numbers(text);
    double noise_mm = -1, noise_deg = -1, delay_ms = -1;
    numbers >> noise_mm >> noise_deg >> delay_ms;
    if (!numbers || noise_mm < 0 || noise_deg < 0 || delay_ms < 0) return std::nullopt;
    return Camera{noise_mm / 1000, noise_deg * roboss::kPi / 180, delay_ms / 1000};
}

Camera Camera::required() {
    if (const auto camera = from_environment()) return *camera;
    throw std::runtime_error(
        "ROBOSS_SOCCER_CAMERA is no camera\n"
        "  remedy: give noise in mm and degrees, and a delay in ms: \"2 1 33\"");
}

View see(roboss::Client& client, const Pitch& pitch, Team team, const Camera& camera, double side) {
    const auto mover = [&](roboss::RobotId robot) {
        Mover seen = mover_of(client, robot, side);
        // Both teams look through the same camera; 0 is the index of no sensor of theirs.
        if (camera.noise_m > 0 || camera.noise_rad > 0)
            blur(seen, camera, {client.seed(), robot.value, 0, client.tick()});
        return seen;
    };
    View view{pitch.field, client.time_s(), {}, {}, mover(pitch.ball)};
    for (const roboss::RobotId robot : pitch.of_team(team)) view.own.push_back(mover(robot));
    for (const roboss::RobotId robot : pitch.of_team(other(team))) view.others.push_back(mover(robot));
    return view;
}

}  // namespace soccer
