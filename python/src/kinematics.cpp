// RobotModel: kinematics and dynamics of one robot for many configurations; and trajectories. Shapes are
// checked in Python, sizes again in C++. Nothing here holds the GIL while it computes.
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>

#include "bindings.h"
#include "errors.h"
#include "roboss/kinematics/dynamics.h"
#include "roboss/kinematics/inverse_kinematics.h"
#include "roboss/kinematics/trajectory.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

using Filled = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using Given = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using MaybeGiven = std::optional<Given>;

std::span<double> span_of(const Filled& array) {
    return {array.data(), array.size()};
}

std::span<const double> span_of(const Given& array) {
    return {array.data(), array.size()};
}

std::span<const double> span_of(const MaybeGiven& array) {
    return array ? span_of(*array) : std::span<const double>{};
}

Vec3 vec3(const Given& three) {
    return {three.data()[0], three.data()[1], three.data()[2]};
}

/// x y z, quaternion x y z w.
Pose pose(const Given& seven) {
    const double* p = seven.data();
    return {{p[0], p[1], p[2]}, normalized(Quat{p[6], p[3], p[4], p[5]})};
}

FrameAxes axes_of(bool in_tool) {
    return in_tool ? FrameAxes::kTool : FrameAxes::kWorld;
}

RobotModel make(std::shared_ptr<const Model> model, std::size_t robot, bool cut_loops,
                const MaybeGiven& base) {
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
           const Given& targets, const Given& start, const Filled& q, const Filled& report) {
    const nb::gil_scoped_release release;
    std::vector<InverseKinematicsResult> results(targets.size() / 7);
    inverse_kinematics(robot, LinkId(link), options, span_of(targets), span_of(start), span_of(q), results);
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
            [](const RobotModel& r, const Given& q, std::size_t link, const Given& tool, const Filled& out) {
                tool_poses(r, span_of(q), LinkId(link), pose(tool), span_of(out));
            },
            WithoutGil())
        .def(
            "link_poses",
            [](const RobotModel& r, const Given& q, const Filled& out) {
                link_poses(r, span_of(q), span_of(out));
            },
            WithoutGil())
        .def(
            "tool_twists",
            [](const RobotModel& r, const Given& q, const Given& v, std::size_t link, const Given& tool,
               const Filled& out) {
                tool_twists(r, span_of(q), span_of(v), LinkId(link), pose(tool), span_of(out));
            },
            WithoutGil())
        .def(
            "tool_jacobians",
            [](const RobotModel& r, const Given& q, std::size_t link, const Given& tool, bool in_tool,
               const Filled& out) {
                tool_jacobians(r, span_of(q), LinkId(link), pose(tool), axes_of(in_tool), span_of(out));
            },
            WithoutGil())
        .def(
            "inverse_kinematics",
            [](const RobotModel& r, std::size_t link, const Given& tool, const std::array<double, 6>& weights,
               bool in_tool, const nb::dict& options, const std::vector<bool>& moving, const Given& targets,
               const Given& start, const Filled& q, const Filled& report) {
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
            [](const RobotModel& r, const Given& q, const MaybeGiven& v, const MaybeGiven& a,
               const Given& gravity, const Filled& out) {
                inverse_dynamics(r, span_of(q), span_of(v), span_of(a), vec3(gravity), span_of(out));
            },
            nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg(), WithoutGil())
        .def(
            "forward_dynamics",
            [](const RobotModel& r, const Given& q, const MaybeGiven& v, const MaybeGiven& forces,
               const Given& gravity, const Filled& out) {
                forward_dynamics(r, span_of(q), span_of(v), span_of(forces), vec3(gravity), span_of(out));
            },
            nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg(), WithoutGil())
        .def(
            "passive_forces",
            [](const RobotModel& r, const Given& q, const MaybeGiven& v, const Filled& out) {
                passive_forces(r, span_of(q), span_of(v), span_of(out));
            },
            nb::arg(), nb::arg().none(), nb::arg(), WithoutGil())
        .def(
            "mass_matrices",
            [](const RobotModel& r, const Given& q, const Filled& out) {
                mass_matrices(r, span_of(q), span_of(out));
            },
            WithoutGil())
        .def(
            "coriolis_matrices",
            [](const RobotModel& r, const Given& q, const Given& v, const Filled& out) {
                coriolis_matrices(r, span_of(q), span_of(v), span_of(out));
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
    module.def("robot_model", &make, nb::arg("model"), nb::arg("robot"), nb::arg("cut_loops"),
               nb::arg("base").none());
    module.def("compose", [](const Given& a, const Given& b, const Filled& out) {
        const Pose X = pose(a) * pose(b);
        const std::array<double, 7> numbers{X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w};
        std::copy(numbers.begin(), numbers.end(), out.data());
    });
    module.def(
        "joint_trajectory",
        [](const Given& q0, const Given& q1, const Given& v0, const Given& v1, const Given& times,
           const Filled& q, const Filled& v, const Filled& a) {
            joint_trajectory({span_of(q0), span_of(q1), span_of(v0), span_of(v1)}, span_of(times),
                             {span_of(q), span_of(v), span_of(a)});
        },
        WithoutGil());
    module.def(
        "cartesian_trajectory",
        [](const Given& pose0, const Given& pose1, double ramp, const Given& times, const Filled& poses,
           const Filled& twists) {
            cartesian_trajectory(pose(pose0), pose(pose1), ramp, span_of(times), span_of(poses),
                                 span_of(twists));
        },
        WithoutGil());
}

}  // namespace roboss_python
