// See free_course.h.
#include "physics/dynamics/free_course.h"

#include <algorithm>
#include <cmath>

#include "physics/contact/swept_contact.h"
#include "physics/dynamics/joint_rows.h"
#include "physics/dynamics/kick_drift.h"

namespace roboss {
namespace {

constexpr double kTurnMost = 2;    // rad in a tick: what turns further has no course
constexpr double kFarthest = 1e6;  // m in a tick: likewise

bool has_joints(const RobotType& type) {
    return type.nv > type.base_nv();
}

BodyMotion motion_of(const BodyWork& body, const Vec3& origin) {
    const Spatial& v = body.velocity;
    return {body.X_WB, v.angular, v.linear + cross(v.angular, body.X_WB.p - origin)};
}

}  // namespace

void FreeCourses::start(std::size_t robots, bool keep_reactions) {
    if (flights_.size() < robots) flights_.resize(robots);
    for (std::size_t r = 0; r < count_; ++r) flights_[r].ahead = Ahead::kUnknown;
    count_ = robots, keep_reactions_ = keep_reactions;
}

bool FreeCourses::compute(const Model& model, const RobotWork& robot, std::vector<BodyMotion>& ends) {
    const RobotType& type = *robot.type;
    const double dt = model.dt_s;
    const auto turns_too_far = [&](const Mechanics<double>& work) {
        return !(fastest_turn(work) * dt * dt < kTurnMost * kTurnMost);
    };
    if (!has_joints(type) || (keep_reactions_ && !type.loops.empty()) || !moves_freely(model, robot))
        return false;
    if (turns_too_far(robot)) return false;
    state_ = *robot.state;
    work_.id = robot.id, work_.take(type, state_);
    forward_kinematics<double>(type, state_.q, work_);
    forward_velocities<double>(type, state_.v, work_);
    advance_freely(model, work_, buffer_);
    forward_kinematics<double>(type, state_.q, work_);
    forward_velocities<double>(type, state_.v, work_);
    if (turns_too_far(work_)) return false;
    ends.clear();
    for (const BodyWork& body : work_.bodies) ends.push_back(motion_of(body, work_.origin));
    return std::ranges::all_of(ends, [&](const BodyMotion& end) {
        return norm(end.X.p - robot.origin) < kFarthest && norm(end.linear) * dt < kFarthest;
    });
}

bool FreeCourses::knows(const Model& model, const RobotWork& robot, std::size_t number) {
    if (!has_joints(*robot.type)) return false;
    Flight& flight = flights_[number];
    if (flight.ahead == Ahead::kUnknown)
        flight.ahead = compute(model, robot, flight.ends) ? Ahead::kComputed : Ahead::kNone;
    return flight.ahead == Ahead::kComputed;
}

std::optional<Course> FreeCourses::find(const Model& model, const RobotWork& robot, std::size_t number,
                                        std::size_t shape) {
    const BodyShape& of_body = robot.type->shapes[shape];
    if (of_body.body < 0 || !knows(model, robot, number)) return std::nullopt;
    const auto body = static_cast<std::size_t>(of_body.body);
    const Transform X = shape_pose(robot, shape);
    const BodyMotion from = motion_of(robot.bodies[body], robot.origin);
    return course_between(of_body.shape, X, from, flights_[number].ends[body], model.dt_s,
                          turning_speed<double>(of_body.shape, X.R, from.angular));
}

Course known_course(const Model& model, const RobotWork& robot, std::size_t number, std::size_t shape,
                    FreeCourses& free_courses) {
    const std::optional<Course> free = free_courses.find(model, robot, number, shape);
    return free ? *free : course_of(robot, shape, model.dt_s);
}

}  // namespace roboss
