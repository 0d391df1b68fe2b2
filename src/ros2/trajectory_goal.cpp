// See trajectory_goal.h.
#include "ros2/trajectory_goal.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "physics/dynamics/kinematics.h"
#include "ros2/robot_controllers.h"

namespace roboss::ros2 {

namespace {

constexpr double kStep_s = 0.01;          // between the points that an on-board controller gets
constexpr std::size_t kMostRows = 2'000;  // of these

Error bad_joints(const std::string& what) {
    return {what, "name each joint of the robot's controller once", "bad-joints"};
}

}  // namespace

TrajectoryJoints TrajectoryJoints::of(const RobotType& type) {
    TrajectoryJoints able;
    for (const OnboardInfo& controller : type.onboard) {
        if (!std::holds_alternative<JointTrajectoryControllerSpec>(controller.spec.parameters)) continue;
        able.channel = static_cast<std::uint32_t>(controller.channels.front());
        for (const AxisRef& axis : controller.axes) able.joints.push_back(axis.joint);
        return able;
    }
    if (!type.onboard.empty()) return able;  // its motors have a controller already
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (is_driven(type, JointId(j))) able.joints.push_back(JointId(j));
    return able;
}

TrajectoryJoints TrajectoryJoints::of(const RobotType& type, std::vector<JointId> joints) {
    TrajectoryJoints able = of(type);
    if (able.channel && std::ranges::is_permutation(joints, able.joints)) return able;
    able.channel.reset(), able.joints = std::move(joints);
    return able;
}

Result<TrajectoryGoal> TrajectoryGoal::of(const Goal& wanted, const RunControl& run, RobotId robot,
                                          const TrajectoryJoints& able) {
    if (run.tick() < 0) return Error{"the world was not seen yet", "send the goal again", "no-world"};
    if (!wanted.multi_dof_trajectory.points.empty() || !wanted.component_path_tolerance.empty() ||
        !wanted.component_goal_tolerance.empty())
        return bad_joints("joints with several axes cannot follow a trajectory");
    TrajectoryGoal goal;
    goal.robot_ = robot, goal.channel_ = able.channel;
    if (const roboss::Result<> chosen = goal.choose_joints(wanted, run.model().type_of(robot), able); !chosen)
        return chosen.error();
    if (const auto set = goal.set_tolerances(wanted.path_tolerance, goal.on_the_way_); !set)
        return set.error();
    if (const auto set = goal.set_tolerances(wanted.goal_tolerance, goal.at_the_end_); !set)
        return set.error();
    goal.goal_time_s_ = std::max(0.0, seconds_of(wanted.goal_time_tolerance));
    roboss::Result<Trajectory> trajectory = Trajectory::of(wanted.trajectory, goal.actual(run));
    if (!trajectory) return trajectory.error();
    goal.trajectory_ = std::move(trajectory).value();
    const Time& stamp = wanted.trajectory.header.stamp;
    const double dt_s = run.model().dt_s, begin_s = stamp.sec + 1e-9 * stamp.nanosec;
    goal.begin_ =
        stamp.sec == 0 && stamp.nanosec == 0 ? run.tick() : static_cast<Tick>(std::llround(begin_s / dt_s));
    const bool is_past = goal.time_s(run) > goal.trajectory_.duration_s();
    if (is_past || (goal.channel_ && goal.begin_ != run.tick() && begin_s != 0))
        return Error{is_past ? "the trajectory ends in the past"
                             : "the on-board controller begins at once: its trajectories have no stamp",
                     "leave the stamp of the trajectory 0", "old-stamp"};
    return goal;
}

Result<> TrajectoryGoal::choose_joints(const Goal& goal, const RobotType& type,
                                       const TrajectoryJoints& able) {
    names_ = goal.trajectory.joint_names;
    for (const std::string& name : names_) {
        const auto joint = type.find_joint(name);
        if (!joint || std::ranges::find(able.joints, *joint) == able.joints.end())
            return bad_joints("the robot has no joint '" + name.substr(0, 100) + "' that can follow");
        joints_.push_back(*joint);
    }
    if (std::set<JointId>(joints_.begin(), joints_.end()).size() != joints_.size())
        return bad_joints("a joint is named twice");
    on_the_way_.resize(joints_.size()), at_the_end_.resize(joints_.size());
    if (!able.channel) return Ok{};
    if (joints_.size() != able.joints.size())
        return bad_joints("the on-board controller takes all of its " + std::to_string(able.joints.size()) +
                          " joints");
    for (const JointId joint : able.joints)
        places_.push_back(static_cast<std::size_t>(std::ranges::find(joints_, joint) - joints_.begin()));
    return Ok{};
}

/// 0 is the default, which is none; negative is none.
Result<> TrajectoryGoal::set_tolerances(const std::vector<JointTolerance>& from,
                                        std::vector<Tolerance>& to) const {
    for (const JointTolerance& tolerance : from) {
        const auto name = std::ranges::find(names_, tolerance.name);
        if (name == names_.end())
            return bad_joints("a tolerance is for '" + tolerance.name.substr(0, 100) +
                              "', which the trajectory does not name");
        Tolerance& own = to[static_cast<std::size_t>(name - names_.begin())];
        if (tolerance.position > 0) own.position = tolerance.position;
        if (tolerance.velocity > 0) own.velocity = tolerance.velocity;
    }
    return Ok{};
}

double TrajectoryGoal::time_s(const RunControl& run) const {
    return static_cast<double>(run.tick() - begin_) * run.model().dt_s;
}

std::vector<JointPoint> TrajectoryGoal::actual(const RunControl& run) const {
    const RobotType& type = run.model().type_of(robot_);
    std::vector<JointPoint> points;
    for (const JointId joint : joints_) {
        const JointState at = joint_state(type, run.states()[robot_.index()], joint);
        points.push_back({at.position, at.velocity, 0});
    }
    return points;
}

/// A point in the layout of the on-board controller's list.
std::vector<double> TrajectoryGoal::row(double time_s, const std::vector<JointPoint>& joints) const {
    std::vector<double> row{time_s};
    for (const std::size_t place : places_) {
        row.push_back(joints[place].position), row.push_back(joints[place].velocity);
        row.push_back(0);  // effort besides that of the controller
    }
    return row;
}

Result<> TrajectoryGoal::begin(RunControl& run) const {
    if (!channel_) return Ok{};
    const double duration_s = trajectory_.duration_s();
    const auto steps =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(duration_s / kStep_s)), 1, kMostRows);
    Command command{*channel_, {}};
    for (std::size_t i = 1; i <= steps; ++i) {
        const double time_s = duration_s * static_cast<double>(i) / static_cast<double>(steps);
        std::ranges::copy(row(time_s, trajectory_.at(time_s)), std::back_inserter(command.values));
    }
    return run.order(robot_, command);
}

