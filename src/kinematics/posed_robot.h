// A RobotModel at one configuration after the other, in the kernel's coordinates: the buffers that all rows
// of a batch share, so that a row allocates nothing.
#pragma once

#include "kinematics/robot_model.h"
#include "physics/dynamics/dynamics.h"

namespace roboss {

struct PosedRobot {
    explicit PosedRobot(const RobotModel& of) : robot(of), q(static_cast<std::size_t>(of.type().nq)) {
        v.resize(of.v_columns());
        work.type = &of.type();
    }

    /// Poses and motion axes of the configuration in `row`.
    void place(const double* row) {
        robot.to_coordinates(row, q);
        place();
    }
    /// The same of `q`.
    void place() { forward_kinematics<double>(robot.type(), q, work); }
    /// Velocities of a placed robot; nullptr: at rest.
    void move(const double* row) {
        for (std::size_t c = 0; c < v.size(); ++c) v[robot.v_of(c)] = row != nullptr ? row[c] : 0.0;
        forward_velocities<double>(robot.type(), v, work);
    }
    /// Pose of a link's frame in the world.
    Transform link_pose(LinkId link) const {
        const Link& info = robot.type().links[link.index()];
        return (info.body < 0 ? base_transform<double>(q)
                              : work.bodies[static_cast<std::size_t>(info.body)].X_WB) *
               info.X_BL;
    }
    /// Calls visit(entry of v) for each degree of freedom that moves the link.
    template <class Visit>
    void visit_path(LinkId link, Visit visit) const {
        const int b = robot.type().links[link.index()].body;
        if (b < 0) return;
        const Body& body = robot.type().bodies[static_cast<std::size_t>(b)];
        const auto last = static_cast<std::size_t>(body.v_index + body.nv - 1);
        const DofPaths& paths = robot.type().paths;
        for (std::size_t k = 0; k < paths.length(last); ++k)
            visit(static_cast<std::size_t>(paths.path(last)[k]));
    }
    /// Motion of a point at the world position p per unit of entry i of v; its body must be one that i moves.
    Spatial point_motion(std::size_t i, const Vec3& p) const {
        const Spatial& axis = work.axes[i];
        return {axis.angular, axis.linear + cross(axis.angular, p - work.origin)};
    }

    const RobotModel& robot;
    std::vector<double> q, v;
    RobotWork work;
};

}  // namespace roboss
