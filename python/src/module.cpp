// roboss._core: the C++ side of the package. It has no docstrings for users: they stand in the Python
// modules, which check arguments, look names up, and pass arrays that are of the right shape and contiguous.
#include "bindings.h"

NB_MODULE(_core, module) {
    module.doc() = "The C++ side of the package roboss; programs use roboss itself.";
    roboss_python::bind_view(module);
    roboss_python::bind_world(module);
    roboss_python::bind_saves(module);
    roboss_python::bind_simulation(module);
    roboss_python::bind_batch(module);
    roboss_python::bind_robots(module);
    roboss_python::bind_readings(module);
    roboss_python::bind_sensor_facts(module);
    roboss_python::bind_remote(module);
    roboss_python::bind_camera(module);
    roboss_python::bind_journal(module);
    roboss_python::bind_kinematics(module);
    roboss_python::bind_ros2(module);
}
