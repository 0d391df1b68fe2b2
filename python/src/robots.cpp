// RobotSet: arrays of some robots of a Simulation. Rows and columns are checked in Python; sizes are checked
// again in C++.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>

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
    std::shared_ptr<const RobotSet> robots;
    std::array<std::shared_ptr<LiveArray>, 4> live{};  // those that were asked for, by Property

    const RobotSet& set() const { return *robots; }

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

enum class Property { kPose, kTwist, kJointPosition, kJointVelocity };

std::shared_ptr<LiveArray> make_live(const Robots& robots, Property property) {
    const std::size_t parts = robots.simulations.size(), axes = robots.set().axes().size();
    const auto make = [&](LiveArray::Read read, std::size_t columns) {
        return std::make_shared<LiveArray>(robots.robots, read, columns, parts);
    };
    switch (property) {
        case Property::kPose:
            return make(&RobotSet::poses, RobotSet::kPoseColumns);
        case Property::kTwist:
            return make(&RobotSet::twists, RobotSet::kTwistColumns);
        case Property::kJointPosition:
            return make(&RobotSet::joint_positions, axes);
        case Property::kJointVelocity:
            break;
    }
    return make(&RobotSet::joint_velocities, axes);
}

/// The array of a property, up to date; from then on the simulations feed it. `is_single`: without an axis of
/// simulations.
template <Property P>
LiveArray::Array live(Robots& robots, bool is_single) {
    for (const auto& simulation : robots.simulations)
        (void)simulation->access();  // raises before anything is changed
    std::shared_ptr<LiveArray>& array = robots.live[static_cast<std::size_t>(P)];
    const bool is_new = !array;
    if (is_new) array = make_live(robots, P);
    for (std::size_t i = 0; i < robots.simulations.size(); ++i) {
        if (is_new) robots.simulations[i]->feed(array, i);
        array->update(i, robots.simulations[i]->access());
    }
    return LiveArray::array(array, is_single);
}

template <void (RobotSet::*Read)(const RunAccess&, std::span<double>) const>
void fill(Robots& robots, const Out& out) {
    robots.for_each(numbers(out),
                    [&](RunAccess& run, std::span<double> part) { (robots.set().*Read)(run, part); });
}

template <void (RobotSet::*Read)(const RunAccess&, std::size_t, std::span<double>) const>
void fill_link(Robots& robots, std::size_t link, const Out& out) {
    robots.for_each(numbers(out),
                    [&](RunAccess& run, std::span<double> part) { (robots.set().*Read)(run, link, part); });
}

/// Fills flags, a row for each simulation, without the GIL: it steps copies of the states.
void touching(Robots& robots, const nb::ndarray<bool, nb::c_contig, nb::device::cpu>& out) {
    const std::size_t row = robots.set().size();
    ROBOSS_CHECK(out.size() == robots.simulations.size() * row, std::to_string(out.size()) + " flags");
    for_each_run(robots.simulations, [&](std::size_t i, RunAccess& run) {
        robots.set().touching(run, {out.data() + i * row, row});
    });
}

/// Raises the first refusal, after all that was done is seen.
void finish_change(Robots& robots, const Result<>& done) {
    for (const auto& simulation : robots.simulations) simulation->refresh();
    raise_if_refused(done);
}

/// A method that sets something from an array.
template <Result<> (RobotSet::*Set)(RunAccess&, std::span<const double>) const>
void set(Robots& robots, const In& values) {
    Result<> done = Ok{};
    robots.for_each(numbers(values), [&](RunAccess& run, std::span<const double> part) {
        if (done) done = (robots.set().*Set)(run, part);
    });
    finish_change(robots, done);
}

void set_joints(Robots& robots, const std::vector<std::size_t>& columns, std::uint32_t mode,
                const In& targets, double max_effort, const MaybeIn& position_gain,
                const MaybeIn& velocity_gain) {
    const std::span<const double> all = numbers(targets);
    const auto part_of = [&](const MaybeIn& gain, std::span<const double> part) {
        const std::span<const double> values = numbers(gain);
        if (values.empty()) return values;
        return values.subspan(static_cast<std::size_t>(part.data() - all.data()), part.size());
    };
    robots.for_each(all, [&](RunAccess& run, std::span<const double> part) {
        raise_if_refused(
            robots.set().set_joints(run, columns, static_cast<MotorMode>(mode), part, max_effort,
                                    {part_of(position_gain, part), part_of(velocity_gain, part)}));
    });
}

/// Fills the array of one number of all joints or links: what robots have (Read), or what the file has
/// (ReadFile).
template <class Parameter, auto Read, auto ReadFile>
void fill_parameters(Robots& robots, std::size_t parameter, bool of_file, const Out& out) {
    const auto which = static_cast<Parameter>(parameter);
    robots.for_each(numbers(out), [&](RunAccess& run, std::span<double> part) {
        if (of_file)
            (robots.set().*ReadFile)(which, part);
        else
            (robots.set().*Read)(run, which, part);
    });
}

template <class Parameter, auto Set>
void set_parameters(Robots& robots, const std::vector<std::size_t>& columns,
                    const std::vector<std::size_t>& parameters, const In& values) {
    std::vector<Parameter> which;
    for (const std::size_t parameter : parameters) which.push_back(static_cast<Parameter>(parameter));
    Result<> done = Ok{};
    robots.for_each(numbers(values), [&](RunAccess& run, std::span<const double> part) {
        if (done) done = (robots.set().*Set)(run, columns, which, part);
    });
    finish_change(robots, done);
}

