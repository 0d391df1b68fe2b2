// RobotSet: arrays of some robots of a Simulation. Rows and columns are checked in Python; sizes are checked
// again in C++.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "bindings.h"
#include "roboss/local/robot_set.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// Some robots, and the simulations of one world that they are in.
struct Robots {
    Simulations simulations;
    RobotSet set;

    /// Calls visit(run, part) with each run and its part of the array.
    template <class T, class Visit>
    void for_each(std::span<T> array, Visit visit) const {
        const std::size_t part = array.size() / std::max<std::size_t>(1, simulations.size());
        for (std::size_t i = 0; i < simulations.size(); ++i)
            visit(simulations[i]->access(), array.subspan(i * part, part));
    }
};

void raise_if_refused(const Result<>& result) {
    if (!result) raise("OrderError", result.error());
}

/// A method that fills an array: the method of RobotSet, called with the run.
template <void (RobotSet::*Read)(const RunAccess&, std::span<double>) const>
void fill(Robots& robots, const Out& out) {
    robots.for_each(numbers(out),
                    [&](RunAccess& run, std::span<double> part) { (robots.set.*Read)(run, part); });
}

template <void (RobotSet::*Read)(const RunAccess&, LinkId, std::span<double>) const>
void fill_link(Robots& robots, std::uint32_t link, const Out& out) {
    robots.for_each(numbers(out), [&](RunAccess& run, std::span<double> part) {
        (robots.set.*Read)(run, LinkId(link), part);
    });
}

/// Fills flags, a row for each simulation, without the GIL: it steps copies of the states.
void touching(Robots& robots, const nb::ndarray<bool, nb::c_contig, nb::device::cpu>& out) {
    std::vector<RunAccess*> runs;
    for (const auto& simulation : robots.simulations) runs.push_back(&simulation->access());
    const std::size_t row = robots.set.size();
    ROBOSS_CHECK(out.size() == runs.size() * row, std::to_string(out.size()) + " flags");
    without_gil(robots.simulations, [&] {
        for (std::size_t i = 0; i < runs.size(); ++i)
            robots.set.touching(*runs[i], {out.data() + i * row, row});
    });
}

/// A method that sets something from an array.
template <Result<> (RobotSet::*Set)(RunAccess&, std::span<const double>) const>
void set(Robots& robots, const In& values) {
    robots.for_each(numbers(values), [&](RunAccess& run, std::span<const double> part) {
        raise_if_refused((robots.set.*Set)(run, part));
    });
}

Robots make(Simulations simulations, const std::vector<std::uint32_t>& ids) {
    std::vector<RobotId> robots;
    for (const std::uint32_t id : ids) robots.emplace_back(id);
    RobotSet set(simulations.front()->model(), std::move(robots));
    return {std::move(simulations), std::move(set)};
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
        .def("touching", &touching, nb::arg("out"))
        .def("set_poses", &set<&RobotSet::set_poses>, nb::arg("poses"))
        .def("set_twists", &set<&RobotSet::set_twists>, nb::arg("twists"))
        .def("set_joint_positions", &set<&RobotSet::set_joint_positions>, nb::arg("positions"))
        .def("set_joint_velocities", &set<&RobotSet::set_joint_velocities>, nb::arg("velocities"))
        .def(
            "set_joints",
            [](Robots& r, const std::vector<std::size_t>& columns, std::uint32_t mode, const In& targets,
               double max_effort) {
                r.for_each(numbers(targets), [&](RunAccess& run, std::span<const double> part) {
                    raise_if_refused(
                        r.set.set_joints(run, columns, static_cast<MotorMode>(mode), part, max_effort));
                });
            },
            nb::arg("columns"), nb::arg("mode"), nb::arg("targets"), nb::arg("max_effort"))
        .def(
            "apply_wrenches",
            [](Robots& r, std::uint32_t link, const In& wrenches, Tick ticks) {
                r.for_each(numbers(wrenches), [&](RunAccess& run, std::span<const double> part) {
                    raise_if_refused(r.set.apply_wrenches(run, LinkId(link), part, ticks));
                });
            },
            nb::arg("link"), nb::arg("wrenches"), nb::arg("ticks"))
        .def(
            "command",
            [](Robots& r, std::size_t channel, std::size_t values, const In& rows) {
                r.for_each(numbers(rows), [&](RunAccess& run, std::span<const double> part) {
                    raise_if_refused(r.set.command(run, channel, values, part));
                });
            },
            nb::arg("channel"), nb::arg("values"), nb::arg("rows"));
    module.def("robots", &make, nb::arg("simulations"), nb::arg("ids"));
}

}  // namespace roboss_python
