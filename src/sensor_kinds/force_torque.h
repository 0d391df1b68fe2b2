// The force-torque sensor of a joint (SDF: force_torque in a <joint>): what the joint passes on.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "math/vec3.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a force-torque sensor measures: the mean over the tick that begins at `tick`, the motor's share
/// included.
struct ForceTorqueReading {
    Vec3 force;     ///< N
    Vec3 torque;    ///< N m, about the joint's origin; in the sensor's frame about the sensor's origin
    Tick tick = 0;  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"force", "N"}, r.force);
        visit({"torque", "N m"}, r.torque);
    }
};

/// It stands on the joint's child link, at the sensor's pose in the joint frame.
struct ForceTorqueSpec {
    using Reading = ForceTorqueReading;  ///< what it measures

    std::string joint;                          ///< that it measures, of the same robot
    std::string frame = "child",                ///< of the axes: "child", "parent" (link) or "sensor"
        measure_direction = "child_to_parent";  ///< on the parent; "parent_to_child": on the child
    NoiseSpec force_x,                          ///< N
        force_y,                                ///< N
        force_z;                                ///< N
    NoiseSpec torque_x,                         ///< N m
        torque_y,                               ///< N m
        torque_z;                               ///< N m

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 36,
                                      .name = "force_torque",
                                      .phrase = "a force-torque sensor",
                                      .sdf_types = "force_torque",
                                      .block = "force_torque",
                                      .needs_all_states = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint", "roboss:joint"}, s.joint);
        visit({"frame", "frame"}, s.frame);
        visit({"measure_direction", "measure_direction"}, s.measure_direction);
        visit({"force_x", "force/x/noise", "N"}, s.force_x);
        visit({"force_y", "force/y/noise", "N"}, s.force_y);
        visit({"force_z", "force/z/noise", "N"}, s.force_z);
        visit({"torque_x", "torque/x/noise", "N m"}, s.torque_x);
        visit({"torque_y", "torque/y/noise", "N m"}, s.torque_y);
        visit({"torque_z", "torque/z/noise", "N m"}, s.torque_z);
    }
    /// Compares all members.
    friend bool operator==(const ForceTorqueSpec&, const ForceTorqueSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (joint.empty())
            problems.push_back(
                {"is in no joint", "Put a force-torque sensor in the <joint> that it measures."});
        if (frame != "child" && frame != "parent" && frame != "sensor")
            problems.push_back({"has the <frame> '" + frame + "'", "Write child, parent or sensor."});
        if (measure_direction != "child_to_parent" && measure_direction != "parent_to_child")
            problems.push_back({"has the <measure_direction> '" + measure_direction + "'",
                                "Write child_to_parent or parent_to_child."});
    }
};

}  // namespace roboss