template <auto Reset>
void reset_parameters(Robots& robots, const std::vector<std::size_t>& columns) {
    Result<> done = Ok{};
    for (const auto& simulation : robots.simulations)
        if (done) done = (robots.set().*Reset)(simulation->access(), columns);
    finish_change(robots, done);
}

/// Methods for the numbers of joints and links, gravity and wind.
void bind_parameters(nb::class_<Robots>& robots) {
    using Joint = JointParameter;
    using Link = LinkParameter;
    robots
        .def("joint_parameters",
             &fill_parameters<Joint, &RobotSet::joint_parameters, &RobotSet::file_parameters>,
             nb::arg("parameter"), nb::arg("of_file"), nb::arg("out"))
        .def("set_joint_parameters", &set_parameters<Joint, &RobotSet::set_joint_parameters>,
             nb::arg("columns"), nb::arg("parameters"), nb::arg("values"))
        .def("reset_joint_parameters", &reset_parameters<&RobotSet::reset_joint_parameters>,
             nb::arg("columns"))
        .def("link_parameters",
             &fill_parameters<Link, &RobotSet::link_parameters, &RobotSet::file_link_parameters>,
             nb::arg("parameter"), nb::arg("of_file"), nb::arg("out"))
        .def("set_link_parameters", &set_parameters<Link, &RobotSet::set_link_parameters>, nb::arg("columns"),
             nb::arg("parameters"), nb::arg("values"))
        .def("reset_link_parameters", &reset_parameters<&RobotSet::reset_link_parameters>, nb::arg("columns"))
        .def("surroundings",
             &fill_parameters<Surrounding, &RobotSet::surroundings, &RobotSet::file_surroundings>,
             nb::arg("parameter"), nb::arg("of_file"), nb::arg("out"))
        .def("set_surroundings", &set_parameters<Surrounding, &RobotSet::set_surroundings>,
             nb::arg("columns"), nb::arg("parameters"), nb::arg("values"))
        .def("reset_surroundings", &reset_parameters<&RobotSet::reset_surroundings>, nb::arg("columns"));
}

Robots make_robots(Simulations simulations, const std::vector<std::uint32_t>& ids) {
    std::vector<RobotId> robots;
    for (const std::uint32_t id : ids) robots.emplace_back(id);
    auto set = std::make_shared<RobotSet>(simulations.front()->model(), std::move(robots));
    return {std::move(simulations), std::move(set)};
}

}  // namespace

void bind_robots(nb::module_& module) {
    nb::class_<Robots> bound(module, "Robots");
    bound.def("pose", &live<Property::kPose>, nb::arg("single"))
        .def("twist", &live<Property::kTwist>, nb::arg("single"))
        .def("joint_position", &live<Property::kJointPosition>, nb::arg("single"))
        .def("joint_velocity", &live<Property::kJointVelocity>, nb::arg("single"))
        .def("link_poses", &fill_link<&RobotSet::link_poses>, nb::arg("link"), nb::arg("out"))
        .def("link_twists", &fill_link<&RobotSet::link_twists>, nb::arg("link"), nb::arg("out"))
        .def("joint_efforts", &fill<&RobotSet::joint_efforts>, nb::arg("out"))
        .def("energies", &fill<&RobotSet::energies>, nb::arg("out"))
        .def("touching", &touching, nb::arg("out"))
        .def("set_poses", &set<&RobotSet::set_poses>, nb::arg("poses"))
        .def("set_twists", &set<&RobotSet::set_twists>, nb::arg("twists"))
        .def("set_joint_positions", &set<&RobotSet::set_joint_positions>, nb::arg("positions"))
        .def("set_joint_velocities", &set<&RobotSet::set_joint_velocities>, nb::arg("velocities"))
        .def("set_joints", &set_joints, nb::arg("columns"), nb::arg("mode"), nb::arg("targets"),
             nb::arg("max_effort"), nb::arg("position_gain").none(), nb::arg("velocity_gain").none())
        .def(
            "apply_wrenches",
            [](Robots& r, std::optional<std::size_t> link, const In& wrenches, Tick ticks) {
                r.for_each(numbers(wrenches), [&](RunAccess& run, std::span<const double> part) {
                    raise_if_refused(r.set().apply_wrenches(run, link, part, ticks));
                });
            },
            nb::arg("link").none(), nb::arg("wrenches"), nb::arg("ticks"))
        .def(
            "command",
            [](Robots& r, std::size_t channel, std::size_t values, const In& rows) {
                r.for_each(numbers(rows), [&](RunAccess& run, std::span<const double> part) {
                    raise_if_refused(r.set().command(run, channel, values, part));
                });
            },
            nb::arg("channel"), nb::arg("values"), nb::arg("rows"));
    bind_parameters(bound);
    std::vector<std::tuple<std::string, std::string, std::string>> parameters;
    for (const JointParameterInfo& row : joint_parameters())
        parameters.emplace_back(row.name, row.turning, row.sliding);
    module.attr("joint_parameters") = parameters;  // name, unit of axes that turn, unit of those that slide
    std::vector<std::pair<std::string, std::string>> of_links;
    for (const LinkParameterInfo& row : link_parameters()) of_links.emplace_back(row.name, row.unit);
    module.attr("link_parameters") = of_links;  // name, unit
    std::vector<std::pair<std::string, std::string>> of_surroundings;
    for (const SurroundingInfo& row : surroundings()) of_surroundings.emplace_back(row.name, row.unit);
    module.attr("surroundings") = of_surroundings;  // name, unit
    module.def("robots", &make_robots, nb::arg("simulations"), nb::arg("ids"));
}

}  // namespace roboss_python