TrajectoryGoal::Sample TrajectoryGoal::sample(const RunControl& run) const {
    const double now_s = time_s(run);
    return {trajectory_.at(now_s), actual(run), trajectory_.next(now_s)};
}

std::optional<TrajectoryGoal::Result> TrajectoryGoal::outcome(const RunControl& run,
                                                              const Sample& sample) const {
    const double late_s = time_s(run) - trajectory_.duration_s();
    const std::vector<Tolerance>& tolerances = late_s < 0 ? on_the_way_ : at_the_end_;
    for (std::size_t j = 0; j < names_.size(); ++j) {
        const double off = std::abs(sample.desired[j].position - sample.actual[j].position);
        const double speed_off = std::abs(sample.desired[j].velocity - sample.actual[j].velocity);
        if (off <= tolerances[j].position && speed_off <= tolerances[j].velocity) continue;
        const std::string text = "joint '" + names_[j] + "' is off by " + std::to_string(off) +
                                 " rad or m and " + std::to_string(speed_off) + " rad/s or m/s";
        if (late_s < 0) return Result{Result::kPathToleranceViolated, text};
        if (goal_time_s_ > 0 && late_s > goal_time_s_) return Result{Result::kGoalToleranceViolated, text};
        return {};  // it has more time to get there
    }
    if (late_s < 0) return {};
    return Result{Result::kSuccessful, ""};
}

void TrajectoryGoal::follow(RunControl& run, Tick period) const {
    if (channel_) return;
    const double then_s = time_s(run) + static_cast<double>(period) * run.model().dt_s;
    (void)hold_positions(run, trajectory_.at(then_s));  // the run reports refusals
}

void TrajectoryGoal::hold(RunControl& run) const {
    if (channel_)
        (void)run.order(robot_, Command{*channel_, row(0, [&] {
                                            std::vector<JointPoint> at = actual(run);
                                            for (JointPoint& joint : at) joint.velocity = 0;
                                            return at;
                                        }())});
    else
        (void)hold_positions(run, actual(run));
}

bool TrajectoryGoal::hold_positions(RunControl& run, const std::vector<JointPoint>& at) const {
    const RobotType& type = run.model().type_of(robot_);
    bool all = true;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        if (follows(type, joints_[j])) continue;
        all =
            run.order(robot_, SetJoint{joints_[j], 0, MotorMode::kPosition, at[j].position, -1}).ok() && all;
    }
    return all;
}

}  // namespace roboss::ros2
