// The parts of the module, one function for each file.
#pragma once

#include <nanobind/nanobind.h>

namespace roboss_python {

void bind_world(nanobind::module_& module);
void bind_simulation(nanobind::module_& module);
void bind_saves(nanobind::module_& module);
void bind_journal(nanobind::module_& module);
void bind_batch(nanobind::module_& module);
void bind_robots(nanobind::module_& module);
void bind_readings(nanobind::module_& module);
void bind_sensor_facts(nanobind::module_& module);
void bind_remote(nanobind::module_& module);
void bind_camera(nanobind::module_& module);
void bind_view(nanobind::module_& module);
void bind_kinematics(nanobind::module_& module);
void bind_ros2(nanobind::module_& module);

}  // namespace roboss_python
