// RobotModel: kinematics and dynamics of one robot for many configurations; and trajectories. Shapes are
// checked in Python, sizes again in C++. Nothing here holds the GIL while it computes.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>

#include "arrays.h"
#include "bindings.h"
#include "errors.h"
#include "roboss/kinematics/dynamics.h"
#include "roboss/kinematics/inverse_kinematics.h"
#include "roboss/kinematics/trajectory.h"
#include "roboss/math/array_rows.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

Pose pose(const In& seven) {
    return pose_at(seven.data());
}

FrameAxes axes_of(bool in_tool) {
    return in_tool ? FrameAxes::kTool : FrameAxes::kWorld;
}

RobotModel make_robot_model(std::shared_ptr<const Model> model, std::size_t robot, bool cut_loops,
                            const MaybeIn& base) {
    RobotModelOptions options{.cut_loops = cut_loops};
    if (base) options.X_WR = pose(*base);
    return value_or_raise(RobotModel::create(std::move(model), RobotId(robot), options), "ArgumentError");
}

/// (name, lower, upper, place of the leader, multiplier, offset) of each column.
nb::list columns_of(const RobotModel& robot) {
    nb::list columns;
    for (std::size_t i = 0; i < robot.axes().size(); ++i) {
        const RobotModel::Column& c = robot.columns()[i];
        columns.append(
            nb::make_tuple(robot.axes()[i].name, c.lower, c.upper, c.leader, c.multiplier, c.leader_offset));
    }
    return columns;
}

/// Columns of `report`: success, errors of position and orientation, iterations, attempts.
void solve(const RobotModel& robot, std::size_t link, const InverseKinematicsOptions& options,
           const In& targets, const In& start, const Out& q, const Out& report) {
    const nb::gil_scoped_release release;
    std::vector<InverseKinematicsResult> results(targets.size() / 7);
    inverse_kinematics(robot, LinkId(link), options, numbers(targets), numbers(start), numbers(q), results);
    double* out = report.data();
    for (const InverseKinematicsResult& r : results) {
        const std::array<double, 5> row{r.success ? 1.0 : 0.0, r.position_error, r.orientation_error,
                                        static_cast<double>(r.iterations), static_cast<double>(r.attempts)};
        out = std::copy(row.begin(), row.end(), out);
    }
}

using Bound = nb::class_<RobotModel>;
using WithoutGil = nb::call_guard<nb::gil_scoped_release>;

void bind_links(Bound& bound) {
    bound
        .def(
            "tool_poses",
            [](const RobotModel& r, const In& q, std::size_t link, const In& tool, const Out& out) {
                tool_poses(r, numbers(q), LinkId(link), pose(tool), numbers(out));
            },
            WithoutGil())
        .def(
            "link_poses",
            [](const RobotModel& r, const In& q, const Out& out) { link_poses(r, numbers(q), numbers(out)); },
            WithoutGil())
        .def(
            "tool_twists",
            [](const RobotModel& r, const In& q, const In& v, std::size_t link, const In& tool,
               const Out& out) {
                tool_twists(r, numbers(q), numbers(v), LinkId(link), pose(tool), numbers(out));
            },
            WithoutGil())
        .def(
            "tool_jacobians",
            [](const RobotModel& r, const In& q, std::size_t link, const In& tool, bool in_tool,
               const Out& out) {
                tool_jacobians(r, numbers(q), LinkId(link), pose(tool), axes_of(in_tool), numbers(out));
            },
            WithoutGil())
        .def("inverse_kinematics",
             [](const RobotModel& r, std::size_t link, const In& tool, const std::array<double, 6>& weights,
                bool in_tool, const nb::dict& options, const std::vector<bool>& moving, const In& targets,
                const In& start, const Out& q, const Out& report) {
                 solve(r, link,
                       {.X_LT = pose(tool),
                        .weights = weights,
                        .axes = axes_of(in_tool),
                        .tolerance = nb::cast<double>(options["tolerance"]),
                        .iterations = nb::cast<int>(options["iterations"]),
                        .attempts = nb::cast<int>(options["attempts"]),
                        .seed = nb::cast<std::uint64_t>(options["seed"]),
                        .moving = {moving.begin(), moving.end()},
                        .path = nb::cast<bool>(options["path"])},
                       targets, start, q, report);
             });
}

void bind_dynamics(Bound& bound) {
    bound
        .def(
            "inverse_dynamics",
            [](const RobotModel& r, const In& q, const MaybeIn& v, const MaybeIn& a, const In& gravity,
               const Out& out) {
                inverse_dynamics(r, numbers(q), numbers(v), numbers(a), vec3_at(gravity.data()),
                                 numbers(out));
            },
            nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg(), WithoutGil())
        .def(
            "forward_dynamics",
            [](const RobotModel& r, const In& q, const MaybeIn& v, const MaybeIn& forces, const In& gravity,
               const Out& out) {
                forward_dynamics(r, numbers(q), numbers(v), numbers(forces), vec3_at(gravity.data()),
                                 numbers(out));
            },
            nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg(), WithoutGil())
        .def(
            "passive_forces",
            [](const RobotModel& r, const In& q, const MaybeIn& v, const Out& out) {
                passive_forces(r, numbers(q), numbers(v), numbers(out));
            },
            nb::arg(), nb::arg().none(), nb::arg(), WithoutGil())
        .def(
            "mass_matrices",
            [](const RobotModel& r, const In& q, const Out& out) {
                mass_matrices(r, numbers(q), numbers(out));
            },
            WithoutGil())
        .def(
            "coriolis_matrices",
            [](const RobotModel& r, const In& q, const In& v, const Out& out) {
                coriolis_matrices(r, numbers(q), numbers(v), numbers(out));
            },
            WithoutGil());
}

}  // namespace

void bind_kinematics(nb::module_& module) {
    Bound bound(module, "RobotModel");
    bound.def_prop_ro("columns", &columns_of)
        .def_prop_ro("start", &RobotModel::start)
        .def_prop_ro("cut_joints", &RobotModel::cut_joints);
    bind_links(bound);
    bind_dynamics(bound);
    module.def("robot_model", &make_robot_model, nb::arg("model"), nb::arg("robot"), nb::arg("cut_loops"),
               nb::arg("base").none());
    module.def("compose",
               [](const In& a, const In& b, const Out& out) { put_row(pose(a) * pose(b), out.data()); });
    module.def(
        "joint_trajectory",
        [](const In& q0, const In& q1, const In& v0, const In& v1, const In& times, const Out& q,
           const Out& v, const Out& a) {
            joint_trajectory({numbers(q0), numbers(q1), numbers(v0), numbers(v1)}, numbers(times),
                             {numbers(q), numbers(v), numbers(a)});
        },
        WithoutGil());
    module.def(
        "cartesian_trajectory",
        [](const In& pose0, const In& pose1, double ramp, const In& times, const Out& poses,
           const Out& twists) {
            cartesian_trajectory(pose(pose0), pose(pose1), ramp, numbers(times), numbers(poses),
                                 numbers(twists));
        },
        WithoutGil());
}

}  // namespace roboss_python
