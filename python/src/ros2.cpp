// The topics of ROS 2 of a run, and their messages at its ticks.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "roboss/ros2/robot_topics.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// (name, type, hash, definition, whether it is latched) of each topic.
nb::list topics_of(const ros2::RobotTopics& topics) {
    nb::list result;
    for (const ros2::Topic& topic : topics.topics())
        result.append(nb::make_tuple(topic.name, topic.type->name, topic.type->hash, topic.type->definition,
                                     topic.is_latched));
    return result;
}

/// (number of the topic, bytes) of each message.
nb::list listed(const std::vector<ros2::RobotTopics::Message>& messages) {
    nb::list result;
    for (const ros2::RobotTopics::Message& message : messages)
        result.append(nb::make_tuple(message.topic, nb::bytes(message.bytes.data(), message.bytes.size())));
    return result;
}

/// The messages at the present tick of a run of the same world.
nb::list messages(ros2::RobotTopics& topics, const std::shared_ptr<Simulation>& simulation) {
    RunAccess& run = simulation->access();
    const auto found = without_gil({simulation}, [&] {
        return topics.messages(run.tick(), run.states(),
                               [&](RobotId robot, std::size_t sensor) -> Result<std::optional<Sample>> {
                                   Result<Sample> sample = run.read(robot, sensor);
                                   if (!sample) return sample.error();
                                   return std::optional(std::move(sample).value());
                               });
    });
    if (!found) raise("SensorError", found.error());
    return listed(found.value());
}

}  // namespace

void bind_ros2(nb::module_& module) {
    nb::class_<ros2::RobotTopics>(module, "Ros2Topics")
        .def("__init__",
             [](ros2::RobotTopics* self, const std::shared_ptr<Simulation>& simulation) {
                 new (self) ros2::RobotTopics(simulation->model());
             })
        .def_prop_ro("topics", &topics_of)
        .def_prop_ro("left_out", &ros2::RobotTopics::left_out)
        .def("select", &ros2::RobotTopics::select)
        .def("latched", [](const ros2::RobotTopics& self, Tick tick) { return listed(self.latched(tick)); })
        .def("messages", &messages);
}

}  // namespace roboss_python
