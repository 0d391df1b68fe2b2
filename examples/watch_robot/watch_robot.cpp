// Prints the state of robots as JSON, one object per line and robot, ten times per simulated second: for
// scripts, and to check that orders of others are obeyed. It gives no orders, and the run does not wait for
// it.
//   ROBOSS_WATCH=car_3,car_7 roboss client roboss_watch_robot.so     (without: every robot)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include <roboss/client/control_program.h>

namespace watch_robot {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return std::isfinite(value) ? text : "null";
}

std::string vector(const roboss::Vec3& v) {
    return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]";
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned char>(c));
        const bool plain = static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\';
        out += plain ? std::string(1, c) : escape;
    }
    return out + "\"";
}

std::string joint(const roboss::Client& client, roboss::RobotId robot, roboss::JointId id) {
    static constexpr const char* kModes[] = {"passive", "velocity", "position", "effort"};
    const roboss::RobotType& type = client.model().type_of(robot);
    const roboss::Joint& joint = type.joints[id.index()];
    std::string axes;
    for (int axis = 0; axis < joint.nv; ++axis) {
        const roboss::JointState state = client.joint(robot, id, axis);
        const roboss::MotorSetpoint& motor = client.state(robot).motors[type.motor_index(joint, axis)];
        axes += (axis > 0 ? "," : "") + ("{\"position\":" + number(state.position)) +
                ",\"velocity\":" + number(state.velocity) + ",\"mode\":\"" +
                kModes[static_cast<std::size_t>(motor.mode)] + "\",\"target\":" + number(motor.target) + "}";
    }
    return quoted(joint.name) + ":[" + axes + "]";
}

/// Pose of the robot's own frame (x y z, quaternion w x y z) and velocity of its base.
std::string report(const roboss::Client& client, roboss::RobotId robot) {
    const roboss::RobotType& type = client.model().type_of(robot);
    const roboss::RobotState& state = client.state(robot);
    const roboss::Pose X_WR =
        roboss::to_pose(roboss::to_transform(roboss::base_pose(state)) * inverse(type.X_RB));
    const roboss::Vec3 v = type.free_base ? roboss::Vec3{state.v[3], state.v[4], state.v[5]} : roboss::Vec3{};
    std::string joints;
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        joints += (j > 0 ? "," : "") + joint(client, robot, roboss::JointId(j));
    return "{\"time\":" + number(client.time_s()) +
           ",\"robot\":" + quoted(client.model().robots[robot.index()].name) +
           ",\"position\":" + vector(X_WR.p) + ",\"orientation\":[" + number(X_WR.q.w) + "," +
           number(X_WR.q.x) + "," + number(X_WR.q.y) + "," + number(X_WR.q.z) +
           "],\"velocity\":" + vector(v) + ",\"joints\":{" + joints + "}}\n";
}

/// Those that ROBOSS_WATCH names with commas between; throws on a name that no robot has.
std::vector<roboss::RobotId> watched(const roboss::Model& model) {
    std::vector<roboss::RobotId> robots;
    const char* names = std::getenv("ROBOSS_WATCH");
    if (names == nullptr || *names == '\0') {
        for (std::size_t r = 0; r < model.robots.size(); ++r) robots.emplace_back(r);
        return robots;
    }
    const std::string list = names;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(',', at), list.size());
        const std::string name = list.substr(at, end - at);
        const auto robot = model.find_robot(name);
        if (!robot)
            throw std::runtime_error("ROBOSS_WATCH names '" + name + "', but the world has no such robot");
        robots.push_back(*robot);
        at = end + 1;
    }
    return robots;
}

class WatchRobot final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {0.1, -1, false}; }

    void start(roboss::Client& client) override { robots_ = watched(client.model()); }

    void control(roboss::Client& client) override {
        std::string lines;
        for (const roboss::RobotId robot : robots_) lines += report(client, robot);
        std::fwrite(lines.data(), 1, lines.size(), stdout);
        std::fflush(stdout);
    }

  private:
    std::vector<roboss::RobotId> robots_;
};

}  // namespace
}  // namespace watch_robot

ROBOSS_CONTROL_PROGRAM(watch_robot::WatchRobot)
