// RobotSet: arrays of some robots of a Simulation. Rows and columns are checked in Python; sizes are checked
// again in C++.
#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "roboss/local/robot_set.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

using Out = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using In = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

std::span<double> numbers(const Out& array) {
    return {array.data(), array.size()};
}

std::span<const double> numbers(const In& array) {
    return {array.data(), array.size()};
}

/// Some robots, and the Simulation that they are in.
struct Robots {
    std::shared_ptr<Simulation> simulation;
    RobotSet set;
};

void raise_if_refused(const Result<>& result) {
    if (!result) raise("OrderError", result.error());
}

/// A method that fills an array: the method of RobotSet, called with the run.
template <void (RobotSet::*Read)(const LocalRun&, std::span<double>) const>
void fill(Robots& robots, const Out& out) {
    (robots.set.*Read)(robots.simulation->run(), numbers(out));
}

template <void (RobotSet::*Read)(const LocalRun&, LinkId, std::span<double>) const>
void fill_link(Robots& robots, std::uint32_t link, const Out& out) {
    (robots.set.*Read)(robots.simulation->run(), LinkId(link), numbers(out));
}

/// A method that sets something from an array.
template <Result<> (RobotSet::*Set)(LocalRun&, std::span<const double>) const>
void set(Robots& robots, const In& values) {
    raise_if_refused((robots.set.*Set)(robots.simulation->run(), numbers(values)));
}

Robots make(std::shared_ptr<Simulation> simulation, const std::vector<std::uint32_t>& ids) {
    std::vector<RobotId> robots;
    for (const std::uint32_t id : ids) robots.emplace_back(id);
    RobotSet set(simulation->model(), std::move(robots));
    return {std::move(simulation), std::move(set)};
}

}  // namespace

void bind_robots(nb::module_& module) {
    nb::class_<Robots>(module, "Robots")
        .def("poses", &fill<&RobotSet::poses>, nb::arg("out"))
        .def("twists", &fill<&RobotSet::twists>, nb::arg("out"))
        .def("joint_positions", &fill<&RobotSet::joint_positions>, nb::arg("out"))
        .def("joint_velocities", &fill<&RobotSet::joint_velocities>, nb::arg("out"))
        .def("link_poses", &fill_link<&RobotSet::link_poses>, nb::arg("link"), nb::arg("out"))
        .def("link_twists", &fill_link<&RobotSet::link_twists>, nb::arg("link"), nb::arg("out"))
        .def("set_poses", &set<&RobotSet::set_poses>, nb::arg("poses"))
        .def("set_twists", &set<&RobotSet::set_twists>, nb::arg("twists"))
        .def("set_joint_positions", &set<&RobotSet::set_joint_positions>, nb::arg("positions"))
        .def("set_joint_velocities", &set<&RobotSet::set_joint_velocities>, nb::arg("velocities"))
        .def(
            "set_joints",
            [](Robots& r, const std::vector<std::size_t>& columns, std::uint32_t mode, const In& targets,
               double max_effort) {
                raise_if_refused(r.set.set_joints(r.simulation->run(), columns, static_cast<MotorMode>(mode),
                                                  numbers(targets), max_effort));
            },
            nb::arg("columns"), nb::arg("mode"), nb::arg("targets"), nb::arg("max_effort"))
        .def(
            "apply_wrenches",
            [](Robots& r, std::uint32_t link, const In& wrenches, Tick ticks) {
                raise_if_refused(
                    r.set.apply_wrenches(r.simulation->run(), LinkId(link), numbers(wrenches), ticks));
            },
            nb::arg("link"), nb::arg("wrenches"), nb::arg("ticks"))
        .def(
            "command",
            [](Robots& r, std::size_t channel, std::size_t values, const In& rows) {
                raise_if_refused(r.set.command(r.simulation->run(), channel, values, numbers(rows)));
            },
            nb::arg("channel"), nb::arg("values"), nb::arg("rows"));
    module.def("robots", &make, nb::arg("simulation"), nb::arg("ids"));
}

}  // namespace roboss_python
